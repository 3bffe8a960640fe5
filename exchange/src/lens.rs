//! The lens of other programs, ideal to image: one form that has the terms of all of them, and which terms each has.
//!
//! With a = X/Z, b = Y/Z in a camera frame of x right, y down, z forwards, r² = a² + b², in our pixel frame:
//!
//! ```text
//! R  = (1 + k1 r² + k2 r⁴ + k3 r⁶ + k4 r⁸) / (1 + d1 r² + d2 r⁴ + d3 r⁶)
//! a' = a R + 2 p1 a b + p2 (r² + 2a²) + s1 r² + s2 r⁴,   b' = b R + p1 (r² + 2b²) + 2 p2 a b + s3 r² + s4 r⁴
//! (a', b', 1) is then turned by the tilt τx, τy of the sensor and projected along its normal
//! u = fx a' + skew b' + cx,   v = fy b' + cy
//! ```
//!
//! An equidistant lens (fisheye) has the same form on (a, b) θ/r, θ = atan r the angle off the axis, for (a, b).
//!
//! OpenCV, "Camera calibration and 3D reconstruction": k, p, s, τ as there (its k4, k5, k6 are d1, d2, d3 here).

use sightline::project::{Camera, Interior};

/// A number of the form above, by its place in [`Lens::terms`].
pub mod term {
    #![allow(missing_docs)] // the names are those of the equations
    pub const FX: usize = 0;
    pub const FY: usize = 1;
    pub const SKEW: usize = 2;
    pub const CX: usize = 3;
    pub const CY: usize = 4;
    pub const K1: usize = 5;
    pub const K2: usize = 6;
    pub const K3: usize = 7;
    pub const K4: usize = 8;
    pub const D1: usize = 9;
    pub const D2: usize = 10;
    pub const D3: usize = 11;
    pub const P1: usize = 12;
    pub const P2: usize = 13;
    pub const S1: usize = 14;
    pub const S2: usize = 15;
    pub const S3: usize = 16;
    pub const S4: usize = 17;
    pub const TX: usize = 18;
    pub const TY: usize = 19;
    /// How many there are.
    pub const ALL: usize = 20;
}
use term::*;

/// A camera model of another program: its name, and its parameters in its order, each with the terms that it is added to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensModel {
    /// Name.
    pub name: &'static str,
    /// Parameters.
    pub parameters: &'static [(&'static str, &'static [usize])],
    /// Whether it is equidistant.
    pub equidistant: bool,
}

/// Values of the terms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lens {
    /// By the constants of [`term`].
    pub terms: [f64; ALL],
    /// Whether it is equidistant.
    pub equidistant: bool,
}

impl LensModel {
    /// The lens of these values; terms that no parameter moves are those of `base`.
    pub fn lens(&self, base: &Lens, values: &[f64]) -> Lens {
        let mut lens = Lens { equidistant: self.equidistant, ..*base };
        for ((_, terms), value) in self.parameters.iter().zip(values) {
            terms.iter().for_each(|term| lens.terms[*term] += value);
        }
        lens
    }

    /// The values that give a lens exactly; `None` if the model lacks one of its terms.
    pub fn exact(&self, base: &Lens, lens: &Lens) -> Option<Vec<f64>> {
        if self.equidistant != lens.equidistant {
            return None;
        }
        let mut left = *lens;
        left.terms.iter_mut().zip(base.terms).for_each(|(term, base)| *term -= base);
        let mut values = Vec::with_capacity(self.parameters.len());
        for (_, terms) in self.parameters {
            let value = left.terms[terms[0]];
            terms.iter().for_each(|term| left.terms[*term] -= value);
            values.push(value);
        }
        // What is left of a difference of focal lengths or of a principal point is rounding, or it is something.
        let rounding = |k: usize| if k <= CY { 1e-12 * lens.terms[k].abs().max(lens.terms[FX].abs()) } else { 0.0 };
        let met = left.terms.iter().enumerate().all(|(k, left)| left.abs() <= rounding(k));
        met.then_some(values)
    }

    /// Names of the parameters.
    pub fn names(&self) -> Vec<String> {
        self.parameters.iter().map(|(name, _)| (*name).to_owned()).collect()
    }
}

impl Lens {
    /// Pixel of a direction (a, b); `None` if the polynomials have no finite value.
    #[allow(clippy::many_single_char_names)] // those of the equations
    pub fn project(&self, [mut a, mut b]: [f64; 2]) -> Option<[f64; 2]> {
        let t = &self.terms;
        if self.equidistant {
            let r = a.hypot(b);
            let scale = if r > 0.0 { r.atan() / r } else { 1.0 };
            (a, b) = (a * scale, b * scale);
        }
        let r2 = a * a + b * b;
        let above = 1.0 + r2 * (t[K1] + r2 * (t[K2] + r2 * (t[K3] + r2 * t[K4])));
        let below = 1.0 + r2 * (t[D1] + r2 * (t[D2] + r2 * t[D3]));
        let radial = above / below;
        let (p1, p2) = (t[P1], t[P2]);
        let mut x = a * radial + 2.0 * p1 * a * b + p2 * (r2 + 2.0 * a * a) + r2 * (t[S1] + r2 * t[S2]);
        let mut y = b * radial + p1 * (r2 + 2.0 * b * b) + 2.0 * p2 * a * b + r2 * (t[S3] + r2 * t[S4]);
        if t[TX] != 0.0 || t[TY] != 0.0 {
            let ((sx, cx), (sy, cy)) = (t[TX].sin_cos(), t[TY].sin_cos());
            // R = Ry(τy) Rx(τx)
            let r = [[cy, sy * sx, -sy * cx], [0.0, cx, sx], [sy, -cy * sx, cy * cx]];
            let [rx, ry, rz] = r.map(|row| row[0] * x + row[1] * y + row[2]);
            (x, y) = ((r[2][2] * rx - r[0][2] * rz) / rz, (r[2][2] * ry - r[1][2] * rz) / rz);
        }
        let pixel = [t[FX] * x + t[SKEW] * y + t[CX], t[FY] * y + t[CY]];
        (pixel[0].is_finite() && pixel[1].is_finite() && below > 0.0).then_some(pixel)
    }

    /// Direction of a pixel, by Newton's iteration from the undistorted one; `None` beyond the fold of the distortion.
    pub fn direction(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        let t = &self.terms;
        let y = (pixel[1] - t[CY]) / t[FY];
        let start = [(pixel[0] - t[CX] - t[SKEW] * y) / t[FX], y];
        // Strong barrel distortion: the start lies beyond the fold of the model, the way from the centre does not.
        self.solve(pixel, start).or_else(|| self.solve(pixel, [0.0, 0.0]))
    }

    fn solve(&self, pixel: [f64; 2], start: [f64; 2]) -> Option<[f64; 2]> {
        const STEP: f64 = 1e-6;
        let misclosure = |at: [f64; 2]| self.project(at).map(|found| [pixel[0] - found[0], pixel[1] - found[1]]);
        let length = |e: [f64; 2]| e[0].hypot(e[1]);
        let mut at = start;
        let mut e = misclosure(at)?;
        for _ in 0..60 {
            let [[a, c], [b, d]] = [[STEP, 0.0], [0.0, STEP]].map(|[x, y]| {
                let (more, less) = (self.project([at[0] + x, at[1] + y]), self.project([at[0] - x, at[1] - y]));
                more.zip(less)
                    .map_or([f64::NAN; 2], |(m, l)| [(m[0] - l[0]) / (2.0 * STEP), (m[1] - l[1]) / (2.0 * STEP)])
            });
            let determinant = a * d - b * c;
            // Turned over: this is the false image beyond the fold.
            if !(determinant > 1e-9 * unit_area(self)) || !(a / self.terms[FX] + d / self.terms[FY] > 0.0) {
                return None;
            }
            if length(e) <= 1e-11 * (1.0 + pixel[0].abs() + pixel[1].abs()) {
                return Some(at);
            }
            let step = [(d * e[0] - b * e[1]) / determinant, (a * e[1] - c * e[0]) / determinant];
            let mut part = 1.0;
            loop {
                let trial = [at[0] + part * step[0], at[1] + part * step[1]];
                if let Some(next) = misclosure(trial).filter(|next| length(*next) < length(e)) {
                    (at, e) = (trial, next);
                    break;
                }
                part *= 0.5;
                if part < 1e-4 {
                    return (length(e) < 1e-8).then_some(at);
                }
            }
        }
        (length(e) < 1e-8).then_some(at)
    }

    /// The lens of an engine's camera, where it has one of this sense: OpenCV's models, or a brown model without distortion.
    pub fn of(camera: &Camera) -> Option<Self> {
        let mut terms = [0.0; ALL];
        let mut equidistant = false;
        match camera.interior {
            Interior::OpencvRational { fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 } => {
                let focal = [(FX, fx?), (FY, fy?), (CX, cx), (CY, cy)];
                let radial = [(K1, k1), (K2, k2), (K3, k3), (D1, k4), (D2, k5), (D3, k6)];
                let all = focal.into_iter().chain(radial).chain([(P1, p1), (P2, p2)]);
                all.for_each(|(k, value)| terms[k] = value);
            }
            Interior::OpencvFisheye { fx, fy, cx, cy, k1, k2, k3, k4 } => {
                equidistant = true;
                let all = [(FX, fx?), (FY, fy?), (CX, cx), (CY, cy), (K1, k1), (K2, k2), (K3, k3), (K4, k4)];
                all.into_iter().for_each(|(k, value)| terms[k] = value);
            }
            Interior::Opencv { fx, fy, cx, cy, k1, k2, p1, p2, k3 } => {
                for (k, value) in
                    [(FX, fx?), (FY, fy?), (CX, cx), (CY, cy), (K1, k1), (K2, k2), (K3, k3), (P1, p1), (P2, p2)]
                {
                    terms[k] = value;
                }
            }
            Interior::Brown { c, x0, y0, k1, k2, k3, p1, p2, b1, b2 } => {
                if [k1, k2, k3, p1, p2].iter().any(|value| *value != 0.0) || b1 <= -1.0 {
                    return None;
                }
                // x̄ (1 + B1) + B2 ȳ = c a, ȳ = -c b.
                let (c, [px, py]) = (c?, camera.pitch());
                terms[FX] = c / ((1.0 + b1) * px);
                terms[SKEW] = b2 * c / ((1.0 + b1) * px);
                terms[FY] = c / py;
                let [cx, cy] = camera.pixel_from_photo([x0, y0]);
                (terms[CX], terms[CY]) = (cx, cy);
            }
        }
        Some(Self { terms, equidistant })
    }

    /// The model of the engine that this lens is, the one with the fewest parameters; `None` if it has terms that all of them lack.
    pub fn interior(&self) -> Option<Interior> {
        const OPENCV: [usize; 9] = [FX, FY, CX, CY, K1, K2, K3, P1, P2];
        const RATIONAL: [usize; 12] = [FX, FY, CX, CY, K1, K2, K3, P1, P2, D1, D2, D3];
        const FISHEYE: [usize; 8] = [FX, FY, CX, CY, K1, K2, K3, K4];
        let t = &self.terms;
        let holds = |held: &[usize]| (0..ALL).all(|k| held.contains(&k) || t[k] == 0.0);
        let (fx, fy, cx, cy) = (Some(t[FX]), Some(t[FY]), t[CX], t[CY]);
        let (k1, k2, k3, p1, p2) = (t[K1], t[K2], t[K3], t[P1], t[P2]);
        if self.equidistant {
            return holds(&FISHEYE).then_some(Interior::OpencvFisheye { fx, fy, cx, cy, k1, k2, k3, k4: t[K4] });
        }
        if holds(&OPENCV) {
            return Some(Interior::Opencv { fx, fy, cx, cy, k1, k2, p1, p2, k3 });
        }
        let (k4, k5, k6) = (t[D1], t[D2], t[D3]);
        let rational = Interior::OpencvRational { fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 };
        holds(&RATIONAL).then_some(rational)
    }
}

/// Pixels of a unit square of directions.
fn unit_area(lens: &Lens) -> f64 {
    (lens.terms[FX] * lens.terms[FY]).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use sightline::camera::pixel_from_camera_point;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    pub(super) fn full() -> Lens {
        let mut terms = [0.0; ALL];
        for (k, value) in [
            (FX, 900.0),
            (FY, 905.0),
            (SKEW, 0.7),
            (CX, 645.5),
            (CY, 352.25),
            (K1, 0.3),
            (K2, -0.05),
            (K3, 0.01),
            (K4, -0.002),
            (D1, 0.45),
            (D2, 0.04),
            (D3, 0.002),
            (P1, 1e-3),
            (P2, -5e-4),
            (S1, 2e-4),
            (S2, -1e-4),
            (S3, -3e-4),
            (S4, 1e-4),
            (TX, 0.01),
            (TY, -0.02),
        ] {
            terms[k] = value;
        }
        Lens { terms, equidistant: false }
    }

    #[test]
    fn pixel_and_direction_are_inverses() {
        for pixel in [[3.0, 4.0], [700.2, 333.3], [1270.0, 700.0], [645.0, 352.0]] {
            let direction = full().direction(pixel).unwrap();
            let back = full().project(direction).unwrap();
            assert!((back[0] - pixel[0]).hypot(back[1] - pixel[1]) < 1e-7, "{pixel:?} became {back:?}");
        }
    }

    #[test]
    fn it_is_the_engines_model_where_that_has_all_terms() {
        let mut lens = full();
        for k in [SKEW, K4, D1, D2, D3, S1, S2, S3, S4, TX, TY] {
            lens.terms[k] = 0.0;
        }
        let camera = Camera::new("c", 1280, 720, lens.interior().unwrap());
        assert_eq!(Lens::of(&camera), Some(lens));
        // and the same of the rational and of the fisheye model
        let rational = Lens {
            terms: std::array::from_fn(|k| if (D1..=D3).contains(&k) { full().terms[k] } else { lens.terms[k] }),
            ..lens
        };
        let mut fisheye = Lens { equidistant: true, ..lens };
        (fisheye.terms[K4], fisheye.terms[P1], fisheye.terms[P2]) = (-0.002, 0.0, 0.0);
        for (lens, model) in [(rational, "opencv_rational"), (fisheye, "opencv_fisheye")] {
            let camera = Camera::new("c", 1280, 720, lens.interior().unwrap());
            assert_eq!((camera.interior.model().name, Lens::of(&camera)), (model, Some(lens)));
            for [a, b] in [[0.3, 0.2], [-0.4, 0.1], [0.0, 0.0]] {
                let ours = pixel_from_camera_point(&camera, Vector3::new(a, -b, -1.0)).unwrap();
                let theirs = lens.project([a, b]).unwrap();
                assert!((ours[0] - theirs[0]).hypot(ours[1] - theirs[1]) < 1e-9, "{model}: {ours:?} {theirs:?}");
            }
        }
        let mut brown = Camera::new("b", 1280, 720, Interior::brown(8.0));
        brown.pixel_pitch = Some([0.009, 0.0091]);
        brown.interior.set(sightline::project::Parameter::X0, 0.13);
        brown.interior.set(sightline::project::Parameter::Y0, -0.07);
        brown.interior.set(sightline::project::Parameter::B1, 3e-3);
        brown.interior.set(sightline::project::Parameter::B2, -2e-3);
        let plain = Lens::of(&brown).unwrap();
        for [a, b] in [[0.3, 0.2], [-0.4, 0.1], [0.2, -0.25]] {
            for (camera, lens) in [(&camera, lens), (&brown, plain)] {
                let ours = pixel_from_camera_point(camera, Vector3::new(a, -b, -1.0)).unwrap();
                let theirs = lens.project([a, b]).unwrap();
                assert!((ours[0] - theirs[0]).hypot(ours[1] - theirs[1]) < 1e-9, "{ours:?} {theirs:?}");
            }
        }
    }

    #[test]
    fn values_of_a_shape_come_back() {
        const SHAPE: LensModel = LensModel {
            name: "test",
            parameters: &[("f", &[FY, FX]), ("b1", &[FX]), ("cx", &[CX]), ("cy", &[CY])],
            equidistant: false,
        };
        let lens = SHAPE.lens(&Lens::default(), &[900.0, 3.5, 640.0, 360.0]);
        assert_eq!((lens.terms[FX], lens.terms[FY]), (903.5, 900.0));
        assert_eq!(SHAPE.exact(&Lens::default(), &lens), Some(vec![900.0, 3.5, 640.0, 360.0]));
        assert_eq!(SHAPE.exact(&Lens::default(), &full()), None);
    }
}
