//! Models of COLMAP: `cameras`, `images` and `points3D`, each as text or binary.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0.5, 0.5): ours |
//! | axes | camera: x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | rotation | quaternion w x y z and translation t, object to camera: x_camera = R X + t |
//! | distortion | ideal to image; SIMPLE_RADIAL k, RADIAL k1 k2, OPENCV k1 k2 p1 p2, FULL_OPENCV with k3 and the denominator k4 k5 k6 as OpenCV, OPENCV_FISHEYE k1 k2 k3 k4 of the angle off the axis |
//!
//! Source: COLMAP's documentation, "Output Format", and `src/colmap/sensor/models.h`. Other fisheye, FOV, division, EUCM and thin prism models are refused
//! by name. Colours and errors of points, rigs and frames are not kept; a keypoint that is of no point is none of ours.

mod binary;
mod text;

use crate::reason::ExchangeReason;
use std::collections::BTreeMap;

use super::foreign::{self, CameraOptions, ExportedCamera, ForeignCamera, Notes};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork, OutgoingNetwork};
use super::{Files, encoding};
use sightline::error::{Error, Place, Reason, Result, Thing};
use sightline::project::{Camera, Point};

const FULL: &[(&str, &[usize])] = &[
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
];
const RADIAL: &[(&str, &[usize])] = &[("f", &[FX, FY]), ("cx", &[CX]), ("cy", &[CY]), ("k1", &[K1]), ("k2", &[K2])];

const FISHEYE: &[(&str, &[usize])] = &[
    ("fx", &[FX]),
    ("fy", &[FY]),
    ("cx", &[CX]),
    ("cy", &[CY]),
    ("k1", &[K1]),
    ("k2", &[K2]),
    ("k3", &[K3]),
    ("k4", &[K4]),
];

/// Models with their numbers in binary files.
const MODELS: [(i32, LensModel); 7] = [
    (0, LensModel { name: "SIMPLE_PINHOLE", parameters: RADIAL.split_at(3).0, equidistant: false }),
    (1, LensModel { name: "PINHOLE", parameters: FULL.split_at(4).0, equidistant: false }),
    (2, LensModel { name: "SIMPLE_RADIAL", parameters: RADIAL.split_at(4).0, equidistant: false }),
    (3, LensModel { name: "RADIAL", parameters: RADIAL, equidistant: false }),
    (4, LensModel { name: "OPENCV", parameters: FULL.split_at(8).0, equidistant: false }),
    (6, LensModel { name: "FULL_OPENCV", parameters: FULL, equidistant: false }),
    (5, LensModel { name: "OPENCV_FISHEYE", parameters: FISHEYE, equidistant: true }),
];
/// Those that are written: the first that is enough.
static WRITTEN: [&LensModel; 4] = [&PINHOLE, &OPENCV, &FULL_OPENCV, &OPENCV_FISHEYE];
static PINHOLE: LensModel = MODELS[1].1;
static OPENCV: LensModel = MODELS[4].1;
static FULL_OPENCV: LensModel = MODELS[5].1;
static OPENCV_FISHEYE: LensModel = MODELS[6].1;
static ALL: [(i32, LensModel); 7] = MODELS;

/// Other models by their numbers, to be named.
const OTHERS: [(i32, &str); 11] = [
    (7, "FOV"),
    (8, "SIMPLE_RADIAL_FISHEYE"),
    (9, "RADIAL_FISHEYE"),
    (10, "THIN_PRISM_FISHEYE"),
    (11, "RAD_TAN_THIN_PRISM_FISHEYE"),
    (12, "SIMPLE_DIVISION"),
    (13, "DIVISION"),
    (14, "SIMPLE_FISHEYE"),
    (15, "FISHEYE"),
    (16, "EUCM"),
    (17, "EQUIRECTANGULAR"),
];

/// An image as its file has it.
#[derive(Clone, Debug, Default, PartialEq)]
struct Image {
    id: u32,
    quaternion: [f64; 4],
    translation: [f64; 3],
    camera: u32,
    name: String,
    /// Keypoints that are of a point.
    measured: Vec<([f64; 2], u64)>,
    /// Keypoints of no point.
    free: usize,
}

/// A camera as its file has it: number, model, lens, size.
type Numbered = (u32, &'static LensModel, Lens, [u32; 2]);

/// The parts of a model that are there.
#[derive(Default)]
struct Model {
    cameras: Option<Vec<Numbered>>,
    images: Option<Vec<Image>>,
    points: Option<Vec<(u64, [f64; 3])>>,
}

/// The part of a model that a file is, by its name.
pub(super) fn part(name: &str) -> Option<(&'static str, bool)> {
    let bare = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let (stem, ending) = bare.rsplit_once('.')?;
    let binary = match ending.to_ascii_lowercase().as_str() {
        "txt" => false,
        "bin" => true,
        _ => return None,
    };
    let known = ["cameras", "images", "points3D", "rigs", "frames"];
    known.into_iter().find(|known| known.eq_ignore_ascii_case(stem)).map(|known| (known, binary))
}

/// Whether files are a model of this format, or its cameras.
pub fn recognises(files: &Files) -> bool {
    let camera = |(name, bytes): (&String, &Vec<u8>)| match part(name) {
        Some(("cameras", false)) => encoding::text(bytes).is_ok_and(|text| text::is_cameras(&text)),
        Some(("cameras", true)) => true,
        _ => false,
    };
    files.iter().any(camera)
}

/// A model by its name in a text.
fn named(name: &str) -> std::result::Result<&'static LensModel, Reason> {
    let found = ALL.iter().find(|(_, shape)| shape.name == name).map(|(_, shape)| shape);
    found.ok_or_else(|| ExchangeReason::NoSuchCameraModel { model: sightline::error::shortened(name) }.into())
}

/// A camera from a line or record.
fn lens(shape: &'static LensModel, values: &[f64]) -> Option<Lens> {
    let lens = shape.lens(&Lens::default(), values);
    (lens.terms[FX] > 0.0 && lens.terms[FY] > 0.0).then_some(lens)
}

fn model(files: &Files, notes: &mut Notes) -> Result<Model> {
    let mut model = Model::default();
    for (name, bytes) in files {
        let Some((kind, is_binary)) = part(name) else {
            notes.ignore(name, 1);
            continue;
        };
        let mut read = || -> Result<()> {
            let text = if is_binary { String::new() } else { encoding::text(bytes)? };
            match (kind, is_binary) {
                ("cameras", false) => model.cameras = Some(text::cameras(&text)?),
                ("cameras", true) => model.cameras = Some(binary::cameras(bytes)?),
                ("images", false) => model.images = Some(text::images(&text)?),
                ("images", true) => model.images = Some(binary::images(bytes)?),
                ("points3D", false) => model.points = Some(text::points(&text)?),
                ("points3D", true) => model.points = Some(binary::points(bytes)?),
                _ => notes.ignore(kind, 1),
            }
            Ok(())
        };
        read().map_err(|error| error.in_file(name))?;
    }
    Ok(model)
}

fn missing(name: &str) -> Error {
    Error::Unknown { kind: Thing::File, name: name.into(), at: Place::default() }
}

fn foreign_cameras(model: &mut Model) -> Result<Vec<ForeignCamera>> {
    let cameras = model.cameras.take().ok_or_else(|| missing("cameras.txt"))?;
    let camera = |(id, shape, lens, size): Numbered| ForeignCamera::new(id.to_string(), size, shape, lens);
    Ok(cameras.into_iter().map(camera).collect())
}

/// The cameras of a model.
///
/// # Errors
/// [`Error::Invalid`] with file and line or what was expected; [`ExchangeReason::NoSuchCameraModel`].
pub fn read_cameras(files: &Files, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let mut model = model(files, notes)?;
    notes.ignore("images", model.images.as_ref().map_or(0, Vec::len));
    notes.ignore("points3D", model.points.as_ref().map_or(0, Vec::len));
    foreign_cameras(&mut model)
}

/// A whole model.
///
/// # Errors
/// [`Error::Invalid`] with file and line or what was expected, [`Error::Unknown`] for a file or a camera that is missing.
pub fn read(files: &Files) -> Result<ForeignNetwork> {
    let mut network = ForeignNetwork::default();
    let mut model = model(files, &mut network.notes)?;
    network.cameras = foreign_cameras(&mut model)?;
    let images = model.images.take().ok_or_else(|| missing("images.txt"))?;
    let mut seen_only: BTreeMap<u64, ()> = BTreeMap::new();
    for image in images {
        let id = image.id.to_string();
        let pose = foreign::Pose::of_quaternion(image.quaternion, image.translation);
        let pose = pose.ok_or_else(|| Error::Invalid {
            reason: ExchangeReason::ExpectedHere {
                expected: "a quaternion w x y z".into(),
                found: format!("{:?}", image.quaternion),
            }
            .into(),
            at: Place::photo(&id),
        })?;
        network.photos.push(network::photo(id.clone(), image.camera.to_string(), &image.name, Some(pose)));
        network.notes.ignore("keypoints of no point", image.free);
        for (pixel, point) in image.measured {
            if model.points.is_none() {
                seen_only.insert(point, ());
            }
            network.observations.push(network::observation(&id, &point.to_string(), pixel));
        }
    }
    if !network.observations.is_empty() {
        network.notes.assume(foreign::Assumed::SigmaOnePixel);
    }
    match model.points {
        Some(points) => {
            network.notes.ignore("colours and errors of points", points.len());
            network.points = points
                .into_iter()
                .map(|(id, xyz)| Point { id: id.to_string(), xyz: Some(xyz), ..Point::default() })
                .collect();
        }
        None => {
            network.points = seen_only.into_keys().map(|id| Point { id: id.to_string(), ..Point::default() }).collect();
        }
    }
    Ok(network)
}

/// The camera as `cameras.txt`.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write_camera(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let out = foreign::outgoing(camera, &WRITTEN, &Lens::default(), options)?;
    let line = text::camera_line(1, camera, &out);
    let mut files = Files::from([("cameras.txt".to_owned(), text::cameras_text(&[line]).into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, out.shape.name, covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}

/// Models that are written.
pub const WRITES: network::Models<'static> = (&WRITTEN, |_| Lens::default());

/// A whole model, as text or binary.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn write(network: &OutgoingNetwork, as_binary: bool) -> Result<Files> {
    let files = if as_binary { binary::write(network) } else { text::write(network) };
    network::with_companion(files, network)
}
