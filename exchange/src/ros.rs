//! `camera_info` of ROS, the YAML that `camera_calibration` writes.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0, 0): cx, cy are ours - 0.5 |
//! | axes | x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | distortion | ideal to image: `plumb_bob` k1 k2 p1 p2 k3, `rational_polynomial` with k4 k5 k6 too, as OpenCV; `equidistant` k1 k2 k3 k4 of the angle off the axis |
//!
//! Source: sensor_msgs/CameraInfo and distortion_models.hpp of common_interfaces; image_pipeline, camera_calibration. The rectification
//! and projection matrices of a stereo pair are derived from the rest and not read.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::Files;
use super::foreign::{self, CameraOptions, ExportedCamera, ForeignCamera, Notes};
use super::lens::Lens;
use super::opencv::{self, FISHEYE, MODELS, PIXEL};
use super::tree::{Node, real};
use sightline::error::Result;
use sightline::project::Camera;

/// Whether a tree is of this format.
pub fn recognises(root: &Node<'_>) -> bool {
    root.get("distortion_model").is_some() && root.get("camera_matrix").is_some()
}

/// The camera of a tree.
///
/// # Errors
/// [`crate::Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`] for another model.
pub fn read(root: &Node<'_>, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let size = [root.need("image_width")?.size()?, root.need("image_height")?.size()?];
    let matrix = root.need("camera_matrix")?;
    let (rows, columns, k) = matrix.matrix()?;
    if (rows, columns) != (3, 3) || k[8] != 1.0 || !(k[0] > 0.0 && k[4] > 0.0) {
        return Err(matrix.expected("a camera matrix: fx 0 cx, 0 fy cy, 0 0 1"));
    }
    let model = root.need("distortion_model")?;
    let coefficients = root.need("distortion_coefficients")?;
    let mut given = coefficients.matrix()?.2;
    let is_fisheye = match model.text()?.as_str() {
        "plumb_bob" | "rational_polynomial" => false,
        "equidistant" | "fisheye" => true,
        // "thin_prism" and others with what OpenCV has by their numbers are taken; the rest has no model.
        other => return Err(model.invalid(ExchangeReason::NoSuchCameraModel { model: other.to_owned() }.into())),
    };
    if given.is_empty() {
        given = vec![0.0; if is_fisheye { 4 } else { 5 }];
    }
    let matrix = [k[0], k[4], k[2], k[5], k[1]];
    let (shape, lens) = if is_fisheye {
        opencv::fisheye_lens(matrix, &given, PIXEL, &coefficients)?
    } else {
        opencv::lens(matrix, &given, PIXEL, &coefficients)?
    };
    let id = root.get("camera_name").map(|name| name.text()).transpose()?.filter(|name| !name.trim().is_empty());
    let read =
        ["image_width", "image_height", "camera_name", "camera_matrix", "distortion_model", "distortion_coefficients"];
    for name in root.names().into_iter().filter(|name| !read.contains(name)) {
        notes.ignore(name, 1);
    }
    Ok(vec![ForeignCamera::new(id.unwrap_or_else(|| "camera".into()), size, shape, lens)])
}

/// The camera as `camera_info`.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let out = foreign::outgoing(camera, &[MODELS[1], MODELS[2], &FISHEYE], &Lens::default(), options)?;
    let [fx, fy, cx, cy] = [out.values[0], out.values[1], out.values[2] - PIXEL, out.values[3] - PIXEL];
    let distortion = &out.values[4..];
    let model = match distortion.len() {
        4 => "equidistant",
        5 => "plumb_bob",
        _ => "rational_polynomial",
    };
    let list = |values: &[f64]| values.iter().map(|value| real(*value)).collect::<Vec<_>>().join(", ");
    let mut text = String::new();
    let _ = writeln!(text, "image_width: {}\nimage_height: {}", camera.width, camera.height);
    let _ = writeln!(text, "camera_name: {}", serde_json::Value::from(camera.id.as_str()));
    let matrix = |name: &str, rows: usize, columns: usize, values: &[f64]| {
        format!("{name}:\n  rows: {rows}\n  cols: {columns}\n  data: [{}]\n", list(values))
    };
    text += &matrix("camera_matrix", 3, 3, &[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]);
    let _ = writeln!(text, "distortion_model: {model}");
    text += &matrix("distortion_coefficients", 1, distortion.len(), distortion);
    text += &matrix("rectification_matrix", 3, 3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    text += &matrix("projection_matrix", 3, 4, &[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let mut files = Files::from([("camera_info.yaml".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, model, covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}
