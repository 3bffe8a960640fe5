//! Difference of two calibrations: image positions of the second camera minus those of the first, after the motion that aligns them best.
//!
//! For a pixel q the first camera gives the ray d, the point p = D d at a distance D. The motion p' = R p - t minimises Σ |b(p') - q|² over a
//! region, b the second camera's projection, by Gauss and Newton's iteration from R = I, t = 0. What remains at the places of a grid, b(p') - q,
//! is the difference.

use nalgebra::{DMatrix, Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use super::places::{self, ImagePlace};
use super::{FitRegion, GRID, MotionReference, motion};
use crate::camera::Model;
use crate::error::{Error, Place, Reason, Result};
use crate::project::Camera;

/// Iterations of the fit; it is nearly linear, and ends at the rounding limit after a few.
const ITERATIONS: usize = 30;
/// A step, radians, that moves no image by a billionth of a pixel; rounding alone makes steps a hundred times shorter.
const NEGLIGIBLE: f64 = 1e-12;

/// Options of the comparison of two cameras.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DifferenceOptions {
    /// Places along the width and the height of the image, borders included.
    pub grid: [usize; 2],
    /// Distance of the points from the projection centre; null: directions.
    pub distance: Option<f64>,
    /// Where the motion is fitted.
    pub region: FitRegion,
    /// Which motion is taken out: rotation, rotation and translation, or none.
    pub reference: MotionReference,
}

impl Default for DifferenceOptions {
    fn default() -> Self {
        Self { grid: GRID, distance: None, region: FitRegion::default(), reference: MotionReference::default() }
    }
}

/// Where the second camera sees what the first one sees, minus where the first does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraDifference {
    /// Columns of the grid, pixels.
    pub u: Vec<f64>,
    /// Rows of the grid, pixels.
    pub v: Vec<f64>,
    /// Per row and column: difference in u, pixels; null if either camera has no image.
    pub du: Vec<Vec<Option<f64>>>,
    /// Per row and column: difference in v.
    pub dv: Vec<Vec<Option<f64>>>,
    /// Rotation from the first camera frame to the second as a vector along its axis, radians.
    pub rotation: [f64; 3],
    /// Translation t in the unit of the distance; null if none was fitted.
    pub translation: Option<[f64; 3]>,
    /// Distance that it holds for; null: directions.
    pub distance: Option<f64>,
    /// Root mean square length of the differences, pixels.
    pub rms_px: Option<f64>,
    /// Largest length.
    pub max_px: Option<f64>,
}

/// Difference of two calibrations of one image size.
///
/// # Errors
/// [`Error::Invalid`] for images of different sizes, a principal distance that is not known, a grid, a distance or a region that is none, or
/// a motion that does not bring the cameras together.
pub fn compare_cameras(a: &Camera, b: &Camera, options: &DifferenceOptions) -> Result<CameraDifference> {
    let fitted = AlignedCameras::new(a, b, options)?;
    let [u, v] = places::axes(a, options.grid)?;
    let difference: Vec<Vec<Option<[f64; 2]>>> =
        v.iter().map(|v| u.iter().map(|u| fitted.at([*u, *v])).collect()).collect();
    let part = |s: usize| difference.iter().map(|row| row.iter().map(|d| d.map(|d| d[s])).collect()).collect();
    let lengths: Vec<f64> = difference.iter().flatten().flatten().map(|d| d[0].hypot(d[1])).collect();
    let rms = (lengths.iter().map(|d| d * d).sum::<f64>() / lengths.len().max(1) as f64).sqrt();
    Ok(CameraDifference {
        du: part(0),
        dv: part(1),
        u,
        v,
        rotation: fitted.rotation.scaled_axis().into(),
        translation: (options.reference == MotionReference::RotationTranslation).then(|| fitted.translation.into()),
        distance: options.distance,
        rms_px: (!lengths.is_empty()).then_some(rms),
        max_px: lengths.iter().copied().reduce(f64::max),
    })
}

/// Two cameras aligned to each other.
pub struct AlignedCameras<'a> {
    a: &'a Camera,
    b: &'a Camera,
    models: [Model; 2],
    distance: f64,
    is_near: bool,
    rotation: Rotation3<f64>,
    translation: Vector3<f64>,
}

impl<'a> AlignedCameras<'a> {
    /// # Errors
    /// As [`compare_cameras`].
    pub fn new(a: &'a Camera, b: &'a Camera, options: &DifferenceOptions) -> Result<Self> {
        places::checked(options.distance)?;
        motion::checked(options.reference, options.distance)?;
        if options.reference == MotionReference::Photos {
            return Err(Error::Invalid { reason: Reason::PhotosOfNoAdjustment, at: Place::field("reference") });
        }
        if (a.width, a.height) != (b.width, b.height) {
            return Err(Error::Invalid { reason: Reason::CamerasOfTwoSizes, at: Place::camera(&b.id) });
        }
        let model = |camera: &Camera| {
            let unknown = || Error::Invalid { reason: Reason::PrincipalDistance, at: Place::camera(&camera.id) };
            Model::new(&camera.interior).ok_or_else(unknown)
        };
        let mut fitted = Self {
            a,
            b,
            models: [model(a)?, model(b)?],
            distance: options.distance.unwrap_or(1.0),
            is_near: options.distance.is_some(),
            rotation: Rotation3::identity(),
            translation: Vector3::zeros(),
        };
        let components = motion::components(options.reference);
        if components > 0 {
            fitted.fit(&places::region(a, options.region), components)?;
        }
        Ok(fitted)
    }

    fn fit(&mut self, region: &[[f64; 2]], components: usize) -> Result<()> {
        let apart = || Error::Invalid { reason: Reason::CamerasApart, at: Place::camera(&self.b.id) };
        for _ in 0..ITERATIONS {
            let mut seen: Vec<ImagePlace> = Vec::new();
            let mut shifts = Vec::new();
            for &pixel in region {
                let Some((point, image)) = self.image(pixel) else { continue };
                let Some(place) = places::seen(self.b, &self.models[1], &[], image, point, self.is_near) else {
                    continue;
                };
                seen.push(place);
                shifts.push(DMatrix::from_column_slice(2, 1, &[image[0] - pixel[0], image[1] - pixel[1]]));
            }
            if 2 * seen.len() <= components {
                return Err(Error::Invalid { reason: Reason::RegionWithoutRays, at: Place::field("region") });
            }
            let step = motion::against(&seen, components, &shifts)?;
            let turn = Vector3::new(step[0], step[1], step[2]);
            let shift = Vector3::new(step[3], step[4], step[5]);
            // p'' = exp([ω]×)(R p - t) - s
            let by = Rotation3::new(turn);
            self.rotation = by * self.rotation;
            self.translation = by * self.translation + shift;
            if turn.norm() + shift.norm() / self.distance < NEGLIGIBLE {
                return Ok(());
            }
            if !(turn.norm() < 3.0) {
                break;
            }
        }
        Err(apart())
    }

    /// The point in the second camera's frame, and its image there, of what the first camera sees at a pixel.
    fn image(&self, pixel: [f64; 2]) -> Option<(Vector3<f64>, [f64; 2])> {
        let ray = Vector3::from(self.models[0].ray(self.a, pixel)?).normalize();
        let shift = if self.is_near { self.translation } else { Vector3::zeros() };
        let point = self.rotation * (ray * self.distance) - shift;
        Some((point, self.models[1].pixel(self.b, point.into())?))
    }

    /// Difference at a pixel; `None` if either camera has no image.
    pub fn at(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        let (_, image) = self.image(pixel)?;
        Some([image[0] - pixel[0], image[1] - pixel[1]])
    }
}
