//! The adjustment's result in the user's units, from states and cofactors in the frame of the adjustment.

use nalgebra::{Matrix3, Matrix6};

use crate::adjust::equations::context::Weighting;
use crate::adjust::gross_errors::start::LEAST;
use crate::adjust::problem::eccentric;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::problem::state::{Frame, State};
use crate::adjust::solve::session::{RigStatistics, RobustVariance, Session, Solution};
use crate::adjust::statistics::cofactors::Cofactors;
use crate::adjustment::{
    AdjustOptions, AdjustedCamera, AdjustedObservation, AdjustedPhoto, AdjustedPoint, Adjustment, CheckDistance,
    CheckPoint, CheckStatistics, Correlation, Criteria, GlobalTest, PhotoUnit, Precision, is_distortion,
};
use crate::camera;
use crate::project::{Camera, Project, Role};
use crate::rotation;
use crate::statistics::distribution::{GLOBAL_ALPHA, chi_squared_quantile};
use crate::statistics::reliability::Reliability;

use super::extent::{distance, largest_distance};

/// Inputs of a result.
pub struct Solved<'a> {
    /// The document.
    pub project: &'a Project,
    /// Meaning of its rows.
    pub numbering: &'a Numbering,
    /// The network.
    pub network: &'a Network,
    /// Adjusted values.
    pub state: &'a State,
    /// Cofactors, unless without statistics.
    pub cofactors: Option<&'a Cofactors>,
    /// Weights and place of the residuals.
    pub weighting: Weighting<'a>,
    /// Square roots of robust factors of given observations, contained in the network's weights; empty for none.
    pub additional_factors: &'a [f64],
    /// vᵀPv.
    pub cost: f64,
    /// Datum constraints.
    pub constraints: usize,
    /// n - u + d.
    pub redundancy: usize,
    /// The variance factor after robust estimation.
    pub robust: Option<RobustVariance>,
    /// Covariances and tests of the relative poses of the rig; empty without statistics.
    pub rig: &'a [RigStatistics],
    /// Standard errors of the distances that are compared only.
    pub check_lengths: &'a [Option<f64>],
}

/// Derivative of the turn by omega, phi, kappa: t = -(Mκ Mφ e1, Mκ e2, e3)·(dω, dφ, dκ).
fn turn_by_angles([_, phi, kappa]: [f64; 3]) -> Matrix3<f64> {
    let (sp, cp) = phi.sin_cos();
    let (sk, ck) = kappa.sin_cos();
    Matrix3::new(-cp * ck, -sk, 0.0, cp * sk, -ck, 0.0, -sp, 0.0, -1.0)
}

/// Square root of a variance, 0 if rounding made it negative.
pub(super) fn root(variance: f64) -> f64 {
    variance.max(0.0).sqrt()
}

fn correlation(names: Vec<String>, covariance: impl Fn(usize, usize) -> f64) -> Correlation {
    let n = names.len();
    let sigma: Vec<f64> = (0..n).map(|k| root(covariance(k, k))).collect();
    let value = |i: usize, j: usize| {
        if i == j {
            return 1.0;
        }
        let product = sigma[i] * sigma[j];
        if product > 0.0 { (covariance(i, j) / product).clamp(-1.0, 1.0) } else { 0.0 }
    };
    let matrix = (0..n).map(|i| (0..n).map(|j| value(i, j)).collect()).collect();
    Correlation { names, matrix }
}

impl<'a> Solved<'a> {
    /// The result's view of a session.
    pub fn new(session: &'a Session<'_>, options: &AdjustOptions, solution: &'a Solution) -> Self {
        Self {
            project: session.project,
            numbering: session.numbering,
            network: &session.network,
            state: &session.state,
            cofactors: solution.cofactors.as_ref(),
            weighting: session.context(options.residuals).weighting,
            additional_factors: &session.additional_factors,
            cost: solution.cost,
            constraints: session.datum.as_ref().map_or(0, |d| d.defect),
            redundancy: session.redundancy,
            robust: session.robust,
            rig: &solution.rig,
            check_lengths: &solution.check_lengths,
        }
    }
}

impl Solved<'_> {
    /// Factor from cofactors to covariances: σ0², or 1 where nothing determines it.
    fn variance_factor(&self) -> f64 {
        match self.robust {
            Some(robust) => robust.variance,
            None if self.redundancy > 0 => self.cost / self.redundancy as f64,
            None => 1.0,
        }
    }

    /// Origin and unit of the coordinates inside.
    pub fn frame(&self) -> &Frame {
        &self.network.frame
    }

    /// Fills in everything that follows from the solution; iterations, termination and advice are the caller's.
    pub fn adjustment(&self) -> Adjustment {
        let redundancy = self.redundancy;
        let tested = redundancy > 0;
        let statistic = self.robust.map_or(self.cost, |robust| robust.sigma0.powi(2) * redundancy as f64);
        let test = tested.then(|| {
            let lower = chi_squared_quantile(GLOBAL_ALPHA / 2.0, redundancy);
            let upper = chi_squared_quantile(1.0 - GLOBAL_ALPHA / 2.0, redundancy);
            GlobalTest { statistic, lower, upper, passed: (lower..=upper).contains(&statistic) }
        });
        let points = self.points();
        let observations = self.observations();
        let check_points = self.check_points();
        let photos = self.photos(&observations);
        Adjustment {
            observations_count: self.network.observations_count(),
            unknowns: self.network.unknowns(),
            constraints: self.constraints,
            redundancy,
            sigma0: tested.then(|| (statistic / redundancy as f64).sqrt()),
            global_test: test,
            rms_px: rms_px(&photos),
            criteria: Criteria::of(redundancy),
            cameras: self.cameras(),
            photos,
            rig: self.relative_poses(),
            precision: self.precision(&points),
            points,
            observations,
            check_statistics: check_statistics(&check_points),
            check_points,
            check_distances: self.check_distances(),
            given: self.additional(),
            eccentricity: eccentric::eccentricities(self.project, self.network, self.weighting.shift),
            ..Adjustment::default()
        }
    }

    fn adjusted_camera(&self, k: usize) -> Camera {
        let mut camera = self.project.cameras[self.network.interiors[k].camera].clone();
        camera.interior = self.state.interiors[k];
        camera
    }

    /// Interior orientations in the network's order.
    pub fn cameras(&self) -> Vec<AdjustedCamera> {
        let factor = self.variance_factor();
        (0..self.network.interiors.len())
            .map(|k| {
                let block = &self.network.interiors[k];
                let mut adjusted = AdjustedCamera {
                    camera: self.adjusted_camera(k),
                    photo: block.photo.map(|p| self.project.photos[self.network.photos[p].index].id.clone()),
                    sigma: Default::default(),
                    significance: Default::default(),
                    correlation: Correlation::default(),
                };
                if let Some(cofactors) = self.cofactors {
                    let q = &cofactors.interiors[k];
                    let names = block.estimated.iter().map(|e| e.parameter.name().to_owned()).collect();
                    adjusted.correlation = correlation(names, |i, j| q[(i, j)]);
                    for (n, estimated) in block.estimated.iter().enumerate() {
                        let sigma = root(factor * q[(n, n)]) * estimated.scale;
                        adjusted.sigma.insert(estimated.parameter, sigma);
                        let value = adjusted.camera.interior.get(estimated.parameter);
                        if let (true, true, Some(value)) = (sigma > 0.0, is_distortion(estimated.parameter), value) {
                            adjusted.significance.insert(estimated.parameter, value.abs() / sigma);
                        }
                    }
                }
                adjusted
            })
            .collect()
    }

    fn photos(&self, observations: &[AdjustedObservation]) -> Vec<AdjustedPhoto> {
        let mut squares = vec![[0.0; 2]; self.network.photos.len()];
        for ray in &self.network.rays {
            let o = &observations[ray.row];
            for (sum, v) in squares[ray.photo].iter_mut().zip([o.vx, o.vy]) {
                *sum += v.map_or(0.0, |v| v * v);
            }
        }
        let factor = self.variance_factor();
        let scale = self.frame().scale;
        let photo = |k: usize| {
            let block = &self.network.photos[k];
            let pose = &self.state.poses[k];
            let angles = rotation::angles(&pose.matrix());
            let count = block.rays.max(1) as f64;
            let camera = &self.project.cameras[self.network.interiors[block.interior].camera];
            let (unit, pixel) = PhotoUnit::of(camera);
            let mut adjusted = AdjustedPhoto {
                id: self.project.photos[block.index].id.clone(),
                position: self.frame().outside(pose.centre),
                rotation: angles,
                rms_x: (squares[k][0] / count).sqrt(),
                rms_y: (squares[k][1] / count).sqrt(),
                unit,
                pixel,
                points: block.rays,
                ..AdjustedPhoto::default()
            };
            let Some(cofactors) = self.cofactors else { return adjusted };
            let q = &cofactors.photos[k];
            adjusted.sigma_position = Some(std::array::from_fn(|a| root(factor * q[(3 + a, 3 + a)]) * scale));
            let by_angles = turn_by_angles(angles);
            let inverse = if angles[1].cos().abs() > 1e-6 { by_angles.try_inverse() } else { None };
            if let Some(inverse) = inverse {
                // From (turn, centre) to (centre, angles).
                let mut change = Matrix6::zeros();
                change.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
                change.fixed_view_mut::<3, 3>(3, 0).copy_from(&inverse);
                let own = change * q * change.transpose();
                adjusted.sigma_rotation = Some(std::array::from_fn(|a| root(factor * own[(3 + a, 3 + a)])));
                let interior = &cofactors.interiors[block.interior];
                let cross = change * &cofactors.photo_interior[k];
                let mut names: Vec<String> = ["X", "Y", "Z", "omega", "phi", "kappa"].map(String::from).into();
                let estimated = &self.network.interiors[block.interior].estimated;
                names.extend(estimated.iter().map(|e| e.parameter.name().to_owned()));
                adjusted.correlation = Some(correlation(names, |i, j| match (i < 6, j < 6) {
                    (true, true) => own[(i, j)],
                    (true, false) => cross[(i, j - 6)],
                    (false, true) => cross[(j, i - 6)],
                    (false, false) => interior[(i - 6, j - 6)],
                }));
            }
            adjusted
        };
        (0..self.network.photos.len()).map(photo).collect()
    }

    fn points(&self) -> Vec<AdjustedPoint> {
        let factor = self.variance_factor() * self.frame().scale.powi(2);
        let point = |k: usize| {
            let block = &self.network.points[k];
            let covariance = self.cofactors.map(|c| c.points[k] * factor);
            AdjustedPoint {
                id: self.project.points[block.index].id.clone(),
                xyz: self.point(k),
                sigma: covariance.map(|c| std::array::from_fn(|a| root(c[(a, a)]))),
                covariance: covariance.map(|c| [c.m11, c.m12, c.m13, c.m22, c.m23, c.m33]),
                rays: block.rays.len(),
            }
        };
        (0..self.network.points.len()).map(point).collect()
    }

    /// Coordinates outside; held axes return exactly as given.
    pub fn point(&self, k: usize) -> [f64; 3] {
        let block = &self.network.points[k];
        let mut xyz = self.frame().outside(self.state.points[k]);
        if let Some(given) = self.project.points[block.index].xyz {
            (0..3).filter(|a| block.fixed[*a]).for_each(|a| xyz[a] = given[a]);
        }
        xyz
    }

    /// Residuals of every image observation of the document whose photo and point took part.
    fn observations(&self) -> Vec<AdjustedObservation> {
        let (mut photos, mut points) = (vec![None; self.project.photos.len()], vec![None; self.project.points.len()]);
        self.network.photos.iter().enumerate().for_each(|(k, block)| photos[block.index] = Some(k));
        self.network.points.iter().enumerate().for_each(|(k, block)| points[block.index] = Some(k));
        let mut ray_of_row = vec![usize::MAX; self.project.observations.len()];
        self.network.rays.iter().enumerate().for_each(|(k, ray)| ray_of_row[ray.row] = k);
        let models: Vec<_> = self.state.interiors.iter().map(camera::Model::new).collect();
        let scale = self.frame().scale;
        let one = |(row, o): (usize, &crate::project::Observation)| {
            let mut adjusted = AdjustedObservation {
                photo: o.photo.clone(),
                point: o.point.clone(),
                ..AdjustedObservation::default()
            };
            let (photo, point) = self.numbering.observations[row];
            let (Some(photo), Some(point)) = (photos[photo], points[point]) else { return adjusted };
            let interior = self.network.photos[photo].interior;
            let ray = ray_of_row[row];
            let mut measured = match self.network.rays.get(ray) {
                Some(ray) => ray.measured,
                None => camera::measurement_from_pixel(
                    &self.project.cameras[self.network.interiors[interior].camera],
                    [o.u, o.v],
                ),
            };
            if let Some(shift) = self.weighting.shift.get(ray) {
                (0..2).for_each(|s| measured[s] -= shift[s]);
            }
            let p = self.state.poses[photo].camera_point(&self.state.points[point]);
            let linear = models[interior].and_then(|m| m.linearise(measured, p, self.weighting.place));
            let Some(linear) = linear.filter(|l| l.residual.iter().all(|v| v.is_finite())) else { return adjusted };
            [adjusted.vx, adjusted.vy] = linear.residual.map(Some);
            let Some(network_ray) = self.network.rays.get(ray) else { return adjusted };
            adjusted.enabled = true;
            let robust = self.weighting.robust.get(ray);
            adjusted.weight = robust.map(|w| w[0].min(w[1]).powi(2)).filter(|w| *w < 1.0);
            if let Some(cofactors) = self.cofactors.filter(|c| !c.rays.is_empty()) {
                let side = |s: usize| {
                    let sqrt_weight = network_ray.sqrt_weight[s] * robust.map_or(1.0, |w| w[s]);
                    let (normalised, q) = (linear.residual[s] * sqrt_weight, cofactors.rays[ray][s]);
                    let mut test = Reliability::new(normalised, q, 1.0 / sqrt_weight);
                    if robust.is_some_and(|w| w[s] <= LEAST) {
                        // What has lost its weight is not tested.
                        test = Reliability { redundancy: test.redundancy, ..Reliability::default() };
                    }
                    (test, test.mdb.map(|mdb| mdb * sqrt_weight * cofactors.influence[ray][s] * scale))
                };
                let ((x, effect_x), (y, effect_y)) = (side(0), side(1));
                (adjusted.rx, adjusted.wx, adjusted.mdb_x) = (Some(x.redundancy), x.w, x.mdb);
                (adjusted.ry, adjusted.wy, adjusted.mdb_y) = (Some(y.redundancy), y.w, y.mdb);
                (adjusted.effect_x, adjusted.effect_y) = (effect_x, effect_y);
            }
            adjusted
        };
        self.project.observations.iter().enumerate().map(one).collect()
    }

    fn check_distances(&self) -> Vec<CheckDistance> {
        let place = |id: &str| self.network.points.iter().position(|p| self.project.points[p.index].id == id);
        let checks = self.project.distances.iter().filter(|d| d.check).enumerate();
        checks
            .map(|(k, d)| {
                let ends = place(&d.from).zip(place(&d.to));
                let length = ends.map(|(a, b)| distance(&self.point(a), &self.point(b)));
                CheckDistance {
                    from: d.from.clone(),
                    to: d.to.clone(),
                    length: d.length,
                    difference: length.map(|length| length - d.length),
                    sigma: self.check_lengths.get(k).copied().flatten(),
                }
            })
            .collect()
    }

    fn check_points(&self) -> Vec<CheckPoint> {
        let mut place = vec![None; self.project.points.len()];
        self.network.points.iter().enumerate().for_each(|(k, p)| place[p.index] = Some(k));
        let checks = self.project.points.iter().enumerate().filter(|(_, p)| p.role == Role::Check);
        checks
            .map(|(k, point)| {
                let difference = place[k].zip(point.xyz).map(|(at, given)| {
                    let adjusted = self.point(at);
                    std::array::from_fn(|a| adjusted[a] - given[a])
                });
                CheckPoint { id: point.id.clone(), difference }
            })
            .collect()
    }

    fn precision(&self, points: &[AdjustedPoint]) -> Option<Precision> {
        let cofactors = self.cofactors?;
        let scale = self.frame().scale;
        let mut precision = Precision::default();
        let mut count = 0.0;
        for ((block, point), q) in self.network.points.iter().zip(points).zip(&cofactors.points) {
            if self.project.points[block.index].role == Role::Tie {
                count += 1.0;
                for a in 0..3 {
                    precision.rms_sigma[a] += point.sigma.map_or(0.0, |s| s[a] * s[a]);
                    precision.mean_q[a] += root(q[(a, a)]) * scale;
                }
            }
        }
        if count > 0.0 {
            precision.rms_sigma.iter_mut().for_each(|s| *s = (*s / count).sqrt());
            precision.mean_q.iter_mut().for_each(|q| *q /= count);
        }
        precision.largest_dimension = largest_distance(points.iter().map(|p| p.xyz).collect());
        let mean = precision.rms_sigma.iter().sum::<f64>() / 3.0;
        precision.relative = (mean > 0.0).then(|| precision.largest_dimension / mean);
        Some(precision)
    }
}

/// Rms of all image residuals in pixels: residuals over the pixel size of their camera.
fn rms_px(photos: &[AdjustedPhoto]) -> Option<f64> {
    let square = |p: &AdjustedPhoto| (p.rms_x / p.pixel[0]).powi(2) + (p.rms_y / p.pixel[1]).powi(2);
    let sum: f64 = photos.iter().map(|p| p.points as f64 * square(p)).sum();
    let count: usize = photos.iter().map(|p| 2 * p.points).sum();
    (count > 0).then(|| (sum / count as f64).sqrt())
}

fn check_statistics(points: &[CheckPoint]) -> Option<CheckStatistics> {
    let differences: Vec<[f64; 3]> = points.iter().filter_map(|p| p.difference).collect();
    let count = differences.len();
    if count == 0 {
        return None;
    }
    let n = count as f64;
    let over = |f: &dyn Fn(&mut dyn Iterator<Item = f64>) -> f64| -> [f64; 3] {
        std::array::from_fn(|a| f(&mut differences.iter().map(|d| d[a])))
    };
    let mean = over(&|axis| axis.sum::<f64>() / n);
    let deviation = std::array::from_fn(|a| {
        let squares: f64 = differences.iter().map(|d| (d[a] - mean[a]).powi(2)).sum();
        (squares / (n - 1.0)).sqrt()
    });
    Some(CheckStatistics {
        count,
        min: over(&|axis| axis.fold(f64::INFINITY, f64::min)),
        max: over(&|axis| axis.fold(f64::NEG_INFINITY, f64::max)),
        mean,
        standard_deviation: (count > 1).then_some(deviation),
        rms: over(&|axis| (axis.map(|d| d * d).sum::<f64>() / n).sqrt()),
        rms_all: (differences.iter().flatten().map(|d| d * d).sum::<f64>() / (3.0 * n)).sqrt(),
    })
}
