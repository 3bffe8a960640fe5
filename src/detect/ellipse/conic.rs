//! Ellipse through points by direct least squares.
//!
//! Minimises the algebraic distance a x² + b x y + c y² + d x + e y + f under 4 a c - b² = 1, which only ellipses fulfil
//! (Fitzgibbon, Pilu & Fisher 1999), in the partitioned form of Halir & Flusser (1998): the linear part is eliminated, and
//! of the remaining 3 x 3 problem S z = λ C z, with C the constraint, the one positive λ belongs to the ellipse.
//! Solved here as C z = μ S z with S = L L': L⁻¹ C L⁻ᵀ is symmetric, has exactly one positive eigenvalue, and stays
//! well defined for points without error.

use super::outline::Outline;

/// Ellipse through five or more weighted points (x, y, weight); `None` if they determine no ellipse.
pub(crate) fn fit(points: &[[f64; 3]]) -> Option<Outline> {
    let (mut weight, mut mx, mut my) = (0.0, 0.0, 0.0);
    for [x, y, w] in points {
        weight += w;
        mx += w * x;
        my += w * y;
    }
    if points.len() < 5 || !(weight > 0.0) {
        return None;
    }
    (mx, my) = (mx / weight, my / weight);
    let spread = points.iter().map(|[x, y, w]| w * ((x - mx).powi(2) + (y - my).powi(2))).sum::<f64>() / weight;
    let scale = (spread / 2.0).sqrt();
    if !(scale > 1e-9 && scale.is_finite()) {
        return None;
    }
    let mut sums = Sums::default();
    for [x, y, w] in points {
        sums.add((x - mx) / scale, (y - my) / scale, *w);
    }
    let Sums { weight, second, third, fourth, .. } = sums;
    let outline = through(weight, second, third, fourth)?;
    let outline = Outline { u: outline.u * scale + mx, v: outline.v * scale + my, ..outline.scaled(scale) };
    outline.is_proper().then_some(outline)
}

/// Sums of w x^i y^j over points: what the ellipse through them depends on. Those of points that lie next to each other are
/// differences of running sums. Meant for places of size 1 about 0.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    pub weight: f64,
    first: [f64; 2],
    second: [f64; 3],
    third: [f64; 4],
    fourth: [f64; 5],
}

impl Sums {
    /// Takes a point in.
    pub fn add(&mut self, x: f64, y: f64, w: f64) {
        let [xx, xy, yy] = [w * x * x, w * x * y, w * y * y];
        self.weight += w;
        add(&mut self.first, [w * x, w * y]);
        add(&mut self.second, [xx, xy, yy]);
        add(&mut self.third, [xx * x, xx * y, yy * x, yy * y]);
        add(&mut self.fourth, [xx * x * x, xx * x * y, xx * y * y, xy * y * y, yy * y * y]);
    }

    /// The sums of what was taken in since `before`.
    pub fn since(&self, before: &Self) -> Self {
        Self {
            weight: self.weight - before.weight,
            first: std::array::from_fn(|i| self.first[i] - before.first[i]),
            second: std::array::from_fn(|i| self.second[i] - before.second[i]),
            third: std::array::from_fn(|i| self.third[i] - before.third[i]),
            fourth: std::array::from_fn(|i| self.fourth[i] - before.fourth[i]),
        }
    }

    /// The ellipse of the points; `None` if they determine none.
    pub fn ellipse(&self) -> Option<Outline> {
        let Self { weight, first, second, third, fourth } = *self;
        if !(weight > 0.0) {
            return None;
        }
        // moved to the centroid (p, q): S'(i, j) is the sum of w (x - p)^i (y - q)^j
        let [p, q] = first.map(|sum| sum / weight);
        let [xx, xy, yy] = second;
        let [x3, xxy, xyy, y3] = third;
        let [x4, x3y, xxyy, xy3, y4] = fourth;
        let n = weight;
        let second = [xx - n * p * p, xy - n * p * q, yy - n * q * q];
        let moved = [
            x3 - 3.0 * p * xx + 2.0 * n * p * p * p,
            xxy - 2.0 * p * xy - q * xx + 2.0 * n * p * p * q,
            xyy - 2.0 * q * xy - p * yy + 2.0 * n * p * q * q,
            y3 - 3.0 * q * yy + 2.0 * n * q * q * q,
        ];
        let fourth = [
            x4 - 4.0 * p * x3 + 6.0 * p * p * xx - 3.0 * n * p.powi(4),
            x3y - 3.0 * p * xxy - q * x3 + 3.0 * p * p * xy + 3.0 * p * q * xx - 3.0 * n * p.powi(3) * q,
            xxyy - 2.0 * q * xxy - 2.0 * p * xyy + q * q * xx + p * p * yy + 4.0 * p * q * xy - 3.0 * n * p * p * q * q,
            xy3 - 3.0 * q * xyy - p * y3 + 3.0 * q * q * xy + 3.0 * p * q * yy - 3.0 * n * p * q.powi(3),
            y4 - 4.0 * q * y3 + 6.0 * q * q * yy - 3.0 * n * q.powi(4),
        ];
        let outline = through(weight, second, moved, fourth)?;
        let outline = Outline { u: outline.u + p, v: outline.v + q, ..outline };
        outline.is_proper().then_some(outline)
    }
}

fn add<const N: usize>(sums: &mut [f64; N], terms: [f64; N]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}

/// The ellipse of sums of x^i y^j of the second, third and fourth order about the centroid, where those of the first are 0.
fn through(weight: f64, second: [f64; 3], third: [f64; 4], fourth: [f64; 5]) -> Option<Outline> {
    let [x4, x3y, xxyy, xy3, y4] = fourth;
    let [x3, xxy, xyy, y3] = third;
    let [xx, xy, yy] = second;
    let det = xx * yy - xy * xy;
    if det <= 0.0 {
        return None;
    }
    // columns of S2 and rows of the linear part as a function of the quadratic one, -S3^-1 S2'
    let mixed = [[x3, xxy, xyy], [xxy, xyy, y3], second];
    let back: [[f64; 3]; 3] = [
        std::array::from_fn(|j| (xy * mixed[1][j] - yy * mixed[0][j]) / det),
        std::array::from_fn(|j| (xy * mixed[0][j] - xx * mixed[1][j]) / det),
        std::array::from_fn(|j| -mixed[2][j] / weight),
    ];
    let reduced = |i: usize, j: usize, own: f64| {
        own + mixed[0][i] * back[0][j] + mixed[1][i] * back[1][j] + mixed[2][i] * back[2][j]
    };
    let damping = 1e-13 * (x4 + xxyy + y4);
    let s11 = reduced(0, 0, x4) + damping;
    let [s21, s22] = [reduced(1, 0, x3y), reduced(1, 1, xxyy) + damping];
    let [s31, s32, s33] = [reduced(2, 0, xxyy), reduced(2, 1, xy3), reduced(2, 2, y4) + damping];
    // L^-1
    let positive = |square: f64| (square > 0.0).then(|| square.sqrt());
    let i11 = 1.0 / positive(s11)?;
    let (l21, l31) = (s21 * i11, s31 * i11);
    let i22 = 1.0 / positive(s22 - l21 * l21)?;
    let l32 = (s32 - l31 * l21) * i22;
    let i33 = 1.0 / positive(s33 - l31 * l31 - l32 * l32)?;
    let (i21, i32) = (-l21 * i11 * i22, -l32 * i22 * i33);
    let i31 = -(l31 * i11 + l32 * i21) * i33;
    // of the symmetric L^-1 C L^-T two places are zero, and the second one of its diagonal is negative
    let (m13, m22) = (2.0 * i11 * i33, -i22 * i22);
    let (m23, m33) = (2.0 * i21 * i33 - i22 * i32, 4.0 * i31 * i33 - i32 * i32);
    let value = positive_eigenvalue(m13, m22, m23, m33)?;
    let [y1, y2] = [m13 / value, m23 / (value - m22)];
    let z = [i11 * y1 + i21 * y2 + i31, i22 * y2 + i32, i33];
    if 4.0 * z[0] * z[2] - z[1] * z[1] <= 0.0 {
        return None;
    }
    from_conic(z, back.map(|row| row[0] * z[0] + row[1] * z[1] + row[2] * z[2]))
}

/// The one positive eigenvalue of the symmetric matrix (0, 0, m13; 0, m22, m23; m13, m23, m33) with a negative m22.
///
/// From above all roots of the characteristic polynomial, which are real, Newton's steps fall to the largest. It solves
/// λ - m33 = m13² / λ + m23² / (λ - m22): with λ below the second fraction as well, the root of a quadratic lies above it.
fn positive_eigenvalue(m13: f64, m22: f64, m23: f64, m33: f64) -> Option<f64> {
    let (square, trace) = (m13 * m13, m22 + m33);
    let minors = m22 * m33 - m23 * m23 - square;
    let det = -m22 * square;
    let mut value = 0.5 * (m33 + (m33 * m33 + 4.0 * (square + m23 * m23)).sqrt());
    if !value.is_finite() {
        return None;
    }
    for _ in 0..60 {
        let polynomial = ((value - trace) * value + minors) * value - det;
        let step = polynomial / ((3.0 * value - 2.0 * trace) * value + minors);
        value -= step;
        // what is left after a small step is its square; a step that rises is rounding
        if !(step > 1e-9 * value.abs()) {
            break;
        }
    }
    (value > 0.0).then_some(value)
}

/// Ellipse of a x² + b x y + c y² + d x + e y + f = 0 with (a, b, c) and (d, e, f).
fn from_conic([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> Option<Outline> {
    let det = 4.0 * a * c - b * b;
    let (u, v) = ((b * e - 2.0 * c * d) / det, (b * d - 2.0 * a * e) / det);
    // x' Q x = h about the centre, and A = sqrt(h) Q^(-1/2)
    let h = -(f + (d * u + e * v) / 2.0);
    let (q11, q12, q22) = (a / h, b / (2.0 * h), c / h);
    let q_det = q11 * q22 - q12 * q12;
    if !(q_det > 0.0 && q11 + q22 > 0.0) {
        return None;
    }
    // the inverse of Q is A A'
    Some(Outline::of_matrix(u, v, q22 / q_det, -q12 / q_det, q11 / q_det))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn rim(outline: &Outline, from: usize, to: usize, noise: f64) -> Vec<[f64; 3]> {
        (from..to)
            .map(|k| {
                let (s, c) = (k as f64 * 0.1).sin_cos();
                let rim = outline.rim(c, s);
                let wobble = noise * (k as f64 * 12.9898).sin();
                [rim.x + wobble * rim.normal[0], rim.y + wobble * rim.normal[1], 1.0]
            })
            .collect()
    }

    #[test]
    fn running_sums_give_the_ellipse_of_a_part() {
        let truth = Outline::from_axes(0.3, -0.2, 0.9, 0.6, 0.7);
        let rim = rim(&truth, 0, 63, 0.01);
        let mut running = vec![Sums::default()];
        for [x, y, w] in &rim {
            let mut next = running[running.len() - 1];
            next.add(*x, *y, *w);
            running.push(next);
        }
        for (from, to) in [(0, 63), (5, 40), (30, 62)] {
            let (plain, fast) = (fit(&rim[from..to]).unwrap(), running[to].since(&running[from]).ellipse().unwrap());
            assert!(plain.differs(&fast) < 1e-9, "{plain:?} {fast:?}");
        }
        assert!(running[9].since(&running[9]).ellipse().is_none());
    }

    #[test]
    fn exact_points_give_the_ellipse_back() {
        for truth in [
            Outline::from_axes(3000.3, 2000.8, 12.0, 5.0, 0.6),
            Outline::from_axes(0.0, 0.0, 200.0, 60.0, -1.4),
            Outline::from_axes(7.5, 9.5, 2.5, 2.5, 0.0),
        ] {
            let found = fit(&rim(&truth, 0, 63, 0.0)).unwrap();
            for (x, y) in
                [(found.u, truth.u), (found.v, truth.v), (found.p, truth.p), (found.q, truth.q), (found.r, truth.r)]
            {
                assert!((x - y).abs() < 1e-6 * truth.p.max(truth.q), "{found:?} {truth:?}");
            }
        }
    }

    #[test]
    fn half_an_arc_is_enough() {
        let truth = Outline::from_axes(100.0, 80.0, 20.0, 11.0, 0.3);
        let found = fit(&rim(&truth, 0, 32, 0.02)).unwrap();
        assert!((found.u - truth.u).hypot(found.v - truth.v) < 0.5, "{found:?}");
    }

    #[test]
    fn points_on_a_line_give_none_or_a_flat_ellipse() {
        let line: Vec<[f64; 3]> = (0..20).map(|k| [f64::from(k), 2.0 * f64::from(k), 1.0]).collect();
        assert!(fit(&line).is_none_or(|outline| outline.semi_axes().1 < 0.1));
        assert!(fit(&[[1.0, 1.0, 1.0]; 9]).is_none());
        assert!(fit(&[[f64::NAN, 1.0, 1.0]; 9]).is_none());
        assert!(fit(&rim(&Outline::from_axes(0.0, 0.0, 2.0, 1.0, 0.0), 0, 4, 0.0)).is_none());
    }
}
