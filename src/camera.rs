//! Camera models: from a point in the camera frame to its image and back, with analytic derivatives.
//!
//! | model | sense | residual = projection minus measurement |
//! | --- | --- | --- |
//! | [`Brown`] | a correction is added to the measured coordinates | at the corrected place or in the measurement, photo units |
//! | [`Opencv`], [`Rational`] | the ideal coordinates are distorted | in the measurement, pixels |
//! | [`Fisheye`] | the angle off the axis is distorted | in the measurement, pixels |
//!
//! A camera-frame point has its z axis towards the viewer, so that points in front of the camera have negative z.

mod brown;
mod fisheye;
mod opencv;
mod rational;
mod units;

use nalgebra::Vector3;

pub use brown::Brown;
pub use fisheye::Fisheye;
pub use opencv::Opencv;
pub use rational::Rational;
pub use units::{parameter_unit, photo_unit};

use crate::adjustment::ResidualPlace;
use crate::project::{Camera, Interior};

/// Largest number of parameters of a model, in the order of [`Interior::parameters`].
pub const PARAMETERS: usize = 13;

/// Derivatives by the parameters of a model that has fewer of them: the rest is zero.
#[inline(always)]
fn padded<const N: usize>(row: [f64; N]) -> [f64; PARAMETERS] {
    let mut all = [0.0; PARAMETERS];
    all[..N].copy_from_slice(&row);
    all
}

/// A residual with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linearised {
    /// Projection minus measurement.
    pub residual: [f64; 2],
    /// Derivatives by the camera-frame point, one row a coordinate.
    pub by_point: [[f64; 3]; 2],
    /// Derivatives by the parameters of the model, one row a coordinate; zero beyond its last.
    pub by_parameter: [[f64; PARAMETERS]; 2],
}

/// A camera model with the values of its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    /// Correction of the measurement.
    Brown(Brown),
    /// Distortion of the ideal image.
    Opencv(Opencv),
    /// The same with a rational radial distortion.
    Rational(Rational),
    /// Distortion of the angle off the axis.
    Fisheye(Fisheye),
}

impl Model {
    /// The model of an interior orientation; none while its principal distance is unknown.
    pub fn new(interior: &Interior) -> Option<Self> {
        match interior {
            Interior::Brown { .. } => Brown::new(interior).map(Self::Brown),
            Interior::Opencv { .. } => Opencv::new(interior).map(Self::Opencv),
            Interior::OpencvRational { .. } => Rational::new(interior).map(Self::Rational),
            Interior::OpencvFisheye { .. } => Fisheye::new(interior).map(Self::Fisheye),
        }
    }

    /// Residual of a measurement (photo units for brown, pixels for the others) of the camera-frame point `p`, and its
    /// derivatives; `None` if the point has no direction that the equations hold for, or where the distortion cannot be
    /// inverted. Points behind a camera that is not [wide](Self::is_wide) follow the same equations: whether that is allowed is
    /// for the caller to say.
    #[inline]
    pub fn linearise(&self, measured: [f64; 2], p: [f64; 3], place: ResidualPlace) -> Option<Linearised> {
        match (self, place) {
            (Self::Brown(brown), ResidualPlace::Corrected) => brown.linearise(measured, p),
            (Self::Brown(brown), ResidualPlace::Measured) => brown.linearise_measured(measured, p),
            (Self::Opencv(opencv), _) => opencv.linearise(measured, p),
            (Self::Rational(rational), _) => rational.linearise(measured, p),
            (Self::Fisheye(fisheye), _) => fisheye.linearise(measured, p),
        }
    }

    /// Whether points beside and behind the camera can have an image.
    pub fn is_wide(&self) -> bool {
        matches!(self, Self::Fisheye(_))
    }

    /// Pixel of a camera-frame point of this camera, whose model it is. `None` if it has no image.
    pub fn pixel(&self, camera: &Camera, p: [f64; 3]) -> Option<[f64; 2]> {
        let pixel = match self {
            Self::Brown(brown) => camera.pixel_from_photo(brown.project(p)?),
            Self::Opencv(opencv) => opencv.project(p)?,
            Self::Rational(rational) => rational.project(p)?,
            Self::Fisheye(fisheye) => fisheye.project(p)?,
        };
        pixel.iter().all(|d| d.is_finite()).then_some(pixel)
    }

    /// Ray of a pixel in the camera frame: (x, y, -1), or for a wide camera of unit length. `None` if the distortion has no
    /// inverse.
    pub fn ray(&self, camera: &Camera, pixel: [f64; 2]) -> Option<[f64; 3]> {
        let forwards = |[x, y]: [f64; 2]| [x, y, -1.0];
        let ray = match self {
            Self::Brown(brown) => forwards(brown.ideal(camera.photo_from_pixel(pixel))),
            Self::Opencv(opencv) => forwards(opencv.ideal(pixel)?),
            Self::Rational(rational) => forwards(rational.ideal(pixel)?),
            Self::Fisheye(fisheye) => fisheye.ray(pixel)?,
        };
        ray.iter().all(|d| d.is_finite()).then_some(ray)
    }
}

/// Measurement in the units of the camera's residuals: photo coordinates (brown) or pixels (the others).
pub fn measurement_from_pixel(camera: &Camera, pixel: [f64; 2]) -> [f64; 2] {
    if camera.interior.model().in_photo_units { camera.photo_from_pixel(pixel) } else { pixel }
}

/// Ray of a pixel in the camera frame, as [`Model::ray`]. None while the principal distance is unknown or where the distortion
/// has no inverse.
pub fn ray_from_pixel(camera: &Camera, pixel: [f64; 2]) -> Option<[f64; 3]> {
    Model::new(&camera.interior)?.ray(camera, pixel)
}

/// Direction of a pixel: distortion-free image coordinates divided by the principal distance, so that the ray in the
/// camera frame is (x, y, -1). None while the principal distance is unknown, where the distortion has no inverse, and for
/// rays of 90 degrees or more off the axis, which have no such coordinates.
pub fn ideal_from_pixel(camera: &Camera, pixel: [f64; 2]) -> Option<[f64; 2]> {
    let [x, y, z] = ray_from_pixel(camera, pixel)?;
    if z == -1.0 {
        return Some([x, y]);
    }
    // a ray of 90 degrees comes out of its sine and cosine with a z of about 1e-16 of either sign
    (z < -1e-12).then(|| [-x / z, -y / z])
}

/// Pixel of a camera-frame point, distortion included. None behind the camera (unless it images what is there), while the
/// principal distance is unknown, or where the distortion has no image of it.
pub fn pixel_from_camera_point(camera: &Camera, p: Vector3<f64>) -> Option<[f64; 2]> {
    Model::new(&camera.interior)?.pixel(camera, p.into())
}

/// Newton's iteration for `f(x) = target` in two dimensions with step halving, from `start`; `f` gives value and
/// derivative. The place and the derivative there; `None` unless the residual vanishes where the derivative keeps its
/// orientation.
fn invert(
    target: [f64; 2],
    start: [f64; 2],
    scale: f64,
    f: impl Fn([f64; 2]) -> ([f64; 2], [[f64; 2]; 2]),
) -> Option<([f64; 2], [[f64; 2]; 2])> {
    let misclosure = |value: [f64; 2]| [target[0] - value[0], target[1] - value[1]];
    // every observation is inverted in every iteration of an adjustment, and `hypot` is many times slower
    let length_of = |e: [f64; 2]| (e[0] * e[0] + e[1] * e[1]).sqrt();
    let mut x = start;
    let (value, mut derivative) = f(x);
    let mut e = misclosure(value);
    let mut length = length_of(e);
    for _ in 0..40 {
        let [[a, b], [c, d]] = derivative;
        let determinant = a * d - b * c;
        if determinant.is_nan() || determinant <= 1e-9 || a + d <= 0.0 || !length.is_finite() {
            return None;
        }
        if length <= 4e-16 * (scale + x[0].abs() + x[1].abs()) {
            return Some((x, derivative));
        }
        let step = [(d * e[0] - b * e[1]) / determinant, (a * e[1] - c * e[0]) / determinant];
        let mut part = 1.0;
        loop {
            let trial = [x[0] + part * step[0], x[1] + part * step[1]];
            let (value, next) = f(trial);
            let next_e = misclosure(value);
            let next_length = length_of(next_e);
            let keeps_orientation = next[0][0] * next[1][1] - next[0][1] * next[1][0] > 1e-9;
            if next_length < length && keeps_orientation {
                (x, e, length, derivative) = (trial, next_e, next_length, next);
                break;
            }
            part *= 0.5;
            if part < 1e-4 {
                // No better point: at the rounding limit, or none exists.
                return (length <= 1e-12 * (scale + target[0].abs() + target[1].abs())).then_some((x, derivative));
            }
        }
    }
    (length <= 1e-12 * (scale + target[0].abs() + target[1].abs())).then_some((x, derivative))
}

#[cfg(test)]
mod battery;

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// Value and derivatives by every argument, one direction at a time, of equations written for dual numbers.
    pub(super) fn automatic(at: &[f64], f: impl Fn(&[Dual64]) -> [Dual64; 2]) -> ([f64; 2], Vec<[f64; 2]>) {
        let mut arguments: Vec<Dual64> = at.iter().map(|&x| Dual64::from(x)).collect();
        let value = f(&arguments).map(|d| d.re);
        let derivatives = (0..at.len()).map(|k| {
            arguments[k].eps = 1.0;
            let derivative = f(&arguments).map(|d| d.eps);
            arguments[k].eps = 0.0;
            derivative
        });
        (value, derivatives.collect())
    }

    /// The DCS420 of the literature: about 140 µm at a radius of 8.3 mm.
    fn dcs420() -> Camera {
        Camera {
            id: "dcs420".into(),
            width: 1524,
            height: 1012,
            pixel_pitch: Some([0.009, 0.009]),
            interior: Interior::Brown {
                c: Some(20.4558),
                x0: 0.1,
                y0: -0.05,
                k1: 2.829e-4,
                k2: -5.133e-7,
                k3: 6.211e-10,
                p1: 1e-5,
                p2: -2e-5,
                b1: 3e-4,
                b2: -1e-4,
            },
            free: Vec::new(),
            sigma: Default::default(),
            per_photo: false,
        }
    }

    fn webcam() -> Camera {
        Camera {
            id: "webcam".into(),
            width: 1280,
            height: 720,
            pixel_pitch: None,
            interior: Interior::Opencv {
                fx: Some(900.0),
                fy: Some(905.0),
                cx: 645.0,
                cy: 352.0,
                k1: -0.25,
                k2: 0.08,
                p1: 1e-3,
                p2: -5e-4,
                k3: -0.01,
            },
            free: Vec::new(),
            sigma: Default::default(),
            per_photo: false,
        }
    }

    #[test]
    fn pixel_and_direction_are_inverses() {
        for camera in [dcs420(), webcam()] {
            for pixel in [[3.0, 4.0], [700.2, 333.3], [1270.0, 700.0], [645.0, 352.0]] {
                let [x, y] = ideal_from_pixel(&camera, pixel).expect("inside the format");
                for distance in [0.3, 7.0] {
                    let p = Vector3::new(x, y, -1.0) * distance;
                    let back = pixel_from_camera_point(&camera, p).expect("in front");
                    assert!((back[0] - pixel[0]).hypot(back[1] - pixel[1]) < 1e-9, "{pixel:?} became {back:?}");
                }
            }
        }
    }

    #[test]
    fn behind_the_camera_or_without_a_principal_distance_there_is_no_image() {
        let mut camera = dcs420();
        assert_eq!(pixel_from_camera_point(&camera, Vector3::new(0.1, 0.0, 1.0)), None);
        assert_eq!(pixel_from_camera_point(&camera, Vector3::new(0.1, 0.0, 0.0)), None);
        if let Interior::Brown { c, .. } = &mut camera.interior {
            *c = None;
        }
        assert_eq!(ideal_from_pixel(&camera, [1.0, 1.0]), None);
    }

    #[test]
    fn a_folded_distortion_is_refused_not_followed() {
        let mut camera = webcam();
        camera.interior.set(crate::project::Parameter::K1, -0.6);
        camera.interior.set(crate::project::Parameter::K3, 0.0);
        camera.interior.set(crate::project::Parameter::K2, 0.0);
        // r (1 - 0.6 r²) has its largest value 0.497 at r = 0.745: nothing is imaged beyond.
        assert_eq!(ideal_from_pixel(&camera, [645.0 + 0.55 * 900.0, 352.0]), None);
        assert!(ideal_from_pixel(&camera, [645.0 + 0.45 * 900.0, 352.0]).is_some());
    }
}
