//! Ellipse through edge points: robust selection, direct fit, geometric refinement.
//!
//! The direct fit minimises an algebraic distance and is biased towards small ellipses; the refinement minimises the
//! orthogonal distances of the kept points from the rim by Gauss-Newton in (u, v, p, q, r). Points further from the rim
//! than three robust sigmas are hidden, disturbed or belong to something else; they are left out and counted.

use nalgebra::{SMatrix, SVector};

use super::conic;
use super::edge::EdgePoint;
use super::outline::Outline;

/// Result of the fit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EllipseFit {
    pub outline: Outline,
    /// Rms of the orthogonal distances of the kept points, in pixels.
    pub rms: f64,
    /// Normal matrix of (u, v, p, q, r) for independent edge points of sigma 1 px.
    pub normal: SMatrix<f64, 5, 5>,
    /// Share of the rays without a fitting edge.
    pub occluded: f64,
    /// Longest run of such rays, as a share of all.
    pub gap: f64,
}

/// Smallest distance, in pixels, that a point may always have.
const TOLERANCE: f64 = 0.25;
/// Blur s moves the steepest place of a rim of curvature κ inwards by about κ s² / 2: so much, in square pixels, is allowed
/// for at the tips of a slender ellipse.
const BENT: f64 = 0.4;
/// Largest distance of a kept point, in robust standard deviations.
const SIGMAS: f64 = 3.0;

/// How a fit starts and ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start {
    /// More than a few tenths of a pixel off: replaced by the direct fit, and refined once.
    Rough,
    /// Near: refined until the last correction is below so many pixels.
    Near(f64),
}

/// Fits an ellipse to the kept points; updates which are kept.
pub(crate) fn fit(points: &mut [EdgePoint], start: &Outline, from: Start) -> Option<EllipseFit> {
    let (rough, converged) = match from {
        Start::Rough => (true, f64::INFINITY),
        Start::Near(converged) => (false, converged),
    };
    let count = points.len();
    let (mut distances, mut kept) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut outline = *start;
    // the start may be a pixel off; what lies far from it is left out at first
    let first = if rough { 1.0 + 0.05 * outline.semi_axes().1 } else { 2.0 * TOLERANCE };
    select(points, &outline, &mut distances, SIGMAS, first);
    let mut changed = true;
    for round in 0..if rough { 3 } else { 0 } {
        let tolerance = if round == 0 { 2.0 * TOLERANCE } else { TOLERANCE };
        if !changed {
            // the same points have the same ellipse: only the limit may still change
            if round > 1 {
                break;
            }
            changed = select(points, &outline, &mut distances, 1.5, tolerance);
            continue;
        }
        kept.clear();
        kept.extend(points.iter().filter(|point| point.kept).map(|point| [point.x, point.y, 1.0]));
        if kept.len() < 8.max(count / 3) {
            return None;
        }
        outline = conic::fit(&kept)?;
        // wrong edges have pulled the ellipse and widened the scatter: the narrow limit lets it go from them
        changed = select(points, &outline, &mut distances, 1.5, tolerance);
    }
    let mut result = None;
    for _ in 0..if rough { 1 } else { 4 } {
        let (normal, right, sum, used) = normal_equations(points, &outline);
        if used < 8.max(count / 3) {
            return None;
        }
        let step = normal.cholesky()?.solve(&right);
        outline = outline.plus(step.as_slice());
        if !outline.is_proper() {
            return None;
        }
        result = Some(EllipseFit {
            outline,
            rms: (sum / (used - 5) as f64).sqrt(),
            normal,
            occluded: 1.0 - used as f64 / count as f64,
            gap: longest_gap(points) as f64 / count as f64,
        });
        if !rough && step.amax() < converged {
            break;
        }
        select(points, &outline, &mut distances, SIGMAS, TOLERANCE);
    }
    result
}

/// Longest run of points that are not kept, around the closed outline.
fn longest_gap(points: &[EdgePoint]) -> usize {
    let (mut longest, mut run) = (0, 0);
    for point in points.iter().chain(points).take(2 * points.len()) {
        run = if point.kept { 0 } else { run + 1 };
        longest = longest.max(run);
    }
    longest.min(points.len())
}

/// Normal equations of the orthogonal distances: matrix, right-hand side, sum of squares, number of points.
fn normal_equations(points: &[EdgePoint], outline: &Outline) -> (SMatrix<f64, 5, 5>, SVector<f64, 5>, f64, usize) {
    let (mut lower, mut right) = ([[0.0; 5]; 5], [0.0; 5]);
    let (mut sum, mut used) = (0.0, 0);
    for point in points.iter().filter(|point| point.kept) {
        let (rim, distance) = outline.nearest(point.x, point.y);
        for i in 0..5 {
            for j in 0..=i {
                lower[i][j] += rim.moves[i] * rim.moves[j];
            }
            right[i] += rim.moves[i] * distance;
        }
        sum += distance * distance;
        used += 1;
    }
    (SMatrix::from_fn(|i, j| lower[i.max(j)][i.min(j)]), SVector::from(right), sum, used)
}

/// Keeps the points that have an edge and lie near the rim: within some robust sigmas, at least `tolerance` pixels.
/// Whether others are kept than before.
fn select(points: &mut [EdgePoint], outline: &Outline, distances: &mut Vec<f64>, sigmas: f64, tolerance: f64) -> bool {
    distances.clear();
    distances.extend(
        points.iter().filter(|point| point.strength > 0.0).map(|point| outline.distance(point.x, point.y).abs()),
    );
    // a robust sigma matters only where more than half of the points lie beyond what is always allowed
    let count = distances.len();
    let limit = if distances.iter().filter(|d| sigmas * 1.4826 * **d <= tolerance).count() > count / 2 {
        tolerance
    } else if count > 0 {
        let mut sorted = distances.clone();
        let (_, &mut median, _) = sorted.select_nth_unstable_by(count / 2, f64::total_cmp);
        (sigmas * 1.4826 * median).max(tolerance)
    } else {
        return false;
    };
    let (a, b) = outline.semi_axes();
    let bent = BENT * a / (b * b) > 0.5 * TOLERANCE;
    let mut changed = false;
    for (point, distance) in points.iter_mut().filter(|point| point.strength > 0.0).zip(distances) {
        let limit = if bent { limit + BENT * outline.curvature(point.x, point.y) } else { limit };
        let keep = *distance <= limit;
        changed |= keep != point.kept;
        point.kept = keep;
    }
    changed
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::edge::rim_points;

    #[test]
    fn a_fifth_of_wrong_edges_is_left_out() {
        let truth = Outline::from_axes(50.2, 40.7, 20.0, 12.0, 0.4);
        let mut points: Vec<EdgePoint> = rim_points(&truth, 40)
            .enumerate()
            .map(|(k, rim)| {
                let off = if k % 5 == 0 { 2.5 } else { 0.05 * (k as f64 * 12.9898).sin() };
                EdgePoint { x: rim.x + off * rim.normal[0], y: rim.y + off * rim.normal[1], strength: 50.0, kept: true }
            })
            .collect();
        let start = truth.plus(&[0.8, -0.7, 0.5, -0.4, 0.1]);
        let rough = fit(&mut points, &start, Start::Rough).unwrap();
        let found = fit(&mut points, &rough.outline, Start::Near(1e-4)).unwrap();
        assert!((found.outline.u - truth.u).hypot(found.outline.v - truth.v) < 0.02, "{found:?}");
        assert!((found.occluded - 0.2).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn too_few_edges_give_nothing() {
        let truth = Outline::from_axes(50.2, 40.7, 20.0, 12.0, 0.4);
        let mut points: Vec<EdgePoint> = rim_points(&truth, 40)
            .enumerate()
            .map(|(k, rim)| EdgePoint { x: rim.x, y: rim.y, strength: if k < 9 { 50.0 } else { 0.0 }, kept: k < 9 })
            .collect();
        assert!(fit(&mut points, &truth, Start::Rough).is_none());
    }
}
