//! Brown's model: a correction added to the measured coordinates ("image to ideal").
//!
//! With x̄ = x - x0, ȳ = y - y0, r² = x̄² + ȳ² and p = M·(X - XL):
//!
//! ```text
//! Δx = x̄(K1 r² + K2 r⁴ + K3 r⁶) + P1(r² + 2x̄²) + 2 P2 x̄ȳ + B1 x̄ + B2 ȳ
//! Δy = ȳ(K1 r² + K2 r⁴ + K3 r⁶) + P2(r² + 2ȳ²) + 2 P1 x̄ȳ
//! x̄ + Δx = -c px/pz,   ȳ + Δy = -c py/pz
//! ```
//!
//! D. C. Brown, Close-range camera calibration, Photogrammetric Engineering 37 (1971).

use super::{Linearised, PARAMETERS, invert, padded};
use crate::project::Interior;

/// Values of the parameters, photo units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)] // the names are the field's own
pub struct Brown {
    pub c: f64,
    pub x0: f64,
    pub y0: f64,
    pub k1: f64,
    pub k2: f64,
    pub k3: f64,
    pub p1: f64,
    pub p2: f64,
    pub b1: f64,
    pub b2: f64,
}

impl Brown {
    /// The model of an interior orientation; `None` for another model or while c is unknown.
    pub fn new(interior: &Interior) -> Option<Self> {
        match *interior {
            Interior::Brown { c: Some(c), x0, y0, k1, k2, k3, p1, p2, b1, b2 } => {
                Some(Self { c, x0, y0, k1, k2, k3, p1, p2, b1, b2 })
            }
            _ => None,
        }
    }

    /// Corrected coordinates (x̄ + Δx, ȳ + Δy) and their derivative by (x̄, ȳ).
    #[inline]
    pub fn corrected(&self, [x, y]: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
        let r2 = x * x + y * y;
        let radial = r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        let slope = 2.0 * (self.k1 + r2 * (2.0 * self.k2 + r2 * 3.0 * self.k3));
        let (p1, p2) = (self.p1, self.p2);
        let value = [
            x + x * radial + p1 * (r2 + 2.0 * x * x) + 2.0 * p2 * x * y + self.b1 * x + self.b2 * y,
            y + y * radial + p2 * (r2 + 2.0 * y * y) + 2.0 * p1 * x * y,
        ];
        let across = slope * x * y + 2.0 * (p1 * y + p2 * x);
        let derivative = [
            [1.0 + radial + slope * x * x + 6.0 * p1 * x + 2.0 * p2 * y + self.b1, across + self.b2],
            [across, 1.0 + radial + slope * y * y + 6.0 * p2 * y + 2.0 * p1 * x],
        ];
        (value, derivative)
    }

    /// Direction (x, y) of a measurement, the ray being (x, y, -1).
    pub fn ideal(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([x, y], _) = self.corrected([x - self.x0, y - self.y0]);
        [x / self.c, y / self.c]
    }

    /// Measured coordinates of a camera-frame point; none behind the camera or beyond the model's fold.
    pub fn project(&self, [px, py, pz]: [f64; 3]) -> Option<[f64; 2]> {
        if pz.is_nan() || pz >= 0.0 {
            return None;
        }
        let ideal = [-self.c * px / pz, -self.c * py / pz];
        let ([x, y], _) = invert(ideal, ideal, self.c.abs(), |x| self.corrected(x))?;
        Some([x + self.x0, y + self.y0])
    }

    /// Residual at the corrected place, e = ideal image minus corrected measurement; none at the projection centre.
    #[inline(always)]
    pub fn linearise(&self, measured: [f64; 2], [px, py, pz]: [f64; 3]) -> Option<Linearised> {
        if pz.is_nan() || pz == 0.0 {
            return None;
        }
        let (x, y) = (measured[0] - self.x0, measured[1] - self.y0);
        let ([cx, cy], d) = self.corrected([x, y]);
        let inverse = 1.0 / pz;
        let (nx, ny) = (-px * inverse, -py * inverse);
        let a = -self.c * inverse;
        let by_parameter = self.by_parameter([x, y], [nx, ny], d);
        Some(Linearised {
            residual: [self.c * nx - cx, self.c * ny - cy],
            by_point: [[a, 0.0, a * nx], [0.0, a, a * ny]],
            by_parameter,
        })
    }

    /// Residual in the measurement: v with x̄ + v corrected to the ideal image. Rigorous, since the weights belong there.
    ///
    /// Where the correction has no inverse near the measurement, its linear part is inverted instead.
    pub fn linearise_measured(&self, measured: [f64; 2], p: [f64; 3]) -> Option<Linearised> {
        let [px, py, pz] = p;
        if pz.is_nan() || pz == 0.0 {
            return None;
        }
        let start = [measured[0] - self.x0, measured[1] - self.y0];
        let inverse = 1.0 / pz;
        let (nx, ny) = (-px * inverse, -py * inverse);
        let ideal = [self.c * nx, self.c * ny];
        let inverted = invert(ideal, start, self.c.abs(), |x| self.corrected(x));
        let (place, d) = inverted.unwrap_or_else(|| (start, self.corrected(start).1));
        let determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
        if determinant.is_nan() || determinant.abs() < 1e-9 {
            return None;
        }
        let f = [[d[1][1] / determinant, -d[0][1] / determinant], [-d[1][0] / determinant, d[0][0] / determinant]];
        let from_ideal = |e: [f64; 2]| [f[0][0] * e[0] + f[0][1] * e[1], f[1][0] * e[0] + f[1][1] * e[1]];
        let residual = if inverted.is_some() {
            [place[0] - start[0], place[1] - start[1]]
        } else {
            let [cx, cy] = self.corrected(start).0;
            from_ideal([ideal[0] - cx, ideal[1] - cy])
        };
        // x̄ + v = g⁻¹(ideal), x̄ = x - x0: by x0 the residual changes by 1, by the other parameters through g⁻¹.
        let at_corrected = self.by_parameter(place, [nx, ny], [[0.0; 2]; 2]);
        let mut by_parameter = [[0.0; PARAMETERS]; 2];
        for k in 0..PARAMETERS {
            let [ex, ey] = from_ideal([at_corrected[0][k], at_corrected[1][k]]);
            (by_parameter[0][k], by_parameter[1][k]) = (ex, ey);
        }
        (by_parameter[0][1], by_parameter[1][1]) = (1.0, 0.0);
        (by_parameter[0][2], by_parameter[1][2]) = (0.0, 1.0);
        let a = -self.c * inverse;
        let mut by_point = [[0.0; 3]; 2];
        for (k, column) in [[a, 0.0], [0.0, a], [a * nx, a * ny]].into_iter().enumerate() {
            let [ex, ey] = from_ideal(column);
            (by_point[0][k], by_point[1][k]) = (ex, ey);
        }
        Some(Linearised { residual, by_point, by_parameter })
    }

    /// Derivatives of ideal minus corrected by c, x0, y0, K1-3, P1, P2, B1, B2, at the place (x̄, ȳ) with derivative d.
    #[inline(always)]
    fn by_parameter(&self, [x, y]: [f64; 2], [nx, ny]: [f64; 2], d: [[f64; 2]; 2]) -> [[f64; PARAMETERS]; 2] {
        let r2 = x * x + y * y;
        let r4 = r2 * r2;
        let r6 = r4 * r2;
        let xy2 = -2.0 * x * y;
        [
            padded([nx, d[0][0], d[0][1], -x * r2, -x * r4, -x * r6, -(r2 + 2.0 * x * x), xy2, -x, -y]),
            padded([ny, d[1][0], d[1][1], -y * r2, -y * r4, -y * r6, xy2, -(r2 + 2.0 * y * y), 0.0, 0.0]),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::tests::automatic;
    use num_dual::Dual64;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const LENS: [f64; 10] = [20.4558, 0.1, -0.05, 2.829e-4, -5.133e-7, 6.211e-10, 1e-5, -2e-5, 3e-4, -1e-4];

    fn brown() -> Brown {
        let [c, x0, y0, k1, k2, k3, p1, p2, b1, b2] = LENS;
        Brown { c, x0, y0, k1, k2, k3, p1, p2, b1, b2 }
    }

    /// The equations as they stand: parameters, camera-frame point, measured place.
    fn misclosure(q: &[Dual64]) -> [Dual64; 2] {
        let [x, y] = [q[13] - q[1], q[14] - q[2]];
        let r2 = x * x + y * y;
        let radial = r2 * q[3] + r2 * r2 * q[4] + r2 * r2 * r2 * q[5];
        let dx = x * radial + q[6] * (r2 + x * x * 2.0) + q[7] * x * y * 2.0 + q[8] * x + q[9] * y;
        let dy = y * radial + q[7] * (r2 + y * y * 2.0) + q[6] * x * y * 2.0;
        [-q[0] * q[10] / q[12] - x - dx, -q[0] * q[11] / q[12] - y - dy]
    }

    fn arguments(p: [f64; 3], place: [f64; 2]) -> [f64; 15] {
        let mut at = [0.0; 15];
        at[..10].copy_from_slice(&LENS);
        at[10..13].copy_from_slice(&p);
        at[13..].copy_from_slice(&place);
        at
    }

    #[test]
    fn the_correction_of_the_dcs420_is_about_140_micrometres() {
        let lens = Brown { c: 20.4558, k1: 2.829e-4, k2: -5.133e-7, k3: 6.211e-10, ..Brown::default() };
        let ([x, _], _) = lens.corrected([8.3, 0.0]);
        // By hand: 0.16176 - 0.02022 + 0.00169 mm, outwards.
        assert!((x - 8.3 - 0.1432).abs() < 1e-4, "{}", x - 8.3);
    }

    #[test]
    fn derivatives_agree_with_automatic_differentiation() {
        let measured = [6.2, -4.7];
        for p in [[1.2, -0.8, -3.7], [-900.0, 1500.0, -2800.0], [0.0, 0.0, -1.0]] {
            let (value, derivative) = automatic(&arguments(p, measured), misclosure);
            let ours = brown().linearise(measured, p).expect("in front");
            for row in 0..2 {
                assert!((ours.residual[row] - value[row]).abs() < 1e-12 * (1.0 + value[row].abs()));
                for k in 0..13 {
                    let mine = if k < 10 { ours.by_parameter[row][k] } else { ours.by_point[row][k - 10] };
                    let theirs = derivative[k][row];
                    assert!((mine - theirs).abs() <= 1e-12 * theirs.abs().max(1e-12), "{row} {k}: {mine} {theirs}");
                }
            }
        }
    }

    #[test]
    fn rigorous_derivatives_follow_from_the_implicit_equation() {
        // e(q, p, place) = 0 defines the place; its derivative is -(∂e/∂place)⁻¹ ∂e/∂(q, p).
        let measured = [6.2, -4.7];
        let p = [1.1, -0.8, -3.7];
        let ours = brown().linearise_measured(measured, p).expect("in front");
        let place = [measured[0] + ours.residual[0], measured[1] + ours.residual[1]];
        let (value, derivative) = automatic(&arguments(p, place), misclosure);
        assert!(value[0].hypot(value[1]) < 1e-12, "the place closes: {value:?}");
        let ([a, c], [b, d]) = (derivative[13], derivative[14]);
        let determinant = a * d - b * c;
        for k in 0..13 {
            let [ex, ey] = derivative[k];
            let expected = [-(d * ex - b * ey) / determinant, -(a * ey - c * ex) / determinant];
            for row in 0..2 {
                let mine = if k < 10 { ours.by_parameter[row][k] } else { ours.by_point[row][k - 10] };
                let theirs = expected[row];
                assert!((mine - theirs).abs() <= 1e-10 * theirs.abs().max(1e-6), "{row} {k}: {mine} {theirs}");
            }
        }
    }

    #[test]
    fn projection_closes_the_equation() {
        let p = [1.2, -0.8, -3.7];
        let measured = brown().project(p).expect("in front");
        let e = brown().linearise(measured, p).expect("in front").residual;
        assert!(e[0].hypot(e[1]) < 1e-13, "{e:?}");
    }
}
