//! Camera chains of Kalibr (`camchain.yaml`).
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0, 0): the principal point is ours - 0.5 |
//! | axes | x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | distortion | ideal to image: `pinhole` with `radtan` k1 k2 r1 r2 (OpenCV's k1 k2 p1 p2) `equidistant` k1 k2 k3 k4 of the angle off the axis, or `none` |
//! | poses | `T_cn_cnm1` takes points of the camera before into this one; the first camera is the object system |
//!
//! Source: Kalibr's wiki, "Supported models" and "Yaml formats". `omni`, `ds`, `eucm` cameras and `fov` distortions are refused by
//! name.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};

use super::Files;
use super::foreign::{self, CameraOptions, ExportedCamera, ForeignCamera, Notes, Pose};
use super::lens::Lens;
use super::opencv::{self, FISHEYE, MODELS, PIXEL};
use super::tree::{Node, real};
use sightline::error::Result;
use sightline::project::Camera;

/// Whether a tree is of this format.
pub fn recognises(root: &Node<'_>) -> bool {
    root.get("cam0").is_some_and(|camera| camera.get("camera_model").is_some() && camera.get("intrinsics").is_some())
}

/// The cameras of a chain.
///
/// # Errors
/// [`crate::Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`] for a lens that is not perspective.
pub fn read(root: &Node<'_>, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let mut cameras = Vec::new();
    // A chain that is not joined has no pose from there on.
    let mut before = Some(Pose { rotation: Matrix3::identity(), position: [0.0; 3] });
    for k in 0.. {
        let name = format!("cam{k}");
        let Some(node) = root.get(&name) else { break };
        let model = node.need("camera_model")?;
        if model.text()? != "pinhole" {
            return Err(model.invalid(ExchangeReason::NoSuchCameraModel { model: model.text()? }.into()));
        }
        let [fx, fy, cx, cy] = node.need("intrinsics")?.exactly()?;
        let distortion = node.get("distortion_model").map_or(Ok("none".to_owned()), |model| model.text())?;
        let given: Vec<f64> = match distortion.as_str() {
            "radtan" | "equidistant" => node.need("distortion_coeffs")?.exactly::<4>()?.to_vec(),
            "none" => Vec::new(),
            other => {
                let model = ExchangeReason::NoSuchCameraModel { model: format!("pinhole-{other}") }.into();
                return Err(node.need("distortion_model")?.invalid(model));
            }
        };
        let focal = node.need("intrinsics")?;
        if !(fx > 0.0 && fy > 0.0) {
            return Err(focal.expected("focal lengths above 0"));
        }
        let matrix = [fx, fy, cx, cy, 0.0];
        let (shape, lens) = if distortion == "equidistant" {
            opencv::fisheye_lens(matrix, &given, PIXEL, &focal)?
        } else {
            opencv::lens(matrix, &given, PIXEL, &focal)?
        };
        let resolution = node.need("resolution")?;
        let [width, height] = &resolution.items()?[..] else { return Err(resolution.expected("width and height")) };
        let mut camera = ForeignCamera::new(name.clone(), [width.size()?, height.size()?], shape, lens);
        if k > 0 {
            let joined = before.zip(node.get("T_cn_cnm1"));
            before = joined.map(|(before, transform)| after(&before, &transform)).transpose()?;
        }
        camera.pose = before;
        let read = ["camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution", "T_cn_cnm1"];
        for other in node.names().into_iter().filter(|other| !read.contains(other)) {
            notes.ignore(other, 1);
        }
        cameras.push(camera);
    }
    for name in root.names().into_iter().filter(|name| !cameras.iter().any(|camera| camera.id == *name)) {
        notes.ignore(name, 1);
    }
    if cameras.is_empty() {
        return Err(root.expected("a chain of cameras: cam0, cam1, ..."));
    }
    Ok(cameras)
}

/// The pose of a camera that a transform joins to the one before.
fn after(before: &Pose, node: &Node<'_>) -> Result<Pose> {
    let mut all = Vec::new();
    for row in node.items()? {
        all.extend(row.numbers()?);
    }
    let expected = || node.expected("4 x 4 numbers: a rotation and a translation");
    if all.len() != 16 {
        return Err(expected());
    }
    let rotation = Matrix3::from_fn(|i, k| all[4 * i + k]);
    let translation = Vector3::new(all[3], all[7], all[11]);
    let whole = rotation * before.rotation;
    let moved = rotation * Vector3::from(before.translation()) + translation;
    Pose::new(whole, moved.into()).ok_or_else(expected)
}

/// The camera as a chain of one.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let out = foreign::outgoing(camera, &[MODELS[0], &FISHEYE], &Lens::default(), options)?;
    let [fx, fy, cx, cy] = [out.values[0], out.values[1], out.values[2] - PIXEL, out.values[3] - PIXEL];
    let list = |values: &[f64]| values.iter().map(|value| real(*value)).collect::<Vec<_>>().join(", ");
    let mut text = String::from("cam0:\n  cam_overlaps: []\n  camera_model: pinhole\n");
    let model = if out.shape.equidistant { "equidistant" } else { "radtan" };
    let _ = writeln!(text, "  distortion_coeffs: [{}]\n  distortion_model: {model}", list(&out.values[4..]));
    let _ = writeln!(text, "  intrinsics: [{}]", list(&[fx, fy, cx, cy]));
    let _ = writeln!(text, "  resolution: [{}, {}]", camera.width, camera.height);
    let mut files = Files::from([("camchain.yaml".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, &format!("pinhole-{model}"), covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}
