//! OpenCV's fisheye: the angle from the axis is distorted, in our pixel frame (OpenCV's cx, cy are ours - 0.5).
//!
//! With x = px, y = -py, z = -pz (right, down, forwards), r² = x² + y² and the angle off the axis θ = atan2(r, z), 0 ≤ θ < π:
//!
//! ```text
//! θd = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸),   u = fx θd x/r + cx,   v = fy θd y/r + cy
//! ```
//!
//! OpenCV's own functions take z > 0 only; the equations hold beside and behind the camera too.
//!
//! Source: J. Kannala and S. S. Brandt, A generic camera model and calibration method for conventional, wide-angle, and fish-eye
//! lenses, IEEE Transactions on Pattern Analysis and Machine Intelligence 28 (2006); OpenCV, "Fisheye camera model".

use std::f64::consts::PI;

use super::{Linearised, padded};
use crate::project::Interior;

/// Values of the parameters; focal lengths and principal point in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)] // the names are the model's own
pub struct Fisheye {
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    pub k1: f64,
    pub k2: f64,
    pub k3: f64,
    pub k4: f64,
}

/// Places from the axis to 180 degrees at which the distortion is examined, so that no image is taken from beyond a fold.
const PLACES: u32 = 64;

impl Fisheye {
    /// The model of an interior orientation; `None` for another model or while a focal length is unknown.
    pub fn new(interior: &Interior) -> Option<Self> {
        match *interior {
            Interior::OpencvFisheye { fx: Some(fx), fy: Some(fy), cx, cy, k1, k2, k3, k4 } => {
                Some(Self { fx, fy, cx, cy, k1, k2, k3, k4 })
            }
            _ => None,
        }
    }

    /// Distorted angle and its derivative by the angle.
    #[inline]
    pub fn distorted(&self, angle: f64) -> (f64, f64) {
        let Self { k1, k2, k3, k4, .. } = *self;
        let t = angle * angle;
        let value = angle * (1.0 + t * (k1 + t * (k2 + t * (k3 + t * k4))));
        let slope = 1.0 + t * (3.0 * k1 + t * (5.0 * k2 + t * (7.0 * k3 + t * 9.0 * k4)));
        (value, slope)
    }

    /// Whether the distorted angle grows all the way from the axis to an angle.
    fn reaches(&self, angle: f64) -> bool {
        let step = PI / f64::from(PLACES);
        let between = (1..PLACES).map(|k| f64::from(k) * step).take_while(|at| *at < angle);
        between.chain([angle]).all(|at| self.distorted(at).1 > 0.0)
    }

    /// Ray of a pixel in the camera frame, of unit length; `None` beyond the model's fold or 180 degrees.
    pub fn ray(&self, [u, v]: [f64; 2]) -> Option<[f64; 3]> {
        let (a, b) = ((u - self.cx) / self.fx, (v - self.cy) / self.fy);
        let radius = a.hypot(b);
        if radius == 0.0 {
            return Some([0.0, 0.0, -1.0]);
        }
        let angle = self.angle(radius)?;
        let (sine, cosine) = angle.sin_cos();
        Some([sine * a / radius, -sine * b / radius, -cosine])
    }

    /// The angle of a distorted one: bracketed on the way from the axis, then by Newton's iteration inside the bracket.
    fn angle(&self, distorted: f64) -> Option<f64> {
        let step = PI / f64::from(PLACES);
        let mut low = 0.0;
        let mut high = None;
        for k in 1..=PLACES {
            let at = f64::from(k) * step;
            let (value, slope) = self.distorted(at);
            if value >= distorted {
                high = Some(at);
                break;
            }
            if !(slope > 0.0) {
                return self.before_the_fold(distorted, low, at);
            }
            low = at;
        }
        self.bracketed(distorted, low, high?)
    }

    /// The angle where the fold lies between `low` and `high`: the largest distorted angle is found first.
    fn before_the_fold(&self, distorted: f64, low: f64, high: f64) -> Option<f64> {
        let (mut inside, mut outside) = (low, high);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if self.distorted(middle).1 > 0.0 { inside = middle } else { outside = middle }
        }
        (self.distorted(inside).0 >= distorted).then(|| self.bracketed(distorted, low, inside)).flatten()
    }

    fn bracketed(&self, distorted: f64, mut low: f64, mut high: f64) -> Option<f64> {
        let mut at = distorted.clamp(low, high);
        for _ in 0..100 {
            let (value, slope) = self.distorted(at);
            let e = distorted - value;
            if e.abs() <= 4e-16 * (1.0 + distorted) {
                break;
            }
            if e > 0.0 {
                low = at
            } else {
                high = at
            }
            let next = at + e / slope;
            let inside = slope > 0.0 && next > low && next < high;
            let next = if inside { next } else { 0.5 * (low + high) };
            if next == at || high - low <= 1e-16 * high {
                break;
            }
            at = next;
        }
        let met = (self.distorted(at).0 - distorted).abs() <= 1e-13 * (1.0 + distorted);
        (met && self.reaches(at) && at < PI).then_some(at)
    }

    /// Pixel of a camera-frame point; none on the axis behind the camera or beyond the fold, where a second, false image would
    /// appear.
    pub fn project(&self, [px, py, pz]: [f64; 3]) -> Option<[f64; 2]> {
        let (x, y, z) = (px, -py, -pz);
        let r = x.hypot(y);
        if r == 0.0 {
            return (z > 0.0).then_some([self.cx, self.cy]);
        }
        let angle = r.atan2(z);
        let (distorted, _) = self.distorted(angle);
        let pixel = [self.fx * distorted * x / r + self.cx, self.fy * distorted * y / r + self.cy];
        (distorted > 0.0 && self.reaches(angle)).then_some(pixel)
    }

    /// Residual in pixels, projection minus measurement; none at the projection centre and on the axis behind it.
    ///
    /// With (c, s) = (x, y)/r and d² = r² + z²: ∂(θd c)/∂x = A c² + S s², ∂(θd c)/∂y = (A - S) c s, ∂(θd c)/∂z = -θd' c r/d²,
    /// where A = θd' z/d² and S = θd/r, which is 1/z on the axis.
    #[inline]
    pub fn linearise(&self, measured: [f64; 2], [px, py, pz]: [f64; 3]) -> Option<Linearised> {
        let (x, y, z) = (px, -py, -pz);
        let r = x.hypot(y);
        let squared = r * r + z * z;
        if !(squared > 0.0) || (r == 0.0 && z < 0.0) {
            return None;
        }
        let angle = r.atan2(z);
        let (distorted, slope) = self.distorted(angle);
        let (c, s, across) = if r > 0.0 { (x / r, y / r, distorted / r) } else { (1.0, 0.0, 1.0 / z) };
        let (along, away) = (slope * z / squared, -slope * r / squared);
        let (fx, fy) = (self.fx, self.fy);
        let (ad, bd) = (distorted * c, distorted * s);
        // ∂/∂py = -∂/∂y, ∂/∂pz = -∂/∂z.
        let mixed = (along - across) * c * s;
        let by_point = [
            [fx * (along * c * c + across * s * s), -fx * mixed, -fx * away * c],
            [fy * mixed, -fy * (along * s * s + across * c * c), -fy * away * s],
        ];
        let t = angle * angle;
        let powers = [angle * t, angle * t * t, angle * t * t * t, angle * t * t * t * t];
        let [x1, x2, x3, x4] = powers.map(|power| fx * power * c);
        let [y1, y2, y3, y4] = powers.map(|power| fy * power * s);
        let linear = Linearised {
            residual: [fx * ad + self.cx - measured[0], fy * bd + self.cy - measured[1]],
            by_point,
            // f, fx, fy, cx, cy, k1, k2, k3, k4; f moves fy in the ratio fy : fx.
            by_parameter: [
                padded([ad, ad, 0.0, 1.0, 0.0, x1, x2, x3, x4]),
                padded([bd * fy / fx, 0.0, bd, 0.0, 1.0, y1, y2, y3, y4]),
            ],
        };
        linear.residual.iter().all(|e| e.is_finite()).then_some(linear)
    }
}
