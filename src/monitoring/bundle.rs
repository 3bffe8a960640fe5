//! One bundle adjustment of all epochs, for the method `joint` with shared cameras or with more than two epochs.
//!
//! Reference points that are stable in every pair with the first epoch have one set of coordinates, all other points one an epoch. A
//! shared camera is one set of parameters, any other camera one an epoch. With the covariance C of all coordinates
//!
//! ```text
//! d = x_j - x_i        C_d = C_ii + C_jj - C_ij - C_ji
//! ```
//!
//! Whether a camera may be shared is tested by the weighted squares Ω of the residuals with the camera shared and with one set of its
//! parameters an epoch: T = (Ω_shared - Ω_own) / h / s², h the difference of the redundancies, against F(h, r), s² = Ω_own / r
//! (W. Niemeier, Ausgleichungsrechnung, 2008, chapter 6: test of a general linear hypothesis).

use std::collections::{BTreeSet, HashMap};

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::epoch::{Prepared, at};
use super::judgement::judged;
use super::request::{ComparisonMethod, DatumChoice, Options, VarianceChoice};
use super::result::{JointAdjustment, SharedCamera};
use crate::adjust::adjust;
use crate::adjustment::{AdjustOptions, Adjustment, StatisticsChoice, Termination};
use crate::error::{Error, Place, Reason, Result, shortened};
use crate::initial::similarity::{self, Similarity};
use crate::project::{Camera, Datum, DatumKind, Project, Role};
use crate::rotation::{angles, object_to_camera};

/// The free network of an epoch with its adjusted values, as it enters the adjustment of all epochs.
#[derive(Clone, Debug)]
pub struct EpochNetwork {
    /// Project.
    pub project: Project,
    /// Options of its adjustment.
    pub options: AdjustOptions,
}

/// Prepares the network of an adjusted project. `None` for cameras that are fixed to each other.
pub fn network(project: &Project, adjustment: &Adjustment) -> Option<EpochNetwork> {
    if project.rig.is_some() {
        return None;
    }
    let mut project = crate::adjust::apply(project, adjustment);
    let places: HashMap<&str, [f64; 3]> = adjustment.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    for point in project.points.iter_mut() {
        point.xyz = places.get(point.id.as_str()).copied();
        (point.role, point.sigma) = (Role::Tie, None);
    }
    project.points.retain(|p| p.xyz.is_some());
    let poses: HashMap<&str, _> = adjustment.photos.iter().map(|p| (p.id.as_str(), p)).collect();
    for photo in project.photos.iter_mut() {
        match poses.get(photo.id.as_str()) {
            Some(pose) => {
                (photo.position, photo.rotation) = (Some(pose.position), Some(pose.rotation));
                photo.sigma_position = None;
            }
            None => photo.enabled = false,
        }
    }
    // What an epoch rejected stays rejected.
    let used: BTreeSet<(&str, &str)> =
        adjustment.observations.iter().filter(|o| o.enabled).map(|o| (o.photo.as_str(), o.point.as_str())).collect();
    project.observations.retain(|o| used.contains(&(o.photo.as_str(), o.point.as_str())));
    project.distances.retain(|d| places.contains_key(d.from.as_str()) && places.contains_key(d.to.as_str()));
    project.set_aside.clear();
    Some(EpochNetwork { project, options: adjustment.options.clone() })
}

/// Points of all epochs in one adjustment at most: their covariance is a full matrix of three rows a point, of which several are held at a time
/// (72 MB each).
pub const MOST: usize = 1000;

/// Points of one adjustment of all epochs.
pub fn points(epochs: &[Prepared], stable: &[String]) -> usize {
    let stable: BTreeSet<&str> = stable.iter().map(String::as_str).collect();
    let own = |epoch: &Prepared| epoch.ids.iter().filter(|id| !stable.contains(id.as_str())).count();
    stable.len() + epochs.iter().map(own).sum::<usize>()
}

/// With so many points no camera can be shared; what shares none is compared in pairs.
///
/// # Errors
/// [`Reason::EpochShareMany`] where cameras are to be shared.
pub fn refused(points: usize, options: &Options) -> Result<()> {
    if options.shared_cameras.is_empty() {
        return Ok(());
    }
    Err(Error::Invalid { reason: Reason::EpochShareMany { points, limit: MOST }, at: Place::field("shared_cameras") })
}

/// Whether all epochs enter one adjustment.
///
/// # Errors
/// With shared cameras: [`Reason::EpochShareMethod`], [`Reason::EpochShareOptions`], [`Reason::EpochCameraMissing`],
/// [`Reason::EpochCameraUnlike`].
pub fn wanted(epochs: &[Prepared], options: &Options) -> Result<bool> {
    let shared = &options.shared_cameras;
    let networks: Option<Vec<&EpochNetwork>> = epochs.iter().map(|e| e.network.as_ref()).collect();
    let allowed = options.method == ComparisonMethod::Joint
        && options.variance != VarianceChoice::Separate
        && options.datum == DatumChoice::Reference;
    let fault = |reason, at| Err(Error::Invalid { reason, at });
    let field = || Place::field("shared_cameras");
    let (true, Some(networks)) = (allowed, networks) else {
        return if shared.is_empty() { Ok(false) } else { fault(Reason::EpochShareMethod, field()) };
    };
    let first = networks[0];
    let unlike = networks.iter().position(|network| !alike(&network.options, &first.options));
    if let Some(k) = unlike {
        let (name, first) = (epochs[k].name.clone(), epochs[0].name.clone());
        let reason = Reason::EpochShareOptions { name, first };
        return if shared.is_empty() { Ok(false) } else { fault(reason, at(k, "adjustment")) };
    }
    let camera = |k: usize, id: &str| networks[k].project.cameras.iter().find(|c| c.id == id);
    for id in shared {
        for k in 0..epochs.len() {
            let name = epochs[k].name.clone();
            let Some(own) = camera(k, id) else {
                return fault(Reason::EpochCameraMissing { camera: shortened(id), name }, field());
            };
            if camera(0, id).is_some_and(|first| !may_be_one(first, own)) {
                let first = epochs[0].name.clone();
                return fault(Reason::EpochCameraUnlike { camera: shortened(id), name, first }, field());
            }
        }
    }
    Ok(!shared.is_empty() || epochs.len() > 2)
}

/// Whether two adjustments weight their observations by the same rules.
fn alike(a: &AdjustOptions, b: &AdjustOptions) -> bool {
    a.robust == b.robust
        && a.residuals == b.residuals
        && a.unmodelled == b.unmodelled
        && a.target_diameter == b.target_diameter
        && a.variance_components.is_none()
        && b.variance_components.is_none()
}

/// Whether cameras differ in nothing but what is estimated.
fn may_be_one(a: &Camera, b: &Camera) -> bool {
    let mut own = b.interior;
    for parameter in b.free.iter().filter(|p| !b.sigma.contains_key(p)) {
        if let Some(value) = a.interior.get(*parameter) {
            own.set(*parameter, value);
        }
    }
    let free = |c: &Camera| c.free.iter().copied().collect::<BTreeSet<_>>();
    own == a.interior
        && free(a) == free(b)
        && Camera { interior: a.interior, free: a.free.clone(), ..b.clone() } == *a
        && !a.per_photo
}

/// All epochs after their adjustment.
pub struct Bundle {
    places: HashMap<(usize, String), usize>,
    xyz: Vec<Vector3<f64>>,
    covariance: DMatrix<f64>,
    /// Points with one set of coordinates.
    pub stable: BTreeSet<String>,
    /// Degrees of freedom of the variance factor.
    pub f: Option<f64>,
    /// Standard deviation of unit weight that the covariance holds.
    pub sigma0: f64,
    /// As reported.
    pub told: JointAdjustment,
}

/// Adjusts all epochs together. `renamed`: own names of matched points, by their names in the first epoch, for each epoch.
///
/// # Errors
/// Whatever the adjustment finds; [`Reason::EpochJointNotConverged`].
pub fn adjusted(
    epochs: &[Prepared],
    renamed: &[&HashMap<String, String>],
    stable: &[String],
    options: &Options,
) -> Result<Bundle> {
    let stable: BTreeSet<String> = stable.iter().cloned().collect();
    let shared: Vec<&str> = options.shared_cameras.iter().map(String::as_str).collect();
    let base = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        snooping: false,
        covariance_of: Vec::new(),
        ..epochs[0].network.as_ref().map(|n| n.options.clone()).unwrap_or_default()
    };
    let run = |project: &Project, options: &AdjustOptions| {
        let found = adjust(project, options, &mut |_| true)?;
        match found.termination {
            Termination::Converged => Ok(found),
            _ => Err(Error::Invalid { reason: Reason::EpochJointNotConverged, at: Place::field("method") }),
        }
    };
    let project = merged(epochs, renamed, &stable, &shared)?;
    let covariance_of = project.points.iter().map(|p| p.id.clone()).collect();
    let found = run(&project, &AdjustOptions { covariance_of, ..base.clone() })?;
    let squares = |a: &Adjustment| a.sigma0.map_or(0.0, |s| s * s) * a.redundancy as f64;
    let mut cameras = Vec::new();
    for &id in &shared {
        let others: Vec<&str> = shared.iter().copied().filter(|other| *other != id).collect();
        let own = run(&merged(epochs, renamed, &stable, &others)?, &base)?;
        let h = found.redundancy.saturating_sub(own.redundancy);
        let test = (h > 0 && own.redundancy > 0).then(|| {
            let r = own.redundancy as f64;
            let variance = if options.variance == VarianceChoice::Given { 1.0 } else { squares(&own) / r };
            let f = (options.variance != VarianceChoice::Given).then_some(r);
            judged((squares(&found) - squares(&own)).max(0.0) / variance, h, f, options.significance)
        });
        cameras.push(SharedCamera { id: id.to_owned(), test });
    }
    let stated = found.covariance.as_ref();
    let ids = stated.map(|c| &c.points[..]).unwrap_or_default();
    let n = 3 * ids.len();
    let covariance = DMatrix::from_fn(n, n, |i, j| stated.map_or(0.0, |c| c.matrix[i][j]));
    let known: HashMap<&str, [f64; 3]> = found.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    let xyz = ids.iter().map(|id| known.get(id.as_str()).copied().unwrap_or_default().into()).collect();
    let at: HashMap<&str, usize> = ids.iter().enumerate().map(|(k, id)| (id.as_str(), k)).collect();
    let mut places = HashMap::new();
    for (k, epoch) in epochs.iter().enumerate() {
        for id in &epoch.ids {
            if let Some(&place) = at.get(name(k, id, &stable).as_str()) {
                places.insert((k, id.clone()), place);
            }
        }
    }
    let sigma0 = found.sigma0.unwrap_or(1.0);
    let told = JointAdjustment {
        points: epochs[0].ids.iter().filter(|id| stable.contains(*id)).cloned().collect(),
        cameras,
        sigma0: found.sigma0,
        redundancy: found.redundancy,
    };
    let given = options.variance == VarianceChoice::Given;
    let covariance = if given { covariance / (sigma0 * sigma0) } else { covariance };
    let f = (!given).then_some(found.redundancy as f64);
    Ok(Bundle { places, xyz, covariance, stable, f, sigma0: if given { 1.0 } else { sigma0 }, told })
}

fn name(k: usize, id: &str, stable: &BTreeSet<String>) -> String {
    if stable.contains(id) { format!("@{id}") } else { format!("{k}@{id}") }
}

/// All epochs as one free network in the system of the first.
fn merged(
    epochs: &[Prepared],
    renamed: &[&HashMap<String, String>],
    stable: &BTreeSet<String>,
    shared: &[&str],
) -> Result<Project> {
    let mut all = Project { datum: Datum { kind: DatumKind::Free, points: None }, ..Project::default() };
    let target: HashMap<&str, Vector3<f64>> =
        epochs[0].ids.iter().zip(&epochs[0].xyz).map(|(id, x)| (id.as_str(), *x)).collect();
    let mut known = BTreeSet::new();
    for (k, epoch) in epochs.iter().enumerate() {
        let Some(EpochNetwork { project, .. }) = &epoch.network else { continue };
        let first_name: HashMap<&str, &str> =
            epoch.ids.iter().map(|id| (renamed[k].get(id).unwrap_or(id).as_str(), id.as_str())).collect();
        let point_name = |own: &str| match first_name.get(own) {
            Some(id) => name(k, id, stable),
            // It has no counterpart in the first epoch.
            None => format!("{k}~{own}"),
        };
        let camera_name = |id: &str| if shared.contains(&id) { format!("@{id}") } else { format!("{k}@{id}") };
        let photo_name = |id: &str| format!("{k}@{id}");
        let transform =
            if k == 0 { Similarity::identity() } else { onto_first(k, project, &first_name, stable, &target)? };
        for camera in &project.cameras {
            let id = camera_name(&camera.id);
            if !all.cameras.iter().any(|c| c.id == id) {
                all.cameras.push(Camera { id, ..camera.clone() });
            }
        }
        for mut photo in project.photos.iter().cloned() {
            (photo.id, photo.camera) = (photo_name(&photo.id), camera_name(&photo.camera));
            photo.position = photo.position.map(|x| transform.point(&x.into()).into());
            photo.rotation = photo.rotation.map(|r| angles(&(object_to_camera(r) * transform.rotation.transpose())));
            all.photos.push(photo);
        }
        for mut point in project.points.iter().cloned() {
            point.id = point_name(&point.id);
            point.xyz = point.xyz.map(|x| transform.point(&x.into()).into());
            point.normal = point.normal.map(|n| (transform.rotation * Vector3::from(n)).into());
            if known.insert(point.id.clone()) {
                all.points.push(point);
            }
        }
        for mut observation in project.observations.iter().cloned() {
            observation.photo = photo_name(&observation.photo);
            observation.point = point_name(&observation.point);
            all.observations.push(observation);
        }
        for mut distance in project.distances.iter().cloned() {
            (distance.from, distance.to) = (point_name(&distance.from), point_name(&distance.to));
            all.distances.push(distance);
        }
    }
    Ok(all)
}

fn onto_first(
    k: usize,
    project: &Project,
    first_name: &HashMap<&str, &str>,
    stable: &BTreeSet<String>,
    target: &HashMap<&str, Vector3<f64>>,
) -> Result<Similarity> {
    let pairs = project.points.iter().filter_map(|p| {
        let id = first_name.get(p.id.as_str()).filter(|id| stable.contains(**id))?;
        Some((Vector3::from(p.xyz?), *target.get(id)?))
    });
    let (source, target): (Vec<_>, Vec<_>) = pairs.unzip();
    let fit = similarity::fit(&source, &target);
    fit.map(|fit| fit.transform).map_err(|_| Error::Invalid { reason: Reason::EpochReferenceLine, at: at(k, "") })
}

impl Bundle {
    /// Displacements between two epochs of points that both have, with their covariance, three rows a point. A point that the adjustment
    /// does not have: `None`.
    pub fn displacements(&self, [from, to]: [usize; 2], ids: &[String]) -> Option<(Vec<Vector3<f64>>, DMatrix<f64>)> {
        let place = |epoch: usize, id: &String| self.places.get(&(epoch, id.clone())).copied();
        let both = ids.iter().map(|id| Some([place(from, id)?, place(to, id)?]));
        let both: Vec<[usize; 2]> = both.collect::<Option<_>>()?;
        let d = both.iter().map(|&[a, b]| self.xyz[b] - self.xyz[a]).collect();
        let c = |i: usize, j: usize, a: usize, b: usize| self.covariance[(3 * i + a, 3 * j + b)];
        let n = 3 * ids.len();
        let matrix = DMatrix::from_fn(n, n, |row, column| {
            let ([i, j], [p, q], a, b) = (both[row / 3], both[column / 3], row % 3, column % 3);
            // A stable point has not moved, whatever rounding leaves of the difference.
            if i == j || p == q { 0.0 } else { c(j, q, a, b) + c(i, p, a, b) - c(j, p, a, b) - c(i, q, a, b) }
        });
        Some((d, (&matrix + matrix.transpose()) * 0.5))
    }

    /// Coordinates of a point in the epochs that have it, and their covariance.
    pub fn places(&self, id: &str, epochs: usize) -> (Vec<usize>, DVector<f64>, DMatrix<f64>) {
        let there: Vec<(usize, usize)> =
            (0..epochs).filter_map(|k| Some((k, *self.places.get(&(k, id.to_owned()))?))).collect();
        let n = 3 * there.len();
        let x = DVector::from_fn(n, |i, _| self.xyz[there[i / 3].1][i % 3]);
        let c =
            DMatrix::from_fn(n, n, |i, j| self.covariance[(3 * there[i / 3].1 + i % 3, 3 * there[j / 3].1 + j % 3)]);
        (there.into_iter().map(|(k, _)| k).collect(), x, c)
    }

    /// Block of two rows of a matrix of [`Self::displacements`].
    pub fn block(matrix: &DMatrix<f64>, i: usize, j: usize) -> Matrix3<f64> {
        matrix.fixed_view::<3, 3>(3 * i, 3 * j).into_owned()
    }
}
