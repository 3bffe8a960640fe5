//! Cameras fixed to each other: the relative pose of each camera of a rig to the first one is the same at every exposure.
//!
//! With the attitudes M (object to camera) and projection centres X of the first camera (r) and another one (m) at exposure e,
//!
//! ```text
//! R_e = M_m M_rᵀ,   t_e = M_r (X_m - X_r)
//! ```
//!
//! are m's attitude and place in r's axes. Their means R̄ (the rotation with Σ log(R_e R̄ᵀ) = 0) and t̄ over the n exposures minimise
//!
//! ```text
//! Σ |log(R_e R̄ᵀ)|² / σ_R² + |t_e - t̄|² / σ_t²
//! ```
//!
//! and are eliminated beforehand: they are no unknowns of the equations, and each camera adds 6(n - 1) observations. With d_e the weighted deviations
//! from the mean, J_e their derivatives by both photos, the normal equations take up Σ JᵀJ - (ΣJ)ᵀ(ΣJ)/n and the right-hand side -Σ Jᵀd.
//! A turn τ of a photo about its camera axes, M' = exp([τ]×) M, and a shift δ of its projection centre change
//!
//! ```text
//! log(R_e R̄ᵀ) by τ_m - R_e τ_r,   t_e by τ_r × t_e + M_r (δ_m - δ_r)
//! ```
//!
//! the former as far as deviations are small; the gradient of the sum is exact for any. Elimination of parameters: E. M. Mikhail,
//! Observations and Least Squares, 1976; the base of a stereo rig as a constraint: J. L. Lerma, S. Navarro, M. Cabrelles, A. E. Segui,
//! Photogrammetric Record 25 (2010), 321.

use nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Vector3};

use crate::project::Rig;

use super::state::{Frame, State};

/// Weighted deviation of an exposure from the mean: rotation, then position.
pub type Deviation = SVector<f64, 6>;
/// Its derivatives by the first camera's photo and the other one's: turn and shift of each.
pub type ByPhotos = SMatrix<f64, 6, 12>;

/// Rounds of the mean of rotations, each of which leaves the square of the error, and the turn that is rounding.
const MOST_ROUNDS: usize = 20;
const SETTLED: f64 = 1e-15;

/// A camera of the rig other than the first.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its column in the document.
    pub column: usize,
    /// Per exposure its row in the document and the photos of the first camera and of this one (indices into `Network::photos`).
    pub exposures: Vec<(usize, [usize; 2])>,
    /// Reciprocal standard errors of rotation and position in the frame of the adjustment.
    pub sqrt_weight: [f64; 2],
}

/// The mean of the relative poses, and what each exposure is off.
#[derive(Clone, Debug)]
pub struct Mean {
    /// From the first camera's axes to the member's.
    pub rotation: Matrix3<f64>,
    /// The member's projection centre in the first camera's axes.
    pub position: Vector3<f64>,
    /// Per exposure, not weighted.
    pub deviations: Vec<Deviation>,
}

/// The members that any exposure has together with the first camera. `place` has the places of the document's photos in the network,
/// `usize::MAX` for those that are not used.
pub fn members(rig: &Rig, together: &[Vec<Option<usize>>], place: &[usize], frame: &Frame) -> Vec<Member> {
    let taking_part = |photo: Option<usize>| photo.map(|photo| place[photo]).filter(|at| *at != usize::MAX);
    let member = |column: usize| {
        let exposures = together.iter().enumerate().filter_map(|(row, photos)| {
            let pair = [taking_part(photos[0])?, taking_part(*photos.get(column)?)?];
            Some((row, pair))
        });
        let sqrt_weight = [1.0 / rig.sigma_rotation, frame.scale / rig.sigma_position];
        Member { column, exposures: exposures.collect(), sqrt_weight }
    };
    (1..rig.cameras()).map(member).filter(|member| !member.exposures.is_empty()).collect()
}

/// Rotation vector of a rotation matrix. The arc tangent keeps the digits of small turns; the arc cosine of the trace loses those below
/// 1e-8, which a stiff rig would take for deviations.
fn rotation_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    let sine = Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5;
    let (s, c) = (sine.norm(), 0.5 * (r.trace() - 1.0));
    match (s < 1e-9, c > 0.0) {
        (false, _) => sine * (s.atan2(c) / s),
        (true, true) => sine,
        // A rotation of 180°, whose axis is in the symmetric part.
        (true, false) => Rotation3::from_matrix_unchecked(*r).scaled_axis(),
    }
}

impl Member {
    /// Independent scalar observations: every exposure but one compares the relative pose.
    pub fn observations(&self) -> usize {
        6 * (self.exposures.len() - 1)
    }

    fn relative(&self, state: &State, exposure: usize) -> (Matrix3<f64>, Vector3<f64>) {
        let [first, own] = self.exposures[exposure].1.map(|photo| &state.poses[photo]);
        let m = first.matrix();
        (own.matrix() * m.transpose(), m * (Vector3::from(own.centre) - Vector3::from(first.centre)))
    }

    /// The mean of the relative poses at a state.
    pub fn mean(&self, state: &State) -> Mean {
        let n = self.exposures.len();
        let relative: Vec<_> = (0..n).map(|exposure| self.relative(state, exposure)).collect();
        let position = relative.iter().map(|(_, t)| t).sum::<Vector3<f64>>() / n as f64;
        let mut rotation = relative[0].0;
        let off = |r: &Matrix3<f64>, mean: &Matrix3<f64>| rotation_vector(&(r * mean.transpose()));
        for _ in 0..MOST_ROUNDS {
            let turn = relative.iter().map(|(r, _)| off(r, &rotation)).sum::<Vector3<f64>>() / n as f64;
            rotation = crate::rotation::turned(&rotation, turn);
            if turn.norm() < SETTLED {
                break;
            }
        }
        let deviation = |(r, t): &(Matrix3<f64>, Vector3<f64>)| {
            let (turn, shift) = (off(r, &rotation), t - position);
            Deviation::from_fn(|k, _| if k < 3 { turn[k] } else { shift[k - 3] })
        };
        Mean { rotation, position, deviations: relative.iter().map(deviation).collect() }
    }

    /// Derivatives of an exposure's relative pose by its photos, not weighted.
    pub fn by_photos(&self, state: &State, exposure: usize) -> ByPhotos {
        let (r, t) = self.relative(state, exposure);
        let m = state.poses[self.exposures[exposure].1[0]].matrix();
        let mut j = ByPhotos::zeros();
        j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-r);
        j.fixed_view_mut::<3, 3>(0, 6).fill_with_identity();
        // τ × t = -[t]× τ
        j.fixed_view_mut::<3, 3>(3, 0).copy_from(&-t.cross_matrix());
        j.fixed_view_mut::<3, 3>(3, 3).copy_from(&-m);
        j.fixed_view_mut::<3, 3>(3, 9).copy_from(&m);
        j
    }

    fn weight(&self, row: usize) -> f64 {
        self.sqrt_weight[row / 3]
    }

    /// Weighted deviations with their derivatives.
    pub fn equations(&self, state: &State) -> Vec<(Deviation, ByPhotos)> {
        let mean = self.mean(state);
        let one = |(exposure, deviation): (usize, &Deviation)| {
            let by_photos = self.by_photos(state, exposure);
            let weighted = Deviation::from_fn(|k, _| deviation[k] * self.weight(k));
            (weighted, ByPhotos::from_fn(|k, c| by_photos[(k, c)] * self.weight(k)))
        };
        mean.deviations.iter().enumerate().map(one).collect()
    }

    /// Weighted squares at a state.
    pub fn cost(&self, state: &State) -> f64 {
        let deviations = self.mean(state).deviations;
        deviations.iter().flat_map(|d| (0..6).map(move |k| (d[k] * self.weight(k)).powi(2))).sum()
    }

    /// The place of unknown `column` of an exposure's derivatives, in vectors where photo k begins at `photo[k]`.
    pub fn place(&self, photo: &[usize], exposure: usize, column: usize) -> usize {
        photo[self.exposures[exposure].1[column / 6]] + column % 6
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::problem::state::ExteriorOrientation;
    use crate::noise::Noise;
    use crate::rotation::turned;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// Exposures anywhere, whose relative pose scatters by `scatter`.
    fn state(exposures: usize, scatter: f64, seed: u64) -> (Member, State) {
        let mut noise = Noise::new(seed, 0);
        let mut three = |size: f64| Vector3::from_fn(|_, _| noise.normal() * size);
        let (base, turn) = (three(0.5), three(1.0));
        let mut state = State::default();
        for _ in 0..exposures {
            let first = ExteriorOrientation::new(three(2.0).into(), three(1.0).into());
            let m = first.matrix();
            let place = Vector3::from(first.centre) + m.transpose() * (base + three(scatter));
            let own = turned(&(Rotation3::new(turn).into_inner() * m), three(scatter));
            state.poses.push(first);
            state.poses.push(ExteriorOrientation { m: super::super::state::rows(&own), centre: place.into() });
        }
        let exposures = (0..exposures).map(|k| (k, [2 * k, 2 * k + 1])).collect();
        (Member { column: 1, exposures, sqrt_weight: [700.0, 30.0] }, state)
    }

    fn stepped(state: &State, photo: usize, k: usize, by: f64) -> State {
        let mut state = state.clone();
        let pose = &mut state.poses[photo];
        if k < 3 {
            let mut turn = Vector3::zeros();
            turn[k] = by;
            pose.m = super::super::state::rows(&turned(&pose.matrix(), turn));
        } else {
            pose.centre[k - 3] += by;
        }
        state
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        for seed in 0..20 {
            let (member, state) = state(4, 1e-7, seed);
            let equations = member.equations(&state);
            for (exposure, column) in (0..4).flat_map(|e| (0..12).map(move |c| (e, c))) {
                let photo = member.exposures[exposure].1[column / 6];
                let at = |by: f64| member.equations(&stepped(&state, photo, column % 6, by))[exposure].0;
                let step = 1e-5;
                let numeric = (at(step) - at(-step)) / (2.0 * step);
                // Of a deviation from the mean, to which the exposure itself adds a fourth.
                let analytic = equations[exposure].1.column(column) * 0.75;
                assert!((numeric - analytic).norm() < 1e-4 * 700.0, "{seed} {exposure} {column}: {numeric} {analytic}");
            }
        }
    }

    #[test]
    fn the_gradient_is_exact_for_large_deviations_too() {
        for seed in 0..20 {
            let (member, state) = state(5, 0.2, seed);
            let equations = member.equations(&state);
            for (exposure, column) in (0..5).flat_map(|e| (0..12).map(move |c| (e, c))) {
                let photo = member.exposures[exposure].1[column / 6];
                let cost = |by: f64| member.cost(&stepped(&state, photo, column % 6, by));
                let step = 1e-5;
                let numeric = (cost(step) - cost(-step)) / (2.0 * step);
                let (d, j) = &equations[exposure];
                let analytic = 2.0 * j.column(column).dot(d);
                assert!((numeric - analytic).abs() < 1e-5 * member.cost(&state), "{seed}: {numeric} {analytic}");
            }
        }
    }

    #[test]
    fn rotation_vectors_keep_their_digits() {
        for size in [0.0, 1e-15, 1e-12, 1e-8, 1e-3, 1.0, 3.0] {
            let turn = Vector3::new(0.6, -0.64, 0.48) * size;
            let found = rotation_vector(Rotation3::new(turn).matrix());
            assert!((found - turn).norm() <= 1e-15 + 1e-14 * size, "{size}: {found} {turn}");
        }
    }

    #[test]
    fn the_mean_leaves_no_sum() {
        let (member, state) = state(7, 0.3, 5);
        let sum = member.mean(&state).deviations.iter().sum::<Deviation>();
        assert!(sum.norm() < 1e-12, "{sum}");
    }
}
