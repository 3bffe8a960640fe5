//! Covariance of the points of an epoch, by blocks of three rows, and its S-transformation.
//!
//! With the directions G of a similarity at the points (identity, rotation, and scale where it is not kept) and the unweighted
//! constraints of the datum points, M = (GᵀWG)⁻¹GᵀW with W the weights of the datum points (0 elsewhere), the transformed covariance is
//! C' = S C Sᵀ, S = I - G M (W. Baarda, S-transformations and criterion matrices, 1973):
//!
//! ```text
//! C'_ij = C_ij - G_i V_j - V_iᵀ G_jᵀ + G_i (V Mᵀ) G_jᵀ        V = M C
//! ```

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

/// Directions of a similarity.
pub const DIRECTIONS: usize = 7;
/// Of a point's displacement the datum takes up a part, more where it carries more of it. Where less than this is left the others lie on
/// a line, and its turn is held by the point alone: without the limit a rounding error would be inverted.
const LEAST_LEFT: f64 = 1e-9;
type Directions = SMatrix<f64, 3, DIRECTIONS>;
type DatumRows = SMatrix<f64, DIRECTIONS, 3>;
type Square = SMatrix<f64, DIRECTIONS, DIRECTIONS>;

/// Covariance of points.
#[derive(Clone, Debug, PartialEq)]
pub enum PointsCovariance {
    /// Points are not correlated: a block each.
    Blocks(Vec<Matrix3<f64>>),
    /// Three rows a point.
    Full(DMatrix<f64>),
}

impl PointsCovariance {
    /// Block of two points.
    pub fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        match self {
            Self::Blocks(blocks) if i == j => blocks[i],
            Self::Blocks(_) => Matrix3::zeros(),
            Self::Full(matrix) => matrix.fixed_view::<3, 3>(3 * i, 3 * j).into_owned(),
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        match self {
            Self::Blocks(blocks) => blocks.len(),
            Self::Full(matrix) => matrix.nrows() / 3,
        }
    }

    /// That of coordinates multiplied by a matrix: A C Aᵀ.
    pub fn turned(&self, a: &Matrix3<f64>) -> Self {
        match self {
            Self::Blocks(blocks) => Self::Blocks(blocks.iter().map(|block| a * block * a.transpose()).collect()),
            Self::Full(matrix) => {
                let mut turned = matrix.clone();
                for i in 0..self.len() {
                    for j in 0..self.len() {
                        let block = a * self.block(i, j) * a.transpose();
                        turned.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&block);
                    }
                }
                Self::Full(turned)
            }
        }
    }

    /// That of some of the points, in their order.
    pub fn chosen(&self, places: &[usize]) -> Self {
        match self {
            Self::Blocks(blocks) => Self::Blocks(places.iter().map(|&k| blocks[k]).collect()),
            Self::Full(matrix) => {
                let n = 3 * places.len();
                Self::Full(DMatrix::from_fn(n, n, |i, j| {
                    matrix[(3 * places[i / 3] + i % 3, 3 * places[j / 3] + j % 3)]
                }))
            }
        }
    }

    /// `a` times one and `b` times the other, of as many points.
    pub fn sum(a: f64, one: &Self, b: f64, other: &Self) -> Self {
        match (one, other) {
            (Self::Blocks(one), Self::Blocks(other)) => {
                Self::Blocks(one.iter().zip(other).map(|(p, q)| p * a + q * b).collect())
            }
            (Self::Full(one), Self::Full(other)) => Self::Full(one * a + other * b),
            (Self::Full(full), blocks) => Self::Full(added(full * a, b, blocks)),
            (blocks, Self::Full(full)) => Self::Full(added(full * b, a, blocks)),
        }
    }
}

fn added(mut full: DMatrix<f64>, factor: f64, blocks: &PointsCovariance) -> DMatrix<f64> {
    for k in 0..blocks.len() {
        let mut view = full.fixed_view_mut::<3, 3>(3 * k, 3 * k);
        view += blocks.block(k, k) * factor;
    }
    full
}

/// A datum: the points that carry it, and what it leaves free.
#[derive(Clone, Debug)]
pub struct ReferenceDatum {
    /// Directions at all points.
    g: Vec<Directions>,
    /// Rows of M at the datum points.
    m: Vec<(usize, DatumRows)>,
    /// Number of directions: 0, 6 or 7.
    pub defect: usize,
}

impl ReferenceDatum {
    /// Datum of the `carriers` with weights, at `points`; `defect` of 7 leaves the scale free, 6 keeps it, 0 transforms nothing. None
    /// where the carriers lie on a line.
    pub fn new(points: &[Vector3<f64>], carriers: &[(usize, f64)], defect: usize) -> Option<Self> {
        if defect == 0 {
            return Some(Self { g: vec![Directions::zeros(); points.len()], m: Vec::new(), defect });
        }
        let total: f64 = carriers.iter().map(|(_, w)| w).sum();
        let centre = carriers.iter().map(|&(k, w)| points[k] * w).sum::<Vector3<f64>>() / total;
        let squares = carriers.iter().map(|&(k, w)| w * (points[k] - centre).norm_squared()).sum::<f64>();
        let extent = (squares / total).sqrt();
        if !(extent > 0.0) || !extent.is_finite() {
            return None;
        }
        let g: Vec<Directions> = points.iter().map(|p| directions(&((p - centre) / extent), defect)).collect();
        let mut normal = carriers.iter().fold(Square::zeros(), |n, &(k, w)| n + g[k].transpose() * g[k] * w);
        for k in defect..DIRECTIONS {
            normal[(k, k)] = 1.0;
        }
        // Weights may be of any size; what decides is how well the rotations can be separated. On a line one of them has no lever.
        let eigen = (normal / total).fixed_view::<6, 6>(0, 0).into_owned().symmetric_eigenvalues();
        if !(eigen.min() > 1e-10 * eigen.max()) {
            return None;
        }
        let inverse = normal.try_inverse()?;
        let m = carriers.iter().map(|&(k, w)| (k, inverse * g[k].transpose() * w)).collect();
        Some(Self { g, m, defect })
    }

    /// Differences in this datum: S d.
    pub fn difference(&self, d: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let parameters = self.m.iter().map(|(k, m)| m * d[*k]).sum::<SMatrix<f64, DIRECTIONS, 1>>();
        d.iter().zip(&self.g).map(|(d, g)| d - g * parameters).collect()
    }

    /// K of carrier `place`: its difference in the datum of the other carriers is K times that in this datum, K = (I - G M)⁻¹ with its own
    /// G and M. `None` if the others do not carry a datum.
    pub fn of_others(&self, place: usize) -> Option<Matrix3<f64>> {
        let (_, m) = self.m.iter().find(|(k, _)| *k == place)?;
        let left = Matrix3::identity() - self.g[place] * m;
        if left.symmetric_eigenvalues().min() > LEAST_LEFT { left.try_inverse() } else { None }
    }

    /// Orthonormal columns that span the directions at the carriers, three rows a carrier in their order.
    pub fn null_space(&self) -> DMatrix<f64> {
        let rows = 3 * self.m.len();
        let g = DMatrix::from_fn(rows, self.defect, |i, j| self.g[self.m[i / 3].0][(i % 3, j)]);
        g.qr().q()
    }
}

/// Shift, turn and stretch at a place.
fn directions(x: &Vector3<f64>, defect: usize) -> Directions {
    let mut g = Directions::zeros();
    g.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
    // d(ω × x)/dω
    g.fixed_view_mut::<3, 3>(0, 3).copy_from(&-x.cross_matrix());
    if defect == DIRECTIONS {
        g.set_column(6, x);
    }
    g
}

/// Covariance in a datum.
pub struct Transformed<'a> {
    covariance: &'a PointsCovariance,
    datum: &'a ReferenceDatum,
    v: Vec<DatumRows>,
    square: Square,
}

impl<'a> Transformed<'a> {
    /// Prepares the blocks.
    pub fn new(covariance: &'a PointsCovariance, datum: &'a ReferenceDatum) -> Self {
        let n = covariance.len();
        let mut v = vec![DatumRows::zeros(); n];
        match covariance {
            PointsCovariance::Blocks(blocks) => datum.m.iter().for_each(|(k, m)| v[*k] += m * blocks[*k]),
            PointsCovariance::Full(_) => {
                for (j, v) in v.iter_mut().enumerate() {
                    *v = datum.m.iter().map(|(k, m)| m * covariance.block(*k, j)).sum();
                }
            }
        }
        let square = datum.m.iter().map(|(k, m)| v[*k] * m.transpose()).sum();
        Self { covariance, datum, v, square }
    }

    /// Block of two points.
    pub fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        let (gi, gj) = (&self.datum.g[i], &self.datum.g[j]);
        let block = self.covariance.block(i, j) - gi * self.v[j] - self.v[i].transpose() * gj.transpose();
        block + gi * self.square * gj.transpose()
    }

    /// Matrix of some points, three rows each.
    pub fn matrix(&self, places: &[usize]) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(3 * places.len(), 3 * places.len());
        for (a, &i) in places.iter().enumerate() {
            for (b, &j) in places.iter().enumerate().skip(a) {
                let block = self.block(i, j);
                matrix.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&block);
                matrix.fixed_view_mut::<3, 3>(3 * b, 3 * a).copy_from(&block.transpose());
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn random(seed: u64, n: usize) -> (Vec<Vector3<f64>>, DMatrix<f64>) {
        let mut g = generator(seed);
        let points = (0..n).map(|_| Vector3::from_fn(|_, _| 100.0 * uniform(&mut g))).collect();
        let a = DMatrix::from_fn(3 * n, 3 * n, |_, _| uniform(&mut g) - 0.5);
        (points, &a * a.transpose())
    }

    /// Against S as a dense matrix.
    #[test]
    fn blocks_are_those_of_the_dense_product() {
        for (seed, defect) in [(1, 6), (2, 7), (3, 0)] {
            let (points, c) = random(seed, 7);
            let carriers = [(0, 1.0), (2, 0.5), (3, 2.0), (6, 1.0)];
            let datum = ReferenceDatum::new(&points, &carriers, defect).unwrap();
            let g = DMatrix::from_fn(21, defect, |i, j| datum.g[i / 3][(i % 3, j)]);
            let mut w = DMatrix::zeros(21, 21);
            carriers.iter().for_each(|&(k, weight)| (0..3).for_each(|a| w[(3 * k + a, 3 * k + a)] = weight));
            let s = match defect {
                0 => DMatrix::identity(21, 21),
                _ => {
                    let m = (g.transpose() * &w * &g).try_inverse().unwrap() * g.transpose() * &w;
                    DMatrix::identity(21, 21) - &g * m
                }
            };
            let expected = &s * &c * s.transpose();
            let covariance = PointsCovariance::Full(c.clone());
            let all: Vec<usize> = (0..7).collect();
            let found = Transformed::new(&covariance, &datum).matrix(&all);
            assert!((&found - &expected).norm() < 1e-10 * expected.norm(), "{defect}");
            let d: Vec<_> = (0..7).map(|k| Vector3::new(k as f64, 1.0, -0.3 * k as f64)).collect();
            let flat = nalgebra::DVector::from_iterator(21, d.iter().flat_map(|d| d.iter().copied()));
            let moved = datum.difference(&d);
            let expected = s * flat;
            assert!((0..21).all(|i| (moved[i / 3][i % 3] - expected[i]).abs() < 1e-10));
            // Blocks and full matrices are one thing.
            let own: Vec<_> = (0..7).map(|k| covariance.block(k, k)).collect();
            let sparse = PointsCovariance::Blocks(own);
            let full = PointsCovariance::sum(1.0, &sparse, 1.0, &PointsCovariance::Full(DMatrix::zeros(21, 21)));
            let (a, b) = (Transformed::new(&sparse, &datum).matrix(&all), Transformed::new(&full, &datum).matrix(&all));
            assert!((a - b).norm() < 1e-10);
        }
    }

    #[test]
    fn points_on_a_line_carry_no_datum() {
        let points: Vec<_> = (0..5).map(|k| Vector3::new(k as f64, 2.0 * k as f64, 1.0)).collect();
        let carriers: Vec<_> = (0..5).map(|k| (k, 1.0)).collect();
        assert!(ReferenceDatum::new(&points, &carriers, 6).is_none());
        assert!(ReferenceDatum::new(&points, &carriers, 0).is_some());
    }
}
