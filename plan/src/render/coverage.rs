//! Exact images of outlines: the share of each pixel that a blurred shape covers, without supersampling.
//!
//! A pixel is a unit box, the point spread a Gaussian of standard deviation s. With the cumulative normal Φ,
//!
//! ```text
//! k(t) = Φ((t + ½)/s) - Φ((t - ½)/s)          box convolved with Gaussian
//! K(t) = ∫ k                                   its antiderivative
//! I(x, y) = ∮ -K(x - u) k(y - v) dv            Green's theorem along the outline (u, v)
//! ```
//!
//! The integrand is smooth and, for a closed smooth outline, periodic, so that the trapezium rule is exact to rounding
//! once its nodes are closer than about s/2; corners are handled by Gauss nodes between them.

/// A node of the integral along an outline: position, and dv times the quadrature weight.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// To the right, pixels.
    pub u: f64,
    /// Downwards, pixels.
    pub v: f64,
    /// Increment of v.
    pub dv: f64,
}

/// Maximum number of nodes of an outline; one around a picture of 250 million pixels has a million.
pub const MAX_NODES: usize = 1 << 22;

/// Number of standard deviations beyond which the point spread is neglected (2·10⁻⁹).
const REACH: f64 = 6.0;

/// A window of pixels with the covered share of each.
#[derive(Clone, Debug)]
pub struct Coverage {
    /// First column.
    pub left: usize,
    /// First row.
    pub top: usize,
    /// Number of columns, at least 1.
    pub columns: usize,
    /// Covered shares, 0 to 1, row by row.
    pub shares: Vec<f64>,
}

/// Nodes of a smooth closed outline given by `point` over a full turn, with at least the density `spacing` (pixels).
///
/// The derivative is the eighth-order central difference over the periodic nodes. `None` if a point does not project into the picture
/// plane or if more than [`MAX_NODES`] are needed.
pub fn smooth(point: impl Fn(f64) -> Option<[f64; 2]>, spacing: f64) -> Option<Vec<Node>> {
    const ROUGH: usize = 16;
    let rough: Option<Vec<_>> = (0..ROUGH).map(|k| point(k as f64 / ROUGH as f64 * std::f64::consts::TAU)).collect();
    let rough = rough?;
    let length: f64 = (0..ROUGH)
        .map(|k| {
            let (p, q) = (rough[k], rough[(k + 1) % ROUGH]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        })
        .sum();
    let n = ((1.6 * length / spacing).ceil() as usize).max(64);
    if n > MAX_NODES {
        return None;
    }
    let rim: Option<Vec<_>> = (0..n).map(|k| point(k as f64 / n as f64 * std::f64::consts::TAU)).collect();
    let rim = rim?;
    let nodes = (0..n).map(|k| {
        let difference = |step: usize| rim[(k + step) % n][1] - rim[(k + n - step) % n][1];
        let dv = 4.0 / 5.0 * difference(1) - 1.0 / 5.0 * difference(2) + 4.0 / 105.0 * difference(3)
            - 1.0 / 280.0 * difference(4);
        Node { u: rim[k][0], v: rim[k][1], dv }
    });
    Some(nodes.collect())
}

/// Nodes of a closed polygon: two Gauss points on each chord.
pub fn polygon(vertices: &[[f64; 2]]) -> Vec<Node> {
    let offset = 0.5 / 3f64.sqrt();
    let chord = |k: usize| {
        let (p, q) = (vertices[k], vertices[(k + 1) % vertices.len()]);
        let at = move |share: f64| Node {
            u: p[0] + share * (q[0] - p[0]),
            v: p[1] + share * (q[1] - p[1]),
            dv: (q[1] - p[1]) / 2.0,
        };
        [at(0.5 - offset), at(0.5 + offset)]
    };
    (0..vertices.len()).flat_map(chord).collect()
}

/// The share of each pixel of a picture that the inside of the outline covers; `psf` is the standard deviation of the point spread in
/// pixels.
pub fn coverage(nodes: &[Node], psf: f64, [width, height]: [usize; 2]) -> Coverage {
    let bounds = |value: fn(&Node) -> f64, size: usize| {
        let low = nodes.iter().map(value).fold(f64::INFINITY, f64::min);
        let high = nodes.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let within = |edge: f64| edge.clamp(0.0, size as f64) as usize;
        (within((low - REACH * psf - 1.0).floor()), within((high + REACH * psf + 1.0).ceil()))
    };
    let ((left, right), (top, bottom)) = (bounds(|n| n.u, width), bounds(|n| n.v, height));
    let (columns, rows) = (right.saturating_sub(left), bottom.saturating_sub(top));
    let mut shares = vec![0.0; columns * rows];
    if shares.is_empty() {
        return Coverage { left, top, columns: 1, shares };
    }
    // The sign of the area gives the direction of the outline: it is reversed for shapes seen from behind.
    let area: f64 = nodes.iter().map(|n| (n.u - nodes[0].u) * n.dv).sum();
    let half = REACH * psf + 0.5;
    let span = |at: f64, start: usize, count: usize| {
        let first = (at - half - start as f64 - 0.5).floor().max(0.0) as usize;
        let last = ((at + half - start as f64 + 0.5).ceil().max(0.0) as usize).min(count);
        // Empty for nodes to the right of the window.
        first.min(last)..last
    };
    let mut steps = Vec::new();
    for node in nodes {
        let mut reached = span(node.u, left, columns);
        // K rises from 0 to 1 across the point spread. Only its second differences are added here; the rows are summed at the end.
        steps.clear();
        let first = left as f64 + reached.start as f64 - node.u;
        let mut edge = antiderivative(first, psf);
        let mut before = 0.0;
        for column in 0..reached.len() {
            let next = antiderivative(first + column as f64 + 1.0, psf);
            steps.push(next - edge - before);
            before = next - edge;
            edge = next;
        }
        // For nodes to the left of the window K is 1 in the whole row.
        if reached.end == 0 {
            reached = 0..1;
            steps.push(1.0);
        }
        let rows_reached = span(node.v, top, rows);
        let mut low = cumulative((top as f64 + rows_reached.start as f64 - node.v) / psf);
        for row in rows_reached {
            let high = cumulative((top as f64 + row as f64 + 1.0 - node.v) / psf);
            let factor = (high - low) * node.dv * area.signum();
            low = high;
            let line = &mut shares[row * columns + reached.start..row * columns + reached.end];
            line.iter_mut().zip(&steps).for_each(|(share, step)| *share -= factor * step);
        }
    }
    for line in shares.chunks_exact_mut(columns) {
        let mut sum = 0.0;
        for share in line {
            sum += *share;
            *share = sum;
        }
    }
    Coverage { left, top, columns, shares }
}

/// Φ.
fn cumulative(t: f64) -> f64 {
    0.5 * libm::erfc(-t * std::f64::consts::FRAC_1_SQRT_2)
}

/// ∫ Φ(t/s) dt = t Φ(t/s) + s φ(t/s).
fn antiderivative(t: f64, s: f64) -> f64 {
    let x = t / s;
    t * cumulative(x) + s * (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt()
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const SIZE: [usize; 2] = [60, 50];
    const ELLIPSE: [f64; 5] = [20.3, 17.8, 6.2, 3.1, 0.6];

    fn on_ellipse([u, v, a, b, angle]: [f64; 5], t: f64) -> [f64; 2] {
        let (x, y) = (a * t.cos(), b * t.sin());
        [u + x * angle.cos() - y * angle.sin(), v + x * angle.sin() + y * angle.cos()]
    }

    fn moments(c: &Coverage) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (i, share) in c.shares.iter().enumerate() {
            sums[0] += share;
            sums[1] += share * (c.left as f64 + (i % c.columns) as f64 + 0.5);
            sums[2] += share * (c.top as f64 + (i / c.columns) as f64 + 0.5);
        }
        [sums[0], sums[1] / sums[0], sums[2] / sums[0]]
    }

    #[test]
    fn area_and_centre_are_exact_whichever_way_the_outline_runs() {
        for turn in [1.0, -1.0] {
            let nodes = smooth(|t| Some(on_ellipse(ELLIPSE, turn * t)), 0.25).unwrap();
            let [area, u, v] = moments(&coverage(&nodes, 0.7, SIZE));
            assert!(
                (area - std::f64::consts::PI * 6.2 * 3.1).abs() < 1e-6,
                "{} {u} {v}",
                area - std::f64::consts::PI * 6.2 * 3.1
            );
            assert!((u - 20.3).abs() < 1e-6 && (v - 17.8).abs() < 1e-6, "{u} {v}");
        }
    }

    #[test]
    fn each_pixel_agrees_with_brute_force() {
        let psf = 0.8;
        let nodes = smooth(|t| Some(on_ellipse(ELLIPSE, t)), 0.25).unwrap();
        let exact = coverage(&nodes, psf, SIZE);
        let box_gauss = |t: f64| cumulative((t + 0.5) / psf) - cumulative((t - 0.5) / psf);
        for (column, row) in [(20, 17), (14, 14), (26, 21), (24, 24), (18, 20)] {
            // Polar sum over the ellipse, midpoint rule.
            let (rings, sectors) = (800, 400);
            let mut sum = 0.0;
            for i in 0..rings {
                let r = (i as f64 + 0.5) / rings as f64;
                for j in 0..sectors {
                    let t = (j as f64 + 0.5) / sectors as f64 * std::f64::consts::TAU;
                    let [a, b] = [6.2 * r, 3.1 * r];
                    let [u, v] = on_ellipse([20.3, 17.8, a, b, 0.6], t);
                    sum += r * box_gauss(column as f64 + 0.5 - u) * box_gauss(row as f64 + 0.5 - v);
                }
            }
            let brute = sum * std::f64::consts::TAU * 6.2 * 3.1 / (rings * sectors) as f64;
            let place = (row - exact.top) * exact.columns + (column - exact.left);
            assert!((exact.shares[place] - brute).abs() < 2e-5, "{} for {brute}", exact.shares[place]);
        }
    }

    #[test]
    fn shapes_cut_by_the_border_have_the_coverage_of_whole_shapes() {
        let [u, v, a, b, angle] = ELLIPSE;
        let at = |c: &Coverage, column: usize, row: usize| {
            let inside = row >= c.top && column >= c.left && column - c.left < c.columns;
            inside.then(|| c.shares.get((row - c.top) * c.columns + column - c.left).copied()).flatten().unwrap_or(0.0)
        };
        let drawn = |u: f64, v: f64, size: [usize; 2]| {
            coverage(&smooth(|t| Some(on_ellipse([u, v, a, b, angle], t)), 0.25).unwrap(), 0.7, size)
        };
        let whole = drawn(u, v, SIZE);
        // across the upper left corner, across the lower right one, and around a picture smaller than the shape
        for ([left, top], size) in [([20, 18], SIZE), ([0, 0], [22, 19]), ([18, 16], [4, 3])] {
            let part = drawn(u - left as f64, v - top as f64, size);
            assert!(part.left + part.columns <= size[0] && part.top + part.shares.len() / part.columns <= size[1]);
            for (column, row) in (0..size[0].min(20)).flat_map(|x| (0..size[1].min(20)).map(move |y| (x, y))) {
                let (one, other) = (at(&part, column, row), at(&whole, column + left, row + top));
                assert!((one - other).abs() < 1e-9, "{column} {row}: {one} {other}");
            }
        }
        assert!(drawn(-30.0, 10.0, SIZE).shares.is_empty() && drawn(10.0, 90.0, SIZE).shares.is_empty());
        assert!(smooth(|t| Some([1e9 * t.cos(), 1e9 * t.sin()]), 0.25).is_none());
    }

    #[test]
    fn polygons_keep_their_area() {
        let corners = [[13.2, 14.1], [23.2, 14.1], [23.2, 19.1], [13.2, 19.1]];
        // Chords short against the point spread, as the renderer makes them.
        let vertices: Vec<_> = (0..4)
            .flat_map(|k| {
                let (p, q): ([f64; 2], [f64; 2]) = (corners[k], corners[(k + 1) % 4]);
                (0..20).map(move |i| {
                    let s = i as f64 / 20.0;
                    [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]
                })
            })
            .collect();
        let filled = coverage(&polygon(&vertices), 0.7, SIZE);
        let [area, u, v] = moments(&filled);
        assert!((area - 50.0).abs() < 1e-6 && (u - 18.2).abs() < 1e-6 && (v - 16.6).abs() < 1e-6);
        let middle = (16 - filled.top) * filled.columns + (18 - filled.left);
        assert!((filled.shares[middle] - 0.999).abs() < 0.01);
    }
}
