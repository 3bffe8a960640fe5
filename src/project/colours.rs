//! Colours of a lens: an interior orientation for each, as differences from the camera's own.
//!
//! A lens refracts red and blue otherwise than green, so that it images them with another principal distance, principal point and
//! distortion. A camera's own parameters are those of the colour it was calibrated in, green or grey. What is added to them for red and blue
//! is held: it is known to a few hundredths of a pixel from one photo ([`crate::camera::colour_differences`]), and the parameters it is added
//! to stay the only unknowns. With parameters p and differences d every equation of a photo measured in red is that of p + d; as d is
//! constant, the derivatives by p are those by p + d.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::validation::{LARGEST, invalid};
use super::{Camera, Interior, Parameter, Photo};
use crate::error::{Error, Place, Reason, Result, Thing};

/// A colour that a lens images otherwise than green.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LensColour {
    /// Red.
    Red,
    /// Blue.
    Blue,
}

impl LensColour {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Red, Self::Blue];

    /// Name in the project format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Blue => "blue",
        }
    }
}

/// What is added to a camera's parameters for a colour, in their own units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ColourDifferences {
    /// By parameter; 0 where one is missing. `f` moves fx and keeps the ratio fy : fx.
    pub parameters: BTreeMap<Parameter, f64>,
    /// Their standard errors, where known.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sigma: BTreeMap<Parameter, f64>,
}

impl Interior {
    /// The parameters with differences added to those that are known.
    pub fn plus(mut self, differences: &BTreeMap<Parameter, f64>) -> Self {
        for (&parameter, difference) in differences {
            if let Some(value) = self.get(parameter) {
                self.set(parameter, value + difference);
            }
        }
        self
    }
}

impl Camera {
    /// What is added to the parameters for a photo: the set of the colour it was measured in, where the camera has one.
    pub fn differences_of(&self, photo: &Photo) -> Option<&BTreeMap<Parameter, f64>> {
        Some(&self.colours.get(&photo.colour?)?.parameters)
    }

    /// The camera as it took a photo: with the photo's own interior orientation, in the colour it was measured in. This is what images the
    /// photo's points; it has no colours left.
    pub fn of_photo(&self, photo: &Photo) -> Self {
        let own = photo.interior.filter(|_| self.per_photo).unwrap_or(self.interior);
        let interior = self.differences_of(photo).map_or(own, |differences| own.plus(differences));
        Self { interior, colours: BTreeMap::new(), ..self.clone() }
    }

    /// Parameters that the model has, numbers, a principal distance that stays one, f or fx and fy.
    pub(super) fn validate_colours(&self) -> Result<()> {
        for (colour, set) in &self.colours {
            let at =
                |p: &Parameter| Place::camera(&self.id).with_field(format!("colours.{}.{}", colour.name(), p.name()));
            for p in set.parameters.keys().chain(set.sigma.keys()) {
                if !self.interior.parameters().contains(p) {
                    return Err(Error::Unknown { kind: Thing::Parameter, name: p.name().into(), at: at(p) });
                }
            }
            for (p, difference) in &set.parameters {
                if !(difference.abs() < LARGEST) {
                    return invalid(Reason::ParameterNotFinite, at(p));
                }
                let distance = matches!(p, Parameter::C | Parameter::F | Parameter::Fx | Parameter::Fy);
                if distance && self.interior.get(*p).is_some_and(|own| own + difference <= 0.0) {
                    return invalid(Reason::PrincipalDistance, at(p));
                }
            }
            if let Some((p, _)) = set.sigma.iter().find(|(_, sigma)| !(**sigma >= 0.0 && **sigma < LARGEST)) {
                return invalid(Reason::NegativeSigma, at(p));
            }
            let has = |p: Parameter| set.parameters.contains_key(&p);
            if has(Parameter::F) && (has(Parameter::Fx) || has(Parameter::Fy)) {
                return invalid(Reason::FocalLengthTwice, at(&Parameter::F));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Project;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn camera() -> Camera {
        let set = |p: Parameter, d: f64| ColourDifferences { parameters: [(p, d)].into(), sigma: [(p, 0.5)].into() };
        let mut camera = Camera::new("k", 100, 80, Interior::brown(90.0));
        camera.colours =
            [(LensColour::Red, set(Parameter::C, 0.25)), (LensColour::Blue, set(Parameter::K1, -1e-3))].into();
        camera
    }

    fn photo(colour: Option<LensColour>) -> Photo {
        Photo { id: "1".into(), camera: "k".into(), colour, enabled: true, ..Photo::default() }
    }

    #[test]
    fn a_photo_is_imaged_in_the_colour_it_was_measured_in() {
        let mut camera = camera();
        let c = |camera: &Camera, colour| camera.of_photo(&photo(colour)).interior.get(Parameter::C);
        assert_eq!(
            [None, Some(LensColour::Red), Some(LensColour::Blue)].map(|x| c(&camera, x)),
            [90.0, 90.25, 90.0].map(Some)
        );
        assert_eq!(camera.of_photo(&photo(Some(LensColour::Blue))).interior.get(Parameter::K1), Some(-1e-3));
        // of its own interior orientation where there is one a photo, and of the camera's where not
        let own = Photo { interior: Some(Interior::brown(80.0)), ..photo(Some(LensColour::Red)) };
        assert_eq!(camera.of_photo(&own).interior.get(Parameter::C), Some(90.25));
        camera.per_photo = true;
        assert_eq!(camera.of_photo(&own).interior.get(Parameter::C), Some(80.25));
        // a principal distance that is not known does not become one
        if let Interior::Brown { c, .. } = &mut camera.interior {
            *c = None;
        }
        assert_eq!(c(&camera, Some(LensColour::Red)), None);
    }

    #[test]
    fn a_document_keeps_its_colours_and_one_without_them_its_text() {
        let mut project = Project {
            cameras: vec![camera()],
            photos: vec![photo(Some(LensColour::Red))].into(),
            ..Project::default()
        };
        project.validate().expect("sound");
        let text = serde_json::to_string(&project).expect("a document");
        assert!(text.contains(r#""colours":{"red":{"parameters":{"c":0.25},"sigma":{"c":0.5}},"blue":"#), "{text}");
        assert_eq!(serde_json::from_str::<Project>(&text).expect("a document"), project);
        project.cameras[0].colours.clear();
        project.photos[0].colour = None;
        let text = serde_json::to_string(&project).expect("a document");
        assert!(!text.contains("colour"), "{text}");
    }

    #[test]
    fn every_fault_of_a_set_is_placed() {
        let faults = [
            (Parameter::Fx, 1.0, 0.5, "unknown", "colours.red.fx"),
            (Parameter::C, f64::NAN, 0.5, "invalid", "colours.red.c"),
            (Parameter::C, -90.0, 0.5, "invalid", "colours.red.c"),
            (Parameter::K1, 1.0, -0.5, "invalid", "colours.red.k1"),
        ];
        for (p, difference, sigma, code, place) in faults {
            let mut camera = camera();
            let set = ColourDifferences { parameters: [(p, difference)].into(), sigma: [(p, sigma)].into() };
            camera.colours.insert(LensColour::Red, set);
            let error = Project { cameras: vec![camera], ..Project::default() }.validate().expect_err("a fault");
            assert_eq!(error.code(), code, "{error}");
            assert!(error.to_string().contains(place), "{error}");
        }
    }
}
