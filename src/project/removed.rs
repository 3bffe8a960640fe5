//! Fields that documents of earlier versions have and the format no longer has. The reader of a document passes over them; they are counted
//! here and named in `origin.ignored`.
//!
//! Earlier versions corrected image coordinates by lateral colour: a camera had differences of its parameters for red and blue (`colours`), a
//! photo the colour that its centres were measured in (`colour`), and the report what was measured of the lens (`report.colours`).

use serde::Deserialize;
use serde_json::Value;

use super::{Ignored, Origin, Project};

/// How many items of a document have a field that was removed from the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RemovedFields {
    /// Cameras with parameter differences for red or blue.
    pub cameras: usize,
    /// Photos with the colour that they were measured in.
    pub photos: usize,
    /// Photos whose lateral colour the report showed.
    pub reported: usize,
}

impl RemovedFields {
    /// Name of the cameras' fields in `ignored`.
    pub const OF_CAMERAS: &str = "lateral colour of cameras, and results computed with it";
    /// Name of the photos' fields in `ignored`.
    pub const OF_PHOTOS: &str = "colours that photos were measured in";
    /// Name of the report's fields in `ignored`.
    pub const OF_REPORT: &str = "lateral colour in the report";
    /// All three.
    pub const NAMES: [&str; 3] = [Self::OF_CAMERAS, Self::OF_PHOTOS, Self::OF_REPORT];

    /// From the JSON that a document was read from.
    pub fn of(json: &str) -> Self {
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Fields {
            colour: Value,
            colours: Value,
        }
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Document {
            cameras: Vec<Fields>,
            photos: Vec<Fields>,
            report: Fields,
        }
        // Documents without these fields are not read twice.
        if !json.contains("\"colour") {
            return Self::default();
        }
        let Ok(document) = serde_json::from_str::<Document>(json) else { return Self::default() };
        Self {
            cameras: document.cameras.iter().filter(|camera| count_entries(&camera.colours) > 0).count(),
            photos: document.photos.iter().filter(|photo| !photo.colour.is_null()).count(),
            reported: count_entries(&document.report.colours),
        }
    }

    /// Names them in the origin of the document that was read.
    pub fn note_in(self, project: &mut Project) {
        note_removed(&mut project.origin, Self::OF_CAMERAS, self.cameras);
        note_removed(&mut project.origin, Self::OF_PHOTOS, self.photos);
        note_removed(&mut project.origin, Self::OF_REPORT, self.reported);
    }

    /// Whether an adjustment was computed with lateral colour: then it does not belong to the document as it is read now. Text behind the JSON
    /// of the adjustment is not read.
    pub fn in_adjustment(json: &str) -> bool {
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Camera {
            colours: Value,
        }
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Adjustment {
            cameras: Vec<Camera>,
        }
        let read = || Adjustment::deserialize(&mut serde_json::Deserializer::from_str(json));
        json.contains("\"colours\"")
            && read().is_ok_and(|read| read.cameras.iter().any(|camera| count_entries(&camera.colours) > 0))
    }
}

/// Names removed fields in an origin; reading the same document again does not count them twice.
pub(crate) fn note_removed(origin: &mut Option<Box<Origin>>, name: &str, count: usize) {
    if count == 0 {
        return;
    }
    let earlier = || Box::new(Origin { format: Origin::EARLIER.into(), ..Origin::default() });
    let ignored = &mut origin.get_or_insert_with(earlier).ignored;
    match ignored.iter_mut().find(|known| known.name == name) {
        Some(known) => known.count = known.count.max(count),
        None => ignored.push(Ignored { name: name.into(), count }),
    }
}

/// Entries of a table or a list.
pub(crate) fn count_entries(value: &Value) -> usize {
    value.as_object().map_or(0, serde_json::Map::len) + value.as_array().map_or(0, Vec::len)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// A document as the version before wrote it.
    const EARLIER: &str = r#"{"format": "sightline", "version": 1,
        "cameras": [
            {"id": "k", "width": 100, "height": 80, "model": "brown", "c": 90.0,
             "colours": {"red": {"parameters": {"c": 0.25}, "sigma": {"c": 0.5}}, "blue": {"parameters": {"k1": -0.001}}}},
            {"id": "l", "width": 100, "height": 80, "model": "brown", "c": 90.0}],
        "photos": [
            {"id": "1", "camera": "k", "colour": "red"}, {"id": "2", "camera": "k", "colour": "blue"},
            {"id": "3", "camera": "l", "colour": null}],
        "layers": [{"id": "edges", "colour": [255, 0, 0]}],
        "report": {"colours": [{"photo": "1", "corner": 64.0, "red": {"linear": 0.7, "cubic": -0.3, "sigma": 0.01, "rms": 0.02, "targets": 40}}]}}"#;

    #[test]
    fn an_earlier_document_opens_and_names_what_is_left_out() {
        let mut project: Project = serde_json::from_str(EARLIER).expect("a document");
        project.validate().expect("sound");
        let removed = RemovedFields::of(EARLIER);
        assert_eq!(removed, RemovedFields { cameras: 1, photos: 2, reported: 1 });
        removed.note_in(&mut project);
        removed.note_in(&mut project);
        let origin = project.origin.as_deref().expect("an origin");
        let named: Vec<_> = origin.ignored.iter().map(|one| (one.name.as_str(), one.count)).collect();
        assert_eq!(named, RemovedFields::NAMES.into_iter().zip([1, 2, 1]).collect::<Vec<_>>());
        assert!(!origin.is_foreign());
        // Written again, the document has none of them and still records that.
        let text = serde_json::to_string(&project).expect("text");
        assert_eq!(RemovedFields::of(&text), RemovedFields::default());
        assert_eq!(serde_json::from_str::<Project>(&text).expect("a document"), project);
    }

    #[test]
    fn the_origin_in_another_program_stays() {
        let mut project = Project {
            origin: Some(Box::new(Origin { format: "colmap".into(), ..Origin::default() })),
            ..Project::default()
        };
        RemovedFields { cameras: 2, ..RemovedFields::default() }.note_in(&mut project);
        let origin = project.origin.expect("an origin");
        assert!(origin.is_foreign() && origin.ignored.len() == 1);
        let mut other = Project::default();
        RemovedFields::of(r#"{"layers": [{"id": "edges", "colour": [0, 0, 0]}]}"#).note_in(&mut other);
        assert_eq!(other.origin, None);
    }

    #[test]
    fn an_adjustment_with_lateral_colour_is_recognised() {
        assert!(RemovedFields::in_adjustment(r#"{"cameras": [{"colours": {"red": {"parameters": {"c": 0.25}}}}]}"#));
        assert!(RemovedFields::in_adjustment(r#"{"cameras": [{"colours": {"red": {}}}]},"rows":[]}"#));
        assert!(!RemovedFields::in_adjustment(r#"{"cameras": [{"colours": {}}], "other": {"colours": {"red": 1}}}"#));
    }
}
