//! Scenes of AliceVision and Meshroom (`.sfm`, JSON), versions 1.0 to 1.2.14.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the principal point of a centred camera is half the size of the picture: ours, and as AliceVision exports it to COLMAP |
//! | axes | camera: x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | rotation | matrix object to camera, by columns, and the projection centre |
//! | distortion | ideal to image: radial k1, radial k1 k2 k3, brown k1 k2 k3 t1 t2 (OpenCV's p1 p2), fisheye4 k1 k2 k3 k4 of the angle off the axis |
//! | focal length | pixels before 1.2.2; then millimetres with the sensor's width; `pixelRatio` is fx/fy before 1.2.5, then fy/fx |
//! | principal point | from the upper left corner before 1.2.1, then from the centre of the picture |
//!
//! Source: AliceVision, `sfmDataIO/jsonIO.cpp` and `sfmDataIO/CHANGES.md`. Other fisheye, 3DEqualizer and other models are refused by name. Photos of rigs have no pose of
//! their own; metadata, colours and feature files are counted.

use crate::reason::ExchangeReason;
use serde_json::{Map, Value, json};

use super::Files;
use super::foreign::{Assumed, ForeignCamera, Notes, Pose};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork, Models, OutgoingNetwork};
use super::tree::Node;
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::Point;

/// Its models; cx, cy are values of our frame here.
pub static BROWN: LensModel = LensModel {
    name: "brown",
    equidistant: false,
    parameters: &[
        ("fx", &[FX]),
        ("fy", &[FY]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("t1", &[P1]),
        ("t2", &[P2]),
    ],
};

/// Its fisheye with four coefficients.
static FISHEYE4: LensModel = LensModel {
    name: "fisheye4",
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

/// Whether a tree is of this format.
pub fn recognises(root: &Node<'_>) -> bool {
    root.get("version").is_some_and(|version| version.value.is_array()) && root.get("intrinsics").is_some()
}

/// The cameras of a scene.
///
/// # Errors
/// [`Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`].
pub fn cameras(root: &Node<'_>, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let version = root.need("version")?.exactly::<3>()?;
    let before = |other: [f64; 3]| version < other;
    if version[0] != 1.0 || version > [1.0, 2.0, 99.0] {
        return Err(root.need("version")?.expected("version 1.0 to 1.2"));
    }
    let mut cameras = Vec::new();
    for node in root.need("intrinsics")?.items()? {
        let size = [node.need("width")?.size()?, node.need("height")?.size()?];
        let [width, height] = size.map(f64::from);
        let mut pp: [f64; 2] = node.need("principalPoint")?.exactly()?;
        if !before([1.0, 2.0, 1.0]) {
            pp = [pp[0] + width / 2.0, pp[1] + height / 2.0];
        }
        let focal = if before([1.0, 2.0, 0.0]) {
            let f = node.need("pxFocalLength")?.positive()?;
            [f, f]
        } else if before([1.0, 2.0, 2.0]) {
            node.need("pxFocalLength")?.exactly()?
        } else {
            let sensor = node.get("sensorWidth").map_or(Ok(36.0), |width| width.positive())?;
            let f = node.need("focalLength")?.positive()? / sensor * width;
            let ratio = node.get("pixelRatio").map_or(Ok(1.0), |ratio| ratio.positive())?;
            [f, if before([1.0, 2.0, 5.0]) { f / ratio } else { f * ratio }]
        };
        let kind = node.need("type")?.text()?;
        let distortion = node.get("distortionType").map(|kind| kind.text()).transpose()?;
        let coefficients: &[usize] = match (kind.as_str(), distortion.as_deref()) {
            ("pinhole", None | Some("none")) => &[],
            ("radial1", None) | ("pinhole", Some("radialk1")) => &[K1],
            ("radial3", None) | ("pinhole", Some("radialk3")) => &[K1, K2, K3],
            ("brown", None) | ("pinhole", Some("brown")) => &[K1, K2, K3, P1, P2],
            ("fisheye4", None) | ("pinhole", Some("fisheye4")) => &[K1, K2, K3, K4],
            (kind, distortion) => {
                let model = shortened(&[kind, distortion.unwrap_or_default()].join(" "));
                return Err(node.need("type")?.invalid(ExchangeReason::NoSuchCameraModel { model }.into()));
            }
        };
        if let Some(undistortion) = node.get("undistortionParams")
            && undistortion.numbers()?.iter().any(|value| *value != 0.0)
        {
            return Err(undistortion.invalid(ExchangeReason::NoSuchCameraModel { model: "undistortion".into() }.into()));
        }
        let values = node.get("distortionParams").map_or(Ok(Vec::new()), |node| node.numbers())?;
        if values.len() != coefficients.len() && !(values.is_empty() || coefficients.is_empty()) {
            let expected = format!("{} coefficients", coefficients.len());
            return Err(node.need("distortionParams")?.expected(&expected));
        }
        let is_fisheye = coefficients.contains(&K4);
        let shape = if is_fisheye { &FISHEYE4 } else { &BROWN };
        let mut lens = shape.lens(&Lens::default(), &[focal[0], focal[1], pp[0], pp[1]]);
        if !(focal[0] > 0.0 && focal[1] > 0.0) {
            return Err(node.expected("focal lengths above 0"));
        }
        coefficients.iter().zip(values).for_each(|(term, value)| lens.terms[*term] = value);
        cameras.push(ForeignCamera::new(node.need("intrinsicId")?.text()?, size, shape, lens));
    }
    for name in root
        .names()
        .into_iter()
        .filter(|name| !["version", "views", "intrinsics", "poses", "structure", "controlPoints"].contains(name))
    {
        notes.ignore(name, 1);
    }
    Ok(cameras)
}

/// A whole scene.
///
/// # Errors
/// As [`cameras`].
pub fn read(root: &Node<'_>) -> Result<ForeignNetwork> {
    let mut network = ForeignNetwork::default();
    network.cameras = cameras(root, &mut network.notes)?;
    let list = |name: &str| root.get(name).map_or(Ok(Vec::new()), |node| node.items());
    let mut poses = std::collections::HashMap::new();
    for node in list("poses")? {
        let transform = node.need("pose")?.need("transform")?;
        let rotation = transform.need("rotation")?;
        let matrix = nalgebra::Matrix3::from_column_slice(&rotation.exactly::<9>()?);
        let pose = Pose::at(matrix, transform.need("center")?.exactly()?);
        poses.insert(node.need("poseId")?.text()?, pose.ok_or_else(|| rotation.expected("a rotation"))?);
    }
    let mut used = 0;
    for node in list("views")? {
        let id = node.need("viewId")?.text()?;
        let camera = node.need("intrinsicId")?.text()?;
        let path = node.get("path").map_or(Ok(String::new()), |path| path.text())?;
        let rig = node.get("rigId").map(|rig| rig.text()).transpose()?.is_some_and(|rig| rig != "4294967295");
        let pose = node.get("poseId").map(|pose| pose.text()).transpose()?.and_then(|pose| poses.get(&pose).copied());
        network.notes.ignore("poses of rigs", usize::from(rig));
        network.notes.ignore("metadata", usize::from(node.get("metadata").is_some()));
        let pose = pose.filter(|_| !rig);
        used += usize::from(pose.is_some());
        network.photos.push(network::photo(id, camera, &path, pose));
    }
    network.notes.ignore("poses without a view", poses.len().saturating_sub(used));
    for (list_name, prefix) in [("structure", ""), ("controlPoints", "control ")] {
        for node in list(list_name)? {
            let id = format!("{prefix}{}", node.need("landmarkId")?.text()?);
            network.notes.ignore("colours of points", usize::from(node.get("color").is_some()));
            for seen in node.get("observations").map_or(Ok(Vec::new()), |node| node.items())? {
                let Some(pixel) = seen.get("x") else {
                    network.notes.ignore("observations without coordinates", 1);
                    continue;
                };
                let photo = seen.need("observationId")?.text()?;
                network.observations.push(network::observation(&photo, &id, pixel.exactly()?));
            }
            network.points.push(Point { id, xyz: Some(node.need("X")?.exactly()?), ..Point::default() });
        }
    }
    if !network.observations.is_empty() {
        network.notes.assume(Assumed::SigmaOnePixel);
    }
    Ok(network)
}

/// Models that are written.
pub const WRITES: Models<'static> = (&[&BROWN, &FISHEYE4], |_| Lens::default());

/// `scene.sfm`, version 1.2.5.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn write(network: &OutgoingNetwork) -> Result<Files> {
    // Boost's property trees know texts only.
    let text = |value: f64| Value::String(format!("{value:?}"));
    let texts = |values: &[f64]| Value::Array(values.iter().map(|value| text(*value)).collect());
    let intrinsics: Vec<Value> = network
        .cameras
        .iter()
        .enumerate()
        .map(|(k, (camera, out))| {
            let [fx, fy, cx, cy, coefficients @ ..] = &out.values[..] else { return Value::Null };
            let [fx, fy, cx, cy] = [*fx, *fy, *cx, *cy];
            let (width, height) = (f64::from(camera.width), f64::from(camera.height));
            let sensor = camera.pixel_pitch.map_or(36.0, |[pitch, _]| pitch * width);
            json!({
                "intrinsicId": (k + 1).to_string(),
                "width": camera.width.to_string(),
                "height": camera.height.to_string(),
                "sensorWidth": text(sensor),
                "sensorHeight": text(sensor * height / width),
                "serialNumber": camera.id,
                "type": out.shape.name,
                "initializationMode": "calibrated",
                "initialFocalLength": text(fx / width * sensor),
                "focalLength": text(fx / width * sensor),
                "pixelRatio": text(fy / fx),
                "pixelRatioLocked": "false",
                "principalPoint": texts(&[cx - width / 2.0, cy - height / 2.0]),
                "distortionInitializationMode": "calibrated",
                "distortionParams": texts(coefficients),
                "undistortionOffset": texts(&[0.0, 0.0]),
                "undistortionParams": "",
                "locked": "false",
            })
        })
        .collect();
    let views: Vec<Value> = network
        .photos
        .iter()
        .map(|photo| {
            let camera = &network.cameras[photo.camera].0;
            json!({
                "viewId": photo.number.to_string(),
                "poseId": photo.number.to_string(),
                "frameId": photo.number.to_string(),
                "intrinsicId": (photo.camera + 1).to_string(),
                "path": photo.file,
                "width": camera.width.to_string(),
                "height": camera.height.to_string(),
                "metadata": Map::new(),
            })
        })
        .collect();
    let poses: Vec<Value> = network
        .photos
        .iter()
        .map(|photo| {
            json!({
                "poseId": photo.number.to_string(),
                "pose": {
                    "transform": { "rotation": texts(photo.pose.rotation.as_slice()), "center": texts(&photo.pose.position) },
                    "locked": "0",
                },
            })
        })
        .collect();
    let structure: Vec<Value> = network
        .points
        .iter()
        .map(|point| {
            let observations: Vec<Value> = point
                .seen
                .iter()
                .map(|(photo, place)| {
                    let photo = &network.photos[*photo];
                    json!({
                        "observationId": photo.number.to_string(),
                        "featureId": place.to_string(),
                        "x": texts(&photo.measured[*place].0),
                        "scale": "0",
                    })
                })
                .collect();
            json!({
                "landmarkId": point.number.to_string(),
                "descType": "unknown",
                "color": ["128", "128", "128"],
                "X": texts(&point.xyz),
                "observations": observations,
            })
        })
        .collect();
    let scene = json!({ "version": ["1", "2", "5"], "views": views, "intrinsics": intrinsics, "poses": poses, "structure": structure });
    let bytes = serde_json::to_vec_pretty(&scene).map_err(|error| Error::Invalid {
        reason: Reason::CannotWriteJson { message: error.to_string() },
        at: Place::default(),
    })?;
    network::with_companion(Files::from([("scene.sfm".to_owned(), bytes)]), network)
}
