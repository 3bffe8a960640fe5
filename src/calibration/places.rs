//! Image positions with the derivatives of a point's image by the camera's parameters and motions.

use nalgebra::{DMatrix, Matrix2x3, Vector3};

use super::FitRegion;
use crate::adjustment::ResidualPlace;
use crate::camera::{Model, measurement_from_pixel};
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Camera, Parameter};

/// Maximum number of places along a side of a grid: a million 2 x 2 matrices are a map, more is a mistake.
const LARGEST_GRID: usize = 1000;
/// Places along a side of the region that a motion is fitted over: a few hundred in all, of functions as smooth as a lens.
const ACROSS: u32 = 21;
/// Radius of the central region in parts of the shorter side.
const CENTRAL: f64 = 1.0 / 6.0;

/// A place in the image.
pub struct ImagePlace {
    /// The point seen there in the camera frame: at the distance, or at the distance 1 for a direction.
    pub point: Vector3<f64>,
    /// Derivatives of the pixel by the parameters, two rows.
    pub by_parameter: DMatrix<f64>,
    /// Derivatives of the pixel by a turn ω and a shift t of the camera, p' = p + ω × p - t, two rows; by t zero for a direction.
    pub by_motion: DMatrix<f64>,
}

/// The place of a pixel; `None` if the model gives it no ray.
pub fn place(camera: &Camera, parameters: &[Parameter], pixel: [f64; 2], distance: Option<f64>) -> Option<ImagePlace> {
    let model = Model::new(&camera.interior)?;
    let ray = Vector3::from(model.ray(camera, pixel)?).normalize();
    seen(camera, &model, parameters, pixel, ray * distance.unwrap_or(1.0), distance.is_some())
}

/// The place of a pixel at which a camera-frame point is seen.
pub fn seen(
    camera: &Camera,
    model: &Model,
    parameters: &[Parameter],
    pixel: [f64; 2],
    point: Vector3<f64>,
    is_near: bool,
) -> Option<ImagePlace> {
    let measured = measurement_from_pixel(camera, pixel);
    let linear = model.linearise(measured, point.into(), ResidualPlace::Measured)?;
    let [width, height] = camera.residual_pitch();
    // photo coordinates count upwards
    let per_pixel = [1.0 / width, if camera.interior.model().in_photo_units { -1.0 / height } else { 1.0 / height }];
    let by_point = Matrix2x3::from_fn(|s, a| linear.by_point[s][a] * per_pixel[s]);
    let columns = parameters.iter().map(|p| camera.interior.parameters().iter().position(|own| own == p));
    let columns: Vec<usize> = columns.collect::<Option<_>>()?;
    let by_parameter = DMatrix::from_fn(2, columns.len(), |s, k| linear.by_parameter[s][columns[k]] * per_pixel[s]);
    let by_turn = by_point * -point.cross_matrix();
    let by_motion = DMatrix::from_fn(2, 6, |s, k| match k {
        0..3 => by_turn[(s, k)],
        _ if is_near => -by_point[(s, k - 3)],
        _ => 0.0,
    });
    let finite = by_parameter.iter().chain(by_motion.iter()).all(|d| d.is_finite());
    finite.then_some(ImagePlace { point, by_parameter, by_motion })
}

/// Coordinates of the grid's columns and rows: from border to border of the image, both included.
///
/// # Errors
/// [`Error::Invalid`] for a grid of fewer than two places along a side, or of too many.
pub fn axes(camera: &Camera, grid: [usize; 2]) -> Result<[Vec<f64>; 2]> {
    if grid.iter().any(|n| !(2..=LARGEST_GRID).contains(n)) {
        return Err(Error::Invalid { reason: Reason::CalibrationGrid, at: Place::field("grid") });
    }
    let axis = |size: u32, n: usize| (0..n).map(|k| f64::from(size) * k as f64 / (n - 1) as f64).collect();
    Ok([axis(camera.width, grid[0]), axis(camera.height, grid[1])])
}

/// # Errors
/// [`Error::Invalid`] for a distance that is none.
pub fn checked(distance: Option<f64>) -> Result<()> {
    if distance.is_some_and(|d| !(d > 0.0 && d.is_finite())) {
        return Err(Error::Invalid { reason: Reason::CalibrationDistance, at: Place::field("distance") });
    }
    Ok(())
}

/// Pixels spread evenly over the region that a motion is fitted over.
pub fn region(camera: &Camera, region: FitRegion) -> Vec<[f64; 2]> {
    let (width, height) = (f64::from(camera.width), f64::from(camera.height));
    let step = |k: u32| (f64::from(k) + 0.5) / f64::from(ACROSS) - 0.5;
    let all = (0..ACROSS).flat_map(|j| (0..ACROSS).map(move |i| [step(i), step(j)]));
    let pixel = |[a, b]: [f64; 2], across: f64, down: f64| [width / 2.0 + a * across, height / 2.0 + b * down];
    match region {
        FitRegion::All => all.map(|at| pixel(at, width, height)).collect(),
        FitRegion::Centre => {
            let across = 2.0 * CENTRAL * width.min(height);
            all.filter(|[a, b]| a * a + b * b <= 0.25).map(|at| pixel(at, across, across)).collect()
        }
    }
}
