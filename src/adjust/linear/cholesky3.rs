//! The 3 × 3 normal matrix of one point: Cholesky factor and triangular solutions.

/// Data of an eliminated point for back-substitution.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointFactor {
    /// l11, l21, l31, l22, l32, l33 with reciprocal diagonal.
    pub l: [f64; 6],
    /// L⁻¹Aᵀe.
    pub h: [f64; 3],
    /// λ times the undamped diagonal of N.
    pub damping: [f64; 3],
}

/// A pivot that is at most this part of its diagonal is lost to rounding, as in the reduced equations.
const LOST: f64 = 1e-12;

/// Cholesky factor of a symmetric 3 × 3 matrix (xx, xy, xz, yy, yz, zz), reciprocal diagonal, and whether a pivot is lost to
/// rounding; one without any digit is replaced by its diagonal.
pub fn factor3(n: [f64; 6]) -> ([f64; 6], bool) {
    let mut lost = false;
    let mut pivot = |value: f64, diagonal: f64| {
        lost |= value.is_nan() || value <= LOST * diagonal;
        if value > 1e-14 * diagonal { value } else { diagonal.max(1e-300) }
    };
    let d1 = 1.0 / pivot(n[0], n[0]).sqrt();
    let (l21, l31) = (n[1] * d1, n[2] * d1);
    let d2 = 1.0 / pivot(n[3] - l21 * l21, n[3]).sqrt();
    let l32 = (n[4] - l31 * l21) * d2;
    let d3 = 1.0 / pivot(n[5] - l31 * l31 - l32 * l32, n[5]).sqrt();
    ([d1, l21, l31, d2, l32, d3], lost)
}

/// L⁻¹x.
#[inline(always)]
pub fn forward3(l: &[f64; 6], x: [f64; 3]) -> [f64; 3] {
    let a = x[0] * l[0];
    let b = (x[1] - l[1] * a) * l[3];
    [a, b, (x[2] - l[2] * a - l[4] * b) * l[5]]
}

/// L⁻ᵀx.
#[inline(always)]
pub fn backward3(l: &[f64; 6], x: [f64; 3]) -> [f64; 3] {
    let c = x[2] * l[5];
    let b = (x[1] - l[4] * c) * l[3];
    [(x[0] - l[1] * b - l[2] * c) * l[0], b, c]
}
