//! The null space of normal equations, found by inverse iteration.

use nalgebra::{SMatrix, SVector};

use crate::adjust::datum::free::{self, Direction, SIMILARITY};
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::equations::context::Context;
use crate::adjust::equations::normal::ReducedNormalEquations;
use crate::adjust::equations::ordering::Layout;
use crate::adjust::problem::state::State;

/// Damping of the inverse iteration: what is weaker counts as undetermined.
const SHIFT: f64 = 1e-10;
/// Vectors of the null space looked at.
const MOST_VECTORS: usize = 12;

/// Vectors that the observations do not determine, each unknown weighted by the effect it has on its own observations.
/// Inverse iteration with (N + λD)⁻¹D, orthogonal in D.
pub fn null_space(context: Context<'_>, normal: &mut ReducedNormalEquations, pins: &[usize]) -> Option<Vec<Full>> {
    let Context { network, layout, state, .. } = context;
    if !normal.build(context, SHIFT, pins) {
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
        let rows = free::at_photo(&pose.m, &pose.centre);
        let row = |k: usize| (vector.reduced[at + k], turned(rows[k], diagonal.reduced[at + k]));
        blocks.push((0..6).map(row).collect());
    }
    for (point, x) in state.points.iter().enumerate() {
        let rows = free::at_point(x);
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
