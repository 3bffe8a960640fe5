//! Calibrations of MicMac (`AutoCal*.xml`, `ExportAPERO`).
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | PP of a centred camera is half of SzIm, as MicMac's importers write it: ours |
//! | axes | x right, y down, z forwards |
//! | distortion | image to ideal (`eConvApero_DistM2C`), in pixels about CDist: r² (c0 + c1 r² + ...), P1, P2, b1, b2; (F, PP) project the corrected point |
//!
//! Source: MicMac, `cDistModStdPhpgr::Direct` and `ElDistRadiale_PolynImpair`. With CDist at PP and no more than three radial coefficients that is the
//! brown model, whose y points up: P2, b2 change their sign. Other distortions (`ModUnif` of fisheye lenses, grids, ideal to image) are
//! refused by name.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::Files;
use super::agisoft_lens::{number, numbers, wrong};
use super::conversion::{self, Conversion, Covariance, LARGEST_PX, Side, WARNING_PX};
use super::dbat::element::Element;
use super::foreign::{
    self, CameraOptions, Correction, ExportedCamera, ForeignCamera, ForeignModel, LONGEST_SIDE, Notes,
};
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::{Camera, Interior};

/// The element of the calibration.
fn calibration(root: &Element) -> Option<&Element> {
    if root.name == "CalibrationInternConique" { Some(root) } else { root.child("CalibrationInternConique") }
}

/// Whether a document is of this format.
pub fn recognises(root: &Element) -> bool {
    calibration(root).is_some()
}

/// The camera of a document.
///
/// # Errors
/// [`Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`].
pub fn read(root: &Element, id: &str, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let Some(node) = calibration(root) else { return Err(wrong(&root.name, "CalibrationInternConique", "")) };
    let refused = |model: String, field: &str| Error::Invalid {
        reason: ExchangeReason::NoSuchCameraModel { model }.into(),
        at: Place::field(field),
    };
    let text = |name: &str| {
        let missing = || Error::Invalid { reason: Reason::Missing { name: name.into() }, at: Place::field(name) };
        node.child(name).map(|child| child.text.as_str()).ok_or_else(missing)
    };
    if let Some(sense) = node.child("KnownConv").filter(|sense| sense.text != "eConvApero_DistM2C") {
        return Err(refused(format!("MicMac {}", shortened(&sense.text)), "KnownConv"));
    }
    let pp = numbers::<2>("PP", text("PP")?)?;
    let f = number("F", text("F")?)?;
    if !(f > 0.0) {
        return Err(wrong("F", "a focal length above 0", text("F")?));
    }
    let size = numbers::<2>("SzIm", text("SzIm")?)?;
    if size.iter().any(|side| side.fract() != 0.0 || !(1.0..f64::from(LONGEST_SIDE)).contains(side)) {
        return Err(wrong("SzIm", "width and height in pixels", text("SzIm")?));
    }
    let mut correction = Correction { f, pp, centre: pp, radial: Vec::new(), rest: [0.0; 4] };
    let distortions: Vec<&Element> = node.children("CalibDistortion").flat_map(|outer| &outer.children).collect();
    let distortions: Vec<&Element> = distortions.into_iter().filter(|model| model.name != "ModNoDist").collect();
    if distortions.len() > 1 {
        return Err(refused("MicMac with several distortions".into(), "CalibDistortion"));
    }
    if let Some(model) = distortions.first() {
        let radial = match model.name.as_str() {
            "ModRad" => Some(*model),
            "ModPhgrStd" => model.child("RadiePart"),
            other => {
                let kind = model.child("TypeModele").map(|kind| kind.text.clone()).unwrap_or_default();
                return Err(refused(format!("MicMac {} {kind}", shortened(other)), "CalibDistortion"));
            }
        };
        if let Some(radial) = radial {
            if let Some(centre) = radial.child("CDist") {
                correction.centre = numbers("CDist", &centre.text)?;
            }
            let coefficients = radial.children("CoeffDist").map(|child| number("CoeffDist", &child.text));
            correction.radial = coefficients.collect::<Result<_>>()?;
            notes.ignore("CoeffDistInv", radial.children("CoeffDistInv").count());
        }
        for (value, name) in correction.rest.iter_mut().zip(["P1", "P2", "b1", "b2"]) {
            *value = model.child(name).map_or(Ok(0.0), |child| number(name, &child.text))?;
        }
    }
    for child in &node.children {
        if !["KnownConv", "PP", "F", "SzIm", "CalibDistortion"].contains(&child.name.as_str()) {
            notes.ignore(&child.name, 1);
        }
    }
    let size = [size[0] as u32, size[1] as u32];
    let [p1, p2, b1, b2] = correction.rest;
    let k = |k: usize| correction.radial.get(k).copied().unwrap_or(0.0);
    let (x0, y0) = (pp[0] - f64::from(size[0]) / 2.0, f64::from(size[1]) / 2.0 - pp[1]);
    let interior = Interior::Brown { c: Some(f), x0, y0, k1: k(0), k2: k(1), k3: k(2), p1, p2: -p2, b1, b2: -b2 };
    let camera = Camera::new(id, size[0], size[1], interior);
    let more = correction.radial.iter().skip(3).any(|value| *value != 0.0);
    let distorts = correction.radial.iter().chain(&correction.rest).any(|value| *value != 0.0);
    let other = more || (correction.centre != pp && distorts);
    let model = ForeignModel::Correction(camera, other.then_some(correction));
    Ok(vec![ForeignCamera { id: id.to_owned(), size, model, pose: None, region: None, covariance: None }])
}

/// The camera as a calibration: the brown model in pixels.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let region = options.region.clone().unwrap_or_else(|| conversion::whole([camera.width, camera.height]));
    conversion::check_region(&region)?;
    let (brown, conversion) = in_pixels(camera, &region, options.convert)?;
    let Interior::Brown { c: Some(c), x0, y0, k1, k2, k3, p1, p2, b1, b2 } = brown.interior else {
        return Err(Error::MissingInitialValues {
            photos: Vec::new(),
            points: Vec::new(),
            cameras: vec![camera.id.clone()],
        });
    };
    let direction = |pixel| conversion::direction_of(camera, pixel);
    let covariance = options.covariance.as_ref().map(|covariance| {
        let from = (&Side::Engine(camera.clone()), &Side::values(camera)[..]);
        let to = (&Side::Engine(brown.clone()), &Side::values(&brown)[..]);
        conversion::carried(&foreign::single(covariance, camera), from, to, &region, &direction).map(|all| turned(&all))
    });
    let covariance = covariance.transpose()?;
    let pp = [f64::from(camera.width) / 2.0 + x0, f64::from(camera.height) / 2.0 - y0];
    let mut text = String::from(
        "<?xml version=\"1.0\" ?>\n<ExportAPERO>\n  <CalibrationInternConique>\n    <KnownConv>eConvApero_DistM2C</KnownConv>\n",
    );
    let _ = writeln!(
        text,
        "    <PP>{:?} {:?}</PP>\n    <F>{c:?}</F>\n    <SzIm>{} {}</SzIm>",
        pp[0], pp[1], camera.width, camera.height
    );
    let _ = writeln!(
        text,
        "    <CalibDistortion>\n      <ModPhgrStd>\n        <RadiePart>\n          <CDist>{:?} {:?}</CDist>",
        pp[0], pp[1]
    );
    for k in [k1, k2, k3] {
        let _ = writeln!(text, "          <CoeffDist>{k:?}</CoeffDist>");
    }
    let _ = writeln!(
        text,
        "        </RadiePart>\n        <P1>{p1:?}</P1>\n        <P2>{:?}</P2>\n        <b1>{b1:?}</b1>\n        <b2>{:?}</b2>",
        -p2, -b2
    );
    text += "      </ModPhgrStd>\n    </CalibDistortion>\n  </CalibrationInternConique>\n</ExportAPERO>\n";
    let mut files = Files::from([("AutoCal.xml".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &covariance {
        files.extend([foreign::covariance_file(&camera.id, "ModPhgrStd", covariance)?]);
    }
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}

/// The covariance in this format's names and signs: y points down.
fn turned(covariance: &Covariance) -> Covariance {
    const NAMES: [(&str, &str, f64); 10] = [
        ("c", "F", 1.0),
        ("x0", "PPx", 1.0),
        ("y0", "PPy", -1.0),
        ("k1", "CoeffDist1", 1.0),
        ("k2", "CoeffDist2", 1.0),
        ("k3", "CoeffDist3", 1.0),
        ("p1", "P1", 1.0),
        ("p2", "P2", -1.0),
        ("b1", "b1", 1.0),
        ("b2", "b2", -1.0),
    ];
    let of = |name: &String| {
        NAMES.iter().find(|(ours, ..)| ours == name).map_or(("", 1.0), |(_, theirs, sign)| (*theirs, *sign))
    };
    let all: Vec<(&str, f64)> = covariance.parameters.iter().map(of).collect();
    let row = |(row, (_, sign)): (&Vec<f64>, &(&str, f64))| {
        row.iter().zip(&all).map(|(value, (_, other))| value * sign * other).collect()
    };
    Covariance {
        parameters: all.iter().map(|(name, _)| (*name).to_owned()).collect(),
        matrix: covariance.matrix.iter().zip(&all).map(row).collect(),
    }
}

/// The camera as a brown model in pixels, exactly where it is one of square pixels.
fn in_pixels(camera: &Camera, region: &[[f64; 2]], convert: bool) -> Result<(Camera, Option<Conversion>)> {
    let [px, py] = camera.pitch();
    let scaled = match camera.interior {
        Interior::Brown { c: Some(c), x0, y0, k1, k2, k3, p1, p2, b1, b2 } => {
            let s = py;
            Interior::Brown {
                c: Some(c / s),
                x0: x0 / px,
                y0: y0 / py,
                k1: k1 * s * s,
                k2: k2 * s.powi(4),
                k3: k3 * s.powi(6),
                p1: p1 * s,
                p2: p2 * s,
                b1,
                b2,
            }
        }
        _ => {
            let plain = foreign::undistorted(camera)?;
            foreign::near_brown(&plain, [camera.width, camera.height])
        }
    };
    let near = Camera { pixel_pitch: None, interior: scaled, ..camera.clone() };
    if px == py && matches!(camera.interior, Interior::Brown { .. }) {
        return Ok((near, None));
    }
    let side = Side::Engine(near.clone());
    let direction = |pixel| conversion::direction_of(camera, pixel);
    let fails = || Error::Invalid {
        reason: ExchangeReason::ConversionFails { model: conversion::model_name(camera).into() }.into(),
        at: Place::camera(&camera.id),
    };
    let fitted = conversion::fit(&side, &Side::values(&near), region, &direction).ok_or_else(fails)?;
    if fitted.max_px > LARGEST_PX && !convert {
        let reason = ExchangeReason::ConversionTooLarge { max_px: fitted.max_px.into() }.into();
        return Err(Error::Invalid { reason, at: Place::camera(&camera.id) });
    }
    let conversion = Conversion {
        camera: camera.id.clone(),
        from: conversion::model_name(camera).into(),
        to: "MicMac ModPhgrStd".into(),
        max_px: fitted.max_px,
        rms_px: fitted.rms_px,
        region: region.to_vec(),
        warning: fitted.max_px > WARNING_PX,
    };
    Ok((Side::camera(&near, &fitted.values), Some(conversion)))
}
