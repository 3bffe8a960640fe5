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

    let (mut s1, mut s2, mut s3) = (Matrix3::zeros(), Matrix3::zeros(), Matrix3::zeros());
    for [x, y, w] in points {
        let (x, y) = ((x - mx) / scale, (y - my) / scale);
        let quadratic = Vector3::new(x * x, x * y, y * y);
        let linear = Vector3::new(x, y, 1.0);
        s1 += *w * quadratic * quadratic.transpose();
        s2 += *w * quadratic * linear.transpose();
        s3 += *w * linear * linear.transpose();
    }
    // linear part as a function of the quadratic one: -S3^-1 S2' z
    let back = -(s3.try_inverse()? * s2.transpose());
    let mut reduced = s1 + s2 * back;
    reduced = (reduced + reduced.transpose()) / 2.0;
    for i in 0..3 {
        reduced[(i, i)] += 1e-13 * s1.trace();
    }
    let lower = reduced.cholesky()?.l();
    let inverse = lower.try_inverse()?;
    let constraint = Matrix3::new(0.0, 0.0, 2.0, 0.0, -1.0, 0.0, 2.0, 0.0, 0.0);
    let z = inverse.transpose() * leading_eigenvector(inverse * constraint * inverse.transpose())?;
    if 4.0 * z.x * z.z - z.y * z.y <= 0.0 {
        return None;
    }
    let outline = from_conic(z, back * z)?;
    let outline = Outline { u: outline.u * scale + mx, v: outline.v * scale + my, ..outline.scaled(scale) };
    outline.is_proper().then_some(outline)
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
    // square root of the inverse M of a 2 x 2 matrix: (M + sqrt(det M) I) / sqrt(trace M + 2 sqrt(det M))
    let (m11, m12, m22) = (q22 / q_det, -q12 / q_det, q11 / q_det);
    let root = (1.0 / q_det).sqrt();
    let norm = (m11 + m22 + 2.0 * root).sqrt();
    Some(Outline { u, v, p: (m11 + root) / norm, q: (m22 + root) / norm, r: m12 / norm })
}

/// Eigenvector of the largest eigenvalue of a symmetric matrix, by a fixed number of Jacobi sweeps.
fn leading_eigenvector(mut m: Matrix3<f64>) -> Option<Vector3<f64>> {
    if m.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let mut vectors = Matrix3::identity();
    for _ in 0..8 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if m[(i, j)] == 0.0 {
                continue;
            }
            let theta = (m[(j, j)] - m[(i, i)]) / (2.0 * m[(i, j)]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let mut turn = Matrix3::identity();
            turn[(i, i)] = c;
            turn[(j, j)] = c;
            turn[(i, j)] = t * c;
            turn[(j, i)] = -t * c;
            m = turn.transpose() * m * turn;
            vectors *= turn;
        }
    }
    let largest = (0..3).max_by(|&i, &j| m[(i, i)].total_cmp(&m[(j, j)]))?;
    (m[(largest, largest)] > 0.0).then(|| vectors.column(largest).into())
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
        assert!(fit(&line).is_none_or(|outline| outline.axes().1 < 0.1));
        assert!(fit(&[[1.0, 1.0, 1.0]; 9]).is_none());
        assert!(fit(&[[f64::NAN, 1.0, 1.0]; 9]).is_none());
        assert!(fit(&rim(&Outline::from_axes(0.0, 0.0, 2.0, 1.0, 0.0), 0, 4, 0.0)).is_none());
    }
}
