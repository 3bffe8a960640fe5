//! Finds photos that were resized, cropped, or taken at another principal distance.
//!
//! Its points fit the others' network only with a lens of its own. Three hypotheses are tried where the camera's lens makes most of its
//! measurements disagree: pixels divided by a factor about the corner of the picture (resized), shifted (cropped), or rays divided by a factor
//! about the principal point (another principal distance). Each has a pose by robust resection over a grid of its parameter, refined by robust
//! least squares.

use nalgebra::{DVector, Vector3, Vector6};

use super::least_squares::robust;
use super::seen::{distance_px, longer_side};
use crate::camera::ideal_from_pixel;
use crate::initial::Pose;
use crate::initial::resection::robust_resection;
use crate::project::Camera;

/// How a photo differs from its camera's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Framing {
    /// Its size is `factor` times the camera's.
    Resized {
        /// Over the camera's size.
        factor: f64,
    },
    /// It is the part of the camera's picture that begins at `offset`.
    Cropped {
        /// Pixels.
        offset: [f64; 2],
    },
    /// It was taken at another principal distance.
    OtherDistance {
        /// Pixels.
        px: f64,
    },
}

/// Points of a network in one photo.
#[derive(Clone, Debug)]
pub struct PhotoPoints<'a> {
    /// Points that others determine.
    pub object: Vec<Vector3<f64>>,
    /// Where the photo has them, pixels.
    pub pixels: Vec<[f64; 2]>,
    /// The camera assigned to it.
    pub camera: &'a Camera,
    /// Residual up to which a measurement agrees, pixels.
    pub limit_px: f64,
}

/// Points that it takes: six unknowns of the pose, up to two more, and some to agree.
const FEWEST: usize = 7;
/// Share of the measurements that agree with a hypothesis at least, and with the camera as given at most.
const AGREEING: f64 = 0.8;
const DISAGREEING: f64 = 0.6;
/// Factors tried: a tenth to four times, a fifth apart.
const FACTORS: [f64; 2] = [0.1, 4.0];
const STEP: f64 = 1.2;
/// Factors nearer to 1 are the lens's own uncertainty, offsets below so many pixels that of the principal point.
const CHANGED: f64 = 0.03;
const SHIFTED_PX: f64 = 20.0;
/// Offsets tried, as shares of the longer side.
const OFFSETS: [f64; 5] = [-0.4, -0.2, 0.0, 0.2, 0.4];

/// A hypothesis with the values of its parameters.
#[derive(Clone, Copy, Debug)]
enum Trial {
    Resized(f64),
    Cropped([f64; 2]),
    Distance(f64),
}

impl PhotoPoints<'_> {
    /// Ideal coordinates under a hypothesis, and pixels measured per unit of them.
    fn image(&self, trial: Trial) -> Option<(Vec<[f64; 2]>, f64)> {
        let px = distance_px(self.camera)?;
        let pixel = |p: [f64; 2]| match trial {
            Trial::Resized(factor) => p.map(|x| x / factor),
            Trial::Cropped(by) => [p[0] + by[0], p[1] + by[1]],
            Trial::Distance(_) => p,
        };
        let (of_ray, units) = match trial {
            Trial::Resized(factor) => (1.0, px * factor),
            Trial::Cropped(_) => (1.0, px),
            Trial::Distance(factor) => (1.0 / factor, px * factor),
        };
        let rays = self.pixels.iter().map(|p| ideal_from_pixel(self.camera, pixel(*p)).map(|r| r.map(|x| x * of_ray)));
        Some((rays.collect::<Option<Vec<_>>>()?, units))
    }

    /// Misfits in pixels under a hypothesis with a pose.
    fn misfits(&self, trial: Trial, pose: &Pose) -> Option<Vec<f64>> {
        let (image, units) = self.image(trial)?;
        Some(self.object.iter().zip(image).map(|(p, m)| pose.misfit(p, m) * units).collect())
    }

    /// The pose that most measurements agree with under a hypothesis, how many do, and the sum of the squares of their misfits, cut off.
    fn resected(&self, trial: Trial, limit_px: f64) -> Option<(usize, f64, Pose)> {
        let (image, units) = self.image(trial)?;
        let pose = robust_resection(&self.object, &image, limit_px / units, 0).ok()?.pose;
        let misfits = self.misfits(trial, &pose)?;
        let agreeing = misfits.iter().filter(|m| **m <= limit_px).count();
        Some((agreeing, misfits.iter().map(|m| m.min(limit_px).powi(2)).sum(), pose))
    }

    /// Hypothesis and pose refined together: misfits at the minimum.
    fn refined(&self, trial: Trial, pose: &Pose) -> Option<(Trial, Vec<f64>)> {
        let depth = self.object.iter().map(|p| (p - pose.centre).norm()).sum::<f64>() / self.object.len() as f64;
        let free = if matches!(trial, Trial::Cropped(_)) { 2 } else { 1 };
        let moved = |p: &DVector<f64>| match trial {
            Trial::Resized(factor) => Trial::Resized(factor * p[6].exp()),
            Trial::Distance(factor) => Trial::Distance(factor * p[6].exp()),
            Trial::Cropped([u, v]) => Trial::Cropped([u + p[6], v + p[7]]),
        };
        let posed = |p: &DVector<f64>| {
            let mut step = Vector6::from_iterator(p.iter().take(6).copied());
            step.fixed_rows_mut::<3>(3).scale_mut(depth);
            pose.moved(&step)
        };
        let residuals = |p: &DVector<f64>| -> Vec<[f64; 2]> {
            let Some((image, units)) = self.image(moved(p)) else {
                return vec![[f64::INFINITY, 0.0]; self.pixels.len()];
            };
            let (pose, unit) = (posed(p), units / (0.3 * self.limit_px));
            let residual = |(point, m): (&Vector3<f64>, [f64; 2])| {
                pose.residual(point, m).map_or([f64::INFINITY, 0.0], |r| [r.x * unit, r.y * unit])
            };
            self.object.iter().zip(image).map(residual).collect()
        };
        let steps: Vec<f64> = (0..6 + free).map(|k| if free == 2 && k > 5 { 1e-2 } else { 1e-7 }).collect();
        let (found, _) = robust(DVector::zeros(6 + free), &steps, &residuals);
        Some((moved(&found), self.misfits(moved(&found), &posed(&found))?))
    }
}

/// How the photo differs from its camera's pictures; `None` if it does not, or where no single difference explains it.
pub fn misframed(seen: &PhotoPoints) -> Option<Framing> {
    let count = seen.object.len();
    if count < FEWEST {
        return None;
    }
    let limit = seen.limit_px;
    let (given, _, _) = seen.resected(Trial::Distance(1.0), limit).unwrap_or((0, 0.0, Pose::identity()));
    if given as f64 > DISAGREEING * count as f64 {
        return None;
    }
    let side = longer_side(seen.camera);
    let factors: Vec<f64> =
        (0..).map(|k| FACTORS[0] * STEP.powi(k)).take_while(|factor| *factor <= FACTORS[1]).collect();
    let shifts = OFFSETS.iter().flat_map(|u| OFFSETS.map(|v| [u * side, v * side]));
    let families: [Vec<Trial>; 3] = [
        factors.iter().map(|f| Trial::Resized(*f)).collect(),
        factors.iter().map(|f| Trial::Distance(*f)).collect(),
        shifts.map(Trial::Cropped).collect(),
    ];
    // Between the steps of a grid no measurement agrees to the last pixel.
    let wide = (0.01 * side).max(limit);
    let mut found: Vec<(f64, Trial)> = Vec::new();
    for family in families {
        let tried = family.into_iter().filter_map(|trial| Some((seen.resected(trial, wide)?, trial)));
        let Some(((_, _, pose), trial)) = tried.min_by(|a, b| a.0.1.total_cmp(&b.0.1)) else { continue };
        let Some((trial, misfits)) = seen.refined(trial, &pose) else { continue };
        let agreeing = misfits.iter().filter(|m| **m <= limit).count();
        if agreeing as f64 >= AGREEING * count as f64 && agreeing > given + 2 {
            found.push((misfits.iter().map(|m| m.min(limit).powi(2)).sum(), trial));
        }
    }
    // A crop has one parameter more, and pays for it with what one more costs.
    let cost = |(squares, trial): &(f64, Trial)| match trial {
        Trial::Cropped(_) => squares * 1.5,
        _ => *squares,
    };
    let (_, best) = found.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
    match best {
        Trial::Resized(factor) => (factor.ln().abs() > CHANGED).then_some(Framing::Resized { factor }),
        Trial::Distance(factor) => {
            let px = distance_px(seen.camera)? * factor;
            (factor.ln().abs() > CHANGED).then_some(Framing::OtherDistance { px })
        }
        Trial::Cropped(offset) => (offset[0].hypot(offset[1]) > SHIFTED_PX).then_some(Framing::Cropped { offset }),
    }
}

#[cfg(test)]
mod tests;
