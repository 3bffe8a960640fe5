//! The doctor: why a network cannot be solved, and what a solvable one is weak in, in the network's own words.
//!
//! Structure comes first (a datum for every connected group of photos); what only the numbers show is read from the null
//! space of the normal equations, found by inverse iteration.

use std::collections::BTreeMap;

use nalgebra::{SMatrix, SVector};

use crate::adjustment::{Adjustment, Advice, ResidualPlace};
use crate::error::{Defect, Error, Result};
use crate::project::{DatumKind, Project};

use super::datum::{self, Direction, SIMILARITY};
use super::eliminated::Full;
use super::given::Key;
use super::layout::Layout;
use super::network::Network;
use super::normal::Normal;
use super::parameters::State;
use super::rows::Weighting;

/// Correlations beyond this are told.
const HIGH_CORRELATION: f64 = 0.95;
/// Redundancy numbers below this are told.
const LOW_REDUNDANCY: f64 = 0.1;
/// Rays that meet under less than this are told, in radians.
const NARROW_INTERSECTION: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Damping of the inverse iteration: what is weaker counts as undetermined.
const SHIFT: f64 = 1e-10;
/// Vectors of the null space looked at.
const MOST_VECTORS: usize = 12;

fn photo_id(project: &Project, network: &Network, photo: usize) -> String {
    project.photos[network.photos[photo].index].id.clone()
}

fn point_id(project: &Project, network: &Network, point: usize) -> String {
    project.points[network.points[point].index].id.clone()
}

/// Defects that the structure alone shows.
///
/// # Errors
/// [`Error::RankDefect`].
pub fn structure(project: &Project, network: &Network, state: &State) -> Result<()> {
    let groups = groups(network, 1);
    let controlled = network.datum == DatumKind::Control;
    if groups.len() == 1 {
        let missing = if controlled { datum::missing_control(network, state) } else { 0 };
        return if missing == 0 {
            Ok(())
        } else {
            Err(Error::RankDefect { defects: vec![Defect::NoDatum { missing }] })
        };
    }
    if controlled {
        let whole = datum::missing_control(network, state);
        let lacking = groups.iter().map(|group| missing_in_group(network, state, group)).max().unwrap_or(0);
        if lacking == 0 {
            return Ok(());
        }
        if whole > 0 {
            return Err(Error::RankDefect {
                defects: vec![Defect::NoDatum { missing: whole }, not_tied(project, network, &groups)],
            });
        }
    }
    Err(Error::RankDefect { defects: vec![not_tied(project, network, &groups)] })
}

fn not_tied(project: &Project, network: &Network, groups: &[Vec<usize>]) -> Defect {
    let named = |group: &Vec<usize>| group.iter().map(|p| photo_id(project, network, *p)).collect();
    Defect::NotTied { groups: groups.iter().map(named).collect() }
}

fn missing_in_group(network: &Network, state: &State, group: &[usize]) -> usize {
    let mut part = network.clone();
    for (k, photo) in part.photos.iter_mut().enumerate().filter(|(k, _)| !group.contains(k)) {
        let _ = k;
        photo.prior = Default::default();
    }
    for point in &mut part.points {
        if !network.rays[point.rays.clone()].iter().any(|ray| group.contains(&ray.photo)) {
            (point.fixed, point.prior) = (Default::default(), Default::default());
        }
    }
    let measured = |p: usize| network.rays[part.points[p].rays.clone()].iter().any(|r| group.contains(&r.photo));
    let bars = network.bars.iter().filter(|bar| measured(bar.from) && measured(bar.to)).cloned().collect();
    part.bars = bars;
    datum::missing_control(&part, state)
}

/// Photos connected by pairs that share at least `shared` points.
fn groups(network: &Network, shared: usize) -> Vec<Vec<usize>> {
    let n = network.photos.len();
    let mut parent: Vec<usize> = (0..n).collect();
    fn root(parent: &mut [usize], mut a: usize) -> usize {
        while parent[a] != a {
            parent[a] = parent[parent[a]];
            a = parent[a];
        }
        a
    }
    let mut common: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for point in &network.points {
        let rays = &network.rays[point.rays.clone()];
        if shared == 1 {
            for pair in rays.windows(2) {
                let (a, b) = (root(&mut parent, pair[0].photo), root(&mut parent, pair[1].photo));
                parent[a.max(b)] = a.min(b);
            }
        } else {
            for (k, a) in rays.iter().enumerate() {
                for b in &rays[..k] {
                    *common.entry((a.photo.min(b.photo), a.photo.max(b.photo))).or_default() += 1;
                }
            }
        }
    }
    for ((a, b), _) in common.into_iter().filter(|(_, count)| *count >= shared) {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b)] = a.min(b);
    }
    for bar in network.bars.iter().filter(|_| shared == 1) {
        let first = |point: usize| network.rays[network.points[point].rays.clone()].first().map(|r| r.photo);
        if let (Some(a), Some(b)) = (first(bar.from), first(bar.to)) {
            let (a, b) = (root(&mut parent, a), root(&mut parent, b));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for photo in 0..n {
        groups.entry(root(&mut parent, photo)).or_default().push(photo);
    }
    groups.into_values().collect()
}

/// Reads a rank defect from the null space of the normal equations at `state`; overwrites `normal`.
pub fn rank_defect(
    project: &Project,
    network: &Network,
    layout: &Layout,
    state: &State,
    normal: &mut Normal,
    pins: &[usize],
) -> Error {
    let weighting = Weighting { place: ResidualPlace::Corrected, robust: &[], shift: &[] };
    let vectors = null_space(network, layout, state, normal, pins, weighting).unwrap_or_default();
    let strength = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    let reduced = |from: usize, length: usize| {
        strength(&mut vectors.iter().flat_map(|v| v.reduced[from..from + length].iter().copied()))
    };
    let photos: Vec<f64> = layout.photo.iter().map(|&at| reduced(at, 6)).collect();
    let points: Vec<f64> = (0..network.points.len())
        .map(|p| strength(&mut vectors.iter().flat_map(|v| (0..3).map(move |a| v.at_point(layout, p, a)))))
        .collect();
    let interiors: Vec<Vec<f64>> = (network.interiors.iter().zip(&layout.interior))
        .map(|(block, &at)| (0..block.estimated.len()).map(|k| reduced(at + k, 1)).collect())
        .collect();
    let most = photos.iter().chain(&points).chain(interiors.iter().flatten()).fold(0.0_f64, |m, x| m.max(*x));
    let takes_part = |x: &f64| *x > 0.02 * most && *x > 0.0;
    let photos: Vec<String> = (photos.iter().enumerate().filter(|(_, x)| takes_part(x)))
        .map(|(k, _)| photo_id(project, network, k))
        .collect();
    let points: Vec<String> = (points.iter().enumerate().filter(|(_, x)| takes_part(x)))
        .map(|(k, _)| point_id(project, network, k))
        .collect();
    let mut parameters: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (block, strengths) in network.interiors.iter().zip(&interiors) {
        for (estimated, _) in block.estimated.iter().zip(strengths).filter(|(_, x)| takes_part(x)) {
            let list = parameters.entry(project.cameras[block.camera].id.clone()).or_default();
            if !list.iter().any(|name| name == estimated.parameter.name()) {
                list.push(estimated.parameter.name().to_owned());
            }
        }
    }
    let tied = groups(network, 3);
    let defects = if !parameters.is_empty() {
        undetermined_parameters(parameters, photos, points)
    } else if photos.is_empty() && !points.is_empty() {
        vec![Defect::TooFewRays { points }]
    } else if points.is_empty() && !photos.is_empty() {
        vec![Defect::PhotoUndetermined { photos }]
    } else if tied.len() > 1 {
        vec![not_tied(project, network, &tied)]
    } else {
        vec![Defect::Combination { points, photos, parameters: Vec::new() }]
    };
    Error::RankDefect { defects }
}

/// Camera parameters that are undetermined, camera by camera; where they are not alone, what moves with them as well.
fn undetermined_parameters(
    parameters: BTreeMap<String, Vec<String>>,
    photos: Vec<String>,
    points: Vec<String>,
) -> Vec<Defect> {
    let names = |(camera, list): (&String, &Vec<String>)| {
        list.iter().map(|parameter| format!("{camera}.{parameter}")).collect::<Vec<_>>()
    };
    let together: Vec<String> = parameters.iter().flat_map(names).collect();
    let alone = photos.is_empty() && points.is_empty() && parameters.len() == 1;
    let each = parameters.into_iter().map(|(camera, parameters)| Defect::ParameterUndetermined { camera, parameters });
    each.chain((!alone).then_some(Defect::Combination { points, photos, parameters: together })).collect()
}

/// Vectors that the observations do not determine, each unknown weighted by the effect it has on its own observations.
/// Inverse iteration with (N + λD)⁻¹D, orthogonal in D.
fn null_space(
    network: &Network,
    layout: &Layout,
    state: &State,
    normal: &mut Normal,
    pins: &[usize],
    weighting: Weighting<'_>,
) -> Option<Vec<Full>> {
    if !normal.build(network, layout, state, weighting, SHIFT, pins) {
        return None;
    }
    normal.factor();
    let diagonal = Full {
        reduced: normal.reference.clone(),
        points: normal.eliminated.factors.iter().map(|p| p.damping.map(|d| d / SHIFT)).collect(),
    };
    let product = |a: &Full, b: &Full| -> f64 {
        let reduced: f64 = (0..layout.size).map(|k| a.reduced[k] * diagonal.reduced[k] * b.reduced[k]).sum();
        let points = a.points.iter().zip(&b.points).zip(&diagonal.points);
        reduced + points.map(|((a, b), d)| (0..3).map(|k| a[k] * d[k] * b[k]).sum::<f64>()).sum::<f64>()
    };
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let count = MOST_VECTORS.min(network.unknowns());
    let mut vectors: Vec<Full> = (0..count)
        .map(|_| Full {
            reduced: (0..layout.size).map(|_| random()).collect(),
            points: (0..network.points.len()).map(|_| std::array::from_fn(|_| random())).collect(),
        })
        .collect();
    let mut gains = vec![0.0; count];
    for _ in 0..6 {
        for vector in &mut vectors {
            vector.reduced.iter_mut().zip(&diagonal.reduced).for_each(|(x, d)| *x *= d);
            vector.points.iter_mut().zip(&diagonal.points).for_each(|(x, d)| (0..3).for_each(|k| x[k] *= d[k]));
        }
        normal.solve_all(network, layout, &mut vectors);
        for k in 0..count {
            let (done, rest) = vectors.split_at_mut(k);
            let vector = &mut rest[0];
            for _ in 0..2 {
                for other in done.iter() {
                    let p = product(vector, other);
                    vector.reduced.iter_mut().zip(&other.reduced).for_each(|(x, o)| *x -= p * o);
                    let points = vector.points.iter_mut().zip(&other.points);
                    points.for_each(|(x, o)| (0..3).for_each(|a| x[a] -= p * o[a]));
                }
            }
            let length = product(vector, vector).sqrt();
            gains[k] = length;
            let factor = if length > 0.0 { 1.0 / length } else { 0.0 };
            vector.reduced.iter_mut().for_each(|x| *x *= factor);
            vector.points.iter_mut().flatten().for_each(|x| *x *= factor);
        }
    }
    // A gain of 1 / (µ + λ): undetermined where µ is of the size of the shift.
    let mut found: Vec<Full> = (vectors.iter().zip(&gains))
        .filter(|(_, gain)| **gain > 0.1 / SHIFT)
        .map(|(vector, _)| vector.clone())
        .collect();
    if found.is_empty() {
        found.extend(vectors.into_iter().take(1));
    }
    for vector in &mut found {
        vector.reduced.iter_mut().zip(&diagonal.reduced).for_each(|(x, d)| *x *= d.sqrt());
        vector.points.iter_mut().zip(&diagonal.points).for_each(|(x, d)| (0..3).for_each(|k| x[k] *= d[k].sqrt()));
        if !pins.is_empty() {
            sparsest(vector, layout, state, &diagonal, pins.len());
        }
    }
    Some(found)
}

/// Adds the similarity to a vector of the null space that leaves as many photos and points as possible where they are. Pins may lie
/// on the very photo that is loose, and then everything else moves. The sum of the blocks' lengths is made smallest by
/// iterated weights (E. Weiszfeld 1937), then that of their logarithms, which prefers many at rest to many that hardly move
/// (E. Candès, M. Wakin, S. Boyd 2008); the vector and the similarity's directions are scaled by √diagonal.
fn sparsest(vector: &mut Full, layout: &Layout, state: &State, diagonal: &Full, defect: usize) {
    let turned = |row: Direction, d: f64| SVector::<f64, SIMILARITY>::from(row) * d.sqrt();
    let mut blocks: Vec<Vec<(f64, SVector<f64, SIMILARITY>)>> = Vec::new();
    for (pose, &at) in state.poses.iter().zip(&layout.photo) {
        let rows = datum::at_photo(&pose.m, &pose.centre);
        let row = |k: usize| (vector.reduced[at + k], turned(rows[k], diagonal.reduced[at + k]));
        blocks.push((0..6).map(row).collect());
    }
    for (point, x) in state.points.iter().enumerate() {
        let rows = datum::at_point(x);
        let row = |a: usize| (vector.at_point(layout, point, a), turned(rows[a], diagonal.at_point(layout, point, a)));
        blocks.push((0..3).map(row).collect());
    }
    for row in blocks.iter_mut().flatten() {
        row.1.rows_mut(defect, SIMILARITY - defect).fill(0.0);
    }
    let moved = |block: &[(f64, SVector<f64, SIMILARITY>)], s: &SVector<f64, SIMILARITY>| {
        block.iter().map(|(x, g)| (x + g.dot(s)).powi(2)).sum::<f64>().sqrt()
    };
    let mut similarity = SVector::<f64, SIMILARITY>::zeros();
    for round in 0..150 {
        let lengths: Vec<f64> = blocks.iter().map(|block| moved(block, &similarity)).collect();
        let least = 1e-9 * lengths.iter().fold(f64::MIN_POSITIVE, |m, l| m.max(*l));
        let mut normal = SMatrix::<f64, SIMILARITY, SIMILARITY>::identity() * 1e-12;
        let mut right = SVector::<f64, SIMILARITY>::zeros();
        for (block, length) in blocks.iter().zip(&lengths) {
            let length = length.max(least);
            let weight = if round < 100 { 1.0 / length } else { (least / length).powi(2) / least };
            for (x, g) in block {
                normal += g * g.transpose() * weight;
                right -= g * (x * weight);
            }
        }
        let Some(next) = normal.cholesky().map(|c| c.solve(&right)) else { return };
        similarity = next;
    }
    if !similarity.iter().all(|s| s.is_finite()) {
        return;
    }
    for (block, &at) in blocks.iter().zip(&layout.photo) {
        (0..6).for_each(|k| vector.reduced[at + k] += block[k].1.dot(&similarity));
    }
    for (point, block) in blocks[layout.photo.len()..].iter().enumerate() {
        (0..3).for_each(|a| vector.add_at_point(layout, point, a, block[a].1.dot(&similarity)));
    }
}

/// What a solved network is weak in.
pub fn advice(project: &Project, network: &Network, state: &State, adjustment: &Adjustment) -> Vec<Advice> {
    let mut advice = Vec::new();
    for camera in &adjustment.cameras {
        let correlation = &camera.correlation;
        for (i, row) in correlation.matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate().take(i).filter(|(_, value)| value.abs() > HIGH_CORRELATION) {
                advice.push(Advice::HighCorrelation {
                    camera: camera.camera.id.clone(),
                    photo: camera.photo.clone(),
                    first: correlation.names[j].clone(),
                    second: correlation.names[i].clone(),
                    correlation: *value,
                });
            }
        }
    }
    for (block, photo) in network.photos.iter().zip(&adjustment.photos) {
        let Some(correlation) = &photo.correlation else { continue };
        for (i, row) in correlation.matrix.iter().enumerate() {
            // The interior orientation's own correlations are told once, above.
            for (j, value) in row.iter().enumerate().take(i.min(6)).filter(|(_, v)| v.abs() > HIGH_CORRELATION) {
                advice.push(Advice::HighCorrelation {
                    camera: project.photos[block.index].camera.clone(),
                    photo: Some(photo.id.clone()),
                    first: correlation.names[j].clone(),
                    second: correlation.names[i].clone(),
                    correlation: *value,
                });
            }
        }
    }
    let weak = adjustment
        .observations
        .iter()
        .filter(|o| o.enabled && [o.rx, o.ry].into_iter().flatten().any(|r| r < LOW_REDUNDANCY));
    let weak: Vec<_> = weak.map(|o| (o.photo.clone(), o.point.clone())).collect();
    let given = adjustment.given.iter();
    let given = given.filter(|g| g.enabled && g.reliability.is_some_and(|r| r.redundancy < LOW_REDUNDANCY));
    let given: Vec<_> = given.map(|g| g.what.clone()).collect();
    if !(weak.is_empty() && given.is_empty()) {
        advice.push(Advice::LowRedundancy { observations: weak, given });
    }
    let (mut two, mut narrow, mut behind) = (Vec::new(), Vec::new(), Vec::new());
    for (k, block) in network.points.iter().enumerate() {
        let id = || point_id(project, network, k);
        let rays = &network.rays[block.rays.clone()];
        let given = (0..3).all(|a| block.fixed[a] || block.prior[a].1 > 0.0);
        if rays.len() == 2 && !given {
            two.push(id());
        }
        let x = &state.points[k];
        let directions: Vec<[f64; 3]> = rays.iter().map(|ray| direction(&state.poses[ray.photo].centre, x)).collect();
        // Rays from opposite sides meet as badly as parallel ones.
        let cosines =
            directions.iter().enumerate().flat_map(|(n, a)| directions[..n].iter().map(move |b| cosine(a, b).abs()));
        let angle = cosines.fold(1.0, f64::min).acos();
        if rays.len() >= 2 && !given && angle < NARROW_INTERSECTION {
            narrow.push((id(), angle));
        }
        for ray in rays.iter().filter(|ray| state.poses[ray.photo].camera_point(x)[2] >= 0.0) {
            behind.push((photo_id(project, network, ray.photo), id()));
        }
    }
    if !two.is_empty() {
        advice.push(Advice::TwoRays { points: two });
    }
    if !narrow.is_empty() {
        advice.push(Advice::NarrowIntersection { points: narrow });
    }
    if !behind.is_empty() {
        advice.push(Advice::BehindCamera { observations: behind });
    }
    let used: Vec<usize> = network.bars.iter().map(|bar| bar.index).collect();
    let out = |k: &usize| network.left_out.contains(&Key::Distance(*k));
    let unused = project.distances.iter().enumerate().filter(|(k, _)| !used.contains(k) && !out(k));
    let unused: Vec<_> = unused.map(|(_, d)| (d.from.clone(), d.to.clone())).collect();
    if !unused.is_empty() {
        advice.push(Advice::DistanceUnused { distances: unused });
    }
    advice
}

fn direction(from: &[f64; 3], to: &[f64; 3]) -> [f64; 3] {
    let d: [f64; 3] = std::array::from_fn(|a| to[a] - from[a]);
    let length = d[0].hypot(d[1]).hypot(d[2]).max(1e-300);
    d.map(|x| x / length)
}

fn cosine(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
