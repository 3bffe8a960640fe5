//! Essential matrices of five pairs of rays.
//!
//! Nistér (2004), IEEE Transactions on Pattern Analysis and Machine Intelligence 26, 756-770: E lies in the null space
//! of the five coplanarity conditions, E = xE₁ + yE₂ + zE₃ + E₄; det E = 0 and 2EEᵀE - tr(EEᵀ)E = 0 are ten cubics in
//! x, y, z, reduced by elimination to one polynomial of degree ten in z. Planes are no exception to it.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::polynomial::real_roots;

/// Exponents of x, y, z per monomial; the first ten are eliminated.
const MONOMIALS: [[usize; 3]; 20] = [
    [3, 0, 0],
    [0, 3, 0],
    [2, 1, 0],
    [1, 2, 0],
    [2, 0, 1],
    [2, 0, 0],
    [0, 2, 1],
    [0, 2, 0],
    [1, 1, 1],
    [1, 1, 0],
    [1, 0, 2],
    [1, 0, 1],
    [1, 0, 0],
    [0, 1, 2],
    [0, 1, 1],
    [0, 1, 0],
    [0, 0, 3],
    [0, 0, 2],
    [0, 0, 1],
    [0, 0, 0],
];

/// Index of the monomial with given exponents, [x][y][z]; 20 where the degree exceeds three.
const PLACE: [[[usize; 4]; 4]; 4] = {
    let mut place = [[[20; 4]; 4]; 4];
    let mut k = 0;
    while k < 20 {
        let [x, y, z] = MONOMIALS[k];
        place[x][y][z] = k;
        k += 1;
    }
    place
};

/// Polynomial in x, y, z of degree up to three.
type Cubic = SVector<f64, 20>;

/// Places of x, y, z and 1: the monomials of degree one and less.
const LINEAR: [usize; 4] = [12, 15, 18, 19];
/// Places of the monomials of degree two and less.
const QUADRATIC: [usize; 10] = [5, 7, 9, 11, 12, 14, 15, 17, 18, 19];

/// `a` (of degree up to two) times `b` (of degree up to one).
fn product(a: &Cubic, b: &Cubic) -> Cubic {
    let mut result = Cubic::zeros();
    for i in QUADRATIC {
        if a[i] == 0.0 {
            continue;
        }
        for j in LINEAR {
            let [p, q] = [MONOMIALS[i], MONOMIALS[j]];
            result[PLACE[p[0] + q[0]][p[1] + q[1]][p[2] + q[2]]] += a[i] * b[j];
        }
    }
    result
}

/// The real essential matrices E, of unit norm, with rᵀE l = 0 for five pairs of rays l = (x, y, -1) in the first and
/// r in the second photo, given in ideal coordinates. Up to ten; none when the pairs leave more than E undetermined.
pub fn five_points(first: &[[f64; 2]; 5], second: &[[f64; 2]; 5]) -> Vec<Matrix3<f64>> {
    let Some(basis) = null_space(first, second) else { return Vec::new() };
    let Some(reduced) = eliminated(&constraints(&basis)) else { return Vec::new() };
    // Rows 4, 6, 8 minus z times rows 5, 7, 9 leave x·b₀(z) + y·b₁(z) + b₂(z) = 0, three times.
    let b: [[Vec<f64>; 3]; 3] = [4, 6, 8].map(|k| {
        let (upper, lower) = (reduced.row(k), reduced.row(k + 1));
        let part = |at: usize, size: usize| -> Vec<f64> {
            let mut p = vec![0.0; size + 1];
            for power in 0..size {
                p[power] += upper[at + size - 1 - power];
                p[power + 1] -= lower[at + size - 1 - power];
            }
            p
        };
        [part(0, 3), part(3, 3), part(6, 4)]
    });
    let at = |p: &[f64], z: f64| p.iter().rev().fold(0.0, |sum, c| sum * z + c);
    let mut found = Vec::new();
    for z in real_roots(&determinant(&b)) {
        let rows: [Vector3<f64>; 3] =
            [0, 1, 2].map(|k| Vector3::new(at(&b[k][0], z), at(&b[k][1], z), at(&b[k][2], z)));
        // The null vector (x, y, 1) is orthogonal to all rows: the largest of their cross products.
        let crosses = [rows[0].cross(&rows[1]), rows[1].cross(&rows[2]), rows[2].cross(&rows[0])];
        let Some(null) = crosses.into_iter().max_by(|a, b| a.norm().total_cmp(&b.norm())) else { continue };
        let (x, y) = (null.x / null.z, null.y / null.z);
        let e = basis.column(0) * x + basis.column(1) * y + basis.column(2) * z + basis.column(3);
        let e = e / e.norm();
        if e.iter().all(|value| value.is_finite()) {
            found.push(Matrix3::new(e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8]));
        }
    }
    found
}

/// Orthonormal basis of the matrices (row by row) that satisfy the five coplanarity conditions.
fn null_space(first: &[[f64; 2]; 5], second: &[[f64; 2]; 5]) -> Option<SMatrix<f64, 9, 4>> {
    let mut basis: Vec<SVector<f64, 9>> = Vec::with_capacity(9);
    let without = |v: &SVector<f64, 9>, basis: &[SVector<f64, 9>]| {
        let mut rest = *v;
        for _ in 0..2 {
            for b in basis {
                rest -= b * b.dot(&rest);
            }
        }
        rest
    };
    for (l, r) in first.iter().zip(second) {
        let (l, r) = ([l[0], l[1], -1.0], [r[0], r[1], -1.0]);
        let row = SVector::<f64, 9>::from_fn(|k, _| r[k / 3] * l[k % 3]);
        let rest = without(&row, &basis);
        if !(rest.norm() > 1e-9 * row.norm()) {
            return None;
        }
        basis.push(rest.normalize());
    }
    while basis.len() < 9 {
        let next = (0..9)
            .map(|k| without(&SVector::<f64, 9>::from_fn(|i, _| f64::from(u8::from(i == k))), &basis))
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        basis.push(next.normalize());
    }
    Some(SMatrix::from_columns(&basis[5..]))
}

/// The ten cubics, one a row.
fn constraints(basis: &SMatrix<f64, 9, 4>) -> SMatrix<f64, 10, 20> {
    let entry = |i: usize, j: usize| {
        let mut p = Cubic::zeros();
        for (k, place) in LINEAR.into_iter().enumerate() {
            p[place] = basis[(3 * i + j, k)];
        }
        p
    };
    let e: [[Cubic; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
    let mut rows = SMatrix::<f64, 10, 20>::zeros();
    let minor = |a: usize, b: usize| product(&e[0][a], &e[1][b]) - product(&e[0][b], &e[1][a]);
    let det = product(&minor(1, 2), &e[2][0]) + product(&minor(2, 0), &e[2][1]) + product(&minor(0, 1), &e[2][2]);
    rows.set_row(0, &det.transpose());
    let square = |i: usize, j: usize| (0..3).map(|k| product(&e[i][k], &e[j][k])).sum::<Cubic>();
    let mut l: [[Cubic; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| square(i, j)));
    let half_trace = (l[0][0] + l[1][1] + l[2][2]) * 0.5;
    for (i, row) in l.iter_mut().enumerate() {
        row[i] -= half_trace;
    }
    for i in 0..3 {
        for j in 0..3 {
            let sum: Cubic = (0..3).map(|k| product(&l[i][k], &e[k][j])).sum();
            rows.set_row(1 + 3 * i + j, &sum.transpose());
        }
    }
    rows
}

/// The right ten columns after the left ten were brought to the identity; `None` if they are singular.
fn eliminated(rows: &SMatrix<f64, 10, 20>) -> Option<SMatrix<f64, 10, 10>> {
    let left = rows.fixed_columns::<10>(0).into_owned();
    let right = rows.fixed_columns::<10>(10).into_owned();
    left.lu().solve(&right).filter(|s| s.iter().all(|value| value.is_finite()))
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            result[i + j] += x * y;
        }
    }
    result
}

/// Determinant of the 3 x 3 matrix of polynomials in z, constant first.
fn determinant(b: &[[Vec<f64>; 3]; 3]) -> Vec<f64> {
    let mut sum = vec![0.0; 11];
    for (i, j, k, sign) in
        [(0, 1, 2, 1.0), (1, 2, 0, 1.0), (2, 0, 1, 1.0), (0, 2, 1, -1.0), (2, 1, 0, -1.0), (1, 0, 2, -1.0)]
    {
        for (power, value) in times(&times(&b[0][i], &b[1][j]), &b[2][k]).into_iter().enumerate() {
            sum[power] += sign * value;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::Pose;
    use crate::initial::robust::{generator, uniform};
    use crate::rotation::object_to_camera;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// How many of 300 random pairs, spatial or plane, have the true essential matrix among the solutions.
    fn found(flat: f64, limit: f64) -> usize {
        let mut g = generator(11);
        let mut next = || 2.0 * uniform(&mut g) - 1.0;
        let mut hits = 0;
        for _ in 0..300 {
            let points = [0; 5].map(|_| Vector3::new(next(), next(), -5.0 + flat * next()));
            let m = object_to_camera([0.3 * next(), 0.3 * next(), 3.0 * next()]);
            let second = Pose { object_to_camera: m, centre: Vector3::new(1.0 + next(), next(), 0.5 * next()) };
            let (l, r) = (points.map(|p| Pose::identity().image(&p)), points.map(|p| second.image(&p)));
            let (l, r) = (l.map(|m| m.expect("in front")), r.map(|m| m.expect("in front")));
            let truth = m * second.centre.cross_matrix();
            let truth = truth / truth.norm();
            let solutions = five_points(&l, &r);
            assert!(solutions.len() <= 10);
            if solutions.iter().any(|e| (e - truth).norm().min((e + truth).norm()) < limit) {
                hits += 1;
            }
        }
        hits
    }

    #[test]
    fn the_true_matrix_is_among_the_solutions_of_spatial_points() {
        let hits = found(1.0, 1e-6);
        assert!(hits >= 298, "{hits}");
    }

    /// A plane brings the roots close together, which costs digits but no solutions; least squares follow anyway.
    #[test]
    fn plane_points_are_no_exception() {
        let hits = found(0.0, 2e-3);
        assert!(hits >= 280, "{hits}");
    }

    #[test]
    fn repeated_points_have_no_solution() {
        assert!(five_points(&[[0.1, 0.2]; 5], &[[0.3, 0.1]; 5]).is_empty());
    }
}
