//! Predicted position of a point in each photo, with its covariance, and its epipolar lines.
//!
//! The point is intersected from its rays. A ray's covariance in ideal coordinates is Σ = Σₗ + A·Cₑ·Aᵀ: that of the measurement, and that
//! of the photo's exterior orientation (A its derivatives, Cₑ from the adjustment). With B the derivatives
//! by the point, its covariance is C = (Σ Bᵀ Σ⁻¹ B)⁻¹, and that of its image in another photo is B·C·Bᵀ + A·Cₑ·Aᵀ. Errors common to all
//! photos (of the interior orientation, of the datum) are neglected, since they largely cancel. In a photo in which the point is already
//! measured, that measurement is not used for the prediction.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Matrix6, SMatrix, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::epipolar_line::epipolar_line;
use super::photo::OrientedPhoto;
use crate::adjustment::{AdjustedPhoto, Adjustment};
use crate::camera::pixel_from_camera_point;
use crate::detection::Target;
use crate::error::{Error, Place, Result, Thing};
use crate::initial::intersection::{Ray, intersect};
use crate::initial::pose::image_jacobian;
use crate::project::{Observation, Project};
use crate::rotation;

/// Options of [`predict`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PredictOptions {
    /// Photos in which epipolar lines are wanted; null: in all.
    pub lines_in: Option<Vec<String>>,
}

/// Predicted positions of a point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Identifier of the point.
    pub point: String,
    /// Number of oriented photos with an enabled observation of the point.
    pub rays: usize,
    /// Object coordinates from these rays; null for fewer than two rays, or if they do not intersect.
    pub xyz: Option<[f64; 3]>,
    /// Their standard errors; null if a photo that sees it has none of its orientation.
    pub sigma: Option<[f64; 3]>,
    /// Oriented photos whose orientation has no standard errors, since they are not adjusted or the adjustment has none: where one of
    /// them takes part the accuracy of the predicted position is not known, and no covariance is given.
    pub without_errors: Vec<String>,
    /// Every oriented photo, in the project's order.
    pub photos: Vec<PhotoPrediction>,
}

/// Predicted position of a point in one photo, pixels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PhotoPrediction {
    /// Identifier of the photo.
    pub photo: String,
    /// Measured position, enabled or not.
    pub measured: Option<[f64; 2]>,
    /// Position predicted from the rays of the other photos; null for fewer than two rays, or if the point is behind the camera.
    pub place: Option<[f64; 2]>,
    /// Covariance of that position: uu, uv, vv; null without the standard errors of the photos' orientations.
    pub covariance: Option<[f64; 3]>,
    /// Lower bound of that covariance, from the measurements and from the orientations that have standard errors.
    pub least_covariance: Option<[f64; 3]>,
    /// Whether that position lies in the picture.
    pub inside: bool,
    /// Distance of the measured from the predicted position.
    pub off_px: Option<f64>,
    /// The same in standard errors of both together (Mahalanobis distance).
    pub off_sigmas: Option<f64>,
    /// Epipolar lines of the rays of the other photos.
    pub lines: Vec<EpipolarLine>,
}

/// Epipolar line: the image of a ray of one photo in another.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EpipolarLine {
    /// The photo whose ray it is.
    pub from: String,
    /// Its course, curved by the distortion: corners in order.
    pub course: Vec<[f64; 2]>,
}

/// Minimum standard error of a measurement, pixels, for effects that are not modelled.
const FINEST_PX: f64 = 0.1;
/// Limit of the Mahalanobis distance: 99.73 % of a two-dimensional normal distribution.
const GATE: f64 = 3.44;
/// Step of the difference quotients: radians, and share of the distance.
const STEP: f64 = 1e-6;

/// An oriented photo, with the covariance of X, Y, Z, omega, phi, kappa.
struct Station {
    photo: OrientedPhoto,
    position: [f64; 3],
    rotation: [f64; 3],
    /// `None` if the orientation has no standard errors.
    covariance: Option<Matrix6<f64>>,
}

/// Intersection of the rays of several observations.
#[derive(Clone, Copy)]
struct Met {
    point: Vector3<f64>,
    /// Covariance matrix of the point, without the contribution of photos whose orientation has no covariance.
    covariance: Matrix3<f64>,
    /// Whether the orientations of all photos contributed.
    complete: bool,
}

/// A measurement of the point.
struct StationObservation {
    station: usize,
    pixel: [f64; 2],
    image: [f64; 2],
    sigma_px: f64,
}

/// Predicts where `point` should be in every oriented photo of the project.
///
/// `adjustment` is that of the project; it gives the covariances of the photos' orientations and sigma0. Without it the positions are
/// predicted without error ellipses. Only the cameras, the photos and the point's observations of the project are read.
///
/// # Errors
/// Those of [`Project::validate`]; [`Error::Unknown`] if the project has no such point.
pub fn predict(
    project: &Project,
    adjustment: Option<&Adjustment>,
    point: &str,
    options: &PredictOptions,
) -> Result<Prediction> {
    project.validate()?;
    if !project.points.iter().any(|p| p.id == point) {
        return Err(Error::Unknown { kind: Thing::Point, name: point.into(), at: Place::default() });
    }
    let stations = stations(project, adjustment);
    let sigma0 = adjustment.and_then(|a| a.sigma0).filter(|s| s.is_finite() && *s > 0.0).unwrap_or(1.0);
    let mine = project.observations.iter().filter(|o| o.point == point).collect::<Vec<_>>();
    let observations =
        mine.iter().filter(|o| o.enabled).filter_map(|o| station_observation(&stations, o, sigma0)).collect::<Vec<_>>();
    let all = meet(&stations, &observations.iter().collect::<Vec<_>>());
    let wanted = |photo: &str| options.lines_in.as_ref().is_none_or(|wanted| wanted.iter().any(|w| w == photo));
    let photos = stations.iter().enumerate().map(|(k, station)| {
        let others = observations.iter().filter(|s| s.station != k).collect::<Vec<_>>();
        let own = others.len() < observations.len();
        let met = if own { meet(&stations, &others) } else { all };
        let measured = mine.iter().find(|o| o.photo == station.photo.id).map(|o| [o.u, o.v]);
        let mut predicted = station.predicted(measured, met);
        if let Some(observation) = observations.iter().find(|s| s.station == k) {
            predicted.off_sigmas = predicted.distance(observation.pixel, observation.sigma_px);
        }
        if wanted(&station.photo.id) {
            let line = |s: &&StationObservation| {
                let from = &stations[s.station].photo;
                let course = epipolar_line(from, &station.photo, s.image);
                (course.len() > 1).then(|| EpipolarLine { from: from.id.clone(), course })
            };
            predicted.lines = others.iter().filter_map(line).collect();
        }
        predicted
    });
    let photos = photos.collect();
    let sigma = all.filter(|met| met.complete).map(|met| [0, 1, 2].map(|k| met.covariance[(k, k)].max(0.0).sqrt()));
    let without = stations.iter().filter(|s| s.covariance.is_none()).map(|s| s.photo.id.clone()).collect();
    let xyz = all.map(|met| met.point.into());
    Ok(Prediction { point: point.into(), rays: observations.len(), xyz, sigma, without_errors: without, photos })
}

fn stations(project: &Project, adjustment: Option<&Adjustment>) -> Vec<Station> {
    let adjusted = |id: &str| adjustment.and_then(|a| a.photos.iter().find(|p| p.id == id));
    let station = |photo: OrientedPhoto| {
        let (position, rotation) =
            project.photos.iter().find(|p| p.id == photo.id).and_then(|p| Some((p.position?, p.rotation?)))?;
        let covariance = adjusted(&photo.id).and_then(covariance);
        Some(Station { photo, position, rotation, covariance })
    };
    OrientedPhoto::all(project).into_iter().filter_map(station).collect()
}

/// Covariance matrix of a photo's six elements of exterior orientation from their standard errors and correlations; `None` if any is
/// missing.
fn covariance(photo: &AdjustedPhoto) -> Option<Matrix6<f64>> {
    let (position, angles) = (photo.sigma_position?, photo.sigma_rotation?);
    let rows = &photo.correlation.as_ref()?.matrix;
    if rows.len() < 6 || rows.iter().take(6).any(|row| row.len() < 6) {
        return None;
    }
    let sigma = |k: usize| if k < 3 { position[k] } else { angles[k - 3] };
    let covariance = Matrix6::from_fn(|i, j| sigma(i) * sigma(j) * if i == j { 1.0 } else { rows[i][j] });
    covariance.iter().all(|c| c.is_finite()).then_some(covariance)
}

/// The observation with its ray; `None` if its photo is not oriented or the pixel has no ray.
fn station_observation(stations: &[Station], o: &Observation, sigma0: f64) -> Option<StationObservation> {
    let station = stations.iter().position(|s| s.photo.id == o.photo)?;
    let image = stations[station].photo.ray([o.u, o.v])?;
    let [su, sv] = o.sigma.both();
    let sigma_px = (0.5 * (su * su + sv * sv)).sqrt() * sigma0;
    let sigma_px = if sigma_px.is_finite() { sigma_px.max(FINEST_PX) } else { FINEST_PX };
    Some(StationObservation { station, pixel: [o.u, o.v], image, sigma_px })
}

/// The point in which the rays of the observations intersect, with its covariance matrix.
fn meet(stations: &[Station], observations: &[&StationObservation]) -> Option<Met> {
    let in_image = |s: &StationObservation| s.sigma_px / stations[s.station].photo.principal_distance_px;
    let rays = observations.iter().map(|s| {
        let pose = stations[s.station].photo.pose;
        Ray { pose, image: s.image, weight: in_image(s).powi(-2) }
    });
    let met = intersect(&rays.collect::<Vec<_>>()).ok()?;
    let mut normal = Matrix3::zeros();
    for s in observations {
        let station = &stations[s.station];
        let measured = Matrix2::identity() * in_image(s).powi(2);
        let weight = (measured + station.of_pose(&met.point)?).try_inverse()?;
        let by_point = station.by_point(&met.point);
        normal += by_point.transpose() * weight * by_point;
    }
    let covariance = normal.try_inverse()?;
    let complete = observations.iter().all(|s| stations[s.station].covariance.is_some());
    let sound = met.point.iter().chain(covariance.iter()).all(|x| x.is_finite());
    sound.then_some(Met { point: met.point, covariance, complete })
}

impl Station {
    /// Derivatives of ideal coordinates by the point.
    fn by_point(&self, point: &Vector3<f64>) -> Matrix2x3<f64> {
        let pose = &self.photo.pose;
        image_jacobian(&pose.to_camera(point)) * pose.object_to_camera
    }

    /// Covariance of ideal coordinates from that of the exterior orientation, by difference quotients; zero if that has no covariance.
    fn of_pose(&self, point: &Vector3<f64>) -> Option<Matrix2<f64>> {
        let Some(covariance) = self.covariance else { return Some(Matrix2::zeros()) };
        let reach = (point - Vector3::from(self.position)).norm();
        let image = |k: usize, step: f64| {
            let (mut position, mut rotation) = (self.position, self.rotation);
            if k < 3 {
                position[k] += step
            } else {
                rotation[k - 3] += step
            };
            let p = rotation::object_to_camera(rotation) * (point - Vector3::from(position));
            (p.z < 0.0).then(|| Vector2::new(-p.x / p.z, -p.y / p.z))
        };
        let mut by_pose = SMatrix::<f64, 2, 6>::zeros();
        for k in 0..6 {
            let step = if k < 3 { STEP * reach } else { STEP };
            by_pose.set_column(k, &((image(k, step)? - image(k, -step)?) / (2.0 * step)));
        }
        Some(by_pose * covariance * by_pose.transpose())
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> Option<Vector2<f64>> {
        pixel_from_camera_point(&self.photo.camera, Vector3::new(x, y, -1.0)).map(Vector2::from)
    }

    /// The prediction for this photo from the intersection of the other photos' rays.
    fn predicted(&self, measured: Option<[f64; 2]>, met: Option<Met>) -> PhotoPrediction {
        let mut predicted = PhotoPrediction { photo: self.photo.id.clone(), measured, ..PhotoPrediction::default() };
        let place = || {
            let Met { point, covariance: cofactors, .. } = met?;
            let image = self.photo.pose.image(&point)?;
            let by_point = self.by_point(&point);
            let ideal = by_point * cofactors * by_point.transpose() + self.of_pose(&point)?;
            let step = |k: usize, h: f64| self.pixel([0, 1].map(|j| image[j] + if j == k { h } else { 0.0 }));
            let quotient = |k: usize| Some((step(k, STEP)? - step(k, -STEP)?) / (2.0 * STEP));
            let scale = Matrix2::from_columns(&[quotient(0)?, quotient(1)?]);
            let c = scale * ideal * scale.transpose();
            let finite = c.iter().all(|x| x.is_finite());
            finite.then_some((self.pixel(image)?, [c[(0, 0)], c[(0, 1)], c[(1, 1)]], self.photo.shows(&point)))
        };
        if let Some((pixel, covariance, inside)) = place() {
            predicted.place = Some(pixel.into());
            predicted.least_covariance = Some(covariance);
            let whole = self.covariance.is_some() && met.is_some_and(|met| met.complete);
            predicted.covariance = whole.then_some(covariance);
            predicted.inside = inside;
            predicted.off_px = measured.map(|[u, v]| (pixel - Vector2::new(u, v)).norm());
        }
        predicted
    }
}

impl PhotoPrediction {
    /// Semi-axes and angle (from u towards v) of the error ellipse of `sigmas` standard errors; `None` without a covariance.
    pub fn ellipse(&self, sigmas: f64) -> Option<[f64; 3]> {
        let [uu, uv, vv] = self.covariance?;
        let (mean, difference) = (0.5 * (uu + vv), 0.5 * (uu - vv));
        let radius = difference.hypot(uv);
        let axis = |variance: f64| sigmas * variance.max(0.0).sqrt();
        Some([axis(mean + radius), axis(mean - radius), 0.5 * uv.atan2(difference)])
    }

    /// Mahalanobis distance of a measurement with the standard error `sigma_px` from the predicted position; `None` without a covariance.
    pub fn distance(&self, at: [f64; 2], sigma_px: f64) -> Option<f64> {
        self.covariance.and_then(|covariance| self.apart(covariance, at, sigma_px))
    }

    fn apart(&self, [uu, uv, vv]: [f64; 3], [u, v]: [f64; 2], sigma_px: f64) -> Option<f64> {
        let [pu, pv] = self.place?;
        let own = sigma_px.max(FINEST_PX).powi(2);
        let both = Matrix2::new(uu + own, uv, uv, vv + own).try_inverse()?;
        let d = Vector2::new(u - pu, v - pv);
        Some((d.transpose() * both * d)[0].max(0.0).sqrt())
    }

    /// Targets that may be the point, the nearest first: index in the list and distance in standard errors. If the orientations have no
    /// standard errors, the lower bound of the covariance is used, so some targets may be missing.
    pub fn candidates(&self, targets: &[Target]) -> Vec<(usize, f64)> {
        let sigma = |t: &Target| (0.5 * (t.sigma_u.powi(2) + t.sigma_v.powi(2))).sqrt();
        let known = self.covariance.or(self.least_covariance);
        let apart = |t: &Target| self.apart(known?, [t.u, t.v], sigma(t));
        let near = |(k, t): (usize, &Target)| Some((k, apart(t).filter(|d| *d <= GATE)?));
        let mut found = targets.iter().enumerate().filter_map(near).collect::<Vec<_>>();
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        found
    }
}

#[cfg(test)]
#[path = "predict/tests.rs"]
mod tests;
