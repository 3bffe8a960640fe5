//! Validation of a document before any computation: unique identifiers, known references, finite numbers, plausible
//! sizes and standard errors. Every complaint names the place and what to do.

use std::collections::{HashMap, HashSet};

use super::{Camera, Interior, Parameter, Project};
use crate::error::{Error, Place, Reason, Result, Thing, shortened};

/// Largest magnitude of a coordinate or parameter: far beyond any object, and its square is still a number.
pub const LARGEST: f64 = 1e100;

impl Project {
    /// Checks the document; missing initial values are allowed here.
    ///
    /// # Errors
    /// [`Error::Invalid`], [`Error::Unknown`] or [`Error::Duplicate`] with the first fault found.
    pub fn validate(&self) -> Result<()> {
        if self.format != "sightline" || self.version != 1 {
            return invalid(
                Reason::Format { format: shortened(&self.format), version: self.version },
                Place::field("format"),
            );
        }
        let cameras = unique(Thing::Camera, self.cameras.iter().map(|c| c.id.as_str()), Place::camera)?;
        let photos = unique(Thing::Photo, self.photos.iter().map(|p| p.id.as_str()), Place::photo)?;
        let points = unique(Thing::Point, self.points.iter().map(|p| p.id.as_str()), Place::point)?;
        self.cameras.iter().try_for_each(camera)?;
        for photo in &self.photos {
            let at = || Place::photo(&photo.id);
            known(Thing::Camera, &photo.camera, &cameras, || at().with_field("camera"))?;
            finite(photo.position.iter().flatten(), || at().with_field("position"))?;
            finite(photo.rotation.iter().flatten(), || at().with_field("rotation"))?;
            sigmas(photo.sigma_position.iter().flatten().flatten(), || at().with_field("sigma_position"))?;
            if let Some(interior) = &photo.interior {
                let model = self.cameras.iter().find(|c| c.id == photo.camera).map(|c| &c.interior);
                if model.is_some_and(|m| std::mem::discriminant(m) != std::mem::discriminant(interior)) {
                    return invalid(Reason::InteriorModel, at().with_field("interior"));
                }
                interior_orientation(interior, at)?;
            }
        }
        for point in &self.points {
            let at = || Place::point(&point.id);
            finite(point.xyz.iter().flatten(), || at().with_field("xyz"))?;
            sigmas(point.sigma.iter().flatten().flatten(), || at().with_field("sigma"))?;
            if point.diameter.is_some_and(|d| !(d > 0.0 && d < LARGEST)) {
                return invalid(Reason::TargetDiameter, at().with_field("diameter"));
            }
            finite(point.normal.iter().flatten(), || at().with_field("normal"))?;
            if point.normal.is_some_and(|normal| normal.iter().all(|n| n.abs() < 1e-100)) {
                return invalid(Reason::TargetNormal, at().with_field("normal"));
            }
        }
        self.validate_observations(&photos, &points)?;
        self.validate_distances(&points)?;
        for id in self.datum.points.iter().flatten() {
            known(Thing::Point, id, &points, || Place::field("datum.points"))?;
        }
        if let Some(list) = &self.datum.points {
            unique(Thing::DatumPoint, list.iter().map(String::as_str), Place::point)?;
        }
        self.validate_rig(&photos)?;
        self.validate_features()
    }

    fn validate_observations(&self, photos: &HashMap<&str, usize>, points: &HashMap<&str, usize>) -> Result<()> {
        let mut seen = HashSet::with_capacity(self.observations.len());
        for o in &self.observations {
            let at = || Place { photo: Some(o.photo.clone()), point: Some(o.point.clone()), ..Place::default() };
            let photo = known(Thing::Photo, &o.photo, photos, || at().with_field("observations"))?;
            let point = known(Thing::Point, &o.point, points, || at().with_field("observations"))?;
            finite([o.u, o.v].iter(), || at().with_field("u, v"))?;
            if o.sigma.both().iter().any(|s| !(*s > 0.0 && *s < LARGEST)) {
                return invalid(Reason::ImageSigma, at().with_field("sigma"));
            }
            if o.enabled && !seen.insert((photo, point)) {
                return Err(Error::Duplicate {
                    kind: Thing::Observation,
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
            known(Thing::Point, &d.from, points, at)?;
            known(Thing::Point, &d.to, points, at)?;
            if d.from == d.to {
                return invalid(Reason::DistanceEnds, at());
            }
            if !(d.length > 0.0 && d.length < LARGEST) {
                return invalid(Reason::DistanceLength, at());
            }
            if !(d.sigma > 0.0 && d.sigma < LARGEST) {
                return invalid(Reason::DistanceSigma, at());
            }
        }
        Ok(())
    }
}

pub(super) fn invalid(reason: Reason, at: Place) -> Result<()> {
    Err(Error::Invalid { reason, at })
}

pub(super) fn unique<'a>(
    kind: Thing,
    ids: impl Iterator<Item = &'a str>,
    place: impl Fn(&'a str) -> Place,
) -> Result<HashMap<&'a str, usize>> {
    let mut index = HashMap::new();
    for (k, id) in ids.enumerate() {
        if index.insert(id, k).is_some() {
            return Err(Error::Duplicate { kind, name: id.into(), at: place(id) });
        }
    }
    Ok(index)
}

pub(super) fn known(kind: Thing, id: &str, index: &HashMap<&str, usize>, at: impl Fn() -> Place) -> Result<usize> {
    index.get(id).copied().ok_or_else(|| Error::Unknown { kind, name: id.into(), at: at() })
}

pub(super) fn finite<'a>(mut values: impl Iterator<Item = &'a f64>, at: impl Fn() -> Place) -> Result<()> {
    if values.all(|v| v.abs() < LARGEST) {
        return Ok(());
    }
    invalid(Reason::NotFinite, at())
}

fn sigmas<'a>(mut values: impl Iterator<Item = &'a f64>, at: impl Fn() -> Place) -> Result<()> {
    if values.all(|v| *v >= 0.0 && *v < LARGEST) {
        return Ok(());
    }
    invalid(Reason::NegativeSigma, at())
}

fn interior_orientation(interior: &Interior, at: impl Fn() -> Place) -> Result<()> {
    for &p in interior.parameters() {
        let Some(value) = interior.get(p) else { continue };
        let distance = matches!(p, Parameter::C | Parameter::F | Parameter::Fx | Parameter::Fy);
        if !(value.abs() < LARGEST) || (distance && value <= 0.0) {
            let reason = if distance { Reason::PrincipalDistance } else { Reason::ParameterNotFinite };
            return invalid(reason, at().with_field(p.name()));
        }
    }
    Ok(())
}

fn camera(camera: &Camera) -> Result<()> {
    let at = || Place::camera(&camera.id);
    if camera.width == 0 || camera.height == 0 {
        return invalid(Reason::SensorGrid, at().with_field("width"));
    }
    if camera.pitch().iter().any(|p| !(*p > 0.0 && *p < LARGEST)) {
        return invalid(Reason::PixelPitch, at().with_field("pixel_pitch"));
    }
    interior_orientation(&camera.interior, at)?;
    for &p in camera.free.iter().chain(camera.sigma.keys()) {
        if !camera.interior.parameters().contains(&p) {
            return Err(Error::Unknown { kind: Thing::Parameter, name: p.name().into(), at: at().with_field("free") });
        }
    }
    for (p, sigma) in &camera.sigma {
        if !(*sigma > 0.0 && *sigma < LARGEST) {
            return invalid(Reason::ParameterSigma, at().with_field(p.name()));
        }
    }
    let estimated = camera.estimated();
    if estimated.contains(&Parameter::F) && (estimated.contains(&Parameter::Fx) || estimated.contains(&Parameter::Fy)) {
        return invalid(Reason::FocalLengthTwice, at().with_field("free"));
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
            photos: vec![Photo { id: "a".into(), camera: "k".into(), enabled: true, ..Photo::default() }].into(),
            points: vec![point("1"), point("2")].into(),
            observations: vec![Observation {
                photo: "a".into(),
                point: "1".into(),
                u: 1.0,
                v: 2.0,
                sigma: Sigma::One(0.1),
                enabled: true,
                target: None,
            }]
            .into(),
            distances: vec![Distance { from: "1".into(), to: "2".into(), length: 3.0, sigma: 0.1, check: false }],
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
            (|p| p.observations.extend_from_within(..1), "duplicate", "1"),
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
