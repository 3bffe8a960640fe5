//! OpenCV's model: ideal to image, on normalised coordinates, in our pixel frame (OpenCV's cx, cy are ours - 0.5).
//!
//! With a = px/(-pz), b = py/pz (right and down), r² = a² + b²:
//!
//! ```text
//! a' = a(1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 a b + p2 (r² + 2a²),   u = fx a' + cx
//! b' = b(1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2b²) + 2 p2 a b,   v = fy b' + cy
//! ```

use super::{Linearised, invert, padded};
use crate::project::Interior;

/// Values of the parameters; focal lengths and principal point in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)] // the names are the model's own
pub struct Opencv {
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    pub k1: f64,
    pub k2: f64,
    pub p1: f64,
    pub p2: f64,
    pub k3: f64,
}

impl Opencv {
    /// The model of an interior orientation; `None` for another model or while a focal length is unknown.
    pub fn new(interior: &Interior) -> Option<Self> {
        match *interior {
            Interior::Opencv { fx: Some(fx), fy: Some(fy), cx, cy, k1, k2, p1, p2, k3 } => {
                Some(Self { fx, fy, cx, cy, k1, k2, p1, p2, k3 })
            }
            _ => None,
        }
    }

    /// Distorted normalised coordinates and their derivative by (a, b).
    #[inline]
    pub fn distorted(&self, [a, b]: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
        let r2 = a * a + b * b;
        let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        let slope = 2.0 * (self.k1 + r2 * (2.0 * self.k2 + r2 * 3.0 * self.k3));
        let (p1, p2) = (self.p1, self.p2);
        let value = [
            a * radial + 2.0 * p1 * a * b + p2 * (r2 + 2.0 * a * a),
            b * radial + p1 * (r2 + 2.0 * b * b) + 2.0 * p2 * a * b,
        ];
        let across = slope * a * b + 2.0 * (p1 * a + p2 * b);
        let derivative = [
            [radial + slope * a * a + 2.0 * p1 * b + 6.0 * p2 * a, across],
            [across, radial + slope * b * b + 6.0 * p1 * b + 2.0 * p2 * a],
        ];
        (value, derivative)
    }

    /// Direction (x, y) of a pixel, the ray being (x, y, -1); `None` beyond the model's fold.
    pub fn ideal(&self, [u, v]: [f64; 2]) -> Option<[f64; 2]> {
        let image = [(u - self.cx) / self.fx, (v - self.cy) / self.fy];
        let ([a, b], _) = invert(image, image, 1.0, |x| self.distorted(x))
            .or_else(|| invert(image, [0.0, 0.0], 1.0, |x| self.distorted(x)))?;
        Some([a, -b])
    }

    /// Pixel of a camera-frame point; none behind the camera.
    pub fn project(&self, [px, py, pz]: [f64; 3]) -> Option<[f64; 2]> {
        if pz.is_nan() || pz >= 0.0 {
            return None;
        }
        let ([a, b], d) = self.distorted([-px / pz, py / pz]);
        // Beyond the fold of the distortion a second, false image would appear.
        let determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
        (determinant > 0.0 && d[0][0] + d[1][1] > 0.0).then_some([self.fx * a + self.cx, self.fy * b + self.cy])
    }

    /// Residual in pixels, projection minus measurement; none at the projection centre.
    #[inline]
    pub fn linearise(&self, measured: [f64; 2], [px, py, pz]: [f64; 3]) -> Option<Linearised> {
        if pz.is_nan() || pz == 0.0 {
            return None;
        }
        let inverse = 1.0 / pz;
        let (a, b) = (-px * inverse, py * inverse);
        let ([ad, bd], d) = self.distorted([a, b]);
        let (fx, fy) = (self.fx, self.fy);
        let r2 = a * a + b * b;
        let r4 = r2 * r2;
        let r6 = r4 * r2;
        let row = |f: f64, d: [f64; 2]| {
            let (by_a, by_b) = (f * d[0], f * d[1]);
            [-by_a * inverse, by_b * inverse, -(by_a * a + by_b * b) * inverse]
        };
        Some(Linearised {
            residual: [fx * ad + self.cx - measured[0], fy * bd + self.cy - measured[1]],
            by_point: [row(fx, d[0]), row(fy, d[1])],
            // f, fx, fy, cx, cy, k1, k2, p1, p2, k3; f moves fy in the ratio fy : fx.
            by_parameter: [
                padded([
                    ad,
                    ad,
                    0.0,
                    1.0,
                    0.0,
                    fx * a * r2,
                    fx * a * r4,
                    fx * 2.0 * a * b,
                    fx * (r2 + 2.0 * a * a),
                    fx * a * r6,
                ]),
                padded([
                    bd * fy / fx,
                    0.0,
                    bd,
                    0.0,
                    1.0,
                    fy * b * r2,
                    fy * b * r4,
                    fy * (r2 + 2.0 * b * b),
                    fy * 2.0 * a * b,
                    fy * b * r6,
                ]),
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::tests::automatic;
    use num_dual::{Dual64, DualNum};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const LENS: [f64; 9] = [900.0, 905.0, 645.0, 352.0, -0.25, 0.08, 1e-3, -5e-4, -0.01];
    const MEASURED: [f64; 2] = [900.0, 200.0];

    /// The equations as they stand; q = f (a change of both focal lengths), then the parameters, then the point.
    fn misclosure(q: &[Dual64]) -> [Dual64; 2] {
        let fx = q[1] + q[0];
        let fy = q[2] + q[0] * (LENS[1] / LENS[0]);
        let (a, b) = (-q[10] / q[12], q[11] / q[12]);
        let r2 = a * a + b * b;
        let radial = q[5] * r2 + q[6] * r2.powi(2) + q[9] * r2.powi(3) + 1.0;
        let ad = a * radial + q[7] * a * b * 2.0 + q[8] * (r2 + a * a * 2.0);
        let bd = b * radial + q[7] * (r2 + b * b * 2.0) + q[8] * a * b * 2.0;
        [fx * ad + q[3] - MEASURED[0], fy * bd + q[4] - MEASURED[1]]
    }

    #[test]
    fn derivatives_agree_with_automatic_differentiation() {
        let [fx, fy, cx, cy, k1, k2, p1, p2, k3] = LENS;
        let lens = Opencv { fx, fy, cx, cy, k1, k2, p1, p2, k3 };
        for p in [[1.2, 0.8, -3.7], [-900.0, 1500.0, -2800.0]] {
            let mut at = [0.0; 13];
            at[1..10].copy_from_slice(&LENS);
            at[10..].copy_from_slice(&p);
            let (value, derivative) = automatic(&at, misclosure);
            let ours = lens.linearise(MEASURED, p).expect("in front");
            for row in 0..2 {
                assert!((ours.residual[row] - value[row]).abs() < 1e-12 * (1.0 + value[row].abs()));
                for k in 0..13 {
                    let mine = if k < 10 { ours.by_parameter[row][k] } else { ours.by_point[row][k - 10] };
                    let theirs = derivative[k][row];
                    assert!((mine - theirs).abs() <= 1e-11 * theirs.abs().max(1e-9), "{row} {k}: {mine} {theirs}");
                }
            }
        }
    }
}
