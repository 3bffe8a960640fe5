//! What a document must hold before anything is computed from it: unique identifiers, known references, finite numbers,
//! sizes and standard errors that make sense. Every complaint names the place and what to do.

use std::collections::{HashMap, HashSet};

use super::{Camera, Interior, Parameter, Project};
use crate::error::{Error, Place, Result};

/// Largest magnitude of a coordinate or parameter: far beyond any object, and its square is still a number.
const LARGEST: f64 = 1e100;

impl Project {
    /// Checks the document; missing initial values are no fault here.
    ///
    /// # Errors
    /// [`Error::Invalid`], [`Error::Unknown`] or [`Error::Duplicate`] with the first fault found.
    pub fn validate(&self) -> Result<()> {
        if self.format != "sightline" || self.version != 1 {
            return invalid(
                format!(
                    "this is format \"{}\" version {}; \"sightline\" version 1 is read here",
                    self.format, self.version
                ),
                Place::field("format"),
            );
        }
        let cameras = unique("camera", self.cameras.iter().map(|c| c.id.as_str()), Place::camera)?;
        let photos = unique("photo", self.photos.iter().map(|p| p.id.as_str()), Place::photo)?;
        let points = unique("point", self.points.iter().map(|p| p.id.as_str()), Place::point)?;
        self.cameras.iter().try_for_each(camera)?;
        for photo in &self.photos {
            let at = || Place::photo(&photo.id);
            known("camera", &photo.camera, &cameras, || at().with_field("camera"))?;
            finite(photo.position.iter().flatten(), || at().with_field("position"))?;
            finite(photo.rotation.iter().flatten(), || at().with_field("rotation"))?;
            sigmas(photo.sigma_position.iter().flatten().flatten(), || at().with_field("sigma_position"))?;
            if let Some(interior) = &photo.interior {
                let model = self.cameras.iter().find(|c| c.id == photo.camera).map(|c| &c.interior);
                if model.is_some_and(|m| std::mem::discriminant(m) != std::mem::discriminant(interior)) {
                    return invalid(
                        "the photo's own interior orientation must be of its camera's model".into(),
                        at().with_field("interior"),
                    );
                }
                interior_orientation(interior, at)?;
            }
        }
        for point in &self.points {
            let at = || Place::point(&point.id);
            finite(point.xyz.iter().flatten(), || at().with_field("xyz"))?;
            sigmas(point.sigma.iter().flatten().flatten(), || at().with_field("sigma"))?;
            if point.diameter.is_some_and(|d| !(d > 0.0 && d < LARGEST)) {
                return invalid("a target's diameter is greater than 0".into(), at().with_field("diameter"));
            }
            finite(point.normal.iter().flatten(), || at().with_field("normal"))?;
            if point.normal.is_some_and(|normal| normal.iter().all(|n| n.abs() < 1e-100)) {
                return invalid(
                    "a target's normal is a direction: not all of it is 0".into(),
                    at().with_field("normal"),
                );
            }
        }
        self.validate_observations(&photos, &points)?;
        self.validate_distances(&points)?;
        for id in self.datum.points.iter().flatten() {
            known("point", id, &points, || Place::field("datum.points"))?;
        }
        if let Some(list) = &self.datum.points {
            unique("datum point", list.iter().map(String::as_str), Place::point)?;
        }
        Ok(())
    }

    fn validate_observations(&self, photos: &HashMap<&str, usize>, points: &HashMap<&str, usize>) -> Result<()> {
        let mut seen = HashSet::with_capacity(self.observations.len());
        for o in &self.observations {
            let at = || Place { photo: Some(o.photo.clone()), point: Some(o.point.clone()), ..Place::default() };
            let photo = known("photo", &o.photo, photos, || at().with_field("observations"))?;
            let point = known("point", &o.point, points, || at().with_field("observations"))?;
            finite([o.u, o.v].iter(), || at().with_field("u, v"))?;
            if o.sigma.both().iter().any(|s| !(*s > 0.0 && *s < LARGEST)) {
                return invalid(
                    "the standard error of an image observation is greater than 0 pixels".into(),
                    at().with_field("sigma"),
                );
            }
            if o.enabled && !seen.insert((photo, point)) {
                return Err(Error::Duplicate {
                    kind: "observation".into(),
                    name: format!("{} in {}", o.point, o.photo),
                    at: at(),
                });
            }
        }
        Ok(())
    }

    fn validate_distances(&self, points: &HashMap<&str, usize>) -> Result<()> {
        for (k, d) in self.distances.iter().enumerate() {
            let at = || Place::point(&d.from).with_field(format!("distances[{k}]"));
            known("point", &d.from, points, at)?;
            known("point", &d.to, points, at)?;
            if d.from == d.to {
                return invalid("a distance joins two different points".into(), at());
            }
            if !(d.length > 0.0 && d.length < LARGEST) {
                return invalid("a distance is greater than 0".into(), at());
            }
            if !(d.sigma > 0.0 && d.sigma < LARGEST) {
                return invalid("the standard error of a distance is greater than 0".into(), at());
            }
        }
        Ok(())
    }
}

fn invalid(detail: String, at: Place) -> Result<()> {
    Err(Error::Invalid { detail, at })
}

fn unique<'a>(
    kind: &str,
    ids: impl Iterator<Item = &'a str>,
    place: impl Fn(&'a str) -> Place,
) -> Result<HashMap<&'a str, usize>> {
    let mut index = HashMap::new();
    for (k, id) in ids.enumerate() {
        if index.insert(id, k).is_some() {
            return Err(Error::Duplicate { kind: kind.into(), name: id.into(), at: place(id) });
        }
    }
    Ok(index)
}

fn known(kind: &str, id: &str, index: &HashMap<&str, usize>, at: impl Fn() -> Place) -> Result<usize> {
    index.get(id).copied().ok_or_else(|| Error::Unknown { kind: kind.into(), name: id.into(), at: at() })
}

fn finite<'a>(mut values: impl Iterator<Item = &'a f64>, at: impl Fn() -> Place) -> Result<()> {
    if values.all(|v| v.abs() < LARGEST) {
        return Ok(());
    }
    invalid("a number here is not finite or beyond all measure".into(), at())
}

fn sigmas<'a>(mut values: impl Iterator<Item = &'a f64>, at: impl Fn() -> Place) -> Result<()> {
    if values.all(|v| *v >= 0.0 && *v < LARGEST) {
        return Ok(());
    }
    invalid("a standard error is 0 (fixed) or greater".into(), at())
}

fn interior_orientation(interior: &Interior, at: impl Fn() -> Place) -> Result<()> {
    for &p in interior.parameters() {
        let Some(value) = interior.get(p) else { continue };
        let distance = matches!(p, Parameter::C | Parameter::F | Parameter::Fx | Parameter::Fy);
        if !(value.abs() < LARGEST) || (distance && value <= 0.0) {
            let what =
                if distance { "the principal distance is greater than 0" } else { "a parameter is a finite number" };
            return invalid(what.into(), at().with_field(p.name()));
        }
    }
    Ok(())
}

fn camera(camera: &Camera) -> Result<()> {
    let at = || Place::camera(&camera.id);
    if camera.width == 0 || camera.height == 0 {
        return invalid("width and height of the sensor grid are at least one pixel".into(), at().with_field("width"));
    }
    if camera.pitch().iter().any(|p| !(*p > 0.0 && *p < LARGEST)) {
        return invalid("the pixel pitch is greater than 0 millimetres".into(), at().with_field("pixel_pitch"));
    }
    interior_orientation(&camera.interior, at)?;
    for &p in camera.free.iter().chain(camera.sigma.keys()) {
        if !camera.interior.parameters().contains(&p) {
            return Err(Error::Unknown {
                kind: "parameter".into(),
                name: p.name().into(),
                at: at().with_field("free"),
            });
        }
    }
    for (p, sigma) in &camera.sigma {
        if !(*sigma > 0.0 && *sigma < LARGEST) {
            return invalid(
                "the a priori standard error of a parameter is greater than 0; leave it out to hold the parameter"
                    .into(),
                at().with_field(p.name()),
            );
        }
    }
    let estimated = camera.estimated();
    if estimated.contains(&Parameter::F) && (estimated.contains(&Parameter::Fx) || estimated.contains(&Parameter::Fy)) {
        return invalid(
            "f stands for fx and fy as one: estimate either f, or fx and fy".into(),
            at().with_field("free"),
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Distance, Observation, Photo, Point, Sigma};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn project() -> Project {
        let camera = Camera {
            id: "k".into(),
            width: 100,
            height: 80,
            pixel_pitch: None,
            interior: Interior::brown(90.0),
            free: vec![Parameter::C],
            sigma: Default::default(),
            per_photo: false,
        };
        let point = |id: &str| Point { id: id.into(), ..Point::default() };
        Project {
            cameras: vec![camera],
            photos: vec![Photo { id: "a".into(), camera: "k".into(), enabled: true, ..Photo::default() }],
            points: vec![point("1"), point("2")],
            observations: vec![Observation {
                photo: "a".into(),
                point: "1".into(),
                u: 1.0,
                v: 2.0,
                sigma: Sigma::One(0.1),
                enabled: true,
            }],
            distances: vec![Distance { from: "1".into(), to: "2".into(), length: 3.0, sigma: 0.1 }],
            ..Project::default()
        }
    }

    #[test]
    fn a_sound_document_passes_and_every_fault_is_placed() {
        project().validate().expect("sound");
        type Fault = fn(&mut Project);
        let faults: [(Fault, &str, &str); 15] = [
            (|p| p.version = 2, "invalid", "format"),
            (|p| p.points[1].id = "1".into(), "duplicate", "1"),
            (|p| p.photos[0].camera = "none".into(), "unknown", "a"),
            (|p| p.observations[0].point = "9".into(), "unknown", "9"),
            (|p| p.observations.push(p.observations[0].clone()), "duplicate", "1"),
            (|p| p.observations[0].u = f64::NAN, "invalid", "u, v"),
            (|p| p.observations[0].sigma = Sigma::Two([0.1, 0.0]), "invalid", "sigma"),
            (|p| p.cameras[0].width = 0, "invalid", "width"),
            (|p| p.cameras[0].free = vec![Parameter::Fx], "unknown", "k"),
            (|p| p.cameras[0].interior = Interior::brown(-3.0), "invalid", "c"),
            (|p| p.distances[0].sigma = 0.0, "invalid", "distances[0]"),
            (|p| p.distances[0].to = "1".into(), "invalid", "1"),
            (|p| p.points[0].normal = Some([0.0; 3]), "invalid", "normal"),
            (|p| p.points[0].normal = Some([0.0, f64::INFINITY, 0.0]), "invalid", "normal"),
            (|p| p.datum.points = Some(vec!["7".into()]), "unknown", "datum.points"),
        ];
        for (k, (fault, code, place)) in faults.into_iter().enumerate() {
            let mut project = project();
            fault(&mut project);
            let error = project.validate().expect_err("a fault");
            assert_eq!(error.code(), code, "fault {k}: {error}");
            assert!(error.to_string().contains(place), "fault {k}: {error}");
        }
    }
}
