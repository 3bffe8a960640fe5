//! One camera model fitted to another: least squares over the part of the picture that is used, with the difference that remains.
//!
//! Directions d_i that a model images at pixels u_i of a grid over the region; the other model g with parameters q minimises
//! Σ |g(q, d_i) - u_i|² (Levenberg-Marquardt, derivatives by central differences of 0.05 px). A covariance C_p of the parameters of the first
//! becomes C_q = G C_p Gᵀ with G = ∂q/∂p = (JqᵀJq)⁻¹ Jqᵀ Jp, J the derivatives of all pixels: exact where nothing remains, and else to the
//! first order of what remains.

use crate::reason::ExchangeReason;
use nalgebra::{DMatrix, DVector, Vector3};
use serde::{Deserialize, Serialize};

use super::lens::{Lens, LensModel};
use sightline::camera::{Model, ideal_from_pixel};
use sightline::error::{Error, Place, Result};
pub use sightline::project::Conversion;
use sightline::project::{Camera, Parameter};

/// A larger difference is a warning: it is as large as a good target's standard error, and the adjustment would feel it.
pub const WARNING_PX: f64 = 0.05;
/// A larger difference is an error unless it is asked for: the file would show another camera.
pub const LARGEST_PX: f64 = 1.0;

/// Points of the fit along each side of the region's bounding box; a model has at most 20 parameters.
const FITTED: usize = 25;
/// The same for the difference that is stated: denser, so that it is not only seen where it was made small.
const STATED: usize = 81;

/// Covariance of parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Covariance {
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Rows.
    pub matrix: Vec<Vec<f64>>,
}

impl Covariance {
    /// A square symmetric matrix without negative variances.
    fn dense(&self, names: &[String]) -> Option<DMatrix<f64>> {
        let n = self.parameters.len();
        let square = n > 0 && self.matrix.len() == n && self.matrix.iter().all(|row| row.len() == n);
        if !square || self.matrix.iter().flatten().any(|value| !value.is_finite()) {
            return None;
        }
        // Parameters that are not named are held.
        let places: Option<Vec<usize>> =
            self.parameters.iter().map(|name| names.iter().position(|known| known == name)).collect();
        let places = places?;
        let mut all = DMatrix::zeros(names.len(), names.len());
        for (i, row) in self.matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                let scale = (self.matrix[i][i] * self.matrix[j][j]).abs().sqrt();
                if (value - self.matrix[j][i]).abs() > 1e-6 * scale || value.abs() > scale * (1.0 + 1e-9) {
                    return None;
                }
                all[(places[i], places[j])] = *value;
            }
            if self.matrix[i][i] < 0.0 || places[..i].contains(&places[i]) {
                return None;
            }
        }
        Some(all)
    }
}

/// The whole picture.
pub fn whole([width, height]: [u32; 2]) -> Vec<[f64; 2]> {
    let (w, h) = (f64::from(width), f64::from(height));
    vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]
}

/// Checks a region.
///
/// # Errors
/// [`ExchangeReason::RegionShape`].
pub fn check_region(region: &[[f64; 2]]) -> Result<()> {
    let finite = region.iter().flatten().all(|value| value.is_finite() && value.abs() < 1e9);
    let area: f64 = (0..region.len())
        .map(|k| {
            let ([x, y], [nx, ny]) = (region[k], region[(k + 1) % region.len()]);
            x * ny - nx * y
        })
        .sum();
    let spread = region.iter().any(|p| region.iter().any(|q| p[0] != q[0]) && region.iter().any(|q| p[1] != q[1]));
    if region.len() >= 3 && finite && spread && (area.abs() > 1e-9 || region.len() > 4) {
        return Ok(());
    }
    Err(Error::Invalid { reason: ExchangeReason::RegionShape.into(), at: Place::field("region") })
}

/// Points of a grid over the bounding box of a region that lie in it, its sides included.
fn grid(region: &[[f64; 2]], count: usize) -> Vec<[f64; 2]> {
    let bound = |axis: usize, pick: fn(f64, f64) -> f64| region.iter().map(|p| p[axis]).reduce(pick).unwrap_or(0.0);
    let [left, top] = [bound(0, f64::min), bound(1, f64::min)];
    let [right, bottom] = [bound(0, f64::max), bound(1, f64::max)];
    let mut points = Vec::new();
    for row in 0..count {
        for column in 0..count {
            let part = |k: usize| k as f64 / (count - 1) as f64;
            let point = [left + (right - left) * part(column), top + (bottom - top) * part(row)];
            if inside(region, point) {
                points.push(point);
            }
        }
    }
    points.extend(region);
    points
}

/// Whether a point lies in a polygon or, to a millionth of a pixel, on its sides.
fn inside(region: &[[f64; 2]], [u, v]: [f64; 2]) -> bool {
    let mut odd = false;
    for (k, [x, y]) in region.iter().enumerate() {
        let [nx, ny] = region[(k + 1) % region.len()];
        let (dx, dy) = (nx - x, ny - y);
        let along = ((u - x) * dx + (v - y) * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
        let along = along.clamp(0.0, 1.0);
        if (u - x - along * dx).hypot(v - y - along * dy) < 1e-6 {
            return true;
        }
        if (*y > v) != (ny > v) && u < x + (v - y) / dy * dx {
            odd = !odd;
        }
    }
    odd
}

/// A model whose parameters are moved: another program's, or the engine's.
#[derive(Clone, Debug)]
pub enum Side {
    /// Another program's, with the terms that none of its parameters moves.
    Lens(&'static LensModel, Lens),
    /// The engine's.
    Engine(Camera),
}

impl Side {
    /// Parameters of the engine's model that are independent.
    fn engine_parameters(camera: &Camera) -> impl Iterator<Item = Parameter> {
        camera.interior.parameters().iter().copied().filter(|parameter| *parameter != Parameter::F)
    }

    /// Names of the parameters.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Lens(shape, _) => shape.names(),
            Self::Engine(camera) => Self::engine_parameters(camera).map(|p| p.name().to_owned()).collect(),
        }
    }

    /// Name of the model.
    pub fn name(&self) -> String {
        match self {
            Self::Lens(shape, _) => shape.name.to_owned(),
            Self::Engine(camera) => model_name(camera).to_owned(),
        }
    }

    /// The engine's camera with these values.
    pub fn camera(camera: &Camera, values: &[f64]) -> Camera {
        let mut camera = camera.clone();
        let parameters: Vec<Parameter> = Self::engine_parameters(&camera).collect();
        parameters.into_iter().zip(values).for_each(|(parameter, value)| camera.interior.set(parameter, *value));
        camera
    }

    /// Values of an engine's camera.
    pub fn values(camera: &Camera) -> Vec<f64> {
        Self::engine_parameters(camera).map(|parameter| camera.interior.get(parameter).unwrap_or(0.0)).collect()
    }

    /// Pixels of all directions; `None` unless each has one.
    fn project(&self, values: &[f64], directions: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        match self {
            Self::Lens(shape, base) => {
                let lens = shape.lens(base, values);
                directions.iter().map(|direction| lens.project(*direction)).collect()
            }
            Self::Engine(camera) => {
                let camera = Self::camera(camera, values);
                let model = Model::new(&camera.interior)?;
                let pixel = |[a, b]: &[f64; 2]| {
                    let p = Vector3::new(*a, -b, -1.0).into();
                    model.pixel(&camera, p)
                };
                directions.iter().map(pixel).collect()
            }
        }
    }

    /// Changes of the parameters that move the pixels by about 0.05 px, each by itself.
    fn steps(&self, values: &[f64], directions: &[[f64; 2]]) -> Option<Vec<f64>> {
        const WANTED: f64 = 0.05;
        let start = self.project(values, directions)?;
        let step = |k: usize| {
            let mut step = values[k].abs().max(1e-3) * 1e-6;
            for _ in 0..60 {
                let mut moved = values.to_vec();
                moved[k] += step;
                let largest = self.project(&moved, directions).map(|pixels| {
                    pixels.iter().zip(&start).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).fold(0.0, f64::max)
                });
                step *= match largest {
                    Some(largest) if largest > 0.5 * WANTED && largest < 2.0 * WANTED => return Some(step),
                    Some(largest) if largest > 1e-5 && largest < 1e3 => WANTED / largest,
                    Some(largest) if largest <= 1e-5 => 1e3,
                    _ => 1e-3,
                };
            }
            None
        };
        (0..values.len()).map(step).collect()
    }

    /// Derivatives of all pixels by the parameters in units of `steps`: 2 n rows.
    fn jacobian(&self, values: &[f64], steps: &[f64], directions: &[[f64; 2]]) -> Option<DMatrix<f64>> {
        let mut all = DMatrix::zeros(2 * directions.len(), values.len());
        for (k, step) in steps.iter().enumerate() {
            let moved = |sign: f64| {
                let mut moved = values.to_vec();
                moved[k] += sign * step;
                self.project(&moved, directions)
            };
            let (more, less) = (moved(1.0)?, moved(-1.0)?);
            for (i, (p, q)) in more.iter().zip(&less).enumerate() {
                all[(2 * i, k)] = (p[0] - q[0]) / 2.0;
                all[(2 * i + 1, k)] = (p[1] - q[1]) / 2.0;
            }
        }
        Some(all)
    }
}

/// Name of the engine's model of a camera.
pub fn model_name(camera: &Camera) -> &'static str {
    camera.interior.model().name
}

/// Pixels over a region with their directions.
#[derive(Clone, Debug, Default)]
pub struct Rays {
    pixels: Vec<[f64; 2]>,
    directions: Vec<[f64; 2]>,
}

impl Rays {
    fn new(points: Vec<[f64; 2]>, direction: &dyn Fn([f64; 2]) -> Option<[f64; 2]>) -> Option<Self> {
        let mut rays = Self::default();
        for pixel in points {
            // A region of which a part has no image is not the region that is used.
            rays.directions.push(direction(pixel)?);
            rays.pixels.push(pixel);
        }
        Some(rays)
    }
}

/// Direction (a, b), b down, of a pixel of the engine's camera.
pub fn direction_of(camera: &Camera, pixel: [f64; 2]) -> Option<[f64; 2]> {
    ideal_from_pixel(camera, pixel).map(|[x, y]| [x, -y])
}

/// Result of a fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// Largest difference in pixels.
    pub max_px: f64,
    /// Root mean square difference.
    pub rms_px: f64,
}

/// Fits a model to directions of pixels over a region, from initial values; `None` if the model or the directions are not defined over all of it.
pub fn fit(
    side: &Side,
    start: &[f64],
    region: &[[f64; 2]],
    direction: &dyn Fn([f64; 2]) -> Option<[f64; 2]>,
) -> Option<Fitted> {
    let rays = Rays::new(grid(region, FITTED), direction)?;
    let n = start.len();
    let steps = side.steps(start, &rays.directions)?;
    let misclosure = |values: &[f64]| -> Option<DVector<f64>> {
        let pixels = side.project(values, &rays.directions)?;
        let parts = pixels.iter().zip(&rays.pixels).flat_map(|(p, q)| [q[0] - p[0], q[1] - p[1]]);
        Some(DVector::from_iterator(2 * pixels.len(), parts))
    };
    let mut values = start.to_vec();
    let mut e = misclosure(&values)?;
    let mut damping = 1e-3;
    for _ in 0..200 {
        let j = side.jacobian(&values, &steps, &rays.directions)?;
        let mut improved = false;
        while damping < 1e12 {
            let mut damped = j.clone().insert_rows(j.nrows(), n, 0.0);
            for k in 0..n {
                damped[(j.nrows() + k, k)] = damping * j.column(k).norm().max(1e-12);
            }
            let mut right = e.clone().insert_rows(j.nrows(), n, 0.0);
            let qr = damped.qr();
            qr.q_tr_mul(&mut right);
            let Some(turn) = qr.r().solve_upper_triangular(&right.rows(0, n).into_owned()) else { break };
            let trial: Vec<f64> = (0..n).map(|k| values[k] + turn[k] * steps[k]).collect();
            let moved = (&j * &turn).amax();
            match misclosure(&trial) {
                Some(next) if next.norm_squared() < e.norm_squared() => {
                    let gain = 1.0 - next.norm_squared() / e.norm_squared();
                    (values, e) = (trial, next);
                    damping = (damping * 0.1).max(1e-9);
                    improved = gain > 1e-14 && moved > 1e-11;
                    break;
                }
                _ if moved < 1e-9 => break,
                _ => damping *= 10.0,
            }
        }
        if !improved {
            break;
        }
    }
    let (max_px, rms_px) = difference(side, &values, region, direction)?;
    Some(Fitted { values, max_px, rms_px })
}

/// Largest and root mean square difference between a model and directions of pixels, over a region.
pub fn difference(
    side: &Side,
    values: &[f64],
    region: &[[f64; 2]],
    direction: &dyn Fn([f64; 2]) -> Option<[f64; 2]>,
) -> Option<(f64, f64)> {
    let rays = Rays::new(grid(region, STATED), direction)?;
    let pixels = side.project(values, &rays.directions)?;
    let squares: Vec<f64> =
        pixels.iter().zip(&rays.pixels).map(|(p, q)| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    Some((squares.iter().copied().fold(0.0, f64::max).sqrt(), mean.sqrt()))
}

/// Covariance of the parameters of one model from that of the other, which images the same directions at the same pixels.
///
/// # Errors
/// [`ExchangeReason::CovarianceShape`].
pub fn carried(
    covariance: &Covariance,
    (from, from_values): (&Side, &[f64]),
    (to, to_values): (&Side, &[f64]),
    region: &[[f64; 2]],
    direction: &dyn Fn([f64; 2]) -> Option<[f64; 2]>,
) -> Result<Covariance> {
    let invalid = || Error::Invalid { reason: ExchangeReason::CovarianceShape.into(), at: Place::field("covariance") };
    let given = covariance.dense(&from.names()).ok_or_else(invalid)?;
    let fails = || Error::Invalid {
        reason: ExchangeReason::ConversionFails { model: from.name() }.into(),
        at: Place::default(),
    };
    let carry = || {
        let rays = Rays::new(grid(region, FITTED), direction)?;
        let (from_steps, to_steps) =
            (from.steps(from_values, &rays.directions)?, to.steps(to_values, &rays.directions)?);
        let by_from = from.jacobian(from_values, &from_steps, &rays.directions)?;
        let by_to = to.jacobian(to_values, &to_steps, &rays.directions)?;
        let n = to_values.len();
        let qr = by_to.qr();
        let mut right = by_from;
        qr.q_tr_mul(&mut right);
        let mut g = qr.r().solve_upper_triangular(&right.rows(0, n).into_owned())?;
        for i in 0..n {
            for k in 0..from_values.len() {
                g[(i, k)] *= to_steps[i] / from_steps[k];
            }
        }
        let all = &g * given * g.transpose();
        all.iter().all(|value| value.is_finite()).then_some(all)
    };
    let all = carry().ok_or_else(fails)?;
    let matrix = (0..all.nrows()).map(|i| (0..all.ncols()).map(|k| all[(i, k)]).collect()).collect();
    Ok(Covariance { parameters: to.names(), matrix })
}

#[cfg(test)]
mod tests;
