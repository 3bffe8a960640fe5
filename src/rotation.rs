//! Attitude of a photo: M = Mκ·Mφ·Mω, which takes object differences into the camera frame.
//!
//! ```text
//! m11 =  cosφ cosκ   m12 =  sinω sinφ cosκ + cosω sinκ   m13 = -cosω sinφ cosκ + sinω sinκ
//! m21 = -cosφ sinκ   m22 = -sinω sinφ sinκ + cosω cosκ   m23 =  cosω sinφ sinκ + sinω cosκ
//! m31 =  sinφ        m32 = -sinω cosφ                    m33 =  cosω cosφ
//! ```
//!
//! The angles are for input and output. Inside, a rotation is its matrix, changed by small turns about the camera's
//! axes, so that no attitude is singular.

use nalgebra::{Matrix3, Vector3};

/// Object to camera, from omega, phi and kappa in radians.
pub fn object_to_camera([omega, phi, kappa]: [f64; 3]) -> Matrix3<f64> {
    let (so, co) = omega.sin_cos();
    let (sp, cp) = phi.sin_cos();
    let (sk, ck) = kappa.sin_cos();
    Matrix3::new(
        cp * ck,
        so * sp * ck + co * sk,
        -co * sp * ck + so * sk,
        -cp * sk,
        -so * sp * sk + co * ck,
        co * sp * sk + so * ck,
        sp,
        -so * cp,
        co * cp,
    )
}

/// Omega, phi and kappa in radians of an object-to-camera matrix; phi lies within ±90°.
///
/// Where |phi| is 90° only the sum or the difference of omega and kappa is defined; omega is 0 then.
pub fn angles(m: &Matrix3<f64>) -> [f64; 3] {
    let cos_phi = m[(2, 1)].hypot(m[(2, 2)]);
    let phi = m[(2, 0)].atan2(cos_phi);
    if cos_phi < 1e-12 {
        // M = Mκ Mφ with ω = 0: m12 = sinκ, m22 = cosκ.
        return [0.0, phi, m[(0, 1)].atan2(m[(1, 1)])];
    }
    [(-m[(2, 1)]).atan2(m[(2, 2)]), phi, (-m[(1, 0)]).atan2(m[(0, 0)])]
}

/// The matrix turned by a small rotation vector `turn` (radians, about the camera's axes): exp([turn]×)·M.
pub fn turned(m: &Matrix3<f64>, turn: Vector3<f64>) -> Matrix3<f64> {
    nalgebra::Rotation3::new(turn).matrix() * m
}

/// Nearest rotation matrix in the sense of least squares (polar decomposition by SVD), of determinant +1.
pub fn nearest(m: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = m.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Matrix3::identity() };
    let mut d = Matrix3::identity();
    d[(2, 2)] = (u * v_t).determinant().signum();
    u * d * v_t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_survive_the_matrix() {
        for angles_in in [[0.1, -0.4, 2.9], [-3.0, 1.2, -0.7], [1.5709, -0.184, -0.0145]] {
            let back = angles(&object_to_camera(angles_in));
            for k in 0..3 {
                assert!((back[k] - angles_in[k]).abs() < 1e-14, "{angles_in:?} became {back:?}");
            }
        }
    }

    #[test]
    fn the_singular_attitude_keeps_its_matrix() {
        for phi in [std::f64::consts::FRAC_PI_2, -std::f64::consts::FRAC_PI_2] {
            let m = object_to_camera([0.3, phi, 0.5]);
            assert!((object_to_camera(angles(&m)) - m).norm() < 1e-12);
        }
    }

    #[test]
    fn nearest_restores_a_disturbed_rotation() {
        let m = object_to_camera([0.3, 0.2, -1.0]);
        let disturbed = m * 1.7 + Matrix3::repeat(1e-9);
        assert!((nearest(&disturbed) - m).norm() < 1e-8);
        assert!((nearest(&disturbed).determinant() - 1.0).abs() < 1e-12);
    }
}
