//! XMP sidecars of RealityCapture and RealityScan (`PHOTO.xmp`, namespace `xcr`): cameras and orientations, a file a photo.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the file does not say where in the upper left pixel: its corner, ours |
//! | scale | image coordinates over the longer side s of the picture, from its centre: u = s x + w/2, v = s y + h/2 |
//! | principal distance | `FocalLength35mm` / 36 · s, principal point (`PrincipalPointU`, `PrincipalPointV`) · s from the centre, V down |
//! | axes | camera: x right, y down, z forwards: x = R (X − Position) |
//! | rotation | matrix by rows, object to camera |
//! | distortion | ideal to image: `DistortionCoeficients` k1 k2 k3 k4 t1 t2; t1, t2 are OpenCV's p2, p1 |
//!
//! Source: Capturing Reality, "RealityCapture XMP Camera Math", for R and Position; scale, principal point and the order of the coefficients are those of AliceVision's
//! `main_importKnownPoses.cpp`; Camorph's `RealityCapture.py` has the same order of the tangential ones. The models `perspective`, `brown3`, `brown4`, `brown3t2` and
//! `brown4t2` are read; `division` and those that begin with K only if all coefficients are 0. The file does not have the size of the picture: it is that of the photo of
//! the same name. The table "Internal/External camera parameters" is not read: its heading, pitch and roll are documented nowhere.

use std::collections::BTreeMap;

use nalgebra::Matrix3;

use super::agisoft_lens::{number, numbers, wrong};
use super::dbat::element::{self, Element};
use super::foreign::{Assumed, ForeignCamera, ForeignModel, LONGEST_SIDE, Pose};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork};
use super::{Files, encoding};
use crate::reason::ExchangeReason;
use sightline::decode;
use sightline::error::{Error, Place, Reason, Result};

/// The namespace, less its version.
const NAMESPACE: &str = "http://www.capturingreality.com/ns/xcr/";

static REALITY_CAPTURE: LensModel = LensModel {
    name: "realitycapture",
    equidistant: false,
    parameters: &[
        ("f", &[FX, FY]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("k4", &[K4]),
        ("t1", &[P2]),
        ("t2", &[P1]),
    ],
};

/// Width and height of photos by the names of their files.
pub type Sizes = BTreeMap<String, [u32; 2]>;

/// Whether a text is of this format.
pub fn recognises(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with('<') && text.contains(NAMESPACE)
}

/// Cameras and photos; sizes are those of pictures among the files, else those given.
///
/// # Errors
/// [`Error::Invalid`] with file and element, for other camera models, and for a photo whose size is not known.
pub fn read(files: &Files, sizes: &Sizes) -> Result<ForeignNetwork> {
    let mut network = ForeignNetwork::default();
    let mut known = sizes.clone();
    let mut sidecars = Vec::new();
    for (name, bytes) in files {
        match encoding::text(bytes) {
            Ok(text) if recognises(&text) => sidecars.push((name, text)),
            _ => {
                let size = decode::size(bytes).map_err(|error| error.in_file(name))?;
                known.insert(name.clone(), [size.width, size.height]);
            }
        }
    }
    for (name, text) in sidecars {
        sidecar(name, &text, &known, &mut network).map_err(|error| error.in_file(name))?;
    }
    if network.photos.is_empty() {
        return Err(wrong("xcr", "an XMP file of RealityCapture", ""));
    }
    network.notes.assume(Assumed::PixelOriginCorner);
    Ok(network)
}

/// A file's name without folders and ending, in small letters.
fn stem(name: &str) -> String {
    let file = name.rsplit(['/', '\\']).next().unwrap_or_default();
    file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_lowercase()
}

fn sidecar(name: &str, text: &str, sizes: &Sizes, network: &mut ForeignNetwork) -> Result<()> {
    let root = element::parse(text)?;
    let description = described(&root).ok_or_else(|| wrong(&root.name, "values of the namespace xcr", ""))?;
    let value = |name: &str| {
        let own = format!("xcr:{name}");
        description.attribute(&own).or_else(|| description.child(&own).map(|child| child.text.as_str()))
    };
    let stem = stem(name);
    let photo = sizes.iter().find(|(file, _)| self::stem(file) == stem);
    let Some((file, size)) = photo else {
        return Err(Error::Invalid { reason: ExchangeReason::PhotoSize { name: stem }.into(), at: Place::default() });
    };
    let [width, height] = *size;
    if width == 0 || height == 0 || width > LONGEST_SIDE || height > LONGEST_SIDE {
        return Err(wrong("size", "a picture", &format!("{width} x {height}")));
    }
    let given = |name: &str, otherwise: f64| value(name).map_or(Ok(otherwise), |text| number(name, text));
    let missing = |name: &str| Error::Invalid { reason: Reason::Missing { name: name.into() }, at: Place::field(name) };
    let focal = value("FocalLength35mm").ok_or_else(|| missing("FocalLength35mm"))?;
    let focal = number("FocalLength35mm", focal)?;
    if !(focal > 0.0) {
        return Err(wrong("FocalLength35mm", "a number above 0", &focal.to_string()));
    }
    for (name, square) in [("Skew", 0.0), ("AspectRatio", 1.0)] {
        let found = given(name, square)?;
        if found != square {
            return Err(wrong(name, &square.to_string(), &found.to_string()));
        }
    }
    let side = f64::from(width.max(height));
    let centre = [f64::from(width) / 2.0, f64::from(height) / 2.0];
    let coefficients = match value("DistortionCoeficients").filter(|text| !text.trim().is_empty()) {
        Some(text) => numbers::<6>("DistortionCoeficients", text)?,
        None => [0.0; 6],
    };
    let model = value("DistortionModel").unwrap_or("perspective").trim();
    let used: &[usize] = match model {
        "perspective" => &[],
        "brown3" => &[0, 1, 2],
        "brown4" => &[0, 1, 2, 3],
        "brown3t2" => &[0, 1, 2, 4, 5],
        "brown4t2" => &[0, 1, 2, 3, 4, 5],
        _ if coefficients == [0.0; 6] => &[],
        other => {
            let reason = ExchangeReason::NoSuchCameraModel { model: other.to_owned() }.into();
            return Err(Error::Invalid { reason, at: Place::field("DistortionModel") });
        }
    };
    if let Some(k) = (0..6).find(|k| !used.contains(k) && coefficients[*k] != 0.0) {
        return Err(wrong(
            "DistortionCoeficients",
            &format!("0 in place {} of {model}", k + 1),
            &coefficients[k].to_string(),
        ));
    }
    let [k1, k2, k3, k4, t1, t2] = coefficients;
    let point = [given("PrincipalPointU", 0.0)?, given("PrincipalPointV", 0.0)?];
    let (cx, cy) = (side * point[0] + centre[0], side * point[1] + centre[1]);
    let lens = REALITY_CAPTURE.lens(&Lens::default(), &[focal / 36.0 * side, cx, cy, k1, k2, k3, k4, t1, t2]);
    let pose = match (value("Rotation"), value("Position")) {
        (Some(rotation), Some(position)) => {
            let (rotation, position) = (numbers::<9>("Rotation", rotation)?, numbers::<3>("Position", position)?);
            let pose = Pose::at(Matrix3::from_row_slice(&rotation), position);
            Some(pose.ok_or_else(|| wrong("Rotation", "a rotation", &format!("{rotation:?}")))?)
        }
        _ => None,
    };
    network.notes.ignore("rigs", usize::from(value("Rig").is_some()));
    network.notes.ignore("geographic positions of photos", usize::from(value("latitude").is_some()));
    let same = |camera: &&ForeignCamera| {
        camera.size == *size && matches!(&camera.model, ForeignModel::Lens(_, other) if *other == lens)
    };
    let camera = match network.cameras.iter().rev().find(same) {
        Some(known) => known.id.clone(),
        None => {
            let id = (network.cameras.len() + 1).to_string();
            network.cameras.push(ForeignCamera::new(id.clone(), *size, &REALITY_CAPTURE, lens));
            id
        }
    };
    let file = file.rsplit(['/', '\\']).next().unwrap_or_default();
    network.photos.push(network::photo(file.to_owned(), camera, file, pose));
    Ok(())
}

/// The element with values of the namespace.
fn described(element: &Element) -> Option<&Element> {
    let own = |name: &str| name.starts_with("xcr:");
    let has = element.attributes.iter().any(|(name, _)| own(name)) || element.children.iter().any(|c| own(&c.name));
    if has { Some(element) } else { element.children.iter().find_map(described) }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const FILE: &str = "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n\
        <rdf:Description xcr:Version=\"3\" xcr:PosePrior=\"locked\" xcr:Coordinates=\"absolute\" xcr:DistortionModel=\"brown3t2\"\n\
        xcr:FocalLength35mm=\"32.4\" xcr:Skew=\"0\" xcr:AspectRatio=\"1\" xcr:PrincipalPointU=\"0.01\" xcr:PrincipalPointV=\"-0.02\"\n\
        xcr:CalibrationPrior=\"exact\" xmlns:xcr=\"http://www.capturingreality.com/ns/xcr/1.1#\">\n\
        <xcr:Rotation>1 0 0 0 -1 0 0 0 -1</xcr:Rotation>\n<xcr:Position>10 20 30</xcr:Position>\n\
        <xcr:DistortionCoeficients>-0.1 0.02 0 0 -0.002 0.001</xcr:DistortionCoeficients>\n</rdf:Description></rdf:RDF></x:xmpmeta>\n";

    fn sizes() -> Sizes {
        [("a.JPG".to_owned(), [4000, 3000]), ("b.jpg".to_owned(), [3000, 4000])].into()
    }

    fn sidecar(text: &str) -> Result<ForeignNetwork> {
        read(&[("A.xmp".to_owned(), text.as_bytes().to_vec())].into(), &sizes())
    }

    /// By hand: a camera at (10, 20, 30) that looks down sees X = (10.5, 21, 26) at x = (0.5, -1, 4): a = 0.125, b = -0.25. With p1 = t2, p2 = t1 the distortion of that
    /// direction is the one worked out in `opensfm`: a' = 0.1237574462890625, b' = -0.247749267578125. f = 32.4 / 36 · 4000 = 3600, so u = 3600 a' + 40 + 2000,
    /// v = 3600 b' - 80 + 1500.
    #[test]
    fn a_point_by_hand_has_its_pixel() {
        let network = sidecar(FILE).unwrap();
        let ForeignModel::Lens(_, lens) = &network.cameras[0].model else { panic!("a lens") };
        let photo = &network.photos[0];
        assert_eq!((photo.file.as_str(), network.cameras[0].size), ("a.JPG", [4000, 3000]));
        let pose = Pose::of(photo.position.unwrap(), photo.rotation.unwrap());
        let p = pose.rotation * nalgebra::Vector3::new(0.5, 1.0, -4.0);
        let pixel = lens.project([p.x / p.z, p.y / p.z]).unwrap();
        let by_hand = [3600.0 * 0.123_757_446_289_062_5 + 2040.0, 3600.0 * -0.247_749_267_578_125 + 1420.0];
        assert!((pixel[0] - by_hand[0]).hypot(pixel[1] - by_hand[1]) < 1e-8, "{pixel:?} {by_hand:?}");
    }

    #[test]
    fn photos_of_one_camera_share_it_and_a_picture_has_its_size() {
        // An upright picture has the same longer side, and another centre. Values may be attributes or elements.
        let upright = FILE
            .replace("<xcr:Position>10 20 30</xcr:Position>", "")
            .replace(" xcr:PosePrior", " xcr:Position=\"10 20 30\" xcr:PosePrior");
        let bmp = {
            // Width 4 and height 3 in the head of a bitmap of 24 bits.
            let mut head = b"BM".to_vec();
            head.extend([90u32, 0, 54, 40, 4, 3].iter().flat_map(|n| n.to_le_bytes()));
            head.extend([1u16, 24].iter().flat_map(|n| n.to_le_bytes()));
            head.extend([0u32, 36, 2835, 2835, 0, 0].iter().flat_map(|n| n.to_le_bytes()));
            head.resize(90, 0);
            head
        };
        let all = [("a.xmp", FILE), ("b.xmp", &upright), ("c.xmp", FILE), ("d.xmp", FILE)];
        let mut files: Files = all.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).into();
        files.insert("c.bmp".into(), bmp);
        let sizes = sizes().into_iter().chain([("d.tif".to_owned(), [4000, 3000])]).collect();
        let network = read(&files, &sizes).unwrap();
        let of: Vec<_> = network.photos.iter().map(|photo| (photo.file.as_str(), photo.camera.as_str())).collect();
        assert_eq!(of, [("a.JPG", "1"), ("b.jpg", "2"), ("c.bmp", "3"), ("d.tif", "1")]);
        let ForeignModel::Lens(_, lens) = &network.cameras[1].model else { panic!("a lens") };
        let found = [lens.terms[FX], lens.terms[CX], lens.terms[CY]];
        assert!(found.iter().zip([3600.0, 1540.0, 1920.0]).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        assert_eq!(network.cameras[2].size, [4, 3]);
        assert_eq!(network.photos[1].position, Some([10.0, 20.0, 30.0]));
    }

    #[test]
    fn damage_and_other_models_are_named() {
        for (from, to, field) in [
            ("1 0 0 0 -1 0 0 0 -1", "1 0 0 0 -1 0 0 0", "Rotation"),
            ("1 0 0 0 -1 0 0 0 -1", "2 0 0 0 -1 0 0 0 -1", "Rotation"),
            ("32.4", "zero", "FocalLength35mm"),
            ("32.4", "0", "FocalLength35mm"),
            ("Skew=\"0\"", "Skew=\"0.1\"", "Skew"),
            ("-0.1 0.02 0 0 -0.002", "-0.1 0.02 0 0.5 -0.002", "DistortionCoeficients"),
            ("brown3t2", "division", "DistortionModel"),
        ] {
            let error = sidecar(&FILE.replacen(from, to, 1)).unwrap_err();
            assert_eq!(error.place().field.as_deref(), Some(field), "{to}: {error}");
            assert_eq!(error.place().file.as_deref(), Some("A.xmp"), "{to}: {error}");
        }
        let plain = FILE.replace("brown3t2", "division").replace("-0.1 0.02 0 0 -0.002 0.001", "0 0 0 0 0 0");
        assert!(sidecar(&plain).is_ok());
        let error = read(&[("z.xmp".to_owned(), FILE.as_bytes().to_vec())].into(), &sizes()).unwrap_err();
        let wanted = ExchangeReason::PhotoSize { name: "z".into() };
        assert_eq!(ExchangeReason::of_error(&error), Some(wanted));
        assert!(recognises(FILE) && !recognises("<x:xmpmeta/>"));
    }
}
