//! Reconstructions of OpenSfM and OpenDroneMap (`reconstruction.json`), with the tracks (`tracks.csv`) where they are there.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | normalised: from the centre of the picture in units of its longer side, x right, y down; u = x s + w/2 in our frame |
//! | axes | camera: x right, y down, z forwards |
//! | rotation | rotation vector and translation, object to camera: P = R X + t |
//! | distortion | ideal to image: perspective f, k1 k2; simple_radial, radial, brown as OpenCV's; fisheye f, k1 k2 of the angle off the axis; fisheye_opencv k1 to k4 |
//!
//! Source: OpenSfM documentation, "Geometric Models" and "Reconstruction file", and `opensfm/features.py`, `normalized_image_coordinates`: (u + 0.5 − w/2) / max(w, h) for pixels whose
//! centres are whole. Other projections (spherical, dual, fisheye62, fisheye624) are refused by name. The first reconstruction is read; further ones, colours and
//! reference coordinates are counted. Without tracks there are orientations and points only.

use crate::reason::ExchangeReason;
use std::collections::HashSet;

use nalgebra::{Rotation3, Vector3};

use super::foreign::{Assumed, ForeignCamera, Pose};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork};
use super::tree::{self, Node};
use super::{Files, encoding};
use sightline::error::{Error, Place, Result, shortened};
use sightline::project::Point;

static PERSPECTIVE: LensModel = LensModel {
    name: "perspective",
    equidistant: false,
    parameters: &[("focal", &[FX, FY]), ("k1", &[K1]), ("k2", &[K2])],
};

static BROWN: LensModel = LensModel {
    name: "brown",
    equidistant: false,
    parameters: &[
        ("focal_x", &[FX]),
        ("focal_y", &[FY]),
        ("c_x", &[CX]),
        ("c_y", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("p1", &[P1]),
        ("p2", &[P2]),
    ],
};

static FISHEYE: LensModel =
    LensModel { name: "fisheye", equidistant: true, parameters: &[("focal", &[FX, FY]), ("k1", &[K1]), ("k2", &[K2])] };

static FISHEYE_OPENCV: LensModel = LensModel {
    name: "fisheye_opencv",
    equidistant: true,
    parameters: &[
        ("focal_x", &[FX]),
        ("focal_y", &[FY]),
        ("c_x", &[CX]),
        ("c_y", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("k4", &[K4]),
    ],
};

/// Whether a tree is of this format.
pub fn recognises(root: &Node<'_>) -> bool {
    let first = root.value.as_array().and_then(|all| all.first());
    first.is_some_and(|first| first.get("cameras").is_some() && first.get("shots").is_some())
}

/// Whether a text is a list of tracks.
pub fn recognises_tracks(text: &str) -> bool {
    text.starts_with("OPENSFM_TRACKS_VERSION")
}

/// A reconstruction from its files.
///
/// # Errors
/// [`Error::Invalid`] with file and element or line; [`ExchangeReason::NoSuchCameraModel`].
pub fn read(files: &Files) -> Result<ForeignNetwork> {
    let mut found: Option<ForeignNetwork> = None;
    let mut tracks = Vec::new();
    for (name, bytes) in files {
        let text = encoding::text(bytes).map_err(|error| error.in_file(name))?;
        if recognises_tracks(&text) {
            tracks.push((name, text));
            continue;
        }
        let network = tree::json(&text).and_then(|tree| reconstruction(&Node::root(&tree)));
        found = Some(network.map_err(|error| error.in_file(name))?);
    }
    let Some(mut network) = found else {
        let reason = ExchangeReason::ExpectedHere {
            expected: "reconstruction.json beside the tracks".into(),
            found: String::new(),
        }
        .into();
        return Err(Error::Invalid { reason, at: Place::default() });
    };
    for (name, text) in tracks {
        measurements(&text, &mut network).map_err(|error| error.in_file(name))?;
    }
    Ok(network)
}

fn reconstruction(root: &Node<'_>) -> Result<ForeignNetwork> {
    if !recognises(root) {
        return Err(root.expected("a list of reconstructions with cameras and shots"));
    }
    let all = root.items()?;
    let (first, further) = all.split_first().ok_or_else(|| root.expected("a reconstruction"))?;
    let mut network = ForeignNetwork::default();
    network.notes.ignore("further reconstructions", further.len());
    let cameras = first.need("cameras")?;
    for id in cameras.names() {
        network.cameras.push(camera(id, &cameras.need(id)?)?);
    }
    let shots = first.need("shots")?;
    for name in shots.names() {
        let shot = shots.need(name)?;
        let vector: [f64; 3] = shot.need("rotation")?.exactly()?;
        let translation: [f64; 3] = shot.need("translation")?.exactly()?;
        let pose = Pose::new(*Rotation3::new(Vector3::from(vector)).matrix(), translation);
        let pose = pose.ok_or_else(|| shot.expected("a rotation and a translation"))?;
        let camera = shot.need("camera")?.text()?;
        network.photos.push(network::photo(name.to_owned(), camera, name, Some(pose)));
        network.notes.ignore("reference coordinates of photos", usize::from(shot.get("gps_position").is_some()));
    }
    if let Some(points) = first.get("points") {
        for id in points.names() {
            let point = points.need(id)?;
            let xyz = Some(point.need("coordinates")?.exactly()?);
            network.points.push(Point { id: id.to_owned(), xyz, ..Point::default() });
            network.notes.ignore("colours of points", usize::from(point.get("color").is_some()));
        }
    }
    Ok(network)
}

fn camera(id: &str, node: &Node<'_>) -> Result<ForeignCamera> {
    let size = [node.need("width")?.size()?, node.need("height")?.size()?];
    let [w, h] = size.map(f64::from);
    let side = w.max(h);
    let kind = node.need("projection_type")?;
    let kind_name = kind.text()?;
    let shape = match kind_name.as_str() {
        "perspective" => &PERSPECTIVE,
        "brown" | "radial" | "simple_radial" => &BROWN,
        "fisheye" => &FISHEYE,
        "fisheye_opencv" => &FISHEYE_OPENCV,
        other => return Err(kind.invalid(ExchangeReason::NoSuchCameraModel { model: shortened(other) }.into())),
    };
    let value = |(name, terms): &(&str, &[usize])| -> Result<f64> {
        let focal = terms.contains(&FX) || terms.contains(&FY);
        match node.get(name) {
            Some(node) if focal => Ok(side * node.positive()?),
            Some(node) if matches!(terms, [CX | CY]) => Ok(side * node.number()?),
            Some(node) => node.number(),
            None if focal => Err(node.need(name).err().unwrap_or_else(|| node.expected("a focal length"))),
            None => Ok(0.0),
        }
    };
    let values = shape.parameters.iter().map(value).collect::<Result<Vec<f64>>>()?;
    let mut centred = Lens::default();
    (centred.terms[CX], centred.terms[CY]) = (w / 2.0, h / 2.0);
    Ok(ForeignCamera::new(id, size, shape, shape.lens(&centred, &values)))
}

/// Rows of photo, track, feature, x, y and more, with tabs between them.
fn measurements(text: &str, network: &mut ForeignNetwork) -> Result<()> {
    let sizes: std::collections::HashMap<String, [f64; 2]> = network
        .photos
        .iter()
        .filter_map(|photo| {
            let camera = network.cameras.iter().find(|camera| camera.id == photo.camera)?;
            Some((photo.id.clone(), camera.size.map(f64::from)))
        })
        .collect();
    let points: HashSet<String> = network.points.iter().map(|point| point.id.clone()).collect();
    let (mut strangers, mut untracked) = (0, 0);
    for (k, line) in text.lines().enumerate().skip(1).filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = |expected: &str, found: &str| {
            let reason = ExchangeReason::ExpectedHere { expected: expected.into(), found: shortened(found) }.into();
            Error::Invalid { reason, at: Place::line(k + 1) }
        };
        let fields: Vec<&str> = line.split('\t').collect();
        let [photo, track, _, x, y, ..] = fields[..] else {
            return Err(wrong("photo, track, feature, x, y with tabs between them", line));
        };
        let number = |word: &str| tree::number(word.trim()).ok_or_else(|| wrong("a number", word));
        let [x, y] = [number(x)?, number(y)?];
        let Some([w, h]) = sizes.get(photo) else {
            strangers += 1;
            continue;
        };
        if !points.contains(track) {
            untracked += 1;
            continue;
        }
        let side = w.max(*h);
        network.observations.push(network::observation(photo, track, [x * side + w / 2.0, y * side + h / 2.0]));
    }
    network.notes.ignore("measurements in photos without orientation", strangers);
    network.notes.ignore("measurements of tracks without a point", untracked);
    if !network.observations.is_empty() {
        network.notes.assume(Assumed::SigmaOnePixel);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::foreign::ForeignModel;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const FILE: &str = r#"[{"cameras": {"c": {"projection_type": "brown", "width": 4000, "height": 3000, "focal_x": 0.8, "focal_y": 0.81, "c_x": 0.01, "c_y": -0.02,
        "k1": -0.1, "k2": 0.02, "k3": 0.0, "p1": 0.001, "p2": -0.002}},
        "shots": {"a.jpg": {"rotation": [3.141592653589793, 0, 0], "translation": [0, 0, 5], "camera": "c", "gps_position": [1, 2, 3]}},
        "points": {"17": {"coordinates": [0.5, 1.0, 1.0], "color": [1, 2, 3]}}}, {"cameras": {}, "shots": {}}]"#;
    const TRACKS: &str = "OPENSFM_TRACKS_VERSION_v1\na.jpg\t17\t4\t0.10\t-0.20\t0.002\t1\t2\t3\nb.jpg\t17\t4\t0\t0\t0.002\t1\t2\t3\na.jpg\t18\t4\t0\t0\t0\t1\t2\t3\n";

    fn files(model: &str, tracks: &str) -> Files {
        [("reconstruction.json", model), ("tracks.csv", tracks)]
            .map(|(n, t)| (n.to_owned(), t.as_bytes().to_vec()))
            .into()
    }

    /// By hand: half a turn about x and t = (0, 0, 5) put X = (0.5, 1, 1) to (0.5, -1, 4): a = 0.125, b = -0.25, r² = 0.078125, R = 1 - 0.1 r² + 0.02 r⁴ = 0.9923095703125;
    /// a' = a R + 2 p1 a b + p2 (r² + 2 a²) = 0.124038696… - 0.0000625 - 0.00021875, b' = b R + p1 (r² + 2 b²) + 2 p2 a b = -0.248077393… + 0.000203125 + 0.000125;
    /// u = 4000 (0.8 a' + 0.01) + 2000, v = 4000 (0.81 b' - 0.02) + 1500.
    #[test]
    fn a_point_by_hand_has_its_pixel() {
        let network = read(&files(FILE, TRACKS)).unwrap();
        let ForeignModel::Lens(_, lens) = &network.cameras[0].model else { panic!("a lens") };
        let pixel = lens.project([0.125, -0.25]).unwrap();
        let r: f64 = 0.992_309_570_312_5;
        let (a, b) = (0.125 * r - 0.000_062_5 - 0.000_218_75, -0.25 * r + 0.000_203_125 + 0.000_125);
        let by_hand = [4000.0 * (0.8 * a + 0.01) + 2000.0, 4000.0 * (0.81 * b - 0.02) + 1500.0];
        assert!((pixel[0] - by_hand[0]).hypot(pixel[1] - by_hand[1]) < 1e-9, "{pixel:?} {by_hand:?}");
        assert_eq!((network.observations[0].u, network.observations[0].v), (2400.0, 700.0));
        let photo = &network.photos[0];
        let position = photo.position.unwrap();
        assert!(position[0].abs() + position[1].abs() + (position[2] - 5.0).abs() < 1e-12, "{position:?}");
        let counted = |name: &str| network.notes.ignored.iter().find(|ignored| ignored.name == name).map(|i| i.count);
        assert_eq!(counted("further reconstructions"), Some(1));
        assert_eq!(counted("measurements in photos without orientation"), Some(1));
        assert_eq!(counted("measurements of tracks without a point"), Some(1));
    }

    #[test]
    fn damage_names_element_or_line() {
        let refused = |model: &str, tracks: &str| read(&files(model, tracks)).unwrap_err();
        let error = refused(&FILE.replace("\"brown\"", "\"spherical\""), TRACKS);
        assert!(matches!(ExchangeReason::of_error(&error), Some(ExchangeReason::NoSuchCameraModel { .. })), "{error}");
        assert_eq!(
            refused(&FILE.replace("[0, 0, 5]", "[0, 5]"), TRACKS).place().field.as_deref(),
            Some("[0].shots.a.jpg.translation")
        );
        assert_eq!(refused(FILE, &TRACKS.replace("0.10", "x")).place().line, Some(2));
        assert_eq!(refused("[{\"cameras\": 1}]", TRACKS).place().file.as_deref(), Some("reconstruction.json"));
    }
}
