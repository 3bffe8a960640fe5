//! Projection uncertainty: the standard error of the pixel at which a direction, or a point at a distance, appears.
//!
//! ```text
//! Σ_q = J̃ Σ J̃ᵀ,   J̃ = J + K G
//! ```
//!
//! with the derivatives J of the pixel by the parameters and K by a motion of the camera, their covariance Σ from the adjustment, and the
//! motion Gθ that takes over most of a change θ (see [`super::motion`]). With [`MotionReference::Photos`] the motion is not fitted but the
//! mean of the photos' own, and Σ is the covariance of parameters and mean motion together (see
//! `src/adjust/solve/session/calibration.rs`): a point p of the object stays where the photos see it,
//! p' = p + ω × p - t.

use nalgebra::{DMatrix, Matrix2};
use serde::{Deserialize, Serialize};

use super::places::{self, ImagePlace};
use super::{FitRegion, GRID, MotionReference, motion};
use crate::adjust;
use crate::adjustment::{AdjustedCamera, Adjustment};
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Parameter, Project};

/// The question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct UncertaintyOptions {
    /// Camera identifier; may be left out where the adjustment has one camera.
    pub camera: Option<String>,
    /// Photo identifier, for a camera with an interior orientation per photo.
    pub photo: Option<String>,
    /// Places along the width and the height of the image, borders included.
    pub grid: [usize; 2],
    /// Distance of the points from the projection centre in the project's unit; null: directions.
    pub distance: Option<f64>,
    /// Where the motion is fitted.
    pub region: FitRegion,
    /// Which motion is taken out.
    pub reference: MotionReference,
}

impl Default for UncertaintyOptions {
    fn default() -> Self {
        Self {
            camera: None,
            photo: None,
            grid: GRID,
            distance: None,
            region: FitRegion::default(),
            reference: MotionReference::default(),
        }
    }
}

/// A place with its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorstPlace {
    /// Column, pixels.
    pub u: f64,
    /// Row, pixels.
    pub v: f64,
    /// Standard error in the worst direction, pixels.
    pub sigma: f64,
}

/// Standard errors of predicted pixels over the image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProjectionUncertainty {
    /// Camera identifier.
    pub camera: String,
    /// Photo whose own interior orientation it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Estimated parameters, whose uncertainty it is; what was held counts as known.
    pub parameters: Vec<Parameter>,
    /// Distance that it holds for; null: directions.
    pub distance: Option<f64>,
    /// Where the motion was fitted.
    pub region: FitRegion,
    /// Which motion was taken out.
    pub reference: MotionReference,
    /// Columns of the grid, pixels.
    pub u: Vec<f64>,
    /// Rows of the grid, pixels.
    pub v: Vec<f64>,
    /// Per row and column: standard error in the worst direction, pixels; null if the model gives no ray.
    pub sigma: Vec<Vec<Option<f64>>>,
    /// Per row and column: variances and covariance uu, uv, vv, square pixels.
    pub covariance: Vec<Vec<Option<[f64; 3]>>>,
    /// Per row and column: whether a measurement lies within one step of the grid. Elsewhere the calibration is extrapolated.
    pub covered: Vec<Vec<bool>>,
    /// The worst place.
    pub worst: Option<WorstPlace>,
    /// Median of the standard errors.
    pub median: Option<f64>,
}

/// Standard errors of the pixels at which a calibrated camera sees directions or points.
///
/// # Errors
/// [`Error::Unknown`] for a camera that the adjustment has not; [`Error::Invalid`] for a grid, a distance or a region that is none, without
/// standard errors of the camera's parameters, or, with [`MotionReference::Photos`], where the document's equations do not give the
/// adjustment's standard errors.
pub fn projection_uncertainty(
    project: &Project,
    adjustment: &Adjustment,
    options: &UncertaintyOptions,
) -> Result<ProjectionUncertainty> {
    let adjusted = chosen(adjustment, options.camera.as_deref(), options.photo.as_deref())?;
    let spread = ProjectionCovariance::of(project, adjustment, adjusted, options)?;
    let camera = &adjusted.camera;
    let [u, v] = places::axes(camera, options.grid)?;
    let at = |u: f64, v: f64| {
        let place = places::place(camera, &spread.parameters, [u, v], options.distance)?;
        spread.at(&place)
    };
    let covariance: Vec<Vec<Option<Matrix2<f64>>>> = v.iter().map(|v| u.iter().map(|u| at(*u, *v)).collect()).collect();
    let sigma: Vec<Vec<Option<f64>>> =
        covariance.iter().map(|row| row.iter().map(|c| c.map(|c| worst_direction(&c))).collect()).collect();
    let mut worst: Option<WorstPlace> = None;
    for (v, row) in v.iter().zip(&sigma) {
        for (u, sigma) in u.iter().zip(row) {
            if let Some(sigma) = *sigma
                && worst.is_none_or(|w| sigma > w.sigma)
            {
                worst = Some(WorstPlace { u: *u, v: *v, sigma });
            }
        }
    }
    let mut all: Vec<f64> = sigma.iter().flatten().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    Ok(ProjectionUncertainty {
        camera: camera.id.clone(),
        photo: adjusted.photo.clone(),
        parameters: spread.parameters.clone(),
        distance: options.distance,
        region: options.region,
        reference: options.reference,
        covered: covered(project, adjustment, adjusted, [&u, &v]),
        u,
        v,
        covariance: covariance
            .iter()
            .map(|row| row.iter().map(|c| c.map(|c| [c.m11, c.m12, c.m22])).collect())
            .collect(),
        sigma,
        worst,
        median: all.get(all.len() / 2).copied(),
    })
}

/// The adjusted camera that is meant.
///
/// # Errors
/// [`Error::Unknown`] for one that is not there, or where several are and none is named.
pub fn chosen<'a>(adjustment: &'a Adjustment, camera: Option<&str>, photo: Option<&str>) -> Result<&'a AdjustedCamera> {
    let mut own = adjustment.cameras.iter().filter(|adjusted| {
        camera.is_none_or(|id| adjusted.camera.id == id) && photo.is_none_or(|id| adjusted.photo.as_deref() == Some(id))
    });
    let unknown = |kind, name: &str, field| Error::Unknown { kind, name: name.to_owned(), at: Place::field(field) };
    let first = own.next().ok_or_else(|| match photo {
        Some(photo) => unknown(Thing::Photo, photo, "photo"),
        None => unknown(Thing::Camera, camera.unwrap_or_default(), "camera"),
    })?;
    if own.next().is_some() {
        let (reason, field) = match camera {
            Some(_) => (Reason::PhotoOfCamera, "photo"),
            None => (Reason::CameraOfSeveral, "camera"),
        };
        return Err(Error::Invalid { reason, at: Place::field(field) });
    }
    Ok(first)
}

/// Covariance of camera parameters and motion (parameters, turn, shift).
pub struct ProjectionCovariance {
    /// Estimated parameters.
    pub parameters: Vec<Parameter>,
    covariance: DMatrix<f64>,
}

impl ProjectionCovariance {
    /// # Errors
    /// As [`projection_uncertainty`].
    pub fn of(
        project: &Project,
        adjustment: &Adjustment,
        adjusted: &AdjustedCamera,
        options: &UncertaintyOptions,
    ) -> Result<Self> {
        places::checked(options.distance)?;
        motion::checked(options.reference, options.distance)?;
        let missing = || Error::Invalid {
            reason: Reason::NoCameraCovariance,
            at: Place { camera: Some(adjusted.camera.id.clone()), ..Place::default() },
        };
        let names = &adjusted.correlation.names;
        let parameters: Vec<Parameter> =
            names.iter().map(|name| name.parse().ok()).collect::<Option<_>>().ok_or_else(missing)?;
        let sigmas: Option<Vec<f64>> = parameters.iter().map(|p| adjusted.sigma.get(p).copied()).collect();
        let sigmas = sigmas.filter(|sigmas| !sigmas.is_empty()).ok_or_else(missing)?;
        let n = parameters.len();
        if options.reference == MotionReference::Photos {
            let covariance = adjust::calibration(project, adjustment, adjusted)?;
            return Ok(Self { parameters, covariance });
        }
        let correlation = |i: usize, j: usize| adjusted.correlation.matrix.get(i).and_then(|row| row.get(j)).copied();
        let own = DMatrix::from_fn(n, n, |i, j| {
            sigmas[i] * sigmas[j] * correlation(i, j).unwrap_or(if i == j { 1.0 } else { 0.0 })
        });
        let camera = &adjusted.camera;
        let region = places::region(camera, options.region);
        let region: Vec<ImagePlace> = region
            .into_iter()
            .filter_map(|pixel| places::place(camera, &parameters, pixel, options.distance))
            .collect();
        let taken = motion::absorbing(&region, options.reference)?;
        let mut all = DMatrix::zeros(n + 6, n);
        all.rows_mut(0, n).fill_with_identity();
        if taken.ncols() == n {
            all.rows_mut(n, 6).copy_from(&taken);
        }
        Ok(Self { parameters, covariance: &all * own * all.transpose() })
    }

    /// Covariance of the pixel at a place that was taken by [`Self::parameters`]; `None` if it is beyond all measure.
    pub fn at(&self, place: &ImagePlace) -> Option<Matrix2<f64>> {
        let j = self.derivatives(place);
        let c = &j * &self.covariance * j.transpose();
        let c = Matrix2::new(c[(0, 0)], c[(0, 1)], c[(1, 0)], c[(1, 1)]);
        c.iter().all(|x| x.is_finite()).then_some(c)
    }

    /// A root S of the covariance, S Sᵀ: parameters of every size, so it is taken of the correlations.
    pub fn root(&self) -> DMatrix<f64> {
        let n = self.covariance.nrows();
        let sigmas: Vec<f64> = self.covariance.diagonal().iter().map(|d| d.max(0.0).sqrt()).collect();
        let over = |s: f64| if s > 0.0 { 1.0 / s } else { 0.0 };
        let alike = DMatrix::from_fn(n, n, |i, j| {
            (self.covariance[(i, j)] + self.covariance[(j, i)]) / 2.0 * over(sigmas[i]) * over(sigmas[j])
        });
        let eigen = alike.symmetric_eigen();
        DMatrix::from_fn(n, n, |i, k| sigmas[i] * eigen.eigenvectors[(i, k)] * eigen.eigenvalues[k].max(0.0).sqrt())
    }

    /// Derivatives of the pixel by parameters and motion, two rows.
    pub fn derivatives(&self, place: &ImagePlace) -> DMatrix<f64> {
        let n = self.parameters.len();
        let mut j = DMatrix::zeros(2, n + 6);
        j.columns_mut(0, n).copy_from(&place.by_parameter);
        j.columns_mut(n, 6).copy_from(&place.by_motion);
        j
    }
}

/// Square root of the larger eigenvalue.
pub fn worst_direction(c: &Matrix2<f64>) -> f64 {
    let (mean, half) = ((c.m11 + c.m22) / 2.0, (c.m11 - c.m22) / 2.0);
    (mean + half.hypot((c.m12 + c.m21) / 2.0)).max(0.0).sqrt()
}

/// Per row and column of a grid whether a measurement that took part lies within one step of it.
pub fn covered(
    project: &Project,
    adjustment: &Adjustment,
    adjusted: &AdjustedCamera,
    [columns, rows]: [&[f64]; 2],
) -> Vec<Vec<bool>> {
    let mut covered = vec![vec![false; columns.len()]; rows.len()];
    let of_camera = |photo: &str| match &adjusted.photo {
        Some(own) => own == photo,
        None => project.photos.iter().any(|p| p.id == photo && p.camera == adjusted.camera.id),
    };
    let mut known: std::collections::HashMap<&str, bool> = std::collections::HashMap::new();
    let near = |axis: &[f64], x: f64| {
        let step = axis.get(1).map_or(f64::INFINITY, |second| second - axis[0]);
        let first = axis.partition_point(|at| *at < x - step);
        let last = axis.partition_point(|at| *at <= x + step);
        first..last
    };
    for (o, _) in project.observations.iter().zip(&adjustment.observations).filter(|(_, r)| r.enabled) {
        if !*known.entry(o.photo.as_str()).or_insert_with(|| of_camera(&o.photo)) {
            continue;
        }
        for j in near(rows, o.v) {
            covered[j][near(columns, o.u)].fill(true);
        }
    }
    covered
}
