//! Ellipse through points by direct least squares.
//!
//! Minimises the algebraic distance a x² + b x y + c y² + d x + e y + f under 4 a c - b² = 1, which only ellipses fulfil
//! (Fitzgibbon, Pilu & Fisher 1999), in the partitioned form of Halir & Flusser (1998): the linear part is eliminated, and
//! of the remaining 3 x 3 problem S z = λ C z, with C the constraint, the one positive λ belongs to the ellipse.
//! Solved here as C z = μ S z with S = L L': L⁻¹ C L⁻ᵀ is symmetric, has exactly one positive eigenvalue, and stays
//! well defined for points without error.

use nalgebra::{Matrix3, Vector3};

use super::outline::Outline;

/// Ellipse through five or more weighted points (x, y, weight); none when they determine no ellipse.
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

    /// The ellipse of the points; none when they determine none.
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
    let s1 = Matrix3::new(x4, x3y, xxyy, x3y, xxyy, xy3, xxyy, xy3, y4);
    let s2 = Matrix3::new(x3, xxy, xx, xxy, xyy, xy, xyy, y3, yy);
    let det = xx * yy - xy * xy;
    if det <= 0.0 {
        return None;
    }
    let inverse = Matrix3::new(yy / det, -xy / det, 0.0, -xy / det, xx / det, 0.0, 0.0, 0.0, 1.0 / weight);
    // linear part as a function of the quadratic one: -S3^-1 S2' z
    let back = -(inverse * s2.transpose());
    let mut reduced = s1 + s2 * back;
    reduced = (reduced + reduced.transpose()) / 2.0;
    for i in 0..3 {
        reduced[(i, i)] += 1e-13 * s1.trace();
    }
    let inverse = inverse_root(&reduced)?;
    let constraint = Matrix3::new(0.0, 0.0, 2.0, 0.0, -1.0, 0.0, 2.0, 0.0, 0.0);
    let z = inverse.transpose() * leading_eigenvector(inverse * constraint * inverse.transpose())?;
    if 4.0 * z.x * z.z - z.y * z.y <= 0.0 {
        return None;
    }
    from_conic(z, back * z)
}

/// L⁻¹ of S = L L', both lower triangular; none where S is not positive definite.
fn inverse_root(s: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let positive = |square: f64| (square > 0.0).then(|| square.sqrt());
    let l11 = positive(s[(0, 0)])?;
    let (l21, l31) = (s[(1, 0)] / l11, s[(2, 0)] / l11);
    let l22 = positive(s[(1, 1)] - l21 * l21)?;
    let l32 = (s[(2, 1)] - l31 * l21) / l22;
    let l33 = positive(s[(2, 2)] - l31 * l31 - l32 * l32)?;
    let (i11, i22, i33) = (1.0 / l11, 1.0 / l22, 1.0 / l33);
    let i21 = -l21 * i11 * i22;
    let i32 = -l32 * i22 * i33;
    let i31 = -(l31 * i11 + l32 * i21) * i33;
    Some(Matrix3::new(i11, 0.0, 0.0, i21, i22, 0.0, i31, i32, i33))
}

/// Ellipse of a x² + b x y + c y² + d x + e y + f = 0 with (a, b, c) and (d, e, f).
fn from_conic(quadratic: Vector3<f64>, linear: Vector3<f64>) -> Option<Outline> {
    let [a, b, c] = [quadratic.x, quadratic.y, quadratic.z];
    let [d, e, f] = [linear.x, linear.y, linear.z];
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

/// Eigenvector of the one positive eigenvalue of a symmetric matrix.
///
/// From above all roots of the characteristic polynomial, which are real, Newton's steps fall to the largest. Rows of
/// M - λ I are normal to the eigenvector: it is the longest of their cross products.
fn leading_eigenvector(m: Matrix3<f64>) -> Option<Vector3<f64>> {
    let trace = m.trace();
    let minors = m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(0, 1)] + m[(0, 0)] * m[(2, 2)] - m[(0, 2)] * m[(0, 2)]
        + m[(1, 1)] * m[(2, 2)]
        - m[(1, 2)] * m[(1, 2)];
    let det = m.determinant();
    let mut value = m.norm();
    if !value.is_finite() {
        return None;
    }
    for _ in 0..60 {
        let polynomial = ((value - trace) * value + minors) * value - det;
        let step = polynomial / ((3.0 * value - 2.0 * trace) * value + minors);
        value -= step;
        // a step that rises is rounding: the root is reached
        if !(step > 1e-15 * value.abs()) {
            break;
        }
    }
    let shifted = m - Matrix3::from_diagonal_element(value);
    let rows = [0, 1, 2].map(|i| shifted.row(i).transpose());
    let normals = [rows[0].cross(&rows[1]), rows[0].cross(&rows[2]), rows[1].cross(&rows[2])];
    let longest = normals.into_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    (value > 0.0 && longest.norm_squared() > 0.0).then(|| longest.normalize())
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
