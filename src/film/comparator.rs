//! Comparator coordinates: readings of fiducial marks and points of each photo become observations.
//!
//! A file has one reading a line: photo, mark or point, x, y in the machine's millimetres; separated by commas,
//! semicolons, tabs or blanks; `#` starts a comment, and a first line of names is skipped.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::transformation::{Kind, Transformation, fit};
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Camera, Observation, Sigma};

/// One reading.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// Photo.
    pub photo: String,
    /// Fiducial mark or object point.
    pub mark: String,
    /// To the right.
    pub x: f64,
    /// Upwards, or downwards for pixels of a scan.
    pub y: f64,
}

/// Which way the machine's y axis points, seen with its x axis to the right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Upwards {
    /// Up, as on comparators.
    #[default]
    Yes,
    /// Down, as the pixels of a scan.
    No,
}

/// How readings become observations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Setup {
    /// Calibrated photo coordinates of the fiducial marks, millimetres from the image centre, x right, y up.
    pub fiducials: BTreeMap<String, [f64; 2]>,
    /// Transformation onto them.
    pub kind: Kind,
    /// Direction of y.
    pub upwards: Upwards,
    /// Standard error of a photo coordinate, millimetres.
    pub sigma: f64,
}

/// The fiducial fit of one photo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InnerOrientation {
    /// Photo.
    pub photo: String,
    /// Marks in the order of the residuals.
    pub marks: Vec<String>,
    /// The transformation.
    pub transformation: Transformation,
}

/// Observations with the fits they went through.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// Observations in pixels of the camera's grid.
    pub observations: Vec<Observation>,
    /// One a photo.
    pub inner_orientations: Vec<InnerOrientation>,
}

/// Largest reading and place of a mark: beyond any plate in any unit, while the sums of squares of a fit stay numbers.
const LARGEST: f64 = 1e9;

/// Readings of any number of photos of one camera as observations.
///
/// # Errors
/// [`Error::Invalid`] if a photo's fiducial marks do not determine the transformation, the camera has no pixel pitch
/// or sigma is not above 0 or beyond all measure; [`Error::Duplicate`] for a mark or point read twice in a photo.
pub fn observations(camera: &Camera, setup: &Setup, readings: &[Reading]) -> Result<Observed> {
    if camera.pixel_pitch.is_none() {
        let at = Place::camera(&camera.id).with_field("pixel_pitch");
        return Err(Error::Invalid { reason: Reason::PitchMissing, at });
    }
    if !setup.sigma.is_finite() || setup.sigma <= 0.0 || setup.sigma > LARGEST {
        return Err(Error::Invalid { reason: Reason::ReadingSigma, at: Place::field("sigma") });
    }
    let far = |values: [f64; 2]| values.iter().any(|value| !value.is_finite() || value.abs() > LARGEST);
    if let Some(reading) = readings.iter().find(|r| far([r.x, r.y])) {
        let at = Place { point: Some(reading.mark.clone()), ..Place::photo(&reading.photo) };
        return Err(Error::Invalid { reason: Reason::NotFinite, at });
    }
    if let Some((mark, _)) = setup.fiducials.iter().find(|(_, place)| far(**place)) {
        return Err(Error::Invalid {
            reason: Reason::NotFinite,
            at: Place { point: Some(mark.clone()), ..Place::default() },
        });
    }
    let up = if setup.upwards == Upwards::Yes { 1.0 } else { -1.0 };
    let machine = |r: &Reading| [r.x, up * r.y];
    let sigma = camera.pitch().map(|p| setup.sigma / p);
    let mut observed = Observed::default();
    let mut done = BTreeSet::new();
    for photo in readings.iter().map(|r| &r.photo).filter(|photo| done.insert(*photo)) {
        let own: Vec<_> = readings.iter().filter(|r| r.photo == *photo).collect();
        let mut known = BTreeSet::new();
        if let Some(twice) = own.iter().find(|r| !known.insert(&r.mark)) {
            let at = Place::photo(photo);
            return Err(Error::Duplicate { kind: Thing::Reading, name: twice.mark.clone(), at });
        }
        let (marks, points): (Vec<_>, Vec<_>) = own.into_iter().partition(|r| setup.fiducials.contains_key(&r.mark));
        let measured: Vec<_> = marks.iter().map(|r| machine(r)).collect();
        let given: Vec<_> = marks.iter().map(|r| setup.fiducials[&r.mark]).collect();
        let transformation = fit(setup.kind, &measured, &given).map_err(|error| match error {
            Error::Invalid { reason, at } => Error::Invalid { reason, at: Place { photo: Some(photo.clone()), ..at } },
            other => other,
        })?;
        for reading in points {
            let Some(place) = transformation.apply(machine(reading)) else { continue };
            let [u, v] = camera.pixel_from_photo(place);
            observed.observations.push(Observation {
                photo: photo.clone(),
                point: reading.mark.clone(),
                u,
                v,
                sigma: Sigma::Two(sigma),
                enabled: true,
                target: None,
            });
        }
        let marks = marks.iter().map(|r| r.mark.clone()).collect();
        observed.inner_orientations.push(InnerOrientation { photo: photo.clone(), marks, transformation });
    }
    Ok(observed)
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::project::Interior;

    fn camera() -> Camera {
        Camera { pixel_pitch: Some([0.01, 0.01]), ..Camera::new("p31", 12_000, 9_000, Interior::brown(100.0)) }
    }

    fn setup(upwards: Upwards) -> Setup {
        let marks = [("F1", [-50.0, 40.0]), ("F2", [50.0, 40.0]), ("F3", [50.0, -40.0]), ("F4", [-50.0, -40.0])];
        Setup {
            fiducials: marks.into_iter().map(|(id, place)| (id.to_owned(), place)).collect(),
            upwards,
            sigma: 0.003,
            ..Setup::default()
        }
    }

    #[test]
    fn readings_become_pixels_of_the_grid() {
        for upwards in [Upwards::Yes, Upwards::No] {
            let setup = setup(upwards);
            let sign = if upwards == Upwards::Yes { 1.0 } else { -1.0 };
            // The machine is turned by 0.1 and has its origin elsewhere.
            let (s, c) = 0.1f64.sin_cos();
            let read = |mark: &str, [x, y]: [f64; 2]| Reading {
                photo: "01".into(),
                mark: mark.into(),
                x: 200.0 + c * x - s * y,
                y: sign * (150.0 + s * x + c * y),
            };
            let mut readings: Vec<_> = setup.fiducials.iter().map(|(id, place)| read(id, *place)).collect();
            readings.push(read("7", [12.0, -5.0]));
            let observed = observations(&camera(), &setup, &readings).unwrap();
            let [o] = &observed.observations[..] else { panic!("one point") };
            assert!((o.u - 7200.0).abs() < 1e-8 && (o.v - 5000.0).abs() < 1e-8, "{o:?}");
            assert!((o.sigma.both()[0] - 0.3).abs() < 1e-12);
            assert_eq!(observed.inner_orientations[0].marks, ["F1", "F2", "F3", "F4"]);
        }
    }

    #[test]
    fn faults_name_the_photo() {
        let reading = |mark: &str| Reading { photo: "01".into(), mark: mark.into(), x: 1.0, y: 2.0 };
        let error =
            observations(&camera(), &setup(Upwards::Yes), &[reading("F1"), reading("7")]).expect_err("one mark");
        assert_eq!(error.place().photo.as_deref(), Some("01"));
        let twice = observations(&camera(), &setup(Upwards::Yes), &[reading("7"), reading("7")]).expect_err("twice");
        assert_eq!(twice.code(), "duplicate");
        let mut pixels = camera();
        pixels.pixel_pitch = None;
        assert!(observations(&pixels, &setup(Upwards::Yes), &[]).is_err());
    }
}
