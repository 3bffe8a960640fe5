//! Lateral colour as a set of parameter differences of a camera.
//!
//! What was measured of a photo is x = (t_u, t_v, l, c) with its covariance Q, pixels: a target at g in green stands in the other colour at
//!
//! g + s(g; x),  s = (t_u, t_v) + (l + c ρ²) (g - m) / R,  ρ = |g - m| / R,
//!
//! with m the middle of the picture and R the radius of its corners ([`crate::detection::Lateral`]). Several photos give the weighted mean
//! N⁻¹ Σ Q⁻¹ x, N = Σ Q⁻¹, whose covariance N⁻¹ grows by the ratio of their scatter to their standard errors where that is above 1: the aberration
//! changes with the focus.
//!
//! The differences d of the camera's parameters p are those that image best, over the whole picture, the ray of every g at g + s. With the
//! residuals of [`Model::linearise`] in the measurement, and their derivatives J by the parameters, Gauss and Newton's iteration
//! d ← d - (JᵀJ)⁻¹ Jᵀ e ends where the model leaves only what it cannot express. A shift is the principal point's, a scale the principal
//! distance's, the cubic part is K1's; K2, K3, P1 and P2 take what is left where the distortion is large or the principal point not the middle. Each of
//! these four without which no place of the picture is imaged [`NEGLIGIBLE_PX`] elsewhere is left out, and the others are fitted without it. To first order
//! d = L x with L = (JᵀJ)⁻¹ Jᵀ ∂s/∂x, so that its covariance is L N⁻¹ Lᵀ. This holds for both models, in millimetres and pixels.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Matrix4, Vector4};

use super::{Model, measurement_from_pixel, ray_from_pixel};
use crate::adjustment::ResidualPlace;
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Camera, ColourDifferences, ColourShift, LensColour, Parameter, PhotoColours};

/// Places along a side of the grid that the differences are fitted in.
const PLACES: u32 = 24;
/// Gauss-Newton steps: the differences are so small that the first leaves less than 1e-6 pixels.
const STEPS: usize = 4;
/// Rms in pixels that the model may leave of the aberration: a tenth of what centres are measured to.
const LEFT_PX: f64 = 0.005;
/// Pixels that a parameter must move some place of the picture by, or it is left out: a hundredth of what centres are measured to.
const NEGLIGIBLE_PX: f64 = 0.001;
/// Share of the places that must have a ray.
const SEEN: f64 = 0.95;

/// Red and blue of a camera from its photos whose colours were measured apart; `measured` has photos of this camera alone.
///
/// # Errors
/// [`Error::Invalid`] where no photo tells the aberration with its covariance, where a photo is of another grid, where the principal distance is
/// not known, and where the model cannot express the aberration to [`LEFT_PX`].
pub fn colour_differences(
    camera: &Camera,
    measured: &[PhotoColours],
) -> Result<BTreeMap<LensColour, ColourDifferences>> {
    let invalid = |reason| Err(Error::Invalid { reason, at: Place::camera(&camera.id).with_field("colours") });
    let (mut frame, mut found) = (None, BTreeMap::new());
    for colour in LensColour::ALL {
        let mut all = Vec::new();
        for photo in measured {
            let shift = match colour {
                LensColour::Red => &photo.red,
                LensColour::Blue => &photo.blue,
            };
            let Some((centre, seen)) = photo.centre.zip(shift.as_ref().and_then(Seen::of)) else { continue };
            let ([u, v], corner) = *frame.get_or_insert((centre, photo.corner));
            let off = (centre[0] - u).abs().max((centre[1] - v).abs()).max((photo.corner - corner).abs());
            if !(off < 1.0 && corner > 0.0) {
                return invalid(Reason::ColoursOfAnotherGrid { photo: photo.photo.clone() });
            }
            all.push(seen);
        }
        let (Some((centre, corner)), Some(mean)) = (frame, mean(&all)) else { continue };
        if Model::new(&camera.interior).is_none() {
            return invalid(Reason::ColoursWithoutDistance);
        }
        match fitted(camera, centre, corner, &mean) {
            Some((set, left)) if left <= LEFT_PX => found.insert(colour, set),
            left => {
                let left_px = left.map_or(f64::INFINITY, |(_, left)| left);
                return invalid(Reason::ColoursBeyondModel { left_px: left_px.into() });
            }
        };
    }
    if found.is_empty() { invalid(Reason::NoColoursMeasured) } else { Ok(found) }
}

/// The four numbers of a colour, with their covariance.
struct Seen {
    x: Vector4<f64>,
    covariance: Matrix4<f64>,
}

impl Seen {
    fn of(shift: &ColourShift) -> Option<Self> {
        let ([u, v], [q11, q12, q13, q14, q22, q23, q24, q33, q34, q44]) = shift.shift.zip(shift.covariance)?;
        #[rustfmt::skip]
        let covariance = Matrix4::new(
            q11, q12, q13, q14,
            q12, q22, q23, q24,
            q13, q23, q33, q34,
            q14, q24, q34, q44,
        );
        let x = Vector4::new(u, v, shift.linear, shift.cubic);
        let sound = x.iter().chain(covariance.iter()).all(|x| x.is_finite()) && covariance.cholesky().is_some();
        sound.then_some(Self { x, covariance })
    }
}

/// Weighted mean of the photos.
fn mean(all: &[Seen]) -> Option<Seen> {
    let weights = all.iter().map(|seen| Some(seen.covariance.cholesky()?.inverse())).collect::<Option<Vec<_>>>()?;
    let normal: Matrix4<f64> = weights.iter().sum();
    let right: Vector4<f64> = weights.iter().zip(all).map(|(weight, seen)| weight * seen.x).sum();
    let covariance = normal.cholesky()?.inverse();
    let x = covariance * right;
    let off = |(weight, seen): (&Matrix4<f64>, &Seen)| (seen.x - x).dot(&(weight * (seen.x - x)));
    let scatter: f64 = weights.iter().zip(all).map(off).sum();
    let free = 4.0 * (all.len() as f64 - 1.0);
    let factor = if free > 0.0 { (scatter / free).max(1.0) } else { 1.0 };
    Some(Seen { x, covariance: covariance * factor })
}

/// Derivatives of the shift at a place by the four numbers, pixels.
fn by_numbers([u, v]: [f64; 2], [mu, mv]: [f64; 2], corner: f64) -> [Vector4<f64>; 2] {
    let [x, y] = [(u - mu) / corner, (v - mv) / corner];
    let square = x * x + y * y;
    [Vector4::new(1.0, 0.0, x, x * square), Vector4::new(0.0, 1.0, y, y * square)]
}

/// A place of the grid: its ray, where the other colour stands and what the four numbers move there, in the camera's unit.
struct GridPlace {
    ray: [f64; 3],
    other: [f64; 2],
    by: [Vector4<f64>; 2],
}

/// The differences with their standard errors, and the rms in pixels that they leave.
fn fitted(camera: &Camera, centre: [f64; 2], corner: f64, seen: &Seen) -> Option<(ColourDifferences, f64)> {
    use Parameter as P;
    let model = camera.interior.model();
    let (distance, [x0, y0], [px, py]) = (model.distance, model.centre, camera.residual_pitch());
    let unit = [px, if model.in_photo_units { -py } else { py }];
    let place = |k: u32, size: u32| (f64::from(k) + 0.5) / f64::from(PLACES) * f64::from(size);
    let grid = (0..PLACES * PLACES).map(|k| [place(k % PLACES, camera.width), place(k / PLACES, camera.height)]);
    let rays: Vec<GridPlace> = grid
        .filter_map(|[u, v]| {
            let by = by_numbers([u, v], centre, corner);
            let other = [u + by[0].dot(&seen.x), v + by[1].dot(&seen.x)];
            Some(GridPlace {
                ray: ray_from_pixel(camera, [u, v])?,
                other: measurement_from_pixel(camera, other),
                by: [by[0] * unit[0], by[1] * unit[1]],
            })
        })
        .collect();
    if (rays.len() as f64) < SEEN * f64::from(PLACES * PLACES) {
        return None;
    }
    // Numerator and denominator of the rational model take each other's place in so small a difference.
    let wanted = [distance, x0, y0, P::K1, P::K2, P::K3, P::P1, P::P2].into_iter();
    let mut wanted: Vec<Parameter> = wanted.filter(|p| camera.interior.parameters().contains(p)).collect();
    let whole = Fit::of(camera, &rays, &wanted)?;
    let mut fit = None;
    for p in [P::P2, P::P1, P::K3, P::K2].into_iter().filter(|p| camera.interior.parameters().contains(p)) {
        let others: Vec<Parameter> = wanted.iter().copied().filter(|q| *q != p).collect();
        let without = Fit::of(camera, &rays, &others)?;
        if without.off(&whole, unit) < NEGLIGIBLE_PX {
            (wanted, fit) = (others, Some(without));
        }
    }
    let fit = fit.unwrap_or(whole);
    let pixels = fit.left.iter().zip(unit.iter().cycle()).map(|(e, unit)| (e / unit).powi(2)).sum::<f64>();
    let left = (pixels / fit.left.len() as f64).sqrt();
    let b = DMatrix::from_fn(fit.left.len(), 4, |row, n| rays[row / 2].by[row % 2][n]);
    let by_x = fit.solution * b;
    let covariance = &by_x * seen.covariance * by_x.transpose();
    let sigma: BTreeMap<Parameter, f64> =
        wanted.iter().enumerate().map(|(k, p)| (*p, covariance[(k, k)].max(0.0).sqrt())).collect();
    let finite = fit.differences.values().chain(sigma.values()).all(|x| x.is_finite());
    finite.then_some((ColourDifferences { parameters: fit.differences, sigma }, left))
}

/// The differences of some of the parameters.
struct Fit {
    differences: BTreeMap<Parameter, f64>,
    /// (JᵀJ)⁻¹ Jᵀ, a row a parameter.
    solution: DMatrix<f64>,
    /// What they leave at every place, u and v, in the camera's unit.
    left: DVector<f64>,
}

impl Fit {
    fn of(camera: &Camera, rays: &[GridPlace], wanted: &[Parameter]) -> Option<Self> {
        let parameters = camera.interior.parameters();
        let column = |p: &Parameter| parameters.iter().position(|own| own == p).unwrap_or_default();
        let columns: Vec<usize> = wanted.iter().map(column).collect();
        let mut differences: BTreeMap<Parameter, f64> = wanted.iter().map(|p| (*p, 0.0)).collect();
        let (mut j, mut e) = (DMatrix::zeros(2 * rays.len(), wanted.len()), DVector::zeros(2 * rays.len()));
        let linearise = |differences: &BTreeMap<Parameter, f64>, j: &mut DMatrix<f64>, e: &mut DVector<f64>| {
            let model = Model::new(&camera.interior.plus(differences))?;
            for (k, GridPlace { ray, other, .. }) in rays.iter().enumerate() {
                let linear = model.linearise(*other, *ray, ResidualPlace::Measured)?;
                for side in 0..2 {
                    let row = 2 * k + side;
                    e[row] = linear.residual[side];
                    columns.iter().enumerate().for_each(|(n, column)| j[(row, n)] = linear.by_parameter[side][*column]);
                }
            }
            Some(())
        };
        let mut inverse = DMatrix::zeros(wanted.len(), wanted.len());
        for _ in 0..STEPS {
            linearise(&differences, &mut j, &mut e)?;
            // K3 in pixels and a principal distance in pixels differ by twenty powers of ten
            let scale = DMatrix::from_diagonal(&DVector::from_iterator(
                wanted.len(),
                j.column_iter().map(|column| 1.0 / column.norm().max(f64::MIN_POSITIVE)),
            ));
            let scaled = &j * &scale;
            inverse = &scale * (scaled.transpose() * &scaled).cholesky()?.inverse() * &scale;
            let step = &inverse * (j.transpose() * &e);
            for (p, step) in wanted.iter().zip(step.iter()) {
                *differences.entry(*p).or_default() -= step;
            }
        }
        linearise(&differences, &mut j, &mut e)?;
        Some(Self { differences, solution: inverse * j.transpose(), left: e })
    }

    /// How far apart two fits image a place at most, in pixels.
    fn off(&self, other: &Self, unit: [f64; 2]) -> f64 {
        let apart = |k: usize| (self.left[k] - other.left[k]) / unit[k % 2];
        (0..self.left.len()).step_by(2).map(|k| apart(k).hypot(apart(k + 1))).fold(0.0, f64::max)
    }
}

#[cfg(test)]
#[path = "colours/tests.rs"]
mod tests;
