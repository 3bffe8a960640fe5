//! Ellipse through edge points: robust selection, direct fit, geometric refinement.
//!
//! The direct fit minimises an algebraic distance and is biased towards small ellipses; the refinement minimises the
//! orthogonal distances of the kept points from the rim by Gauss-Newton in (u, v, p, q, r). Points further from the rim
//! than three robust sigmas are occluded, disturbed or belong to something else; they are left out and counted.

use nalgebra::{SMatrix, SVector};

use wide::f32x4;

use super::edge::Edges;
use crate::detect::acceptance::outline::{BENT, SIGMAS, TOLERANCE};
use crate::detect::ellipse::conic;
use crate::detect::ellipse::outline::Outline;
use crate::detect::median;

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

/// How a fit starts and ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start {
    /// More than a few tenths of a pixel off: replaced by the direct fit, and refined once.
    Rough,
    /// Near: refined until the last correction is below so many pixels.
    Near(f64),
}

/// Fits an ellipse to the kept points; updates which are kept.
pub(crate) fn fit(points: &mut Edges, start: &Outline, from: Start) -> Option<EllipseFit> {
    let (rough, converged) = match from {
        Start::Rough => (true, f64::INFINITY),
        Start::Near(converged) => (false, converged),
    };
    let mut scratch = std::mem::take(&mut points.scratch);
    let result = fit_with(points, start, rough, converged, &mut scratch);
    points.scratch = scratch;
    result
}

/// Memory of a fit.
#[derive(Default)]
pub(crate) struct Scratch {
    kept: Vec<[f64; 3]>,
    distances: Vec<f32>,
    pub sizes: Vec<u32>,
}

fn fit_with(
    points: &mut Edges,
    start: &Outline,
    rough: bool,
    converged: f64,
    scratch: &mut Scratch,
) -> Option<EllipseFit> {
    let count = points.len();
    // all outlines are counted from the place that the points are counted from
    let [u0, v0] = points.origin;
    let mut outline = Outline { u: start.u - u0, v: start.v - v0, ..*start };
    // the start may be a pixel off; what lies far from it is left out at first
    let first = if rough { 1.0 + 0.05 * outline.semi_axes().1 } else { 2.0 * TOLERANCE };
    select(points, &outline, scratch, SIGMAS, first);
    let mut changed = true;
    for round in 0..if rough { 3 } else { 0 } {
        let tolerance = if round == 0 { 2.0 * TOLERANCE } else { TOLERANCE };
        if !changed {
            // the same points have the same ellipse: only the limit may still change
            if round > 1 {
                break;
            }
            changed = select(points, &outline, scratch, 1.5, tolerance);
            continue;
        }
        let kept = &mut scratch.kept;
        kept.clear();
        let places = points.x.iter().zip(&points.y).zip(&points.kept).filter(|(_, kept)| **kept > 0.0);
        kept.extend(places.map(|((x, y), _)| [f64::from(*x), f64::from(*y), 1.0]));
        if kept.len() < 8.max(count / 3) {
            return None;
        }
        outline = conic::fit(kept)?;
        // wrong edges have pulled the ellipse and widened the scatter: the narrow limit lets it go from them
        changed = select(points, &outline, scratch, 1.5, tolerance);
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
            outline: Outline { u: outline.u + u0, v: outline.v + v0, ..outline },
            rms: (sum / (used - 5) as f64).sqrt(),
            normal,
            occluded: 1.0 - used as f64 / count as f64,
            gap: longest_gap(&points.kept) as f64 / count as f64,
        });
        if !rough && step.amax() < converged {
            break;
        }
        select(points, &outline, scratch, SIGMAS, TOLERANCE);
    }
    result
}

/// Longest run of points that are not kept, around the closed outline.
fn longest_gap(kept: &[f32]) -> usize {
    let (mut longest, mut run) = (0, 0);
    for kept in kept.iter().chain(kept) {
        run = if *kept > 0.0 { 0 } else { run + 1 };
        longest = longest.max(run);
    }
    longest.min(kept.len())
}

/// An outline for four points at a time; points and outline are counted from the same place.
struct Four {
    u: f32x4,
    v: f32x4,
    p: f32x4,
    q: f32x4,
    r: f32x4,
    /// 1 / det A.
    inverse: f32x4,
}

impl Four {
    fn new(outline: &Outline) -> Self {
        let det = outline.p * outline.q - outline.r * outline.r;
        let [u, v, p, q, r, inverse] =
            [outline.u, outline.v, outline.p, outline.q, outline.r, 1.0 / det].map(|value| f32x4::splat(value as f32));
        Self { u, v, p, q, r, inverse }
    }

    /// Points of the circle that map to the places, as [`Outline::normalised`].
    #[inline(always)]
    fn normalised(&self, x: f32x4, y: f32x4) -> [f32x4; 2] {
        let (x, y) = (x - self.u, y - self.v);
        [(self.q * x - self.r * y) * self.inverse, (self.p * y - self.r * x) * self.inverse]
    }

    /// Distances from the rim without their sign, as [`Outline::distance`].
    #[inline(always)]
    fn distance(&self, x: f32x4, y: f32x4) -> f32x4 {
        let [c, s] = self.normalised(x, y);
        let (gx, gy) = ((self.q * c - self.r * s) * self.inverse, (self.p * s - self.r * c) * self.inverse);
        let square = c * c + s * s;
        let gradient = (gx * gx + gy * gy).sqrt().fast_max(f32x4::splat(1e-12));
        ((square - square.sqrt()) / gradient).abs()
    }

    /// Curvatures of the rim next to the places, as [`Outline::curvature`].
    #[inline(always)]
    fn curvature(&self, x: f32x4, y: f32x4) -> f32x4 {
        let [c, s] = self.normalised(x, y);
        let (du, dv) = (self.r * c - self.p * s, self.q * c - self.r * s);
        let ratio = ((c * c + s * s) / (du * du + dv * dv).fast_max(f32x4::splat(1e-12))).sqrt();
        ratio * ratio * ratio / self.inverse
    }

    /// Derivatives of the distances along the normals after u, v, p, q, r, and the distances, as [`Outline::nearest`].
    #[inline(always)]
    fn moves(&self, x: f32x4, y: f32x4) -> ([f32x4; 5], f32x4) {
        let [c, s] = self.normalised(x, y);
        let scale = f32x4::ONE / (c * c + s * s).fast_max(f32x4::splat(1e-24)).sqrt();
        let (c, s) = (c * scale, s * scale);
        let (du, dv) = (self.r * c - self.p * s, self.q * c - self.r * s);
        let speed = f32x4::ONE / (du * du + dv * dv).sqrt();
        let (nx, ny) = (dv * speed, -du * speed);
        let (rim_x, rim_y) = (self.u + self.p * c + self.r * s, self.v + self.r * c + self.q * s);
        let distance = (x - rim_x) * nx + (y - rim_y) * ny;
        ([nx, ny, nx * c, ny * s, nx * s + ny * c], distance)
    }
}

/// Normal equations of the orthogonal distances: matrix, right-hand side, sum of squares, number of points.
#[inline(never)]
fn normal_equations(points: &Edges, outline: &Outline) -> (SMatrix<f64, 5, 5>, SVector<f64, 5>, f64, usize) {
    let four = Four::new(outline);
    let (mut lower, mut right) = ([[f32x4::ZERO; 5]; 5], [f32x4::ZERO; 5]);
    let (mut sum, mut used) = (f32x4::ZERO, f32x4::ZERO);
    let columns = [&points.x, &points.y, &points.kept].map(|column| column.as_chunks::<4>().0);
    for ((x, y), kept) in columns[0].iter().zip(columns[1]).zip(columns[2]) {
        let kept = f32x4::new(*kept);
        let (moves, distance) = four.moves(f32x4::new(*x), f32x4::new(*y));
        let distance = distance * kept;
        for i in 0..5 {
            let weighted = moves[i] * kept;
            for j in 0..=i {
                lower[i][j] += weighted * moves[j];
            }
            right[i] += moves[i] * distance;
        }
        sum += distance * distance;
        used += kept;
    }
    let add = |four: f32x4| four.to_array().into_iter().map(f64::from).sum::<f64>();
    let normal = SMatrix::from_fn(|i, j| add(lower[i.max(j)][i.min(j)]));
    (normal, SVector::from(right.map(add)), add(sum), add(used) as usize)
}

/// Keeps the points that have an edge and lie near the rim: within some robust sigmas, at least `tolerance` pixels.
/// Whether others are kept than before.
#[inline(never)]
fn select(points: &mut Edges, outline: &Outline, scratch: &mut Scratch, sigmas: f64, tolerance: f64) -> bool {
    let Scratch { distances, sizes, .. } = scratch;
    let four = Four::new(outline);
    let always = f32x4::splat((tolerance / (sigmas * 1.4826)) as f32);
    let (mut edges, mut near) = (0, 0);
    distances.clear();
    let columns = [&points.x, &points.y, &points.strength].map(|column| column.as_chunks::<4>().0);
    for ((x, y), strength) in columns[0].iter().zip(columns[1]).zip(columns[2]) {
        let is_edge = f32x4::new(*strength).simd_gt(f32x4::ZERO);
        let distance = is_edge.select(four.distance(f32x4::new(*x), f32x4::new(*y)), f32x4::splat(f32::INFINITY));
        edges += is_edge.to_bitmask().count_ones() as usize;
        near += distance.simd_le(always).to_bitmask().count_ones() as usize;
        distances.extend_from_slice(&distance.to_array());
    }
    if edges == 0 {
        return false;
    }
    // a robust sigma matters only where more than half of the points lie beyond what is always allowed
    let limit = if near > edges / 2 {
        tolerance
    } else {
        let found = distances.iter().filter(|distance| distance.is_finite());
        (sigmas * 1.4826 * median::of_sizes(found.copied(), sizes)).max(tolerance)
    };
    let (a, b) = outline.semi_axes();
    let bent = BENT * a / (b * b) > 0.5 * TOLERANCE;
    let limit = f32x4::splat(limit as f32);
    let mut changed = false;
    let Edges { x, y, kept, .. } = points;
    let places = x.as_chunks::<4>().0.iter().zip(y.as_chunks::<4>().0);
    for (((x, y), kept), distance) in places.zip(kept.as_chunks_mut::<4>().0).zip(distances.as_chunks::<4>().0) {
        let limit = if bent {
            limit + f32x4::splat(BENT as f32) * four.curvature(f32x4::new(*x), f32x4::new(*y))
        } else {
            limit
        };
        let distance = f32x4::new(*distance);
        // what has no edge is infinitely far
        let keep = (distance.simd_le(limit) & f32x4::ONE).to_array();
        changed |= keep != *kept;
        *kept = keep;
    }
    changed
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::ellipse::rays::rim_points;

    /// Edges at a distance from the rim, one for each of 40 rays; `None` if there is no distance.
    fn edges(truth: &Outline, off: impl Fn(usize) -> Option<f64>) -> Edges {
        let mut edges = Edges::default();
        edges.begin(&Outline { u: 50.0, v: 40.0, ..*truth }, 40);
        for (k, rim) in rim_points(truth, 40).enumerate() {
            if let Some(off) = off(k) {
                edges.set(k, [rim.x + off * rim.normal[0], rim.y + off * rim.normal[1]], 50.0, true);
            }
        }
        edges
    }

    #[test]
    fn a_fifth_of_wrong_edges_is_left_out() {
        let truth = Outline::from_axes(50.2, 40.7, 20.0, 12.0, 0.4);
        let mut points = edges(&truth, |k| Some(if k % 5 == 0 { 2.5 } else { 0.05 * (k as f64 * 12.9898).sin() }));
        let start = truth.plus(&[0.8, -0.7, 0.5, -0.4, 0.1]);
        let rough = fit(&mut points, &start, Start::Rough).unwrap();
        let found = fit(&mut points, &rough.outline, Start::Near(1e-4)).unwrap();
        assert!((found.outline.u - truth.u).hypot(found.outline.v - truth.v) < 0.02, "{found:?}");
        assert!((found.occluded - 0.2).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn too_few_edges_give_nothing() {
        let truth = Outline::from_axes(50.2, 40.7, 20.0, 12.0, 0.4);
        let mut points = edges(&truth, |k| (k < 9).then_some(0.0));
        assert!(fit(&mut points, &truth, Start::Rough).is_none());
    }

    #[test]
    fn four_at_a_time_are_as_one_by_one() {
        let outline = Outline::from_axes(3.3, -2.1, 30.0, 12.0, 0.4);
        let points = edges(&outline, |k| (k % 7 != 3).then_some(0.8 * (k as f64 * 12.9898).sin()));
        let (normal, right, sum, used) = normal_equations(&points, &Outline { u: -46.7, v: -42.1, ..outline });
        let (mut plain, mut plain_right, mut square) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros(), 0.0);
        for k in (0..40).filter(|k| points.is_kept(*k)) {
            let [x, y] = points.place(k);
            let (rim, distance) = outline.nearest(x, y);
            let moves = SVector::from(rim.moves);
            plain += moves * moves.transpose();
            plain_right += moves * distance;
            square += distance * distance;
            let four = Four::new(&outline);
            let [x4, y4] = [x, y].map(|place| f32x4::splat(place as f32));
            let close = |found: f32x4, plain: f64| (f64::from(found.to_array()[0]) - plain).abs() < 2e-5;
            assert!(close(four.distance(x4, y4), outline.distance(x, y).abs()));
            assert!(close(four.curvature(x4, y4), outline.curvature(x, y)));
        }
        assert_eq!(used, 34);
        assert!((normal - plain).amax() < 1e-4 && (right - plain_right).amax() < 1e-4 && (sum - square).abs() < 1e-4);
    }
}
