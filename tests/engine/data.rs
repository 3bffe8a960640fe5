//! The data with independent answers, read where it lies: the folder of the variable SIGHTLINE_DATA, else
//! `../shared/data` beside the repository. Without the folder a test says so and passes; with it, every file must be there.

/// Bytes of a file below the data folder; `None`, said aloud, where there is no such folder.
///
/// # Panics
/// When the folder is there and the file is not: on a machine that has the data, nothing is skipped.
pub fn data(path: &str) -> Option<Vec<u8>> {
    let folder = host::variable("SIGHTLINE_DATA")
        .unwrap_or_else(|| concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data").to_owned());
    if !host::exists(&folder) {
        host::say(&format!("skipped, no data ({path})"));
        return None;
    }
    Some(host::read(&format!("{folder}/{path}")))
}

/// The same as text.
pub fn text(path: &str) -> Option<String> {
    data(path).map(|bytes| String::from_utf8(bytes).unwrap_or_else(|_| panic!("{path} is not UTF-8")))
}

#[cfg(not(target_arch = "wasm32"))]
mod host {
    pub fn variable(name: &str) -> Option<String> {
        std::env::var(name).ok().filter(|value| !value.is_empty())
    }

    pub fn exists(path: &str) -> bool {
        std::path::Path::new(path).exists()
    }

    pub fn read(path: &str) -> Vec<u8> {
        std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"))
    }

    pub fn say(text: &str) {
        println!("{text}");
    }
}

#[cfg(target_arch = "wasm32")]
mod host {
    use wasm_bindgen::prelude::*;

    #[wasm_bindgen(module = "node:fs")]
    extern "C" {
        #[wasm_bindgen(js_name = existsSync)]
        pub fn exists(path: &str) -> bool;
        #[wasm_bindgen(js_name = readFileSync)]
        pub fn read(path: &str) -> Vec<u8>;
    }

    #[wasm_bindgen(module = "node:process")]
    extern "C" {
        #[wasm_bindgen(thread_local_v2, js_name = env)]
        static ENVIRONMENT: JsValue;
    }

    pub fn variable(name: &str) -> Option<String> {
        let value = ENVIRONMENT.with(|environment| js_sys::Reflect::get(environment, &JsValue::from_str(name)));
        value.ok()?.as_string().filter(|value| !value.is_empty())
    }

    pub fn say(text: &str) {
        wasm_bindgen_test::console_log!("{text}");
    }
}

mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn files_of_the_data_folder_are_read() {
        if let Some(marks) = super::text("camcal/markpts.txt") {
            assert_eq!(marks.lines().filter(|line| !line.starts_with('#')).count(), 2074);
        }
        if let Some(photo) = super::data("camcal/photos/P8250021.JPG") {
            assert_eq!(photo[..3], [0xff, 0xd8, 0xff]);
        }
    }
}
