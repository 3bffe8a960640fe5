//! Residuals by column and row: their root mean square in bands of the image, beside what the standard errors let expect.
//!
//! ```text
//! rms² = Σ (vx² + vy²) / 2n,   expected² = Σ (rx σx² + ry σy²) / 2n
//! ```
//!
//! over the n measurements of a band, in pixels, with the residuals v, the standard errors σ of the measurements and their redundancy
//! numbers r: a residual has the standard deviation σ√r (W. Baarda 1968).

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use super::uncertainty::chosen;
use crate::adjustment::Adjustment;
use crate::error::{Error, Place, Reason, Result};
use crate::project::Project;

/// Bands across and down unless asked otherwise.
const BANDS: usize = 16;
/// Maximum number of bands.
const MOST: usize = 1000;

/// The question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct BandOptions {
    /// Camera identifier; may be left out where the adjustment has one camera.
    pub camera: Option<String>,
    /// Photo identifier, for a camera with an interior orientation per photo.
    pub photo: Option<String>,
    /// Bands across and down, 16 unless given.
    pub bands: usize,
}

impl Default for BandOptions {
    fn default() -> Self {
        Self { camera: None, photo: None, bands: BANDS }
    }
}

/// A band of columns or rows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ResidualBand {
    /// First pixel.
    pub from: f64,
    /// End, pixels.
    pub to: f64,
    /// Measurements.
    pub count: usize,
    /// Root mean square of a residual, pixels; null without measurements.
    pub rms: Option<f64>,
    /// What the standard errors of the measurements let expect, pixels; null without redundancy numbers.
    pub expected: Option<f64>,
}

/// Residuals of a camera in bands of the image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResidualBands {
    /// Camera identifier.
    pub camera: String,
    /// Photo whose own interior orientation it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// By column, from the left.
    pub columns: Vec<ResidualBand>,
    /// By row, from the top.
    pub rows: Vec<ResidualBand>,
}

/// BandSums of a band.
#[derive(Clone, Copy, Default)]
struct BandSums {
    count: usize,
    squares: f64,
    expected: Option<f64>,
}

impl BandSums {
    fn add(&mut self, squares: f64, expected: Option<f64>) {
        let before = if self.count == 0 { Some(0.0) } else { self.expected };
        self.expected = before.zip(expected).map(|(a, b)| a + b);
        self.count += 1;
        self.squares += squares;
    }
}

/// Root mean square of a camera's residuals in bands of columns and of rows. Measurements that did not take part are left out.
///
/// # Errors
/// [`Error::Unknown`] for a camera that the adjustment has not; [`Error::Invalid`] for fewer than two or more than a thousand bands, or an
/// adjustment of another document.
pub fn residual_bands(project: &Project, adjustment: &Adjustment, options: &BandOptions) -> Result<ResidualBands> {
    let adjusted = chosen(adjustment, options.camera.as_deref(), options.photo.as_deref())?;
    if !(2..=MOST).contains(&options.bands) {
        return Err(Error::Invalid { reason: Reason::CalibrationGrid, at: Place::field("bands") });
    }
    if project.observations.len() != adjustment.observations.len() {
        return Err(Error::Invalid { reason: Reason::EquationsOfAnother, at: Place::camera(&adjusted.camera.id) });
    }
    let camera = &adjusted.camera;
    let photos: HashSet<&str> = (project.photos.iter())
        .filter(|p| p.camera == camera.id && adjusted.photo.as_deref().is_none_or(|own| own == p.id))
        .map(|p| p.id.as_str())
        .collect();
    let sizes = [f64::from(camera.width), f64::from(camera.height)];
    let pitch = camera.residual_pitch();
    let mut sums = [vec![BandSums::default(); options.bands], vec![BandSums::default(); options.bands]];
    for (o, found) in project.observations.iter().zip(&adjustment.observations) {
        let (Some(vx), Some(vy), true) = (found.vx, found.vy, found.enabled && photos.contains(o.photo.as_str()))
        else {
            continue;
        };
        let squares = (vx / pitch[0]).powi(2) + (vy / pitch[1]).powi(2);
        let unmodelled = adjustment.options.unmodelled;
        let [su, sv] = o.sigma.both().map(|s| s * s + unmodelled * unmodelled);
        let expected = found.rx.zip(found.ry).map(|(rx, ry)| rx * su + ry * sv);
        for (sums, (at, size)) in sums.iter_mut().zip([o.u, o.v].into_iter().zip(sizes)) {
            let band = ((at / size * options.bands as f64).max(0.0) as usize).min(options.bands - 1);
            sums[band].add(squares, expected);
        }
    }
    let [columns, rows] = [0, 1].map(|axis: usize| {
        let width = sizes[axis] / options.bands as f64;
        let band = |(k, sum): (usize, &BandSums)| {
            let mean = |total: f64| (total.max(0.0) / 2.0 / sum.count as f64).sqrt();
            ResidualBand {
                from: k as f64 * width,
                to: (k + 1) as f64 * width,
                count: sum.count,
                rms: (sum.count > 0).then(|| mean(sum.squares)),
                expected: sum.expected.map(mean),
            }
        };
        sums[axis].iter().enumerate().map(band).collect()
    });
    Ok(ResidualBands { camera: camera.id.clone(), photo: adjusted.photo.clone(), columns, rows })
}
