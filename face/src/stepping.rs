//! An adjustment that is run step by step, as an object with functions: a class would have to be freed by its user.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::Object;
use sightline::adjust::Adjuster;
use wasm_bindgen::prelude::*;

use crate::fault::thrown;
use crate::value;

/// The functions `step`, `back`, `state` and `finish` of an adjustment.
pub fn object(adjuster: Adjuster) -> JsValue {
    let adjuster = Rc::new(RefCell::new(adjuster));
    let object = Object::new();
    let function = |name: &str, call: fn(&mut Adjuster) -> sightline::Result<JsValue>| {
        let adjuster = Rc::clone(&adjuster);
        let called = move || call(&mut adjuster.borrow_mut()).map_err(|error| thrown(&error));
        let closure: Closure<dyn FnMut() -> Result<JsValue, JsValue>> = Closure::new(called);
        value::set(&object, name, &closure.into_js_value());
    };
    function("step", |adjuster| adjuster.step().map(value::write));
    function("back", |adjuster| Ok(value::write(adjuster.back())));
    function("state", |adjuster| Ok(value::write(adjuster.state())));
    function("finish", |adjuster| adjuster.finish().map(value::adjustment_object));
    object.into()
}
