//! The surface that points lie on: its normal at a point, from the nearest neighbours.
//!
//! A plane through n points that lie off it by the rms deviation s (n - 3 degrees of freedom), with rms extents a and b along
//! its axes, has a normal that is uncertain by
//!
//! ```text
//! σ² = s²/n · (1/a² + 1/b²)
//! ```
//!
//! Where a plane does not follow them a paraboloid does, z = a + bx + cy + dx² + exy + fy² over the plane with the point as origin: its
//! normal there is (-b, -c, 1), uncertain by the standard errors of b and c from what the points lie off it (n - 6 degrees
//! of freedom).

use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

/// Neighbours that span a plane, and a paraboloid.
const NEIGHBOURS: usize = 6;
const CURVED_NEIGHBOURS: usize = 14;
/// Coefficients of a paraboloid.
const PARABOLOID: usize = 6;

/// Points in the order of their first coordinate, for finding neighbours.
pub struct Surface<'a> {
    points: &'a [[f64; 3]],
    order: Vec<usize>,
    place: Vec<usize>,
}

/// Axes of a plane through points, the normal last, and the sums of squares along them.
struct PrincipalPlane {
    axes: Matrix3<f64>,
    squares: [f64; 3],
}

impl<'a> Surface<'a> {
    /// Of all these points.
    pub fn new(points: &'a [[f64; 3]]) -> Self {
        Self::of(points, |_| true)
    }

    /// Of those of the points that lie on it, which alone may be asked for.
    pub fn of(points: &'a [[f64; 3]], on: impl Fn(usize) -> bool) -> Self {
        let mut order: Vec<usize> = (0..points.len()).filter(|k| on(*k)).collect();
        order.sort_by(|a, b| points[*a][0].total_cmp(&points[*b][0]));
        let mut place = vec![usize::MAX; points.len()];
        order.iter().enumerate().for_each(|(at, k)| place[*k] = at);
        Self { points, order, place }
    }

    /// The nearest points, nearest first.
    pub fn neighbours(&self, k: usize, count: usize) -> Vec<usize> {
        let x = self.points[k];
        let mut found: Vec<(f64, usize)> = Vec::with_capacity(count + 1);
        let mut visit = |other: usize| {
            let y = self.points[other];
            let along = (y[0] - x[0]).powi(2);
            if found.len() == count && along > found[count - 1].0 {
                return false;
            }
            let squared = along + (y[1] - x[1]).powi(2) + (y[2] - x[2]).powi(2);
            let at = found.partition_point(|(d, _)| *d < squared);
            found.insert(at, (squared, other));
            found.truncate(count);
            true
        };
        // Outwards on either side, until the first coordinate alone is farther than what was found.
        let (before, after) = self.order.split_at(self.place[k]);
        let _ = before.iter().rev().all(|other| visit(*other));
        let _ = after[1..].iter().all(|other| visit(*other));
        found.into_iter().map(|(_, other)| other).collect()
    }

    /// Neighbours that the plane through a point is spanned by.
    pub fn nearest(&self, k: usize) -> Vec<usize> {
        self.neighbours(k, NEIGHBOURS)
    }

    /// Normal of the surface at a point and its standard error in radians: of the plane or the paraboloid, whichever is more certain.
    pub fn normal(&self, k: usize) -> Option<(Vector3<f64>, f64)> {
        let certain = |found: &(Vector3<f64>, f64)| found.1;
        let found = [self.plane(k), self.paraboloid(k)].into_iter().flatten();
        found.min_by(|a, b| certain(a).total_cmp(&certain(b)))
    }

    fn through(&self, around: &[usize]) -> Option<PrincipalPlane> {
        let at = |k: usize| Vector3::from(self.points[k]);
        let mean = around.iter().map(|k| at(*k)).sum::<Vector3<f64>>() / around.len() as f64;
        let centred = DMatrix::from_fn(3, around.len(), |a, n| at(around[n])[a] - mean[a]);
        let eigen = SymmetricEigen::try_new(&centred * centred.transpose(), 1e-15, 200)?;
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let column = |n: usize| eigen.eigenvectors.column(order[n]).clone_owned();
        let axes = Matrix3::from_fn(|row, n| column(n)[row]);
        Some(PrincipalPlane { axes, squares: order.map(|a| eigen.eigenvalues[a].max(0.0)) })
    }

    /// Normal of the plane through a point and its neighbours, and its standard error in radians.
    pub fn plane(&self, k: usize) -> Option<(Vector3<f64>, f64)> {
        let mut around = self.nearest(k);
        around.push(k);
        if around.len() < 4 {
            return None;
        }
        let PrincipalPlane { axes, squares } = self.through(&around)?;
        // Sums of squares along the axes: n a², n b², (n - 3) s².
        let [most, middle, least] = squares;
        // Rounding alone leaves this of a plane.
        let least = least.max(1e-24 * most) / (around.len() - 3) as f64;
        let squared = least / middle + least / most;
        Some((axes.column(2).into_owned(), squared.sqrt())).filter(|(_, sigma)| sigma.is_finite())
    }

    /// Normal of the paraboloid through a point and its neighbours, and its standard error in radians.
    pub fn paraboloid(&self, k: usize) -> Option<(Vector3<f64>, f64)> {
        let mut around = self.neighbours(k, CURVED_NEIGHBOURS);
        around.push(k);
        let n = around.len();
        if n < PARABOLOID + 3 {
            return None;
        }
        let PrincipalPlane { axes, squares } = self.through(&around)?;
        let size = (squares[0] / n as f64).sqrt();
        if !(squares[1] > 1e-6 * squares[0] && size > 0.0) {
            return None;
        }
        let origin = Vector3::from(self.points[k]);
        let local = |other: usize| axes.transpose() * (Vector3::from(self.points[other]) - origin) / size;
        let mut a = DMatrix::zeros(n, PARABOLOID);
        let mut z = DVector::zeros(n);
        for (row, other) in around.iter().enumerate() {
            let p = local(*other);
            let terms = [1.0, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y];
            terms.into_iter().enumerate().for_each(|(column, term)| a[(row, column)] = term);
            z[row] = p.z;
        }
        let normal_matrix = a.transpose() * &a;
        let q = normal_matrix.clone().cholesky()?.inverse();
        // Places on a conic fix no paraboloid.
        if q.diagonal().iter().any(|q| !q.is_finite() || *q > 1e6) {
            return None;
        }
        let x = &q * a.transpose() * &z;
        let off = &z - &a * &x;
        let s2 = (off.norm_squared() / (n - PARABOLOID) as f64).max(1e-24);
        let normal = (axes * Vector3::new(-x[1], -x[2], 1.0)).try_normalize(0.0)?;
        let sigma = (s2 * (q[(1, 1)] + q[(2, 2)])).sqrt();
        Some((normal, sigma)).filter(|(_, sigma)| sigma.is_finite())
    }
}
