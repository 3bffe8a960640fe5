//! What the elimination of the points leaves for back-substitution, gradients and cofactors: per point the factor of its
//! normal matrix, per interior orientation of a point U = CᵀB, per ray its rows A by the point, or rather by the photo's
//! shift, -A; see [`super::normal`].
//!
//! Z = GᵀB for the ray's photo is three times as large as A and is not kept: a turn t and a shift s of the photo act on the ray
//! as the shift Mᵀt × (X - XL) - s of the point, so that Zᵀ(t, s) = L⁻¹AᵀA(Mᵀt × (X - XL) - s).

use std::ops::Range;

use crate::adjust::linear::cholesky3::{PointFactor, backward3, forward3};
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::{ExteriorOrientation, State};

use super::ordering::Layout;

/// An interior orientation that sees a point.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    /// Index into [`Network::interiors`].
    pub interior: usize,
    /// Number of its unknowns.
    pub length: usize,
    /// Start of its U, three rows of `length` numbers.
    at: usize,
}

/// The eliminated points.
#[derive(Clone, Debug)]
pub struct EliminatedPoints {
    /// Per point; unused for kept ones.
    pub factors: Vec<PointFactor>,
    /// Per ray its weighted rows by the photo's shift, which are -A, held axes included; unused for rays of kept points.
    pub by_shift: Vec<[[f64; 3]; 2]>,
    /// Points that their rays do not determine, within the precision of the numbers.
    pub lost: Vec<usize>,
    own: Vec<Own>,
    own_of: Vec<Range<usize>>,
    u: Vec<f64>,
    /// Where the rows were taken.
    poses: Vec<ExteriorOrientation>,
    points: Vec<[f64; 3]>,
}

/// Change of a photo's exterior orientation: rotation in the object frame, shift.
#[derive(Clone, Copy)]
struct PhotoMotion {
    turn: [f64; 3],
    shift: [f64; 3],
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Zeros on held axes.
fn free(x: [f64; 3], fixed: &[bool; 3]) -> [f64; 3] {
    std::array::from_fn(|a| if fixed[a] { 0.0 } else { x[a] })
}

impl EliminatedPoints {
    /// Room for a network's points.
    pub fn new(network: &Network) -> Self {
        let (mut own, mut own_of, mut at) = (Vec::<Own>::new(), Vec::new(), 0);
        for point in &network.points {
            let first = own.len();
            for ray in network.rays[point.rays.clone()].iter().filter(|_| !point.kept) {
                let interior = network.photos[ray.photo].interior;
                let length = network.interiors[interior].estimated.len();
                if length > 0 && own[first..].iter().all(|o| o.interior != interior) {
                    own.push(Own { interior, length, at });
                    at += 3 * length;
                }
            }
            own_of.push(first..own.len());
        }
        Self {
            factors: vec![PointFactor::default(); network.points.len()],
            by_shift: vec![[[0.0; 3]; 2]; network.rays.len()],
            lost: Vec::new(),
            own,
            own_of,
            u: vec![0.0; at],
            poses: Vec::new(),
            points: Vec::new(),
        }
    }

    /// Starts anew at a state.
    pub fn start(&mut self, state: &State) {
        self.lost.clear();
        self.poses.clone_from(&state.poses);
        self.points.clone_from(&state.points);
    }

    /// The interior orientations of a point that have unknowns.
    pub fn own(&self, point: usize) -> &[Own] {
        &self.own[self.own_of[point].clone()]
    }

    /// Row `m` of an interior orientation's U.
    #[inline(always)]
    pub fn u(&self, own: &Own, m: usize) -> &[f64] {
        &self.u[own.at + m * own.length..][..own.length]
    }

    /// An interior orientation's U, zeros beyond its unknowns.
    pub fn whole_u<const N: usize>(&self, own: &Own) -> [[f64; N]; 3] {
        let mut u = [[0.0; N]; 3];
        (0..3).for_each(|m| u[m][..own.length].copy_from_slice(self.u(own, m)));
        u
    }

    /// Takes over U of the point's interior orientation number `n`.
    #[inline(always)]
    pub fn set_u<const N: usize>(&mut self, point: usize, n: usize, u: &[[f64; N]; 3]) {
        let own = self.own[self.own_of[point].start + n];
        for (to, from) in self.u[own.at..own.at + 3 * own.length].chunks_exact_mut(own.length).zip(u) {
            to.copy_from_slice(&from[..own.length]);
        }
    }

    /// Gᵀ over the photo for a ray's pull on its point, u = Aᵀv: (M((X - XL) × u), -u).
    fn at_photo(&self, photo: usize, point: usize, u: [f64; 3]) -> [f64; 6] {
        let pose = &self.poses[photo];
        let w = cross(difference(self.points[point], pose.centre), u);
        let [a, b, c] = pose.m.map(|row| dot(row, w));
        [a, b, c, -u[0], -u[1], -u[2]]
    }

    /// Z of ray number `ray`, transposed: three rows over the photo's unknowns.
    pub fn z(&self, network: &Network, point: usize, ray: usize) -> [[f64; 6]; 3] {
        let (a, photo) = (&self.by_shift[ray], network.rays[ray].photo);
        let fixed = &network.points[point].fixed;
        let b = a.map(|a| forward3(&self.factors[point].l, free(a, fixed)));
        std::array::from_fn(|m| {
            self.at_photo(photo, point, std::array::from_fn(|k| a[0][k] * b[0][m] + a[1][k] * b[1][m]))
        })
    }

    /// x -= Z d over the reduced unknowns, d of one point.
    pub fn subtract(&self, network: &Network, layout: &Layout, point: usize, d: &[f64; 3], x: &mut [f64]) {
        let block = &network.points[point];
        let step = free(backward3(&self.factors[point].l, *d), &block.fixed);
        let rays = block.rays.clone();
        for (ray, a) in network.rays[rays.clone()].iter().zip(&self.by_shift[rays]) {
            let [v, w] = a.map(|a| dot(a, step));
            let z = self.at_photo(ray.photo, point, std::array::from_fn(|k| a[0][k] * v + a[1][k] * w));
            let place = layout.photo[ray.photo];
            x[place..place + 6].iter_mut().zip(z).for_each(|(x, z)| *x -= z);
        }
        for own in self.own(point) {
            let place = layout.interior[own.interior];
            let (u0, u1, u2) = (self.u(own, 0), self.u(own, 1), self.u(own, 2));
            for (k, x) in x[place..place + own.length].iter_mut().enumerate() {
                *x -= u0[k] * d[0] + u1[k] * d[1] + u2[k] * d[2];
            }
        }
    }

    /// Change of the photos' rays by a vector of the reduced unknowns.
    fn motions(&self, layout: &Layout, x: &[f64]) -> Vec<PhotoMotion> {
        let motion = |(pose, &at): (&ExteriorOrientation, &usize)| {
            let [t, shift]: [[f64; 3]; 2] = [at, at + 3].map(|at| [x[at], x[at + 1], x[at + 2]]);
            let m = &pose.m;
            let turn = std::array::from_fn(|k| m[0][k] * t[0] + m[1][k] * t[1] + m[2][k] * t[2]);
            PhotoMotion { turn, shift }
        };
        self.poses.iter().zip(&layout.photo).map(motion).collect()
    }

    /// Zᵀx of one point, from `motions` by x.
    #[inline(always)]
    fn product(
        &self,
        network: &Network,
        layout: &Layout,
        point: usize,
        motions: &[PhotoMotion],
        x: &[f64],
    ) -> [f64; 3] {
        let block = &network.points[point];
        let (place, rays) = (self.points[point], block.rays.clone());
        let mut pull = [0.0; 3];
        for (ray, a) in network.rays[rays.clone()].iter().zip(&self.by_shift[rays]) {
            let PhotoMotion { turn, shift } = motions[ray.photo];
            let moved = difference(cross(turn, difference(place, self.poses[ray.photo].centre)), shift);
            let [v, w] = a.map(|a| dot(a, moved));
            (0..3).for_each(|k| pull[k] += a[0][k] * v + a[1][k] * w);
        }
        let mut sum = forward3(&self.factors[point].l, free(pull, &block.fixed));
        for own in self.own(point) {
            let x = &x[layout.interior[own.interior]..][..own.length];
            for (m, sum) in sum.iter_mut().enumerate() {
                *sum += self.u(own, m).iter().zip(x).map(|(u, x)| u * x).sum::<f64>();
            }
        }
        sum
    }

    /// Steps of the points from the solution of the reduced equations: δX = -L⁻ᵀ(h + Zᵀδ); 0 on held axes.
    pub fn back_substitute(&self, network: &Network, layout: &Layout, x: &[f64]) -> Vec<[f64; 3]> {
        let motions = self.motions(layout, x);
        let step = |point: usize| {
            let block = &network.points[point];
            if block.kept {
                return std::array::from_fn(|a| x[layout.point[point] + a]);
            }
            let PointFactor { l, h, .. } = &self.factors[point];
            let t = self.product(network, layout, point, &motions, x);
            let step = backward3(l, std::array::from_fn(|m| -h[m] - t[m]));
            free(step, &block.fixed)
        };
        (0..network.points.len()).map(step).collect()
    }
}

/// A vector over all unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Full {
    /// Over the reduced equations, kept points included.
    pub reduced: Vec<f64>,
    /// Over the points; 0 for kept ones.
    pub points: Vec<[f64; 3]>,
}

impl Full {
    /// Zero.
    pub fn zeros(network: &Network, layout: &Layout) -> Self {
        Self { reduced: vec![0.0; layout.size], points: vec![[0.0; 3]; network.points.len()] }
    }

    /// Adds to the number at a point's axis.
    pub fn add_at_point(&mut self, layout: &Layout, point: usize, axis: usize, value: f64) {
        match layout.point[point] {
            usize::MAX => self.points[point][axis] += value,
            place => self.reduced[place + axis] += value,
        }
    }

    /// Number at a point's axis.
    pub fn at_point(&self, layout: &Layout, point: usize, axis: usize) -> f64 {
        if layout.point[point] == usize::MAX {
            self.points[point][axis]
        } else {
            self.reduced[layout.point[point] + axis]
        }
    }

    /// Scalar product.
    pub fn product(&self, other: &Self) -> f64 {
        let reduced: f64 = self.reduced.iter().zip(&other.reduced).map(|(a, b)| a * b).sum();
        let points = self.points.iter().zip(&other.points).flat_map(|(a, b)| a.iter().zip(b));
        reduced + points.map(|(a, b)| a * b).sum::<f64>()
    }

    /// The reduced right-hand side after the points' elimination, and L⁻¹ of the points' own part.
    pub fn forward(&mut self, network: &Network, layout: &Layout, eliminated: &EliminatedPoints) {
        for point in (0..network.points.len()).filter(|p| !network.points[*p].kept) {
            let d = forward3(&eliminated.factors[point].l, self.points[point]);
            self.points[point] = d;
            eliminated.subtract(network, layout, point, &d, &mut self.reduced);
        }
    }

    /// The points' part of a solution, after the reduced part.
    pub fn backward(&mut self, network: &Network, layout: &Layout, eliminated: &EliminatedPoints) {
        let motions = eliminated.motions(layout, &self.reduced);
        for (point, block) in network.points.iter().enumerate().filter(|(_, block)| !block.kept) {
            let sum = eliminated.product(network, layout, point, &motions, &self.reduced);
            let d = self.points[point];
            let x = backward3(&eliminated.factors[point].l, std::array::from_fn(|m| d[m] - sum[m]));
            self.points[point] = free(x, &block.fixed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::collinearity::Linearisation;
    use super::super::context::{Context, Weighting};
    use super::super::normal::ReducedNormalEquations;
    use super::super::ordering::layout;
    use super::*;
    use crate::adjust::problem::left_out::RejectedObservations;
    use crate::adjust::problem::numbering::Numbering;
    use crate::adjustment::ResidualPlace;
    use crate::camera::pixel_from_camera_point;
    use crate::project::{Camera, DatumKind, Interior, Observation, Photo, Point, Project, Role, Sigma};
    use crate::rotation::object_to_camera;
    use nalgebra::Vector3;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// Five turned photos of twelve points far from the origin, of which the first is held in one axis.
    fn network() -> (Network, State) {
        let camera = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("c", 2000, 1600, Interior::brown(12.0)) };
        let point = |k: u32| Point {
            id: k.to_string(),
            xyz: Some([5000.0 + f64::from(k % 4) * 100.0, f64::from(k / 4) * 100.0, f64::from(k * 7 % 5) * 40.0]),
            ..Point::default()
        };
        let photo = |k: u32| {
            let turn = f64::from(k) * 1.3;
            let position = [5150.0 + 900.0 * turn.cos(), 100.0 + 900.0 * turn.sin(), 900.0];
            // Towards the middle of the points: this is the third row of M.
            let view = (Vector3::from(position) - Vector3::new(5150.0, 100.0, 80.0)).normalize();
            let rotation = [(-view.y).atan2(view.z), view.x.asin(), turn];
            Photo {
                id: format!("s{k}"),
                camera: "c".into(),
                position: Some(position),
                rotation: Some(rotation),
                enabled: true,
                ..Photo::default()
            }
        };
        let mut project = Project {
            photos: (0..5).map(photo).collect::<Vec<_>>().into(),
            points: (0..12).map(point).collect::<Vec<_>>().into(),
            ..Project::default()
        };
        for (photo, point) in project.photos.iter().flat_map(|photo| project.points.iter().map(move |p| (photo, p))) {
            let (Some(position), Some(angles), Some(xyz)) = (photo.position, photo.rotation, point.xyz) else {
                continue;
            };
            let seen = object_to_camera(angles) * (Vector3::from(xyz) - Vector3::from(position));
            let [u, v] = pixel_from_camera_point(&camera, seen).expect("before the camera");
            let (photo, point) = (photo.id.clone(), point.id.clone());
            let sigma = Sigma::One(0.1);
            project.observations.push(Observation { photo, point, u, v, sigma, enabled: true, target: None });
        }
        project.cameras.push(camera);
        project.datum.kind = DatumKind::Control;
        project.points[0].role = Role::Control;
        project.points[0].sigma = Some([Some(1.0), Some(0.0), Some(1.0)]);
        Network::new(&project, &Numbering::of(&project), &RejectedObservations::nothing(&project)).unwrap()
    }

    #[test]
    fn what_is_kept_acts_as_the_products_of_the_rows_do() {
        let (mut network, state) = network();
        let layout = layout(&mut network);
        assert_eq!(network.points.iter().filter(|p| p.fixed == [false, true, false]).count(), 1);
        let weighting = Weighting { place: ResidualPlace::Corrected, robust: &[], shift: &[] };
        let mut normal = ReducedNormalEquations::new(&network, &layout);
        let context = Context { network: &network, layout: &layout, state: &state, weighting };
        assert!(normal.build(context, 0.0, &[]));
        let eliminated = &normal.eliminated;
        let linearisation = Linearisation::<0>::new(context).unwrap();
        let x: Vec<f64> = (0..layout.size).map(|k| (k as f64 * 0.7).sin()).collect();
        let motions = eliminated.motions(&layout, &x);
        let near = |a: f64, b: f64, size: f64| assert!((a - b).abs() < 1e-12 * size, "{a} {b}");
        for (point, block) in network.points.iter().enumerate() {
            let (mut room, mut behind) = (Vec::new(), 0);
            let rows = linearisation.point(point, &mut room, &mut behind).unwrap();
            let d = [0.3, -0.8, 0.5];
            let (mut product, mut moved, mut size) = ([0.0; 3], vec![0.0; layout.size], 0.0);
            for (row, ray) in rows.iter().zip(block.rays.clone()) {
                let b = row.point.map(|a| forward3(&eliminated.factors[point].l, a));
                let z = eliminated.z(&network, point, ray);
                let length = b.as_flattened().iter().chain(row.pose.as_flattened()).fold(0.0, |s, x| s + x * x);
                size += length;
                for (m, k) in (0..18).map(|n| (n / 6, n % 6)) {
                    let plain = b[0][m] * row.pose[0][k] + b[1][m] * row.pose[1][k];
                    near(z[m][k], plain, length);
                    let at = layout.photo[row.photo] + k;
                    product[m] += plain * x[at];
                    moved[at] -= plain * d[m];
                }
            }
            let got = eliminated.product(&network, &layout, point, &motions, &x);
            (0..3).for_each(|m| near(got[m], product[m], size));
            let mut got = vec![0.0; layout.size];
            eliminated.subtract(&network, &layout, point, &d, &mut got);
            got.iter().zip(&moved).for_each(|(a, b)| near(*a, *b, size));
        }
    }
}
