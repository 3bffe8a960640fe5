//! Tests whether the image residuals are systematic, and names the cause ([`ResidualPattern`]).
//!
//! Every pattern is a group of displacement fields (`basis`); what the estimated unknowns can take over of them is taken out exactly, so
//! that the tests account for the redundancy of the residuals (`gram`). Causes leave traces in each other's fields: a wrong lens leaves a
//! smooth pattern of position too, a refocused photo one by row. Of all patterns that chance does not explain the one is named that tells
//! most with the fewest fields, by the Bayesian information criterion
//!
//! ```text
//! BIC = r ln(eᵀPe - χ²) + k ln r
//! ```
//!
//! (G. Schwarz 1978), or one of fewer fields that explains nearly as much: the fields are linear, and what a strong cause leaves of higher
//! order belongs to it. Single observations compete: a gross error is taken out first and named by data snooping, not here.

mod alone;
mod basis;
mod gram;

use crate::adjust::equations::right_hand_side::weighted_residuals;
use crate::adjust::problem::step::Step;
use crate::adjust::solve::session::Session;
use crate::adjustment::{AdjustOptions, Advice, PatternKind, Remedy, ResidualPattern, ResidualPlace};
use crate::project::{Camera, CameraModel, Parameter};
use crate::statistics::fisher::Fisher;

use alone::Odd;
use basis::Basis;
use gram::Gram;

/// How often a pattern is named in a network without any, over all tests of a camera.
const FALSE_NAMES: f64 = 0.002;
/// Kinds of patterns that share it.
const KINDS: f64 = 7.0;
/// A named pattern is at least this part of eᵀPe. What is smaller changes no standard error by more than 1.5 %, and in large networks
/// even the last digit of a well known lens is significant: people would be sent after nothing.
const WORTH_NAMING: f64 = 0.03;
/// What a cause leaves of higher order is less than this part of it; patterns of more fields that explain no more than that on top are
/// not another cause. Without it strong decentring is called a pattern of position, and a cropped photo drags another one along.
const HIGHER_ORDER: f64 = 0.05;
/// Where every photo is given an interior orientation, those that differ this many times as much from the median of all as half of the
/// photos do are the odd ones. A photo cropped by tens of pixels bends the others too, so that chance does not explain theirs; without this
/// all photos are named. Of 16 focused anew the largest is about five times the median at one in a hundred.
const ODD: f64 = 8.0;
/// Degrees of freedom that have to be left beside a pattern: with fewer, F has no power, and a pattern of many fields fits anything.
const LEFT: usize = 10;
/// Fields of which the unknowns leave nearly nothing are known to five digits. Where a network is bent so far that its equations are nearly
/// singular they are not, and seem to explain more than this part of eᵀPe, which nothing can: then they are not tested.
const BEYOND: f64 = 1.01;
/// Photos that are tested one by one: each costs 16 fields, and the work grows with the square of their number.
const PHOTOS: usize = 32;
/// Numbers over all unknowns that the photos' fields may take: 32 MB twice.
const NUMBERS: usize = 4_000_000;
/// Observations that are tested by themselves.
const SINGLES: usize = 10;

/// A pattern to be tested.
struct PatternCandidate {
    kind: PatternKind,
    camera: usize,
    /// Fields; of single observations those of one.
    fields: Vec<usize>,
    /// Tested photos that it is about; empty: all.
    photos: Vec<usize>,
    /// As many alternatives there were.
    choices: f64,
    is_single: bool,
}

/// A candidate with its test.
struct TestedPattern {
    candidate: PatternCandidate,
    lowered: f64,
    degrees: usize,
    statistic: f64,
    p_value: f64,
    bic: f64,
}

/// eᵀPe with its degrees of freedom.
#[derive(Clone, Copy)]
struct Squares {
    sum: f64,
    redundancy: usize,
}

impl Squares {
    fn test(&self, gram: &Gram, candidate: PatternCandidate) -> Option<TestedPattern> {
        let (lowered, degrees) = gram.explained(&candidate.fields);
        self.judge(candidate, lowered, degrees)
    }

    /// `None` without fields that the unknowns leave, with too few degrees of freedom beside them, or where rounding decides.
    fn judge(&self, candidate: PatternCandidate, lowered: f64, degrees: usize) -> Option<TestedPattern> {
        let others = self.redundancy.checked_sub(degrees).filter(|others| *others >= LEFT && degrees > 0)? as f64;
        if lowered > BEYOND * self.sum {
            return None;
        }
        // rounding may leave nothing or less
        let left = (self.sum - lowered).max(1e-12 * self.sum);
        let (k, r) = (degrees as f64, self.redundancy as f64);
        let statistic = lowered.max(0.0) / k / (left / others);
        let p_value = (candidate.choices * Fisher::new(degrees, Some(others)).tails(statistic)[1]).min(1.0);
        let bic = r * left.ln() + k * r.ln() + 2.0 * candidate.choices.ln();
        (self.sum > 0.0 && statistic.is_finite()).then_some(TestedPattern {
            candidate,
            lowered,
            degrees,
            statistic,
            p_value,
            bic,
        })
    }

    fn without(&self, lowered: f64, degrees: usize) -> Self {
        Self { sum: (self.sum - lowered).max(0.0), redundancy: self.redundancy - degrees }
    }

    /// The part of eᵀPe that a pattern has beyond what chance gives it.
    fn share(&self, tested: &TestedPattern) -> f64 {
        let noise = self.without(tested.lowered, tested.degrees);
        let by_chance = tested.degrees as f64 * noise.sum / noise.redundancy.max(1) as f64;
        (tested.lowered - by_chance) / self.sum
    }
}

/// Tests the residuals of factored equations, with `cost` = eᵀPe. A row a camera and kind of pattern; at most one pattern is named. Empty
/// where nothing is left to be tested.
pub fn patterns(session: &mut Session<'_>, options: &AdjustOptions, cost: f64) -> Vec<ResidualPattern> {
    let Some(Looked { mut rows, suspect }) = looked(session, options.residuals, cost) else { return Vec::new() };
    let named = rows.iter_mut().find(|row| row.named && row.kind == PatternKind::Photo);
    if let (Some(named), Some(suspect)) = (named, suspect)
        && let Some(odd) = alone::odd(session, options, suspect)
        && (!named.photos.is_empty() || odd_tell_more(session.redundancy, named, &odd))
    {
        named.photos = odd.photos.into_iter().map(|photo| session.project.photos[photo].id.clone()).collect();
    }
    rows
}

/// Whether a few photos with cameras of their own tell more, with their unknowns, than what every photo has of its own with its fields: of four
/// of ten autofocused photos the rest agrees by chance.
fn odd_tell_more(redundancy: usize, every: &ResidualPattern, odd: &Odd) -> bool {
    let r = redundancy as f64;
    let bic = |cost: f64, unknowns: usize| r * cost.max(f64::MIN_POSITIVE).ln() + unknowns as f64 * r.ln();
    let left = every.sigma0 * every.sigma0 * (r - every.degrees as f64).max(1.0);
    bic(odd.cost, odd.unknowns) < bic(left, every.degrees)
}

/// The patterns with their tests, and the photo whose own interior orientation explains most where a pattern of photos is named.
struct Looked {
    rows: Vec<ResidualPattern>,
    /// Index into the network's photos.
    suspect: Option<usize>,
}

fn looked(session: &mut Session<'_>, place: ResidualPlace, cost: f64) -> Option<Looked> {
    let remaining = session.remaining_step(place)?;
    found(session, place, cost, &remaining)
}

fn found(session: &Session<'_>, place: ResidualPlace, cost: f64, remaining: &Step) -> Option<Looked> {
    let residuals = weighted_residuals(session.context(place))?;
    let photos = photos(session);
    let basis = Basis::new(session, &photos, &largest(&residuals));
    let (mut gram, response) = Gram::new(session, place, &basis, remaining)?;
    let mut squares = Squares { sum: cost, redundancy: session.redundancy };
    let mut name = None;
    for _ in 0..=basis.singles {
        let tested = candidates(&basis, &gram, &squares);
        let limit = FALSE_NAMES / KINDS / basis.cameras.len() as f64;
        let significant: Vec<&TestedPattern> = tested.iter().filter(|t| t.p_value < limit).collect();
        let Some(best) = significant.iter().min_by(|a, b| a.bic.total_cmp(&b.bic)) else { break };
        if !best.candidate.is_single {
            let near = |t: &&&TestedPattern| {
                let same = !t.candidate.is_single && t.candidate.camera == best.candidate.camera;
                same && t.lowered >= (1.0 - HIGHER_ORDER) * best.lowered && t.degrees <= best.degrees
            };
            // Of as many fields the one that explains more.
            let fewer =
                |a: &&&TestedPattern, b: &&&TestedPattern| a.degrees.cmp(&b.degrees).then(a.bic.total_cmp(&b.bic));
            let best = significant.iter().filter(near).min_by(fewer).unwrap_or(best);
            if squares.share(best) >= WORTH_NAMING {
                name = Some((best.candidate.kind, best.candidate.camera));
            }
            break;
        }
        let (lowered, degrees) = gram.sweep(&best.candidate.fields);
        squares = squares.without(lowered, degrees);
    }
    let mut rows: Vec<TestedPattern> = Vec::new();
    for tested in candidates(&basis, &gram, &squares).into_iter().filter(|t| !t.candidate.is_single) {
        let same = |row: &&mut TestedPattern| {
            (row.candidate.kind, row.candidate.camera) == (tested.candidate.kind, tested.candidate.camera)
        };
        match rows.iter_mut().find(same) {
            Some(row) if tested.bic < row.bic => *row = tested,
            Some(_) => {}
            None => rows.push(tested),
        }
    }
    let row = |tested: &TestedPattern| {
        let PatternCandidate { kind, camera, fields, .. } = &tested.candidate;
        let amounts: Vec<(usize, f64)> = fields.iter().copied().zip(gram.amounts(fields)).collect();
        let mut photos = tested.candidate.photos.clone();
        if *kind == PatternKind::Photo && photos.is_empty() {
            photos = odd_photos(&basis, &gram, *camera);
        }
        let [rms_px, max_px] = response.lengths(session, place, &basis, *camera, &amounts)?;
        let single = matches!(kind, PatternKind::Row | PatternKind::Column | PatternKind::Photo);
        let of_camera = || basis.photos.iter().filter(|(_, of)| of == camera).count();
        let left = squares.without(tested.lowered, tested.degrees);
        let id =
            |photo: &usize| session.project.photos[session.network.photos[basis.photos[*photo].0].index].id.clone();
        Some(ResidualPattern {
            camera: session.project.cameras[basis.cameras[*camera]].id.clone(),
            kind: *kind,
            photos: photos.iter().map(id).collect(),
            photos_tested: single.then(of_camera),
            degrees: tested.degrees,
            statistic: tested.statistic,
            p_value: tested.p_value,
            rms_px,
            max_px,
            sigma0: (left.sum / left.redundancy.max(1) as f64).sqrt(),
            named: name == Some((*kind, *camera)),
        })
    };
    let suspect = name.filter(|(kind, _)| *kind == PatternKind::Photo).and_then(|(_, camera)| {
        let own = (0..basis.photos.len()).filter(|k| basis.photos[*k].1 == camera);
        let explained = own.map(|k| (k, gram.explained(&basis.interior(k).collect::<Vec<_>>()).0));
        explained.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| basis.photos[k].0)
    });
    Some(Looked { rows: rows.iter().map(row).collect::<Option<_>>()?, suspect })
}

/// The photos that are tested one by one: all, or of large networks as many as fit, evenly spread.
fn photos(session: &Session<'_>) -> Vec<usize> {
    let count = session.network.photos.len();
    let size = session.network.unknowns().max(1);
    let room = (NUMBERS / size / 16).clamp(4, PHOTOS).min(count);
    (0..room).map(|k| k * count / room).collect()
}

/// The rays with the largest residuals in their standard errors.
fn largest(residuals: &[[f64; 2]]) -> Vec<usize> {
    let mut rays: Vec<usize> = (0..residuals.len()).collect();
    let length = |k: &usize| residuals[*k][0].hypot(residuals[*k][1]);
    rays.sort_by(|a, b| length(b).total_cmp(&length(a)));
    rays.truncate(SINGLES);
    rays
}

/// Every pattern with its test.
fn candidates(basis: &Basis, gram: &Gram, squares: &Squares) -> Vec<TestedPattern> {
    let mut all = Vec::new();
    let mut add = |kind, camera, fields: Vec<usize>| {
        let candidate = PatternCandidate { kind, camera, fields, photos: Vec::new(), choices: 1.0, is_single: false };
        all.extend(squares.test(gram, candidate));
    };
    for camera in 0..basis.cameras.len() {
        add(PatternKind::Radius, camera, basis.radius(camera).collect());
        add(PatternKind::Tangential, camera, basis.tangential(camera).collect());
        add(PatternKind::Affine, camera, basis.affine(camera).collect());
        add(PatternKind::Position, camera, basis.position(camera).collect());
        let own: Vec<usize> = (0..basis.photos.len()).filter(|k| basis.photos[*k].1 == camera).collect();
        if own.len() < 2 {
            continue;
        }
        // Rotation alone explains most motions; translation can be separated from it only where the object has depth.
        for parts in [basis::MOTION / 2, basis::MOTION] {
            add(PatternKind::Row, camera, own.iter().flat_map(|k| basis.row(*k).take(parts)).collect());
            add(PatternKind::Column, camera, own.iter().flat_map(|k| basis.column(*k).take(parts)).collect());
        }
        add(PatternKind::Photo, camera, own.iter().map(|k| basis.interior(*k).start).collect());
        add(PatternKind::Photo, camera, own.iter().flat_map(|k| basis.interior(*k)).collect());
    }
    for camera in 0..basis.cameras.len() {
        all.extend(single_photos(basis, gram, squares, camera));
    }
    for single in 0..basis.singles {
        let candidate = PatternCandidate {
            kind: PatternKind::Photo,
            camera: 0,
            fields: basis.of_single(single).collect(),
            photos: Vec::new(),
            // the largest of all were chosen
            choices: (squares.redundancy.max(1)) as f64,
            is_single: true,
        };
        all.extend(squares.test(gram, candidate));
    }
    all
}

/// The photos of a camera that have an interior orientation of their own: one after the other, as long as chance does not explain the next
/// one, and fewer than half of them.
fn single_photos(basis: &Basis, gram: &Gram, squares: &Squares, camera: usize) -> Option<TestedPattern> {
    let own: Vec<usize> = (0..basis.photos.len()).filter(|k| basis.photos[*k].1 == camera).collect();
    if own.len() < 2 {
        return None;
    }
    let fields: Vec<usize> = own.iter().flat_map(|k| basis.interior(*k)).collect();
    let of = |n: usize| (basis::INTERIOR * n..basis::INTERIOR * (n + 1)).collect::<Vec<_>>();
    let mut left = gram.part(&fields);
    let (mut now, mut open) = (*squares, (0..own.len()).collect::<Vec<_>>());
    let (mut chosen, mut lowered, mut degrees, mut choices) = (Vec::new(), 0.0, 0, 1.0);
    while open.len() * 2 > own.len() {
        let next = open.iter().map(|n| (*n, left.explained(&of(*n))));
        let Some((n, (by, k))) = next.max_by(|a, b| a.1.0.total_cmp(&b.1.0)) else { break };
        let candidate = PatternCandidate {
            kind: PatternKind::Photo,
            camera,
            fields: Vec::new(),
            photos: Vec::new(),
            choices: open.len() as f64,
            is_single: false,
        };
        let Some(tested) = now.judge(candidate, by, k) else { break };
        if !chosen.is_empty() && (tested.p_value > FALSE_NAMES / KINDS || by < HIGHER_ORDER * lowered) {
            break;
        }
        left.sweep(&of(n));
        now = now.without(by, k);
        open.retain(|other| *other != n);
        choices *= (open.len() + 1) as f64;
        chosen.push(own[n]);
        lowered += by;
        degrees += k;
    }
    chosen.sort_unstable();
    let fields = chosen.iter().flat_map(|k| basis.interior(*k)).collect();
    let candidate =
        PatternCandidate { kind: PatternKind::Photo, camera, fields, photos: chosen, choices, is_single: false };
    squares.judge(candidate, lowered, degrees)
}

/// The tested photos of a camera whose own interior orientation is more than [`ODD`] times as far from the median as that of the median
/// photo. Empty if these are half of the photos or more.
fn odd_photos(basis: &Basis, gram: &Gram, camera: usize) -> Vec<usize> {
    let own: Vec<usize> = (0..basis.photos.len()).filter(|k| basis.photos[*k].1 == camera).collect();
    let fields: Vec<usize> = own.iter().flat_map(|k| basis.interior(*k)).collect();
    let (amounts, scales) = (gram.amounts(&fields), gram.scales(&fields));
    // The camera's own interior orientation stands for one of them: what counts is how far each is from the median.
    let middle: [f64; basis::INTERIOR] =
        std::array::from_fn(|m| median(amounts.iter().skip(m).step_by(basis::INTERIOR).copied().collect()));
    let size = |n: usize| {
        let part = |m: usize| (amounts[basis::INTERIOR * n + m] - middle[m]) * scales[basis::INTERIOR * n + m];
        (0..basis::INTERIOR).map(|m| part(m).powi(2)).sum::<f64>().sqrt()
    };
    let sizes: Vec<f64> = (0..own.len()).map(size).collect();
    let limit = ODD * median(sizes.clone());
    let odd: Vec<usize> = own.iter().zip(&sizes).filter(|(_, size)| **size > limit).map(|(k, _)| *k).collect();
    if odd.len() * 2 < own.len() { odd } else { Vec::new() }
}

/// The middle one of some numbers, the lower one of two; 0 of none.
fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len().saturating_sub(1) / 2).copied().unwrap_or_default()
}

/// The advice about a named pattern; `estimated` are the parameters of its camera that were.
pub fn advice(pattern: &ResidualPattern, camera: &Camera, estimated: &[Parameter]) -> Advice {
    Advice::ResidualPattern {
        camera: pattern.camera.clone(),
        pattern: pattern.kind,
        photos: pattern.photos.clone(),
        p_value: pattern.p_value,
        rms_px: pattern.rms_px,
        max_px: pattern.max_px,
        sigma0: pattern.sigma0,
        remedy: remedy(pattern, camera, estimated),
    }
}

fn remedy(pattern: &ResidualPattern, camera: &Camera, estimated: &[Parameter]) -> Remedy {
    use Parameter as P;
    let model = camera.interior.model();
    let focal = [P::Fx, P::Fy];
    let is_held = |p: &P| {
        let apart = *p == P::F && focal.iter().any(|p| estimated.contains(p));
        model.parameters.contains(p) && !estimated.contains(p) && !apart
    };
    let held = |all: &[P]| all.iter().copied().filter(is_held).collect::<Vec<_>>();
    let models = |all: &[CameraModel]| Remedy::Model { models: all.iter().map(|m| m.name.to_owned()).collect() };
    let or = |parameters: Vec<P>, other: Remedy| match parameters.is_empty() {
        true => other,
        false => Remedy::Estimate { parameters },
    };
    match pattern.kind {
        PatternKind::Radius => {
            let mut own = vec![model.distance];
            own.extend(model.radial.iter().map(|(p, _)| *p));
            let other = match model.name {
                name if name == CameraModel::OPENCV_RATIONAL.name => models(&[CameraModel::OPENCV_FISHEYE]),
                name if name == CameraModel::OPENCV_FISHEYE.name => models(&[CameraModel::OPENCV_RATIONAL]),
                _ => models(&[CameraModel::OPENCV_RATIONAL, CameraModel::OPENCV_FISHEYE]),
            };
            or(held(&own), other)
        }
        PatternKind::Tangential => {
            let [x, y] = model.centre;
            let other = if model.parameters.contains(&P::P1) {
                Remedy::Inspect
            } else {
                models(&[CameraModel::OPENCV_RATIONAL])
            };
            or(held(&[x, y, P::P1, P::P2]), other)
        }
        PatternKind::Affine => {
            let own = if model.parameters.contains(&P::B1) { held(&[P::B1, P::B2]) } else { held(&focal) };
            let other = if model.parameters.contains(&P::B1) { Remedy::Inspect } else { models(&[CameraModel::BROWN]) };
            or(own, other)
        }
        PatternKind::Row | PatternKind::Column => Remedy::HoldStill,
        PatternKind::Photo if pattern.photos.is_empty() => Remedy::PerPhoto,
        PatternKind::Photo => Remedy::OwnCamera { photos: pattern.photos.clone() },
        PatternKind::Position => Remedy::Inspect,
    }
}
