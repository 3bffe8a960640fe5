//! Conversion of a camera to another model: parameters that project the directions of all pixels to where the present ones do, and the
//! residual of that fit in pixels.
//!
//! Over a grid of pixels q with their rays d(q) of the present model, the parameters x of the other one minimise
//!
//! ```text
//! Σ |π(d(q); x) - q|²
//! ```
//!
//! by Levenberg and Marquardt's iteration with the models' own derivatives, from the same principal distance and point without distortion.
//! What a model has no image for (of a perspective model all rays far off the axis) is left out and stated as the share of the picture that was
//! fitted.
//!
//! What is estimated stays what it was, parameter by parameter: principal distance, principal point, radial distortion, decentring,
//! affinity. A priori values of principal distance and point are carried over; those of a distortion mean nothing in another model.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::adjustment::ResidualPlace;
use crate::camera::{Model, measurement_from_pixel};
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Camera, CameraModel, Interior, Parameter, Project};

/// Pixels along each side of the picture; a model has at most 12 parameters that are independent.
const FITTED: u32 = 25;
/// The same where the difference is stated: others, so that it is not only seen where it was made small.
const STATED: u32 = 62;
/// cos of 75 degrees: the image of a perspective lens grows with the tangent, and nothing else in the picture would count beside rays beyond.
const FARTHEST: f64 = 0.258_819_045_102_520_74;
/// Iterations; from no distortion a strong one takes about twenty.
const ITERATIONS: usize = 100;

/// Remaining difference of a conversion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelConversion {
    /// Camera identifier.
    pub camera: String,
    /// Name of the model that was.
    pub from: String,
    /// Name of the model that is.
    pub to: String,
    /// Largest difference of the pixels of one direction, pixels; null if the principal distance is not known, so that there are no
    /// directions.
    pub max_px: Option<f64>,
    /// Root mean square difference.
    pub rms_px: Option<f64>,
    /// Share of the picture that it holds for; the other model has no image of the rest.
    pub share: f64,
    /// Parameters with an a priori standard error that the other model cannot use: those that it has are estimated without it, the others do not exist.
    pub dropped: Vec<Parameter>,
}

/// The project with a camera in another model, the interior orientations of its photos included.
///
/// # Errors
/// [`Error::Unknown`] for a camera or a model that is not there; [`Error::Invalid`] if no values of the other model image the rays.
pub fn convert_camera(project: &Project, camera: &str, model: &str) -> Result<(Project, ModelConversion)> {
    let unknown = |kind, name: &str, field| Error::Unknown { kind, name: name.to_owned(), at: Place::field(field) };
    let to =
        CameraModel::ALL.iter().find(|m| m.name == model).ok_or_else(|| unknown(Thing::CameraModel, model, "model"))?;
    let place = project.cameras.iter().position(|c| c.id == camera);
    let place = place.ok_or_else(|| unknown(Thing::Camera, camera, "camera"))?;
    let own = &project.cameras[place];
    let (converted, mut conversion) = converted(own, to)?;
    let mut project = project.clone();
    for photo in project.photos.iter_mut().filter(|p| p.camera == own.id) {
        let Some(interior) = photo.interior.filter(|interior| interior.model() != to) else { continue };
        let (fitted, left) = interior_of(&Camera { interior, ..own.clone() }, to)?;
        photo.interior = Some(fitted);
        conversion.worse(&left);
    }
    project.cameras[place] = converted;
    Ok((project, conversion))
}

/// The camera in another model.
fn converted(camera: &Camera, to: &CameraModel) -> Result<(Camera, ModelConversion)> {
    let from = camera.interior.model();
    let mut conversion = ModelConversion {
        camera: camera.id.clone(),
        from: from.name.to_owned(),
        to: to.name.to_owned(),
        max_px: None,
        rms_px: None,
        share: 1.0,
        dropped: Vec::new(),
    };
    let (interior, left) = interior_of(camera, to)?;
    conversion.worse(&left);
    if from == to {
        return Ok((camera.clone(), conversion));
    }
    let mut changed = Camera { interior, ..camera.clone() };
    changed.sigma.clear();
    for (&parameter, &sigma) in &camera.sigma {
        match counterpart(parameter, from, to) {
            Some(other) => {
                let axis = usize::from(matches!(parameter, Parameter::Fy | Parameter::Y0 | Parameter::Cy));
                let [was, is] = [from, to].map(|m| if m.in_photo_units { camera.pitch()[axis] } else { 1.0 });
                changed.sigma.insert(other, sigma * is / was);
            }
            None => conversion.dropped.push(parameter),
        }
    }
    changed.free = estimated(&camera.estimated(), from, to);
    changed.free.retain(|p| !changed.sigma.contains_key(p));
    Ok((changed, conversion))
}

/// Largest and root mean square difference, pixels, and the share of the picture.
struct Left {
    max_px: Option<f64>,
    rms_px: Option<f64>,
    share: f64,
}

impl ModelConversion {
    fn worse(&mut self, left: &Left) {
        let larger = |a: Option<f64>, b: Option<f64>| a.map_or(b, |a| Some(b.map_or(a, |b| a.max(b))));
        self.max_px = larger(self.max_px, left.max_px);
        self.rms_px = larger(self.rms_px, left.rms_px);
        self.share = self.share.min(left.share);
    }
}

/// Parameters that are independent.
fn alone(model: &CameraModel) -> Vec<Parameter> {
    model.parameters.iter().copied().filter(|p| *p != Parameter::F).collect()
}

/// The parameter of principal distance or point that means the same.
fn counterpart(parameter: Parameter, from: &CameraModel, to: &CameraModel) -> Option<Parameter> {
    use Parameter as P;
    match parameter {
        P::C | P::F | P::Fx | P::Fy if to.parameters.contains(&parameter) => Some(parameter),
        P::C | P::F | P::Fx => Some(to.distance),
        P::X0 | P::Cx => Some(to.centre[0]),
        P::Y0 | P::Cy => Some(to.centre[1]),
        _ => (from == to).then_some(parameter),
    }
}

/// What is estimated of a model where `own` is of another one.
fn estimated(own: &[Parameter], from: &CameraModel, to: &CameraModel) -> Vec<Parameter> {
    use Parameter as P;
    let has = |all: &[P]| own.iter().any(|p| all.contains(p));
    let is_polynomial = |model: &CameraModel| model.radial.len() == 3;
    let is_radial = has(&from.radial.iter().map(|(p, _)| *p).collect::<Vec<_>>());
    let has_decentring = |model: &CameraModel| model.parameters.contains(&P::P1);
    let is_uneven = has(&[P::B1]) || has(&[P::Fy]);
    let wanted = |p: &P| match p {
        P::C => has(&[P::F, P::Fx, P::Fy]),
        P::F => has(&[P::C, P::F]) && !is_uneven,
        P::Fx | P::Fy => is_uneven && has(&[P::C, P::F, P::Fx, P::Fy]),
        P::X0 | P::Cx => has(&[P::X0, P::Cx]),
        P::Y0 | P::Cy => has(&[P::Y0, P::Cy]),
        // two more are nearly equivalent to the others
        P::K5 | P::K6 => false,
        P::K1 | P::K2 | P::K3 | P::K4 if is_polynomial(from) && is_polynomial(to) => own.contains(p),
        P::K1 | P::K2 | P::K3 | P::K4 => is_radial,
        P::P1 | P::P2 if has_decentring(from) => own.contains(p),
        P::P1 | P::P2 => is_radial && has(&from.centre),
        P::B1 => is_uneven,
        P::B2 => own.contains(p),
    };
    to.parameters.iter().copied().filter(wanted).collect()
}

/// An interior orientation of the other model without distortion.
fn plain(camera: &Camera, to: &CameraModel) -> Interior {
    let from = camera.interior.model();
    let [cx, cy] = {
        let at = from.centre.map(|p| camera.interior.get(p).unwrap_or(0.0));
        if from.in_photo_units { camera.pixel_from_photo(at) } else { at }
    };
    let (fx, fy) = (None, None);
    let mut interior = match to.name {
        name if name == CameraModel::BROWN.name => {
            let [x0, y0] = camera.photo_from_pixel([cx, cy]);
            let mut brown = Interior::brown(1.0);
            brown.set(Parameter::X0, x0);
            brown.set(Parameter::Y0, y0);
            brown
        }
        name if name == CameraModel::OPENCV.name => {
            Interior::Opencv { fx, fy, cx, cy, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 }
        }
        name if name == CameraModel::OPENCV_RATIONAL.name => Interior::OpencvRational {
            fx,
            fy,
            cx,
            cy,
            k1: 0.0,
            k2: 0.0,
            p1: 0.0,
            p2: 0.0,
            k3: 0.0,
            k4: 0.0,
            k5: 0.0,
            k6: 0.0,
        },
        _ => Interior::OpencvFisheye { fx, fy, cx, cy, k1: 0.0, k2: 0.0, k3: 0.0, k4: 0.0 },
    };
    interior.forget_principal_distance();
    if let Some(distance) = camera.principal_distance_px() {
        let [width, height] = camera.pitch();
        if to.in_photo_units {
            interior.set(to.distance, distance * width);
        } else {
            // pixels that are not square see a square lens with two principal distances
            let down = match camera.interior.get(Parameter::Fy) {
                Some(fy) => fy,
                None => distance * width / height,
            };
            interior.set(Parameter::Fx, distance);
            interior.set(Parameter::Fy, down);
        }
    }
    interior
}

/// The interior orientation of the other model that images the same.
fn interior_of(camera: &Camera, to: &CameraModel) -> Result<(Interior, Left)> {
    let from = camera.interior.model();
    let start = plain(camera, to);
    let Some(model) = Model::new(&camera.interior) else {
        let interior = if from == to { camera.interior } else { start };
        return Ok((interior, Left { max_px: None, rms_px: None, share: 1.0 }));
    };
    if from == to {
        return Ok((camera.interior, Left { max_px: Some(0.0), rms_px: Some(0.0), share: 1.0 }));
    }
    let fails = || Error::Invalid {
        reason: Reason::ModelNotFitted { model: to.name.to_owned() },
        at: Place::camera(&camera.id),
    };
    let moved: Vec<Parameter> = alone(to).into_iter().filter(|p| !matches!(p, Parameter::K5 | Parameter::K6)).collect();
    let fit = ConversionProblem { camera, moved, rays: rays(camera, &model, to, FITTED).0 };
    if 2 * fit.rays.len() <= fit.moved.len() {
        return Err(fails());
    }
    let interior = fit.fitted(start).ok_or_else(fails)?;
    let (stated, of) = rays(camera, &model, to, STATED);
    let fitted = Model::new(&interior).ok_or_else(fails)?;
    let other = Camera { interior, ..camera.clone() };
    let apart = |(pixel, ray): &PixelRay| {
        let image = fitted.pixel(&other, *ray)?;
        Some((image[0] - pixel[0]).hypot(image[1] - pixel[1]))
    };
    let lengths: Vec<f64> = stated.iter().filter_map(apart).collect();
    if lengths.is_empty() {
        return Err(fails());
    }
    let rms = (lengths.iter().map(|d| d * d).sum::<f64>() / lengths.len() as f64).sqrt();
    let left = Left {
        max_px: lengths.iter().copied().reduce(f64::max),
        rms_px: Some(rms),
        share: lengths.len() as f64 / of.max(1) as f64,
    };
    Ok((interior, left))
}

/// A pixel and its ray in the camera frame.
type PixelRay = ([f64; 2], [f64; 3]);

/// Pixels from border to border with their rays in the camera frame, as far as the other model can have images of them, and how many have rays.
fn rays(camera: &Camera, model: &Model, to: &CameraModel, across: u32) -> (Vec<PixelRay>, usize) {
    let step = |k: u32, size: u32| f64::from(size) * f64::from(k) / f64::from(across - 1);
    let mut all = Vec::new();
    let mut count = 0;
    for (j, i) in (0..across).flat_map(|j| (0..across).map(move |i| (j, i))) {
        let pixel = [step(i, camera.width), step(j, camera.height)];
        let Some(ray) = model.ray(camera, pixel) else { continue };
        count += 1;
        let length = ray.iter().map(|x| x * x).sum::<f64>().sqrt();
        if to.is_wide || -ray[2] > FARTHEST * length {
            all.push((pixel, ray.map(|x| x / length)));
        }
    }
    (all, count)
}

/// The least squares problem.
struct ConversionProblem<'a> {
    camera: &'a Camera,
    moved: Vec<Parameter>,
    rays: Vec<PixelRay>,
}

impl ConversionProblem<'_> {
    /// Differences in pixels, two rows for each ray, and their derivatives; `None` if the model does not project a ray.
    fn linear(&self, interior: &Interior) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let model = Model::new(interior)?;
        let camera = Camera { interior: *interior, ..self.camera.clone() };
        let pitch = camera.residual_pitch();
        let place = |p: &Parameter| interior.parameters().iter().position(|own| own == p);
        let columns: Vec<usize> = self.moved.iter().map(place).collect::<Option<_>>()?;
        let mut e = DVector::zeros(2 * self.rays.len());
        let mut j = DMatrix::zeros(2 * self.rays.len(), columns.len());
        for (n, (pixel, ray)) in self.rays.iter().enumerate() {
            let linear = model.linearise(measurement_from_pixel(&camera, *pixel), *ray, ResidualPlace::Measured)?;
            for s in 0..2 {
                e[2 * n + s] = linear.residual[s] / pitch[s];
                columns.iter().enumerate().for_each(|(k, c)| {
                    j[(2 * n + s, k)] = linear.by_parameter[s][*c] / pitch[s];
                });
            }
        }
        (e.iter().chain(j.iter()).all(|x| x.is_finite())).then_some((e, j))
    }

    fn fitted(&self, start: Interior) -> Option<Interior> {
        let mut interior = start;
        let (mut e, mut j) = self.linear(&interior)?;
        let mut damping = 1e-3;
        for _ in 0..ITERATIONS {
            let scales: Vec<f64> = j.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE)).collect();
            let mut improved = None;
            while damping < 1e9 {
                let n = scales.len();
                // columns of one length: a K1 per square millimetre beside a principal distance in pixels
                let mut damped = j.clone().insert_rows(j.nrows(), n, 0.0);
                for (k, scale) in scales.iter().enumerate() {
                    damped.column_mut(k).unscale_mut(*scale);
                    damped[(j.nrows() + k, k)] = damping;
                }
                let mut right = (-&e).insert_rows(e.nrows(), n, 0.0);
                let qr = damped.qr();
                qr.q_tr_mul(&mut right);
                let step = qr.r().solve_upper_triangular(&right.rows(0, n).into_owned())?;
                let mut trial = interior;
                for (k, p) in self.moved.iter().enumerate() {
                    trial.set(*p, interior.get(*p)? + step[k] / scales[k]);
                }
                match self.linear(&trial) {
                    Some((next, derivatives)) if next.norm_squared() < e.norm_squared() => {
                        let gain = 1.0 - next.norm_squared() / e.norm_squared();
                        (interior, e, j) = (trial, next, derivatives);
                        damping = (damping * 0.1).max(1e-12);
                        improved = Some(gain);
                        break;
                    }
                    _ => damping *= 10.0,
                }
            }
            // a millionth of the sum is a thousandth of the largest difference or less
            if improved.is_none_or(|gain| gain < 1e-9) {
                break;
            }
        }
        Some(interior)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn camera(interior: Interior) -> Camera {
        let mut camera = Camera::new("k", 1280, 720, interior);
        camera.pixel_pitch = Some([0.005, 0.005]);
        camera
    }

    fn project(camera: Camera) -> Project {
        Project { cameras: vec![camera], ..Project::default() }
    }

    fn opencv(k: [f64; 3], p: [f64; 2]) -> Interior {
        let (fx, fy) = (Some(900.0), Some(903.0));
        Interior::Opencv { fx, fy, cx: 645.0, cy: 352.0, k1: k[0], k2: k[1], p1: p[0], p2: p[1], k3: k[2] }
    }

    #[test]
    fn a_lens_that_both_models_have_is_converted_exactly_and_back() {
        let given = camera(opencv([-0.2, 0.05, -0.004], [1e-3, -4e-4]));
        let (there, left) = convert_camera(&project(given.clone()), "k", "opencv_rational").unwrap();
        assert!(left.max_px.unwrap() < 1e-6 && left.share == 1.0, "{left:?}");
        let (back, left) = convert_camera(&there, "k", "opencv").unwrap();
        assert!(left.max_px.unwrap() < 1e-6, "{left:?}");
        for p in alone(&CameraModel::OPENCV) {
            let [a, b] = [&given, &back.cameras[0]].map(|c| c.interior.get(p).unwrap());
            assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "{p}: {a} {b}");
        }
        // without distortion Brown is opencv, in millimetres or pixels
        for pitch in [None, Some([0.005, 0.004])] {
            let straight = Camera { pixel_pitch: pitch, ..camera(opencv([0.0; 3], [0.0; 2])) };
            let (brown, left) = convert_camera(&project(straight), "k", "brown").unwrap();
            assert!(left.max_px.unwrap() < 1e-6, "{left:?}");
            let c = brown.cameras[0].interior.get(Parameter::C).unwrap();
            let (_, again) = convert_camera(&brown, "k", "opencv").unwrap();
            assert!(c > 0.0 && again.max_px.unwrap() < 1e-6, "{again:?}");
        }
    }

    #[test]
    fn what_a_model_cannot_follow_is_stated() {
        let mild = camera(opencv([-0.1, 0.02, 0.0], [0.0; 2]));
        let (_, left) = convert_camera(&project(mild), "k", "brown").unwrap();
        assert!((1e-4..0.5).contains(&left.max_px.unwrap()), "{left:?}");
        let fisheye = Interior::OpencvFisheye {
            fx: Some(330.0),
            fy: Some(331.5),
            cx: 645.0,
            cy: 352.0,
            k1: -0.012,
            k2: 0.004,
            k3: -0.0011,
            k4: 0.00011,
        };
        // 111 degrees off the axis at the edges: a perspective model images a part of it
        let (_, left) = convert_camera(&project(camera(fisheye)), "k", "opencv_rational").unwrap();
        assert!((0.3..0.9).contains(&left.share), "{left:?}");
    }

    #[test]
    fn what_is_estimated_and_observed_keeps_its_meaning() {
        let mut brown = camera(Interior::brown(5.0));
        brown.free = vec![Parameter::X0, Parameter::K1, Parameter::K2, Parameter::P1];
        brown.sigma = [(Parameter::C, 0.01), (Parameter::K3, 1e-3)].into();
        let (changed, left) = convert_camera(&project(brown), "k", "opencv").unwrap();
        let camera = &changed.cameras[0];
        assert_eq!(camera.free, [Parameter::Cx, Parameter::K1, Parameter::K2, Parameter::P1, Parameter::K3]);
        // 0.01 mm of pixels of 0.005 mm
        assert!((camera.sigma[&Parameter::F] - 2.0).abs() < 1e-12 && camera.sigma.len() == 1);
        assert_eq!(left.dropped, [Parameter::K3]);
        changed.validate().unwrap();
        let (fisheye, _) = convert_camera(&changed, "k", "opencv_fisheye").unwrap();
        use Parameter as P;
        assert_eq!(fisheye.cameras[0].free, [P::Cx, P::K1, P::K2, P::K3, P::K4]);
    }

    #[test]
    fn photos_come_with_it_and_an_unknown_distance_stays_unknown() {
        let mut given = project(camera(opencv([-0.2, 0.05, 0.0], [0.0; 2])));
        given.cameras[0].per_photo = true;
        given.photos = vec![crate::project::Photo {
            id: "1".into(),
            camera: "k".into(),
            interior: Some(opencv([-0.21, 0.05, 0.0], [0.0; 2])),
            enabled: true,
            ..Default::default()
        }]
        .into();
        let (changed, left) = convert_camera(&given, "k", "opencv_rational").unwrap();
        changed.validate().unwrap();
        assert!(left.max_px.unwrap() < 1e-6);
        assert_eq!(changed.photos[0].interior.unwrap().model(), &CameraModel::OPENCV_RATIONAL);
        let mut unknown = given.clone();
        unknown.photos.clear();
        unknown.cameras[0].interior.forget_principal_distance();
        let (changed, left) = convert_camera(&unknown, "k", "brown").unwrap();
        assert_eq!((changed.cameras[0].principal_distance_px(), left.max_px), (None, None));
        assert!(convert_camera(&unknown, "k", "pinhole").is_err() && convert_camera(&unknown, "x", "brown").is_err());
    }
}
