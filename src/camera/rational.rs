//! OpenCV's rational model: ideal to image, on normalised coordinates, in our pixel frame (OpenCV's cx, cy are ours - 0.5).
//!
//! With a = px/(-pz), b = py/pz (right and down), r² = a² + b²:
//!
//! ```text
//! R  = (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶)
//! a' = a R + 2 p1 a b + p2 (r² + 2a²),   u = fx a' + cx
//! b' = b R + p1 (r² + 2b²) + 2 p2 a b,   v = fy b' + cy
//! ```
//!
//! Source: OpenCV, "Camera calibration and 3D reconstruction"; D. Claus and A. W. Fitzgibbon, A rational function lens distortion
//! model for general cameras, CVPR 2005.

use super::{Linearised, invert};
use crate::project::Interior;

/// Values of the parameters; focal lengths and principal point in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)] // the names are the model's own
pub struct Rational {
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    pub k1: f64,
    pub k2: f64,
    pub p1: f64,
    pub p2: f64,
    pub k3: f64,
    pub k4: f64,
    pub k5: f64,
    pub k6: f64,
}

/// Places along the radius at which the distortion is examined, so that no image is taken from beyond a fold or a pole.
const PLACES: u32 = 16;

/// Numerator, denominator and their derivatives by r².
#[derive(Clone, Copy)]
struct Ratio {
    above: f64,
    below: f64,
    above_slope: f64,
    below_slope: f64,
}

impl Rational {
    /// The model of an interior orientation; `None` for another model or while a focal length is unknown.
    pub fn new(interior: &Interior) -> Option<Self> {
        match *interior {
            Interior::OpencvRational { fx: Some(fx), fy: Some(fy), cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 } => {
                Some(Self { fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 })
            }
            _ => None,
        }
    }

    fn ratio(&self, r2: f64) -> Ratio {
        Ratio {
            above: 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3)),
            below: 1.0 + r2 * (self.k4 + r2 * (self.k5 + r2 * self.k6)),
            above_slope: self.k1 + r2 * (2.0 * self.k2 + r2 * 3.0 * self.k3),
            below_slope: self.k4 + r2 * (2.0 * self.k5 + r2 * 3.0 * self.k6),
        }
    }

    /// R at r², and its denominator.
    pub fn radial(&self, r2: f64) -> (f64, f64) {
        let Ratio { above, below, .. } = self.ratio(r2);
        (above / below, below)
    }

    /// Distorted normalised coordinates and their derivative by (a, b).
    #[inline]
    pub fn distorted(&self, [a, b]: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
        let r2 = a * a + b * b;
        let Ratio { above, below, above_slope, below_slope } = self.ratio(r2);
        let radial = above / below;
        let slope = 2.0 * (above_slope - radial * below_slope) / below;
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

    /// Whether the distorted radius grows all the way from the axis to r, r² = `r2`, without a pole.
    fn reaches(&self, r2: f64) -> bool {
        let grows = |k: u32| {
            let share = f64::from(k) / f64::from(PLACES);
            let r2 = r2 * share * share;
            let Ratio { above, below, above_slope, below_slope } = self.ratio(r2);
            // d(r R)/dr times the square of the denominator
            below > 0.0 && above * below + 2.0 * r2 * (above_slope * below - above * below_slope) > 0.0
        };
        (1..=PLACES).all(grows)
    }

    /// Direction (x, y) of a pixel, the ray being (x, y, -1); `None` beyond the model's fold.
    pub fn ideal(&self, [u, v]: [f64; 2]) -> Option<[f64; 2]> {
        let image = [(u - self.cx) / self.fx, (v - self.cy) / self.fy];
        let from = |start| {
            let ([a, b], _) = invert(image, start, 1.0, |x| self.distorted(x))?;
            self.reaches(a * a + b * b).then_some([a, -b])
        };
        from(image).or_else(|| from([0.0, 0.0]))
    }

    /// Pixel of a camera-frame point; none behind the camera or beyond the fold, where a second, false image would appear.
    pub fn project(&self, [px, py, pz]: [f64; 3]) -> Option<[f64; 2]> {
        if pz.is_nan() || pz >= 0.0 {
            return None;
        }
        let (x, y) = (-px / pz, py / pz);
        let ([a, b], d) = self.distorted([x, y]);
        let determinant = d[0][0] * d[1][1] - d[0][1] * d[1][0];
        let upright = determinant > 0.0 && d[0][0] + d[1][1] > 0.0;
        (upright && self.reaches(x * x + y * y)).then_some([self.fx * a + self.cx, self.fy * b + self.cy])
    }

    /// Residual in pixels, projection minus measurement; none at the projection centre or at a pole.
    #[inline]
    pub fn linearise(&self, measured: [f64; 2], [px, py, pz]: [f64; 3]) -> Option<Linearised> {
        if pz.is_nan() || pz == 0.0 {
            return None;
        }
        let inverse = 1.0 / pz;
        let (a, b) = (-px * inverse, py * inverse);
        let ([ad, bd], d) = self.distorted([a, b]);
        if !(ad.is_finite() && bd.is_finite()) {
            return None;
        }
        let (fx, fy) = (self.fx, self.fy);
        let r2 = a * a + b * b;
        let Ratio { above, below, .. } = self.ratio(r2);
        let row = |f: f64, d: [f64; 2]| {
            let (by_a, by_b) = (f * d[0], f * d[1]);
            [-by_a * inverse, by_b * inverse, -(by_a * a + by_b * b) * inverse]
        };
        // By k1..k3 and k4..k6: r², r⁴, r⁶ over the denominator, and the same times -R.
        let up = r2 / below;
        let down = -up * above / below;
        let by = |f: f64, x: f64| {
            [f * x * up, f * x * up * r2, f * x * up * r2 * r2, f * x * down, f * x * down * r2, f * x * down * r2 * r2]
        };
        let (x, y) = (by(fx, a), by(fy, b));
        let (tangential, along_a, along_b) = (2.0 * a * b, r2 + 2.0 * a * a, r2 + 2.0 * b * b);
        Some(Linearised {
            residual: [fx * ad + self.cx - measured[0], fy * bd + self.cy - measured[1]],
            by_point: [row(fx, d[0]), row(fy, d[1])],
            // f, fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6; f moves fy in the ratio fy : fx.
            by_parameter: [
                [ad, ad, 0.0, 1.0, 0.0, x[0], x[1], fx * tangential, fx * along_a, x[2], x[3], x[4], x[5]],
                [bd * fy / fx, 0.0, bd, 0.0, 1.0, y[0], y[1], fy * along_b, fy * tangential, y[2], y[3], y[4], y[5]],
            ],
        })
    }
}
