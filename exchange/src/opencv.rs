//! Cameras in OpenCV's FileStorage, as YAML, XML or JSON.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0, 0): cx, cy are ours - 0.5 |
//! | axes | x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | distortion | ideal to image, on a and b; k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 τx τy, of which the first 4, 5, 8, 12 or 14 are given |
//!
//! Source: OpenCV, "Camera calibration and 3D reconstruction" and `samples/cpp/calibration.cpp`, which writes `camera_matrix`,
//! `distortion_coefficients`, `image_width`, `image_height`, `fisheye_model`. Stereo calibrations have `M1`, `D1`, `M2`, `D2`.
//! With `fisheye_model` other than 0 the coefficients are k1 k2 k3 k4 of `cv::fisheye`. Poses of boards and their image points are not read.

use crate::reason::ExchangeReason;
use std::collections::BTreeMap;
use std::fmt::Write;

use super::foreign::{self, Assumed, CameraOptions, ExportedCamera, ForeignCamera, Notes};
use super::lens::{Lens, LensModel, term::*};
use super::tree::{Node, real};
use super::{Files, network};
use sightline::error::{Error, Lack, Result};
use sightline::project::{Camera, Observation, Project};

/// Its models by the number of coefficients.
pub const MODELS: [&LensModel; 5] = [
    &LensModel { name: "OpenCV 4", parameters: OPENCV14.parameters.split_at(8).0, equidistant: false },
    &LensModel { name: "OpenCV 5", parameters: OPENCV14.parameters.split_at(9).0, equidistant: false },
    &LensModel { name: "OpenCV 8", parameters: OPENCV14.parameters.split_at(12).0, equidistant: false },
    &LensModel { name: "OpenCV 12", parameters: OPENCV14.parameters.split_at(16).0, equidistant: false },
    &OPENCV14,
];

/// Its fisheye model.
pub static FISHEYE: LensModel = LensModel {
    name: "OpenCV fisheye",
    equidistant: true,
    parameters: &[
        ("fx", &[FX]),
        ("fy", &[FY]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("k4", &[K4]),
    ],
};

/// Models that are written.
static WRITTEN: [&LensModel; 6] = [MODELS[0], MODELS[1], MODELS[2], MODELS[3], MODELS[4], &FISHEYE];

const OPENCV14: LensModel = LensModel {
    name: "OpenCV 14",
    equidistant: false,
    parameters: &[
        ("fx", &[FX]),
        ("fy", &[FY]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("p1", &[P1]),
        ("p2", &[P2]),
        ("k3", &[K3]),
        ("k4", &[D1]),
        ("k5", &[D2]),
        ("k6", &[D3]),
        ("s1", &[S1]),
        ("s2", &[S2]),
        ("s3", &[S3]),
        ("s4", &[S4]),
        ("tx", &[TX]),
        ("ty", &[TY]),
    ],
};

/// Our pixel frame minus OpenCV's, in which the centre of the first pixel is (0, 0).
pub const PIXEL: f64 = 0.5;

/// Names of a camera matrix and of its coefficients.
const PAIRS: [(&str, &[&str]); 12] = [
    ("camera_matrix", &["distortion_coefficients", "dist_coeffs", "dist_coeff", "distortion", "distCoeffs"]),
    ("Camera_Matrix", &["Distortion_Coefficients"]),
    ("cameraMatrix", &["distCoeffs", "distortionCoefficients", "dist_coeffs"]),
    ("CameraMatrix", &["DistCoeffs", "DistortionCoefficients"]),
    ("intrinsic_matrix", &["distortion_coefficients", "distortion"]),
    ("K", &["D", "dist", "distortion"]),
    ("mtx", &["dist"]),
    ("M1", &["D1"]),
    ("M2", &["D2"]),
    ("K1", &["D1"]),
    ("K2", &["D2"]),
    ("cameraMatrix1", &["distCoeffs1"]),
];
const FISHEYE_NAMES: [&str; 2] = ["fisheye_model", "fisheye"];
const WIDTH: [&str; 6] = ["image_width", "image_Width", "imageWidth", "width", "img_width", "Image_Width"];
const HEIGHT: [&str; 6] = ["image_height", "image_Height", "imageHeight", "height", "img_height", "Image_Height"];
const SIZE: [&str; 5] = ["image_size", "imageSize", "img_size", "Image_Size", "resolution"];

/// Whether a tree has a camera of this format.
pub fn recognises(root: &Node<'_>) -> bool {
    PAIRS
        .iter()
        .any(|(name, _)| root.get(name).is_some_and(|node| node.matrix().is_ok_and(|(r, c, _)| (r, c) == (3, 3))))
}

/// Cameras of a tree.
///
/// # Errors
/// [`Error::Invalid`] with the element.
pub fn read(root: &Node<'_>, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let mut used: Vec<&str> = Vec::new();
    let mut cameras = Vec::new();
    for (name, coefficients) in PAIRS {
        let Some(matrix) = root.get(name) else { continue };
        let fisheye = FISHEYE_NAMES.iter().find(|name| root.get(name).is_some());
        used.extend(fisheye);
        let is_fisheye = fisheye.and_then(|name| root.get(name)).is_some_and(|node| {
            node.value.as_bool().unwrap_or_else(|| node.number().is_ok_and(|number| number != 0.0))
        });
        let k = camera_matrix(&matrix)?;
        used.push(name);
        let distortion = root.any(coefficients);
        let given = match &distortion {
            Some(node) => node.matrix()?.2,
            None => Vec::new(),
        };
        if let Some(name) = coefficients.iter().find(|name| root.get(name).is_some()) {
            used.push(name);
        }
        let at = distortion.as_ref().unwrap_or(&matrix);
        let (shape, lens) = if is_fisheye { fisheye_lens(k, &given, PIXEL, at)? } else { lens(k, &given, PIXEL, at)? };
        if given.len() == 4 && fisheye.is_none() {
            notes.assume(Assumed::FourCoefficientsRadialTangential);
        }
        let size = size(root, &lens, &mut used, notes)?;
        let id = if cameras.is_empty() { "camera".to_owned() } else { format!("camera {}", cameras.len() + 1) };
        cameras.push(ForeignCamera::new(id, size, shape, lens));
    }
    if cameras.is_empty() {
        return Err(root.expected("a 3 x 3 matrix camera_matrix with distortion_coefficients"));
    }
    for name in root.names().into_iter().filter(|name| !used.contains(name)) {
        notes.ignore(name, 1);
    }
    Ok(cameras)
}

/// fx, fy, cx, cy, skew of a camera matrix.
fn camera_matrix(node: &Node<'_>) -> Result<[f64; 5]> {
    let (rows, columns, values) = node.matrix()?;
    let right = |k: &[f64]| k[3] == 0.0 && k[6] == 0.0 && k[7] == 0.0 && k[8] == 1.0 && k[0] > 0.0 && k[4] > 0.0;
    if (rows, columns) != (3, 3) || !right(&values) {
        return Err(node.expected("a camera matrix: fx 0 cx, 0 fy cy, 0 0 1"));
    }
    Ok([values[0], values[4], values[2], values[5], values[1]])
}

/// The lens of a camera matrix and coefficients in OpenCV's order, in a pixel frame that is `pixel` less than ours.
pub fn lens(
    [fx, fy, cx, cy, skew]: [f64; 5],
    coefficients: &[f64],
    pixel: f64,
    at: &Node<'_>,
) -> Result<(&'static LensModel, Lens)> {
    let shape = match coefficients.len() {
        0 | 4 => MODELS[0],
        5 => MODELS[1],
        8 => MODELS[2],
        12 => MODELS[3],
        14 => MODELS[4],
        other => {
            let found = format!("{other} coefficients");
            return Err(at.invalid(
                ExchangeReason::ExpectedHere { expected: "4, 5, 8, 12 or 14 coefficients".into(), found }.into(),
            ));
        }
    };
    let mut values = vec![fx, fy, cx + pixel, cy + pixel];
    values.extend(coefficients);
    let mut lens = shape.lens(&Lens::default(), &values);
    lens.terms[SKEW] = skew;
    Ok((shape, lens))
}

/// The fisheye lens of a camera matrix and k1 k2 k3 k4, in a pixel frame that is `pixel` less than ours.
pub fn fisheye_lens(
    [fx, fy, cx, cy, skew]: [f64; 5],
    coefficients: &[f64],
    pixel: f64,
    at: &Node<'_>,
) -> Result<(&'static LensModel, Lens)> {
    if ![0, 4].contains(&coefficients.len()) {
        let found = format!("{} coefficients", coefficients.len());
        return Err(
            at.invalid(ExchangeReason::ExpectedHere { expected: "4 coefficients of a fisheye".into(), found }.into())
        );
    }
    let mut values = vec![fx, fy, cx + pixel, cy + pixel];
    values.extend(coefficients);
    let mut lens = FISHEYE.lens(&Lens::default(), &values);
    lens.terms[SKEW] = skew;
    Ok((&FISHEYE, lens))
}

/// Size of the picture.
fn size<'a>(root: &Node<'a>, lens: &Lens, used: &mut Vec<&'a str>, notes: &mut Notes) -> Result<[u32; 2]> {
    if let (Some(width), Some(height)) = (root.any(&WIDTH), root.any(&HEIGHT)) {
        used.extend(root.names().into_iter().filter(|name| WIDTH.contains(name) || HEIGHT.contains(name)));
        return Ok([width.size()?, height.size()?]);
    }
    if let Some(node) = root.any(&SIZE) {
        used.extend(root.names().into_iter().filter(|name| SIZE.contains(name)));
        let items = node.items()?;
        if let [width, height] = &items[..] {
            return Ok([width.size()?, height.size()?]);
        }
        return Err(node.expected("width and height"));
    }
    notes.assume(Assumed::ImageSizeFromPrincipalPoint);
    Ok(twice_principal_point(lens))
}

/// Size of a picture whose principal point is its centre.
pub fn twice_principal_point(lens: &Lens) -> [u32; 2] {
    [CX, CY].map(|k| (2.0 * lens.terms[k]).round().clamp(1.0, 1e6) as u32)
}

/// The camera as a FileStorage in YAML.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let out = foreign::outgoing(camera, &WRITTEN, &Lens::default(), options)?;
    let mut text = String::from("%YAML:1.0\n---\n");
    camera_text(&mut text, camera, &out);
    let mut files = Files::from([("camera.yml".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, out.shape.name, covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}

fn camera_text(text: &mut String, camera: &Camera, out: &foreign::Outgoing) {
    let values = &out.values;
    let [fx, fy, cx, cy] = [values[0], values[1], values[2] - PIXEL, values[3] - PIXEL];
    let _ = writeln!(text, "image_width: {}\nimage_height: {}", camera.width, camera.height);
    if out.shape.equidistant {
        let _ = writeln!(text, "fisheye_model: 1");
    }
    matrix(text, "camera_matrix", 3, 3, &[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0], 0);
    matrix(text, "distortion_coefficients", values.len() - 4, 1, &values[4..], 0);
}

/// A matrix of FileStorage; its lines are indented by `indent` blanks.
fn matrix(text: &mut String, name: &str, rows: usize, columns: usize, values: &[f64], indent: usize) {
    let blanks = " ".repeat(indent);
    let _ = writeln!(text, "{blanks}{name}: !!opencv-matrix");
    let _ = writeln!(text, "{blanks}   rows: {rows}\n{blanks}   cols: {columns}\n{blanks}   dt: d");
    let numbers: Vec<String> = values.iter().map(|value| real(*value)).collect();
    let lines: Vec<String> = numbers.chunks(3).map(|line| line.join(", ")).collect();
    let _ = writeln!(text, "{blanks}   data: [ {} ]", lines.join(&format!(",\n{blanks}       ")));
}

/// A quoted text of FileStorage.
fn quoted(text: &str) -> String {
    let kept: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("\"{}\"", kept.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Image and object points of every photo, for OpenCV's functions that take them: a file a camera with `photos`, each with its file, names,
/// `image_points` and `object_points`.
///
/// # Errors
/// As [`foreign::outgoing`]; [`Error::Empty`] if no photo has points with coordinates.
pub fn write_points(project: &Project, convert: bool) -> Result<Files> {
    let points: std::collections::HashMap<&str, [f64; 3]> =
        project.points.iter().filter_map(|point| Some((point.id.as_str(), point.xyz?))).collect();
    let mut seen_in: std::collections::HashMap<&str, Vec<&Observation>> = std::collections::HashMap::new();
    for seen in project.observations.iter().filter(|seen| seen.enabled) {
        seen_in.entry(&seen.photo).or_default().push(seen);
    }
    let (mut files, mut conversions, mut notes) = (Files::new(), Vec::new(), Notes::default());
    for camera in &project.cameras {
        let mut photos = String::new();
        for photo in project.photos.iter().filter(|photo| photo.enabled && photo.camera == camera.id) {
            let (mut names, mut image, mut object) = (Vec::new(), Vec::new(), Vec::new());
            for seen in seen_in.get(photo.id.as_str()).into_iter().flatten() {
                let Some(xyz) = points.get(seen.point.as_str()) else {
                    notes.ignore("observations of points without coordinates", 1);
                    continue;
                };
                names.push(quoted(&seen.point));
                image.extend([seen.u - PIXEL, seen.v - PIXEL]);
                object.extend(xyz);
            }
            if names.is_empty() {
                notes.ignore("photos without points", 1);
                continue;
            }
            let _ = writeln!(photos, "   -\n      id: {}\n      file: {}", quoted(&photo.id), quoted(&photo.file));
            let _ = writeln!(photos, "      points: [ {} ]", names.join(", "));
            matrix(&mut photos, "image_points", names.len(), 2, &image, 6);
            matrix(&mut photos, "object_points", names.len(), 3, &object, 6);
            notes.ignore("interior orientations of photos", usize::from(photo.interior.is_some()));
        }
        if photos.is_empty() {
            continue;
        }
        let options = CameraOptions { convert, ..CameraOptions::default() };
        let out = foreign::outgoing(camera, &WRITTEN, &Lens::default(), &options)?;
        let mut text = String::from("%YAML:1.0\n---\n");
        camera_text(&mut text, camera, &out);
        text.push_str("photos:\n");
        text.push_str(&photos);
        conversions.extend(out.conversion);
        files.insert(format!("calibration-{}.yml", files.len() + 1), text.into_bytes());
    }
    if files.is_empty() {
        return Err(Error::Empty { what: Lack::Photos });
    }
    let (photos, points) = (BTreeMap::new(), BTreeMap::new());
    files.extend([network::companion(&network::Companion { conversions, photos, points, ignored: &notes.ignored })?]);
    Ok(files)
}
