//! Cross-validation: the camera is calibrated from each part of the photos, and the differences are compared with their standard errors.
//!
//! With the cameras a, b of two parts, d(q) the difference of the pixels at which they see one direction (after the motion that brings them
//! together best), and Σ_q the projection uncertainty of each:
//!
//! ```text
//! predicted(q) = √λ_max(Σ_a,q + Σ_b,q),   ratio(q) = |d(q)| / predicted(q)
//! ```
//!
//! Σ is that of the a priori standard errors: sigma0 takes what a wrong model leaves for noise and would hide what is looked for. Where the a
//! priori standard errors themselves are too small the ratios are large as well; then the difference keeps to the prediction with sigma0 and
//! the residuals of no part have a pattern, which is reported separately ([`CrossVerdict::LargerNoise`]).
//!
//! The right model exceeds twice the prediction at one place of seven by chance, and somewhere in most images. The limit is therefore the ratio that
//! the largest over all covered places exceeds once in a thousand when the model is right, found by draws from the covariances, and never
//! below 2. Parts that see the object alike are bent alike by a wrong model, so that they differ by less than it is wrong: where the residuals
//! of every part have a pattern, which chance does not give twice, 2 is the limit.
//!
//! What the parts share counts as if each had its own: given coordinates, distances, a priori values of parameters. The prediction is then too
//! large, never too small.

use std::collections::{HashMap, HashSet};

use nalgebra::{DMatrix, Matrix2};
use serde::{Deserialize, Serialize};

use super::places::{self, ImagePlace};
use super::uncertainty::{self, ProjectionCovariance, UncertaintyOptions};
use super::{CameraDifference, DifferenceOptions, FitRegion, GRID, MotionReference, WorstPlace, difference, split};
use crate::adjust;
use crate::adjustment::{AdjustOptions, Adjustment, PatternKind, StatisticsChoice, Termination};
use crate::error::{Error, Place, Reason, Result};
use crate::noise::Noise;
use crate::project::{DatumKind, Photo, Point, Project, Role};

/// Maximum number of parts: more of them are parts of few photos, and the number of pairs grows with its square.
pub const MOST_PARTS: usize = 8;
/// Photos of a part without which position and roll cannot be balanced.
const PHOTOS: usize = 2;
/// Smallest limit of the ratio.
const LIMIT: f64 = 2.0;
/// Draws of the largest ratio, of which one in a thousand is the limit.
const DRAWS: usize = 4000;
/// How many of the draws may exceed it.
const BEYOND: usize = DRAWS / 1000;
/// Seed of the draws: the same calibration gets the same limit.
const SEED: u64 = 53;
/// A pattern of a smaller p-value is none of chance: with seven kinds tested in each of two parts, one clean calibration in seventy has one.
const PATTERN: f64 = 1e-3;

/// The question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CrossOptions {
    /// In how many parts the photos are split.
    pub parts: usize,
    /// Camera identifier; may be left out where the project has one camera.
    pub camera: Option<String>,
    /// Places along the width and the height of the image, borders included.
    pub grid: [usize; 2],
    /// Distance of the points from the projection centre in the project's unit; null: directions.
    pub distance: Option<f64>,
    /// Where the motion is fitted.
    pub region: FitRegion,
    /// Which motion is taken out: rotation, rotation and translation, or none.
    pub reference: MotionReference,
    /// How each part is adjusted.
    pub adjust: AdjustOptions,
}

impl Default for CrossOptions {
    fn default() -> Self {
        Self {
            parts: 2,
            camera: None,
            grid: GRID,
            distance: None,
            region: FitRegion::default(),
            reference: MotionReference::default(),
            adjust: AdjustOptions::default(),
        }
    }
}

/// A part of the photos, calibrated by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrossPart {
    /// Photo identifiers.
    pub photos: Vec<String>,
    /// Standard deviation of unit weight.
    pub sigma0: Option<f64>,
    /// Variables on which the residuals of the camera depend significantly.
    pub patterns: Vec<PatternKind>,
    /// The camera as this part has it.
    pub camera: crate::adjustment::AdjustedCamera,
}

/// Verdict of the comparison on the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CrossVerdict {
    /// The parts differ by what their standard errors allow.
    Agrees,
    /// They differ by more, but not by more than sigma0 explains, and the residuals have no pattern: the a priori standard errors of the image
    /// coordinates are too small.
    LargerNoise,
    /// They differ by more: the camera model is wrong, or camera and object did not stay as they were.
    WrongModel,
}

/// Parts compared with each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrossValidation {
    /// Camera identifier.
    pub camera: String,
    /// The parts.
    pub parts: Vec<CrossPart>,
    /// Columns of the grid, pixels.
    pub u: Vec<f64>,
    /// Rows of the grid, pixels.
    pub v: Vec<f64>,
    /// Per row and column: standard error of the difference in its worst direction, by the a priori standard errors, pixels; null if a
    /// part gives no ray. Of several pairs of parts the one with the largest ratio there.
    pub predicted: Vec<Vec<Option<f64>>>,
    /// Per row and column: length of the difference.
    pub observed: Vec<Vec<Option<f64>>>,
    /// Per row and column: observed over predicted.
    pub ratio_map: Vec<Vec<Option<f64>>>,
    /// Per row and column: whether a measurement of every part lies within one step of the grid. Only there the parts are judged.
    pub covered: Vec<Vec<bool>>,
    /// The covered place with the largest ratio; `sigma` is the ratio's prediction there. Null where nothing is covered.
    pub worst: Option<WorstPlace>,
    /// The largest ratio.
    pub ratio: Option<f64>,
    /// The same with the standard errors that include each part's sigma0.
    pub ratio_with_sigma0: Option<f64>,
    /// Ratio that a right model exceeds anywhere once in a thousand, at least 2; 2 where the residuals of every part have a pattern.
    pub limit: f64,
    /// Verdict of the cross-validation.
    pub verdict: CrossVerdict,
}

/// Splits the photos, calibrates the camera from each part with the same options, and compares the cameras with their standard errors.
///
/// # Errors
/// [`Error::Invalid`] for a number of parts that is none, for too few photos, for a camera whose photos have an interior orientation each, for
/// weights and rejections that would take a wrong model for noise, for a part that cannot be adjusted by itself ([`Reason::PartFails`], with
/// the error) or does not converge; as [`super::compare_cameras`] and [`super::projection_uncertainty`].
pub fn cross_validate(project: &Project, options: &CrossOptions) -> Result<CrossValidation> {
    project.validate()?;
    if !(2..=MOST_PARTS).contains(&options.parts) {
        let reason = Reason::CrossParts { given: options.parts, most: MOST_PARTS };
        return Err(Error::Invalid { reason, at: Place::field("parts") });
    }
    super::plain_options(&options.adjust)?;
    let camera = super::camera_of(project, options.camera.as_deref())?;
    if camera.per_photo {
        return Err(Error::Invalid { reason: Reason::CrossPerPhoto, at: Place::camera(&camera.id) });
    }
    let parts = split_photos(project, &camera.id, options.parts)?;
    let mut calibrated = Vec::with_capacity(parts.len());
    for (n, photos) in parts.iter().enumerate() {
        calibrated.push(Calibrated::new(project, &camera.id, options, n, photos)?);
    }
    compared(&calibrated, options)
}

/// Photo identifiers by part: the photos of each camera that take part are split by themselves.
fn split_photos(project: &Project, camera: &str, parts: usize) -> Result<Vec<Vec<String>>> {
    let measured: HashSet<&str> = project.observations.iter().filter(|o| o.enabled).map(|o| o.photo.as_str()).collect();
    let mut split = vec![Vec::new(); parts];
    for own in &project.cameras {
        let is_own = |p: &&Photo| p.camera == own.id && p.enabled && measured.contains(p.id.as_str());
        let photos: Vec<&Photo> = project.photos.iter().filter(is_own).collect();
        if own.id == camera && photos.len() < PHOTOS * parts {
            let reason = Reason::CrossPhotos { given: photos.len(), needed: PHOTOS * parts };
            return Err(Error::Invalid { reason, at: Place::camera(camera) });
        }
        for (photo, part) in photos.iter().zip(split::balanced(&photos, parts)) {
            split[part].push(photo.id.clone());
        }
    }
    Ok(split)
}

/// Takes out the observations of points that the photos that take part see once: in the other parts they have the rays that they lack here.
fn without_single_rays(project: &mut Project) {
    let on: HashSet<&str> = project.photos.iter().filter(|p| p.enabled).map(|p| p.id.as_str()).collect();
    let mut rays: HashMap<&str, usize> = HashMap::new();
    for o in project.observations.iter().filter(|o| o.enabled && on.contains(o.photo.as_str())) {
        *rays.entry(&o.point).or_default() += 1;
    }
    // given coordinates make up for rays
    let is_known = |p: &&Point| p.role == Role::Control && project.datum.kind == DatumKind::Control;
    let known: HashSet<&str> = project.points.iter().filter(is_known).map(|p| p.id.as_str()).collect();
    let is_single = |id: &str| !known.contains(id) && rays.get(id).is_none_or(|n| *n < 2);
    let out: HashSet<String> = project.points.iter().filter(|p| is_single(&p.id)).map(|p| p.id.clone()).collect();
    project.observations.iter_mut().filter(|o| out.contains(&o.point)).for_each(|o| o.enabled = false);
}

/// A part with its adjustment.
struct Calibrated {
    project: Project,
    adjustment: Adjustment,
    own: usize,
    photos: Vec<String>,
    spread: ProjectionCovariance,
    /// Variance factor of the standard errors.
    factor: f64,
}

impl Calibrated {
    fn new(project: &Project, camera: &str, options: &CrossOptions, n: usize, photos: &[String]) -> Result<Self> {
        let fails = |cause: Error| Error::Invalid {
            reason: Reason::PartFails { part: n + 1, photos: photos.len(), cause: Box::new(cause) },
            at: Place::camera(camera),
        };
        let own: HashSet<&str> = photos.iter().map(String::as_str).collect();
        let mut project = project.clone();
        project.photos.iter_mut().for_each(|p| p.enabled &= own.contains(p.id.as_str()));
        without_single_rays(&mut project);
        // what is measured on the result is no part of the calibration
        (project.features, project.systems) = (Vec::new(), Vec::new());
        let adjust_options = AdjustOptions { statistics: StatisticsChoice::Full, ..options.adjust.clone() };
        let adjustment = adjust::adjust(&project, &adjust_options, &mut |_| true).map_err(fails)?;
        if adjustment.termination != Termination::Converged {
            let reason = Reason::PartNotConverged { part: n + 1, photos: photos.len() };
            return Err(Error::Invalid { reason, at: Place::camera(camera) });
        }
        let adjusted = uncertainty::chosen(&adjustment, Some(camera), None)?;
        let asked = UncertaintyOptions {
            camera: Some(camera.to_owned()),
            photo: None,
            grid: options.grid,
            distance: options.distance,
            region: options.region,
            reference: options.reference,
        };
        let spread = ProjectionCovariance::of(&project, &adjustment, adjusted, &asked)?;
        let own = adjustment.cameras.iter().position(|c| std::ptr::eq(c, adjusted)).unwrap_or_default();
        let factor = adjustment.sigma0.filter(|s| *s > 0.0).map_or(1.0, |s| s * s);
        Ok(Self { project, own, photos: photos.to_vec(), spread, factor, adjustment })
    }

    fn camera(&self) -> &crate::project::Camera {
        &self.adjustment.cameras[self.own].camera
    }

    fn place(&self, pixel: [f64; 2], distance: Option<f64>) -> Option<ImagePlace> {
        places::place(self.camera(), &self.spread.parameters, pixel, distance)
    }

    fn patterns(&self) -> Vec<PatternKind> {
        let id = &self.camera().id;
        let own = self.adjustment.patterns.iter().filter(|p| p.camera == *id && p.p_value < PATTERN);
        own.map(|p| p.kind).collect()
    }
}

/// A covered place of the grid.
struct Node {
    /// Row and column.
    at: [usize; 2],
    /// Per part: derivatives of the pixel, times a root of the a priori covariance; a row a coordinate.
    roots: Vec<[Vec<f64>; 2]>,
    /// Per pair: predicted standard error.
    predicted: Vec<f64>,
}

fn compared(parts: &[Calibrated], options: &CrossOptions) -> Result<CrossValidation> {
    let asked = DifferenceOptions {
        grid: options.grid,
        distance: options.distance,
        region: options.region,
        reference: options.reference,
    };
    let pairs: Vec<(usize, usize)> = (0..parts.len()).flat_map(|i| (i + 1..parts.len()).map(move |j| (i, j))).collect();
    let differences: Vec<CameraDifference> = pairs
        .iter()
        .map(|&(i, j)| difference::compare_cameras(parts[i].camera(), parts[j].camera(), &asked))
        .collect::<Result<_>>()?;
    let [u, v] = places::axes(parts[0].camera(), options.grid)?;
    let covered = covered_by_all(parts, [&u, &v]);
    let empty = || vec![vec![None; u.len()]; v.len()];
    let (mut predicted, mut observed, mut ratio_map) = (empty(), empty(), empty());
    let mut nodes = Vec::new();
    let (mut worst, mut largest, mut with_sigma0): (Option<WorstPlace>, Option<f64>, Option<f64>) = (None, None, None);
    let roots: Vec<DMatrix<f64>> = parts.iter().map(|part| part.spread.root() / part.factor.sqrt()).collect();
    for (row, &at_v) in v.iter().enumerate() {
        for (column, &at_u) in u.iter().enumerate() {
            let places: Option<Vec<ImagePlace>> =
                parts.iter().map(|part| part.place([at_u, at_v], options.distance)).collect();
            let Some(places) = places else { continue };
            let covariances: Option<Vec<Matrix2<f64>>> =
                parts.iter().zip(&places).map(|(part, place)| part.spread.at(place)).collect();
            let Some(covariances) = covariances else { continue };
            let mut sigmas = Vec::with_capacity(pairs.len());
            for (&(i, j), difference) in pairs.iter().zip(&differences) {
                let prior = covariances[i] / parts[i].factor + covariances[j] / parts[j].factor;
                let sigma = uncertainty::worst_direction(&prior);
                sigmas.push(sigma);
                let Some((du, dv)) = difference.du[row][column].zip(difference.dv[row][column]) else { continue };
                let length = du.hypot(dv);
                if !(sigma > 0.0) {
                    continue;
                }
                let ratio = length / sigma;
                if ratio_map[row][column].is_none_or(|before| ratio > before) {
                    (ratio_map[row][column], predicted[row][column]) = (Some(ratio), Some(sigma));
                    observed[row][column] = Some(length);
                }
                if !covered[row][column] {
                    continue;
                }
                if largest.is_none_or(|before| ratio > before) {
                    largest = Some(ratio);
                    worst = Some(WorstPlace { u: at_u, v: at_v, sigma });
                }
                let scaled = length / uncertainty::worst_direction(&(covariances[i] + covariances[j]));
                with_sigma0 = Some(with_sigma0.map_or(scaled, |before: f64| before.max(scaled)));
            }
            if covered[row][column] {
                let derivatives = parts.iter().zip(&places).map(|(part, place)| part.spread.derivatives(place));
                let rows = |product: DMatrix<f64>| [0, 1].map(|s| product.row(s).iter().copied().collect());
                let roots = derivatives.zip(&roots).map(|(j, root)| rows(j * root)).collect();
                nodes.push(Node { at: [row, column], roots, predicted: sigmas });
            }
        }
    }
    nodes.retain(|node| ratio_map[node.at[0]][node.at[1]].is_some());
    let patterned = parts.iter().filter(|part| !part.patterns().is_empty()).count();
    let limit = if patterned == parts.len() { LIMIT } else { limit(&nodes, &pairs) };
    let is_beyond = |ratio: Option<f64>| ratio.is_some_and(|ratio| ratio > limit);
    let verdict = match (is_beyond(largest), is_beyond(with_sigma0)) {
        (false, _) => CrossVerdict::Agrees,
        (true, false) if patterned == 0 => CrossVerdict::LargerNoise,
        _ => CrossVerdict::WrongModel,
    };
    let part = |part: &Calibrated| CrossPart {
        photos: part.photos.clone(),
        sigma0: part.adjustment.sigma0,
        patterns: part.patterns(),
        camera: part.adjustment.cameras[part.own].clone(),
    };
    Ok(CrossValidation {
        camera: parts[0].camera().id.clone(),
        parts: parts.iter().map(part).collect(),
        u,
        v,
        predicted,
        observed,
        ratio_map,
        covered,
        worst,
        ratio: largest,
        ratio_with_sigma0: with_sigma0,
        limit,
        verdict,
    })
}

fn covered_by_all(parts: &[Calibrated], axes: [&[f64]; 2]) -> Vec<Vec<bool>> {
    let mut all = vec![vec![true; axes[0].len()]; axes[1].len()];
    for part in parts {
        let own = uncertainty::covered(&part.project, &part.adjustment, &part.adjustment.cameras[part.own], axes);
        all.iter_mut().flatten().zip(own.iter().flatten()).for_each(|(all, own)| *all &= own);
    }
    all
}

/// The ratio that the largest over the nodes and pairs exceeds once in a thousand draws of all parts' parameters.
fn limit(nodes: &[Node], pairs: &[(usize, usize)]) -> f64 {
    let Some(first) = nodes.first() else { return LIMIT };
    let mut noise = Noise::new(SEED, 0);
    let mut largest: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let draws: Vec<Vec<f64>> =
                first.roots.iter().map(|[row, _]| row.iter().map(|_| noise.normal()).collect()).collect();
            let of = |node: &Node| {
                let dot = |row: &[f64], draw: &[f64]| row.iter().zip(draw).map(|(a, b)| a * b).sum::<f64>();
                let moved: Vec<[f64; 2]> =
                    node.roots.iter().zip(&draws).map(|([u, v], draw)| [dot(u, draw), dot(v, draw)]).collect();
                let ratio = |(&(i, j), sigma): (&(usize, usize), &f64)| {
                    (moved[i][0] - moved[j][0]).hypot(moved[i][1] - moved[j][1]) / sigma
                };
                pairs.iter().zip(&node.predicted).filter(|(_, s)| **s > 0.0).map(ratio).fold(0.0, f64::max)
            };
            nodes.iter().map(of).fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(|a, b| b.total_cmp(a));
    largest[BEYOND].max(LIMIT)
}
