//! The 3-D view's own file (web/view3d/view.js), loaded when it is asked for, and its handle.

use std::collections::HashMap;

use js_sys::{Array, Float32Array, Function, Object, Promise, Reflect, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::HtmlElement;

use super::file::download_blob;
use super::picture::Picture;
use super::worker::{describe, field, set};

/// Name of the file beside the page.
const FILE: &str = "view3d.js";

/// The drawn objects; coordinates relative to the centre of the object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Tells objects apart: another one is shown as a whole.
    pub key: String,
    pub unit: String,
    pub names: Vec<String>,
    /// Three a point.
    pub points: Vec<f32>,
    /// 0 tie, 1 control, 2 check; 4 more where it has fewer than three rays or something of it was not used.
    pub roles: Vec<u8>,
    /// Nine a point, columns; empty without covariances.
    pub ellipsoids: Vec<f32>,
    /// Photos that see point k are `ray_photos[ray_start[k]..ray_start[k + 1]]`.
    pub ray_start: Vec<u32>,
    pub ray_photos: Vec<u32>,
    pub photo_names: Vec<String>,
    /// Fifteen a photo: centre and corners.
    pub photos: Vec<f32>,
    /// Six a line.
    pub lines: Vec<f32>,
    pub line_colours: Vec<u8>,
    /// Six a measured distance.
    pub distances: Vec<f32>,
    /// Place and vector of control and check differences.
    pub residuals: Vec<f32>,
    /// Outlines of features, six a piece.
    pub forms: Vec<f32>,
    /// Surfaces of features as triangles, nine numbers each; those of the chosen feature apart.
    pub surfaces: Vec<f32>,
    pub chosen_surface: Vec<f32>,
    /// Place and vector of the deviations of the chosen feature, and their signs.
    pub sticks: Vec<f32>,
    pub stick_signs: Vec<i8>,
    pub labels: Vec<SceneLabel>,
    /// Low and high corner of the points.
    pub bounds: [f32; 6],
    pub size: f64,
    /// Mesh of the grid.
    pub grid: f64,
}

/// A label in the scene: the name of a feature, or of a control point that was not used. The latter is always shown.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLabel {
    pub words: String,
    pub place: [f32; 3],
    pub chosen: bool,
    pub warning: bool,
}

/// Selection, layers and exaggerations of the 3-D view.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneState {
    pub selected: Option<usize>,
    pub photo: Option<usize>,
    pub chosen: Vec<usize>,
    /// The shown objects, as text from the view.
    pub shown: Vec<(&'static str, bool)>,
    /// Exaggeration of ellipsoids, and of vectors.
    pub factor: f64,
    pub sticks: f64,
    /// Direction that "along" looks along.
    pub along: Option<[f64; 3]>,
}

/// The object under a click.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Met {
    Nothing,
    Point {
        index: usize,
        more: bool,
    },
    Photo(usize),
    /// The graphics were taken away.
    Lost,
}

/// Handle of an open 3-D view, which closes when the handle is dropped.
pub struct SceneView {
    handle: JsValue,
    _tell: Closure<dyn FnMut(String, f64, bool)>,
}

impl SceneView {
    /// Loads the view and puts it into an element.
    ///
    /// # Errors
    /// Without WebGL, and where the file cannot be loaded: in words.
    pub async fn open(host: HtmlElement, mut on_met: impl FnMut(Met) + 'static) -> Result<Self, String> {
        let load = field(&js_sys::global(), "sightlineLoad");
        let load: Function = load.dyn_into().map_err(|_| "this build has no 3-D view".to_owned())?;
        let promise = load.call1(&JsValue::UNDEFINED, &FILE.into()).map_err(|e| describe(&e))?;
        let promise: Promise = promise.dyn_into().map_err(|e| describe(&e))?;
        let module = JsFuture::from(promise).await.map_err(|e| describe(&e))?;
        let tell = Closure::new(move |kind: String, index: f64, more: bool| {
            on_met(match kind.as_str() {
                "point" => Met::Point { index: index as usize, more },
                "photo" => Met::Photo(index as usize),
                "lost" => Met::Lost,
                _ => Met::Nothing,
            });
        });
        let open: Function = field(&module, "open").dyn_into().map_err(|e| describe(&e))?;
        let handle = open.call2(&JsValue::UNDEFINED, &host, tell.as_ref()).map_err(|e| describe(&e))?;
        // For tests and the browser's console; it goes with the element.
        let _ = Reflect::set(&host, &"view".into(), &handle);
        Ok(Self { handle, _tell: tell })
    }

    /// Shows a scene, with a picture for each photo that has one.
    pub fn show(&self, scene: &Scene, pictures: &[Option<Picture>]) {
        let object = Object::new();
        let floats = |name: &str, values: &[f32]| set(&object, name, &Float32Array::from(values));
        floats("points", &scene.points);
        floats("ellipsoids", &scene.ellipsoids);
        floats("photos", &scene.photos);
        floats("lines", &scene.lines);
        floats("distances", &scene.distances);
        floats("residuals", &scene.residuals);
        floats("forms", &scene.forms);
        floats("surfaces", &scene.surfaces);
        floats("chosenSurface", &scene.chosen_surface);
        floats("sticks", &scene.sticks);
        floats("box", &scene.bounds);
        set(&object, "roles", &Uint8Array::from(scene.roles.as_slice()));
        set(&object, "lineColours", &Uint8Array::from(scene.line_colours.as_slice()));
        set(&object, "stickSigns", &js_sys::Int8Array::from(scene.stick_signs.as_slice()));
        set(&object, "rayStart", &Uint32Array::from(scene.ray_start.as_slice()));
        set(&object, "rayPhotos", &Uint32Array::from(scene.ray_photos.as_slice()));
        let words = |all: &[String]| all.iter().map(|s| JsValue::from_str(s)).collect::<Array>();
        set(&object, "names", &words(&scene.names));
        set(&object, "photoNames", &words(&scene.photo_names));
        let pictures = pictures.iter().map(|p| p.as_ref().map_or(JsValue::NULL, |p| p.bitmap.clone().into()));
        set(&object, "pictures", &pictures.collect::<Array>());
        let labels = scene.labels.iter().map(|label| {
            let one = Object::new();
            set(&one, "words", &label.words.as_str().into());
            set(&one, "place", &Array::from(&Float32Array::from(label.place.as_slice())));
            set(&one, "chosen", &label.chosen.into());
            set(&one, "warning", &label.warning.into());
            JsValue::from(one)
        });
        set(&object, "labels", &labels.collect::<Array>());
        set(&object, "key", &scene.key.as_str().into());
        set(&object, "unit", &scene.unit.as_str().into());
        set(&object, "size", &scene.size.into());
        set(&object, "grid", &scene.grid.into());
        self.call("show", &object);
    }

    pub fn state(&self, state: &SceneState) {
        let object = Object::new();
        let index = |n: Option<usize>| n.map_or(-1.0, |n| n as f64);
        set(&object, "selected", &index(state.selected).into());
        set(&object, "photo", &index(state.photo).into());
        set(&object, "chosen", &state.chosen.iter().map(|n| JsValue::from(*n as f64)).collect::<Array>());
        state.shown.iter().for_each(|(name, on)| set(&object, name, &(*on).into()));
        set(&object, "factor", &state.factor.into());
        set(&object, "sticks", &state.sticks.into());
        if let Some(along) = state.along {
            set(&object, "along", &along.iter().map(|x| JsValue::from(*x)).collect::<Array>());
        }
        self.call("state", &object);
    }

    /// From a side by name: home, top, front, right, along, fit.
    pub fn look(&self, name: &str) {
        self.call("look", &name.into());
    }

    /// Hands over the picture as a PNG with these lines below it.
    pub fn save(&self, name: &str, lines: &[String], on_fault: impl FnOnce(String) + 'static) {
        let lines = lines.iter().map(|s| JsValue::from_str(s)).collect::<Array>();
        let asked = self.call("picture", &lines).and_then(|promise| promise.dyn_into::<Promise>().ok());
        let name = name.to_owned();
        wasm_bindgen_futures::spawn_local(async move {
            let Some(asked) = asked else { return };
            let saved = match JsFuture::from(asked).await {
                Ok(blob) => blob
                    .dyn_into::<web_sys::Blob>()
                    .map_err(|e| describe(&e))
                    .and_then(|blob| download_blob(&name, &blob)),
                Err(error) => Err(describe(&error)),
            };
            if let Err(fault) = saved {
                on_fault(fault);
            }
        });
    }

    fn call(&self, method: &str, argument: &JsValue) -> Option<JsValue> {
        let method: Function = field(&self.handle, method).dyn_into().ok()?;
        method.call1(&self.handle, argument).ok()
    }
}

impl Drop for SceneView {
    fn drop(&mut self) {
        self.call("close", &JsValue::UNDEFINED);
    }
}

/// Numbers of names, for the scene's lists.
pub fn numbered(names: &[String]) -> HashMap<&str, usize> {
    names.iter().enumerate().map(|(k, name)| (name.as_str(), k)).collect()
}
