//! Candidates on epipolar lines, indexed.
//!
//! The rays of one point in two photos lie in one half-plane bounded by the line through both projection centres. The
//! targets of the second photo are sorted by the angle θ of that half-plane, so that the candidates for a target of the
//! first stand side by side: an image displacement of δ (ideal coordinates) turns the half-plane by at most δ/sin φ, with
//! φ the angle between the ray and the base.

use nalgebra::Vector3;

use super::photo::OrientedPhoto;

/// Half-plane widths, radians, beyond which a target stands too near to the epipole to be sorted.
const WIDEST: f64 = 0.02;

/// The targets of one photo by their half-planes about the base to another.
pub(super) struct EpipolarIndex {
    base: Vector3<f64>,
    zero: Vector3<f64>,
    side: Vector3<f64>,
    /// Angle and number, ascending by angle.
    sorted: Vec<(f64, usize)>,
    /// Largest width among them.
    width: f64,
    /// Targets near the epipole, candidates for everything.
    near_epipole: Vec<usize>,
}

impl EpipolarIndex {
    /// Sorts the rays (ideal coordinates) of `second`; `reach_px` is how far apart a pair may be from its epipolar line. None
    /// for photos taken from one place.
    pub fn new(first: &OrientedPhoto, second: &OrientedPhoto, rays: &[[f64; 2]], reach_px: f64) -> Option<Self> {
        let base = (second.pose.centre - first.pose.centre).try_normalize(0.0)?;
        let mut axis = Vector3::zeros();
        axis[base.iamin()] = 1.0;
        let zero = base.cross(&axis).normalize();
        let mut band =
            Self { base, zero, side: base.cross(&zero), sorted: Vec::new(), width: 0.0, near_epipole: Vec::new() };
        for (k, ray) in rays.iter().enumerate() {
            let (angle, width) = band.half_plane(second, *ray, reach_px);
            if width > WIDEST {
                band.near_epipole.push(k);
            } else {
                band.width = band.width.max(width);
                band.sorted.push((angle, k));
            }
        }
        band.sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(band)
    }

    fn half_plane(&self, photo: &OrientedPhoto, ray: [f64; 2], reach_px: f64) -> (f64, f64) {
        let direction = photo.pose.ray(ray);
        let (x, y) = (direction.dot(&self.zero), direction.dot(&self.side));
        let sine = direction.cross(&self.base).norm();
        (y.atan2(x), reach_px / photo.principal_distance_px / sine.max(1e-12))
    }

    /// Numbers of the targets that may lie on the epipolar line of a ray of the first photo, ascending by angle.
    pub fn candidates(&self, first: &OrientedPhoto, ray: [f64; 2], reach_px: f64) -> Vec<usize> {
        let (angle, own) = self.half_plane(first, ray, reach_px);
        let mut found = self.near_epipole.clone();
        if own > WIDEST {
            found.extend(self.sorted.iter().map(|(_, k)| *k));
            return found;
        }
        let width = own + self.width;
        let mut range = |low: f64, high: f64| {
            let from = self.sorted.partition_point(|(a, _)| *a < low);
            found.extend(self.sorted[from..].iter().take_while(|(a, _)| *a <= high).map(|(_, k)| *k));
        };
        range(angle - width, angle + width);
        // The angle starts anew at half a turn.
        let turn = std::f64::consts::TAU;
        if angle - width < -0.5 * turn {
            range(angle - width + turn, 0.5 * turn);
        }
        if angle + width > 0.5 * turn {
            range(-0.5 * turn, angle + width - turn);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::pixel_from_camera_point;
    use crate::initial::Pose;
    use crate::initial::robust::{generator, uniform};
    use crate::project::{Camera, Interior};
    use crate::rotation;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn photo(angles: [f64; 3], centre: [f64; 3]) -> OrientedPhoto {
        let camera = Camera::new("k", 3000, 2000, Interior::brown(2500.0));
        let pose = Pose { object_to_camera: rotation::object_to_camera(angles), centre: centre.into() };
        OrientedPhoto { id: "1".into(), camera, pose, principal_distance_px: 2500.0 }
    }

    /// Every true pair is among the candidates, epipoles inside the photo or not, and these are few where they are not.
    #[test]
    fn true_pairs_are_among_few_candidates() {
        let mut g = generator(4);
        let mut next = || 2.0 * uniform(&mut g) - 1.0;
        for k in 0..40 {
            let ahead = k % 4 == 0;
            let first = photo([0.1 * next(), 0.1 * next(), 3.0 * next()], [0.0; 3]);
            let centre = if ahead { [0.02, 0.01, -1.0] } else { [1.0, next(), 0.3 * next()] };
            let second = photo([0.1 * next(), 0.1 * next(), 3.0 * next()], centre);
            let points: Vec<Vector3<f64>> =
                (0..500).map(|_| Vector3::new(next(), 0.7 * next(), -4.0 + 0.5 * next())).collect();
            let mut seen = |photo: &OrientedPhoto| -> Vec<[f64; 2]> {
                let image = |p: &Vector3<f64>| {
                    let [u, v] = pixel_from_camera_point(&photo.camera, photo.pose.to_camera(p)).expect("in front");
                    photo.ray([u + 0.5 * next(), v]).expect("a ray")
                };
                points.iter().map(image).collect()
            };
            let (a, b) = (seen(&first), seen(&second));
            let band = EpipolarIndex::new(&first, &second, &b, 1.0).expect("a base");
            let mut offered = 0;
            for (n, ray) in a.iter().enumerate() {
                let candidates = band.candidates(&first, *ray, 1.0);
                offered += candidates.len();
                assert!(candidates.contains(&n), "pair {n} of scene {k}");
            }
            assert!(ahead || offered < 500 * 12, "{offered}");
        }
    }
}
