//! Calibrations of Agisoft (Metashape's and PhotoScan's "Agisoft camera calibration", XML), and the lens of its projects.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0.5, 0.5): ours; cx, cy from the centre of the picture |
//! | axes | x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | distortion | ideal to image: k1 to k4, (P1 (r² + 2a²) + 2 P2 a b, P2 (r² + 2b²) + 2 P1 a b): p1, p2 are OpenCV's exchanged |
//! | affinity | u = w/2 + cx + a' (f + b1) + b' b2,   v = h/2 + cy + b' f |
//!
//! Source: Agisoft Metashape User Manual, Professional Edition, appendix "Camera models". p3, p4, fisheye and other projections are refused by
//! name; files before 1.2 (fx, fy) had other conventions and are refused.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::Files;
use super::conversion::Covariance;
use super::dbat::element::Element;
use super::foreign::{self, CameraOptions, ExportedCamera, ForeignCamera, Notes, Outgoing};
use super::lens::{Lens, LensModel, term::*};
use super::tree;
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::Camera;

/// The model; cx, cy are values of our frame here.
pub static METASHAPE: LensModel = LensModel {
    name: "Metashape frame",
    equidistant: false,
    parameters: &[
        ("f", &[FY, FX]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("b1", &[FX]),
        ("b2", &[SKEW]),
        ("k1", &[K1]),
        ("k2", &[K2]),
        ("k3", &[K3]),
        ("k4", &[K4]),
        ("p1", &[P2]),
        ("p2", &[P1]),
    ],
};

/// An error at an element.
pub fn wrong(name: &str, expected: &str, found: &str) -> Error {
    let reason = ExchangeReason::ExpectedHere { expected: expected.into(), found: shortened(found) }.into();
    Error::Invalid { reason, at: Place::field(name) }
}

/// A number in a text.
pub fn number(name: &str, text: &str) -> Result<f64> {
    tree::number(text.trim()).ok_or_else(|| wrong(name, "a number", text))
}

/// So many numbers in a text.
pub fn numbers<const N: usize>(name: &str, text: &str) -> Result<[f64; N]> {
    let found: Option<Vec<f64>> = text.split_whitespace().map(tree::number).collect();
    found.and_then(|found| found.try_into().ok()).ok_or_else(|| wrong(name, &format!("{N} numbers"), text))
}

/// A size in pixels.
pub fn pixels(name: &str, text: &str) -> Result<u32> {
    let size = text.trim().parse().ok().filter(|size: &u32| *size > 0);
    size.ok_or_else(|| wrong(name, "a whole number of pixels from 1", text))
}

/// Whether a document is of this format.
pub fn recognises(root: &Element) -> bool {
    root.name == "calibration" && root.child("projection").is_some()
}

/// The calibration of a document.
///
/// # Errors
/// [`Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`].
pub fn read(root: &Element, id: &str, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let projection = root.child("projection").map(|child| child.text.clone()).unwrap_or_default();
    let size = |name: &str| {
        let missing = || Error::Invalid { reason: Reason::Missing { name: name.into() }, at: Place::field(name) };
        pixels(name, &root.child(name).ok_or_else(missing)?.text)
    };
    let size = [size("width")?, size("height")?];
    let lens = lens(root, &projection, size)?;
    let known =
        ["projection", "width", "height", "f", "cx", "cy", "b1", "b2", "k1", "k2", "k3", "k4", "p1", "p2", "p3", "p4"];
    for child in root.children.iter().filter(|child| !known.contains(&child.name.as_str())) {
        notes.ignore(&child.name, 1);
    }
    Ok(vec![ForeignCamera::new(id, size, &METASHAPE, lens)])
}

/// The lens of a `calibration` element.
///
/// # Errors
/// [`Error::Invalid`] with the element; [`ExchangeReason::NoSuchCameraModel`].
pub fn lens(calibration: &Element, projection: &str, [width, height]: [u32; 2]) -> Result<Lens> {
    if projection != "frame" {
        let reason = ExchangeReason::NoSuchCameraModel { model: format!("Metashape {}", shortened(projection)) }.into();
        return Err(Error::Invalid { reason, at: Place::field("projection") });
    }
    let value = |name: &str| calibration.child(name).map_or(Ok(0.0), |child| number(name, &child.text));
    if calibration.child("f").is_none() {
        let found = if calibration.child("fx").is_some() { "fx, of a version before 1.2" } else { "" };
        return Err(wrong("calibration", "a principal distance f", found));
    }
    for name in ["p3", "p4"] {
        if value(name)? != 0.0 {
            let reason = ExchangeReason::NoSuchCameraModel { model: format!("Metashape with {name}") }.into();
            return Err(Error::Invalid { reason, at: Place::field(name) });
        }
    }
    let mut values = METASHAPE.parameters.iter().map(|(name, _)| value(name)).collect::<Result<Vec<_>>>()?;
    if !(values[0] > 0.0 && values[0] + values[3] > 0.0) {
        return Err(wrong("f", "a principal distance above 0", &values[0].to_string()));
    }
    values[1] += f64::from(width) / 2.0;
    values[2] += f64::from(height) / 2.0;
    Ok(METASHAPE.lens(&Lens::default(), &values))
}

/// The covariance of a `covariance` element: names under `params`, rows under `coeffs`.
///
/// # Errors
/// [`Error::Invalid`] with the element.
pub fn covariance(element: &Element) -> Result<Option<Covariance>> {
    let (Some(names), Some(rows)) = (element.child("params"), element.child("coeffs")) else { return Ok(None) };
    let parameters: Vec<String> = names.text.split_whitespace().map(str::to_ascii_lowercase).collect();
    let values: Option<Vec<f64>> = rows.text.split_whitespace().map(tree::number).collect();
    let n = parameters.len();
    let values = values.filter(|values| values.len() == n * n && n > 0);
    let values = values.ok_or_else(|| wrong("coeffs", &format!("{} numbers", n * n), &rows.text))?;
    Ok(Some(Covariance { parameters, matrix: values.chunks(n).map(<[f64]>::to_vec).collect() }))
}

/// Elements of a calibration, each in a line that is indented.
///
/// # Errors
/// [`Error::Invalid`] where f and b1 do not hold the principal distance in x: beside f = fy it is too small for b1 = fx - fy.
pub fn elements(out: &Outgoing, camera: &Camera, indent: &str) -> Result<String> {
    let mut text = String::new();
    let [f, b1] = ["f", "b1"].map(|wanted| {
        let mut named = METASHAPE.parameters.iter().zip(&out.values);
        named.find(|((name, _), _)| *name == wanted).map_or(0.0, |(_, value)| *value)
    });
    if !(f > 0.0 && f + b1 > 0.0) {
        return Err(wrong("fx", "a principal distance of the size of fy", &(f + b1).to_string()));
    }
    for ((name, _), value) in METASHAPE.parameters.iter().zip(&out.values) {
        let value = match *name {
            "cx" => value - f64::from(camera.width) / 2.0,
            "cy" => value - f64::from(camera.height) / 2.0,
            _ => *value,
        };
        // Absent ones are 0.
        if value != 0.0 || *name == "f" {
            let _ = writeln!(text, "{indent}<{name}>{value:?}</{name}>");
        }
    }
    Ok(text)
}

/// The camera as a calibration.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    let out = foreign::outgoing(camera, &[&METASHAPE], &Lens::default(), options)?;
    let text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<calibration>\n  <projection>frame</projection>\n  <width>{}</width>\n  <height>{}</height>\n{}</calibration>\n",
        camera.width,
        camera.height,
        elements(&out, camera, "  ")?
    );
    let mut files = Files::from([("camera.xml".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, METASHAPE.name, covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}
