//! The scene: plane faces with circular targets, and their visibility in a photo.

use crate::reason::PlanReason;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Reason, Result};
use sightline::initial::Pose;
use sightline::ring_code::Design;

/// A parallelogram that fills the view and hides what lies behind it. Greys are shares of full scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Face {
    /// One corner.
    pub corner: [f64; 3],
    /// Edge from that corner.
    pub along: [f64; 3],
    /// The other edge from that corner.
    pub across: [f64; 3],
    /// Mean grey.
    #[serde(default = "face_grey")]
    pub grey: f64,
    /// Standard deviation of the texture's grey.
    #[serde(default)]
    pub texture: f64,
    /// Size of the texture's coarsest grains, in object units.
    #[serde(default = "one")]
    pub grain: f64,
}

fn face_grey() -> f64 {
    0.25
}

fn one() -> f64 {
    1.0
}

/// A circular target. Greys are shares of full scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Disc {
    /// Point identifier.
    pub id: String,
    /// Centre.
    pub centre: [f64; 3],
    /// Direction it faces, any length.
    pub normal: [f64; 3],
    /// Diameter.
    pub diameter: f64,
    /// Bits of the code ring, with their number; `None` for a plain disc.
    #[serde(default)]
    pub ring: Option<Ring>,
    /// Grey of the disc and of the set sectors.
    #[serde(default = "white")]
    pub grey: f64,
    /// The round patch it is printed on; `None` if it lies on the ground as it is.
    #[serde(default)]
    pub patch: Option<Patch>,
}

fn white() -> f64 {
    0.85
}

/// A code ring around a disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ring {
    /// Number of sectors.
    pub sectors: u32,
    /// Set sectors, clockwise as seen, the first being the most significant bit.
    pub code: u32,
    /// Radii of the ring, and whether the disc has a spot in its centre.
    #[serde(default)]
    pub design: Design,
}

/// Round ground of a target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Patch {
    /// Diameter over the target's diameter.
    pub ratio: f64,
    /// Grey.
    pub grey: f64,
}

/// Everything a camera could see.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Scene {
    /// Faces.
    pub faces: Vec<Face>,
    /// Targets.
    pub discs: Vec<Disc>,
    /// Grey where no face is.
    pub background: f64,
}

impl Face {
    /// Share of the way from `from` along `ray` at which it meets the face, with the place on the face as shares of its
    /// edges; `None` if it passes by.
    #[inline]
    pub fn meet(&self, from: &Vector3<f64>, ray: &Vector3<f64>) -> Option<(f64, [f64; 2])> {
        let (along, across) = (Vector3::from(self.along), Vector3::from(self.across));
        // Cramer's rule for corner + a·along + b·across = from + t·ray.
        let normal = along.cross(&across);
        let slope = normal.dot(ray);
        let offset = Vector3::from(self.corner) - from;
        let t = normal.dot(&offset) / slope;
        if !(t > 0.0 && t.is_finite()) {
            return None;
        }
        let place = ray * t - offset;
        let square = normal.norm_squared();
        let a = place.cross(&across).dot(&normal) / square;
        let b = along.cross(&place).dot(&normal) / square;
        ((0.0..=1.0).contains(&a) && (0.0..=1.0).contains(&b)).then_some((t, [a, b]))
    }
}

impl Scene {
    /// Whether a face stands between the projection centre and a point. Points on a face are not hidden by it.
    pub fn hides(&self, centre: &Vector3<f64>, point: &Vector3<f64>) -> bool {
        let ray = point - centre;
        self.faces.iter().any(|face| face.meet(centre, &ray).is_some_and(|(t, _)| t < 1.0 - 1e-4))
    }

    /// Checks that sizes and directions can be drawn.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the target, or the face by its place in the list.
    pub fn check(&self) -> Result<()> {
        let invalid = |reason, at| Err(Error::Invalid { reason, at });
        for (index, face) in self.faces.iter().enumerate() {
            let area = Vector3::from(face.along).cross(&Vector3::from(face.across)).norm();
            let numbers = [area, face.grey, face.texture, face.grain];
            if !(area > 0.0 && face.grain > 0.0 && numbers.iter().all(|n| n.is_finite())) {
                return invalid(PlanReason::Face { index }.into(), Place::field("faces"));
            }
        }
        for disc in &self.discs {
            let finite = disc.centre.iter().chain(&disc.normal).all(|n| n.is_finite()) && disc.grey.is_finite();
            if !(finite && Vector3::from(disc.normal).norm() > 0.0 && disc.diameter > 0.0 && disc.diameter.is_finite())
            {
                return invalid(PlanReason::Disc.into(), Place::point(&disc.id));
            }
            if disc.ring.is_some_and(|r| !(2..=24).contains(&r.sectors) || r.code >> r.sectors != 0) {
                return invalid(Reason::CodeRing, Place::point(&disc.id).with_field("ring"));
            }
        }
        Ok(())
    }
}

/// Angle between the ray to a point and the direction it faces, 0 when seen straight on.
pub fn incidence(pose: &Pose, point: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    (pose.centre - point).angle(normal)
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn wall() -> Face {
        Face {
            corner: [-1.0, -1.0, 0.0],
            along: [2.0, 0.0, 0.0],
            across: [1.0, 2.0, 0.0],
            grey: 0.5,
            texture: 0.0,
            grain: 1.0,
        }
    }

    #[test]
    fn rays_meet_a_slanted_parallelogram_where_they_should() {
        let from = Vector3::new(0.5, 0.0, 4.0);
        let (t, [a, b]) = wall().meet(&from, &Vector3::new(0.0, 0.0, -2.0)).expect("a hit");
        assert!((t - 2.0).abs() < 1e-12 && (a - 0.5).abs() < 1e-12 && (b - 0.5).abs() < 1e-12);
        assert!(wall().meet(&from, &Vector3::new(0.0, 0.0, 2.0)).is_none());
        assert!(wall().meet(&Vector3::new(-0.9, 0.9, 4.0), &Vector3::new(0.0, 0.0, -2.0)).is_none());
    }

    #[test]
    fn a_face_hides_what_is_behind_and_not_what_is_on_it() {
        let scene = Scene { faces: vec![wall()], ..Scene::default() };
        let eye = Vector3::new(0.5, 0.0, 4.0);
        assert!(scene.hides(&eye, &Vector3::new(0.5, 0.0, -0.1)));
        assert!(!scene.hides(&eye, &Vector3::new(0.5, 0.0, 0.0)));
        assert!(!scene.hides(&eye, &Vector3::new(0.5, 0.0, 0.1)));
        assert!(!scene.hides(&eye, &Vector3::new(9.0, 0.0, -0.1)));
    }

    #[test]
    fn undrawable_targets_are_named() {
        let disc = Disc {
            id: "7".into(),
            centre: [0.0; 3],
            normal: [0.0; 3],
            diameter: 1.0,
            ring: None,
            grey: 1.0,
            patch: None,
        };
        let error = Scene { discs: vec![disc], ..Scene::default() }.check().expect_err("no direction");
        assert_eq!(error.place().point.as_deref(), Some("7"));
    }
}
