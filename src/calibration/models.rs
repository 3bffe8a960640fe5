//! Camera models compared on one network: which of them the photos support.
//!
//! Each model starts from the present camera, converted over the picture, and is adjusted with the same observations; of every model all of
//! what it has for the present roles is estimated (a radial distortion with all its coefficients). With n observations, k estimated camera
//! parameters and Ω = vᵀPv
//!
//! ```text
//! BIC = n ln(Ω / n) + k ln n
//! ```
//!
//! (G. Schwarz, Estimating the dimension of a model, Annals of Statistics 6, 1978), up to a number that all models share. It needs no variance
//! factor. Beside it stands the rms of image points that were held out: a part of those of points seen in other photos too is not used, and is
//! predicted by the rest. Only points that every model adjusted are counted.

use std::collections::{BTreeMap, HashMap, HashSet};

use serde::{Deserialize, Serialize};

use super::conversion::{ModelConversion, convert_camera};
use crate::adjust;
use crate::adjustment::{AdjustOptions, Adjustment, Criteria, StatisticsChoice, Termination};
use crate::error::{Error, Place, Reason, Result};
use crate::noise::Noise;
use crate::project::{Camera, CameraModel, Parameter, Project};

/// Share of the image points that are held out.
const HELD_OUT: f64 = 0.2;
/// Rays that a point keeps: two intersect, the third is checked.
const RAYS: usize = 3;
/// Points that a photo keeps: three orient it, and twice as many are a photo like the others.
const POINTS: usize = 6;
/// n ln(Ω / Ω_best) beyond which a model fits worse: odds of 150 to 1 (Kass and Raftery, Bayes factors, JASA 90, 1995: "very strong").
const WORSE: f64 = 10.0;

/// Options of the comparison of camera models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ModelsOptions {
    /// Camera identifier; may be left out where the project has one camera.
    pub camera: Option<String>,
    /// Seed of the choice of image points that are held out.
    pub seed: u32,
    /// How each model is adjusted.
    pub adjust: AdjustOptions,
}

impl Default for ModelsOptions {
    fn default() -> Self {
        Self { camera: None, seed: 1, adjust: AdjustOptions::default() }
    }
}

/// Verdict of the comparison on a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ModelVerdict {
    /// The smallest BIC.
    Best,
    /// It fits as well as the best, with fewer parameters.
    AsGoodWithFewer,
    /// It fits as well as the best, with as many parameters.
    AsGood,
    /// It cannot follow the lens: it fits worse.
    TooStiff,
    /// It fits no better than the best, with more parameters.
    Overfits,
    /// It cannot be adjusted; `failure` has the reason.
    Failed,
}

/// A model on the network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedModel {
    /// Name of the model.
    pub model: String,
    /// What its start values left of the present camera; null if it could not be converted.
    pub conversion: Option<ModelConversion>,
    /// The camera with its adjusted values; null if it failed.
    pub camera: Option<Camera>,
    /// Standard deviation of unit weight.
    pub sigma0: Option<f64>,
    /// Estimated parameters of the camera.
    pub parameters: Vec<Parameter>,
    /// Those of distortion that are not significantly different from 0.
    pub insignificant: Vec<Parameter>,
    /// Root mean square of the coordinates of held out image points minus their predictions, pixels; null if none could be held out.
    pub held_out_rms: Option<f64>,
    /// Schwarz's criterion, less that of the best; 0 for the best.
    pub bic: Option<f64>,
    /// Verdict of the comparison.
    pub verdict: ModelVerdict,
    /// Why it failed.
    pub failure: Option<Error>,
}

/// A model that was adjusted.
struct Adjusted {
    variant: usize,
    converted: Project,
    adjustment: Adjustment,
    held_out: Option<Adjustment>,
    cost: f64,
    count: usize,
    estimated: Vec<Parameter>,
}

/// The coefficients of the rational model that are nearly equivalent to its others: compared with them and without.
const STAND_INS: [Parameter; 2] = [Parameter::K5, Parameter::K6];

/// The models that are compared: all, those with coefficients that are nearly equivalent to others: without and with these.
fn variants() -> Vec<(&'static CameraModel, bool)> {
    let has = |model: &CameraModel| STAND_INS.iter().all(|p| model.parameters.contains(p));
    CameraModel::ALL.iter().flat_map(|m| [Some((m, false)), has(m).then_some((m, true))]).flatten().collect()
}

/// Adjusts the network with every camera model and compares them; a row a model in the order of [`CameraModel::ALL`], the rational model
/// without K5 and K6 and then with them.
///
/// # Errors
/// [`Error::Invalid`] for options that would let every model choose its own observations; [`Error::Unknown`] for a camera that is not there;
/// whatever [`Project::validate`] finds. A model that cannot be adjusted is a row with the reason.
pub fn compare_models(project: &Project, options: &ModelsOptions) -> Result<Vec<ComparedModel>> {
    project.validate()?;
    super::plain_options(&options.adjust)?;
    let id = super::camera_of(project, options.camera.as_deref())?.id.clone();
    let mut project = project.clone();
    (project.features, project.systems) = (Vec::new(), Vec::new());
    let adjust_options =
        AdjustOptions { statistics: StatisticsChoice::Precision, covariance_of: Vec::new(), ..options.adjust.clone() };
    // The values of the present model are the better start of all; where it fails the others start from what is given.
    if let Ok(found) = adjust::adjust(&project, &adjust_options, &mut |_| true)
        && found.termination == Termination::Converged
    {
        project = adjust::apply(&project, &found);
    }
    // What stays set aside is so for every model alike.
    project.set_aside.clear();
    let held_out = held_out(&project, options.seed);
    let mut rows = Vec::new();
    for (variant, (model, whole)) in variants().into_iter().enumerate() {
        let converted = convert_camera(&project, &id, model.name);
        let conversion = converted.as_ref().ok().map(|(_, conversion)| conversion.clone());
        let adjusted = converted.and_then(|(mut project, _)| {
            project.cameras.iter_mut().filter(|c| c.id == id).for_each(|camera| complete(camera, model, whole));
            adjusted(project, &id, variant, &adjust_options, &held_out)
        });
        rows.push((model, conversion, adjusted));
    }
    let most = rows.iter().filter_map(|(.., a)| a.as_ref().ok().map(|a| a.count)).max().unwrap_or(0);
    for (_, _, adjusted) in &mut rows {
        if let Ok(found) = adjusted
            && found.count < most
        {
            let reason = Reason::ModelWithoutImages { missing: (most - found.count).div_ceil(2) };
            *adjusted = Err(Error::Invalid { reason, at: Place::camera(&id) });
        }
    }
    let predicted = predicted(&held_out, rows.iter().filter_map(|(.., a)| a.as_ref().ok()));
    let n = most.max(1) as f64;
    let bic = |a: &Adjusted| n * (a.cost.max(f64::MIN_POSITIVE) / n).ln() + a.estimated.len() as f64 * n.ln();
    let sound = || rows.iter().filter_map(|(.., a)| a.as_ref().ok());
    let best = sound().min_by(|a, b| bic(a).total_cmp(&bic(b)));
    let verdict = |a: &Adjusted| {
        let Some(best) = best else { return ModelVerdict::Failed };
        if a.variant == best.variant {
            return ModelVerdict::Best;
        }
        let worse = n * (a.cost.max(f64::MIN_POSITIVE) / best.cost.max(f64::MIN_POSITIVE)).ln();
        match a.estimated.len().cmp(&best.estimated.len()) {
            _ if worse > WORSE => ModelVerdict::TooStiff,
            std::cmp::Ordering::Less => ModelVerdict::AsGoodWithFewer,
            std::cmp::Ordering::Equal => ModelVerdict::AsGood,
            std::cmp::Ordering::Greater => ModelVerdict::Overfits,
        }
    };
    let row = |(model, conversion, found): &(&CameraModel, Option<ModelConversion>, Result<Adjusted>)| {
        let mut row = ComparedModel {
            model: model.name.to_owned(),
            conversion: conversion.clone(),
            camera: None,
            sigma0: None,
            parameters: Vec::new(),
            insignificant: Vec::new(),
            held_out_rms: None,
            bic: None,
            verdict: ModelVerdict::Failed,
            failure: None,
        };
        match found {
            Err(error) => row.failure = Some(error.clone()),
            Ok(a) => {
                let applied = adjust::apply(&a.converted, &a.adjustment);
                row.camera = applied.cameras.into_iter().find(|c| c.id == id);
                row.sigma0 = a.adjustment.sigma0;
                row.parameters = a.estimated.clone();
                row.insignificant = insignificant(&a.adjustment, &id);
                row.held_out_rms = predicted.get(&a.variant).copied();
                row.bic = best.map(|best| bic(a) - bic(best));
                row.verdict = verdict(a);
            }
        }
        row
    };
    Ok(rows.iter().map(row).collect())
}

/// One model, its camera complete: all observations, then without those that are held out.
fn adjusted(
    project: Project,
    id: &str,
    variant: usize,
    options: &AdjustOptions,
    held_out: &HashSet<usize>,
) -> Result<Adjusted> {
    let not_converged = || Error::Invalid { reason: Reason::ModelNotConverged, at: Place::camera(id) };
    let adjustment = adjust::adjust(&project, options, &mut |_| true)?;
    if adjustment.termination != Termination::Converged {
        return Err(not_converged());
    }
    let estimated = project.cameras.iter().find(|c| c.id == id).map(Camera::estimated).unwrap_or_default();
    let cost = adjustment.sigma0.map_or(0.0, |s| s * s) * adjustment.redundancy as f64;
    let mut without = adjust::apply(&project, &adjustment);
    for k in held_out {
        without.observations[*k].enabled = false;
    }
    let plain = AdjustOptions { statistics: StatisticsChoice::None, ..options.clone() };
    let found = (!held_out.is_empty()).then(|| adjust::adjust(&without, &plain, &mut |_| true));
    // what the rest cannot predict is told by its absence
    let found = found.and_then(Result::ok).filter(|found| found.termination == Termination::Converged);
    let count = adjustment.observations_count;
    Ok(Adjusted { variant, converted: project, adjustment, held_out: found, cost, count, estimated })
}

/// Estimates all coefficients of a radial distortion of which some are: models are compared with all that they have, those that stand in for
/// others if `whole`, else they are 0.
fn complete(camera: &mut Camera, model: &CameraModel, whole: bool) {
    let estimated = camera.estimated();
    if !model.radial.iter().any(|(p, _)| estimated.contains(p)) {
        return;
    }
    let missing = model.radial.iter().map(|(p, _)| *p);
    let missing = missing.filter(|p| (whole || !STAND_INS.contains(p)) && !estimated.contains(p));
    camera.free.extend(missing.collect::<Vec<_>>());
    if !whole && STAND_INS.iter().any(|p| estimated.contains(p)) {
        camera.free.retain(|p| !STAND_INS.contains(p));
        camera.sigma.retain(|p, _| !STAND_INS.contains(p));
        STAND_INS.iter().for_each(|p| camera.interior.set(*p, 0.0));
    }
}

/// Indices of a seeded share of the image points, such that every point keeps [`RAYS`] others and every photo [`POINTS`].
fn held_out(project: &Project, seed: u32) -> HashSet<usize> {
    let photos: HashSet<&str> = project.photos.iter().filter(|p| p.enabled).map(|p| p.id.as_str()).collect();
    let (mut rays, mut points): (HashMap<&str, usize>, HashMap<&str, usize>) = (HashMap::new(), HashMap::new());
    let taking = |o: &&crate::project::Observation| o.enabled && photos.contains(o.photo.as_str());
    for o in project.observations.iter().filter(taking) {
        *rays.entry(&o.point).or_default() += 1;
        *points.entry(&o.photo).or_default() += 1;
    }
    let mut noise = Noise::new(u64::from(seed), 0);
    let mut order: Vec<(f64, usize)> = Vec::new();
    for (k, o) in project.observations.iter().enumerate() {
        // a number for each, so that the choice among those that take part does not depend on them
        let key = noise.normal();
        if taking(&o) {
            order.push((key, k));
        }
    }
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let wanted = (order.len() as f64 * HELD_OUT) as usize;
    let mut held_out = HashSet::new();
    for (_, k) in order {
        let o = &project.observations[k];
        let (Some(rays), Some(points)) = (rays.get_mut(o.point.as_str()), points.get_mut(o.photo.as_str())) else {
            continue;
        };
        if held_out.len() < wanted && *rays > RAYS && *points > POINTS {
            *rays -= 1;
            *points -= 1;
            held_out.insert(k);
        }
    }
    held_out
}

/// Rms of the held out coordinates of every variant, over those that all of them predict.
fn predicted<'a>(held_out: &HashSet<usize>, all: impl Iterator<Item = &'a Adjusted>) -> BTreeMap<usize, f64> {
    let mut sums: Vec<(usize, HashMap<usize, f64>)> = Vec::new();
    for a in all {
        let Some(found) = &a.held_out else { continue };
        let pixels: HashMap<&str, [f64; 2]> = found.photos.iter().map(|p| (p.id.as_str(), p.pixel)).collect();
        let square = |k: &usize| {
            let row = found.observations.get(*k)?;
            let [width, height] = pixels.get(row.photo.as_str())?;
            let (vx, vy) = row.vx.zip(row.vy)?;
            a.adjustment.observations.get(*k).filter(|row| row.enabled)?;
            Some((*k, (vx / width).powi(2) + (vy / height).powi(2)))
        };
        sums.push((a.variant, held_out.iter().filter_map(square).collect()));
    }
    let Some((_, first)) = sums.first() else { return BTreeMap::new() };
    let common: Vec<usize> =
        first.keys().copied().filter(|k| sums.iter().all(|(_, squares)| squares.contains_key(k))).collect();
    if common.is_empty() {
        return BTreeMap::new();
    }
    let rms = |squares: &HashMap<usize, f64>| {
        let mut own: Vec<f64> = common.iter().map(|k| squares[k]).collect();
        // the order of a set is chance, and sums depend on it
        own.sort_by(f64::total_cmp);
        (own.iter().sum::<f64>() / (2 * own.len()) as f64).sqrt()
    };
    sums.iter().map(|(variant, squares)| (*variant, rms(squares))).collect()
}

/// Parameters of distortion whose size is below so many standard errors that they are not significantly different from 0, in every photo where each has its own.
fn insignificant(adjustment: &Adjustment, id: &str) -> Vec<Parameter> {
    let own: Vec<_> = adjustment.cameras.iter().filter(|c| c.camera.id == id).collect();
    let Some(first) = own.first() else { return Vec::new() };
    let model = first.camera.interior.model();
    let is_distortion = |p: &Parameter| {
        use Parameter as P;
        model.radial.iter().any(|(radial, _)| radial == p) || matches!(p, P::P1 | P::P2 | P::B1 | P::B2)
    };
    let limit = Criteria::default().significance;
    let is_small = |p: &Parameter| {
        own.iter().all(|c| match (c.camera.interior.get(*p), c.sigma.get(p)) {
            (Some(value), Some(sigma)) => value.abs() < limit * sigma,
            _ => false,
        })
    };
    model.parameters.iter().copied().filter(|p| is_distortion(p) && is_small(p)).collect()
}
