//! Results of Bundler (`bundle.out`, version 0.3), with the list of its pictures (`list.txt`) where it is there.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the picture, x right, y up |
//! | axes | camera: x right, y up, z backwards: ours; p = -P / P.z |
//! | rotation | matrix by rows and translation, object to camera: P = R X + t |
//! | distortion | ideal to image: f (1 + k1 p² + k2 p⁴) p |
//!
//! Source: Bundler User's Manual, "Output format and scene representation". The file has no size of the picture: see [`bal`](super::bal). Cameras of f = 0
//! have no orientation. Colours of points and keys of measurements are not kept. Photos and points are named by their places from 0.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use nalgebra::Matrix3;

use super::bal::{self, SNAVELY, Words};
use super::foreign::Assumed;
use super::lens::{Lens, term::*};
use super::network::{self, ForeignNetwork, Models, OutgoingNetwork};
use super::{Files, encoding};
use sightline::error::{Error, Place, Result};
use sightline::project::{Camera, Point};

/// Whether a text is of this format.
pub fn recognises(text: &str) -> bool {
    text.trim_start().starts_with("# Bundle file v0.")
}

/// A result from its files: the one that begins as such, and a list of pictures.
///
/// # Errors
/// [`Error::Invalid`] with file, line and what was expected there.
pub fn read(files: &Files) -> Result<ForeignNetwork> {
    let mut bundle = None;
    let mut list = Vec::new();
    for (name, bytes) in files {
        let text = encoding::text(bytes).map_err(|error| error.in_file(name))?;
        if recognises(&text) {
            bundle = Some((name, text));
        } else {
            let first = |line: &str| line.split_whitespace().next().map(str::to_owned);
            list.extend(text.lines().filter_map(first));
        }
    }
    let Some((name, text)) = bundle else {
        let reason =
            ExchangeReason::ExpectedHere { expected: "# Bundle file v0.3".into(), found: String::new() }.into();
        return Err(Error::Invalid { reason, at: Place::line(1) });
    };
    network(&text, &list).map_err(|error| error.in_file(name))
}

fn network(text: &str, list: &[String]) -> Result<ForeignNetwork> {
    let mut words = Words::new(text);
    let mut network = ForeignNetwork::default();
    let cameras = words.whole("a number of cameras", usize::MAX)?;
    let points = words.whole("a number of points", usize::MAX)?;
    let mut read = Vec::new();
    for _ in 0..cameras {
        let lens: [f64; 3] = words.numbers("f, k1, k2 of a camera")?;
        let rotation: [f64; 9] = words.numbers("the rotation of a camera")?;
        let translation: [f64; 3] = words.numbers("the translation of a camera")?;
        read.push((lens, Matrix3::from_row_slice(&rotation), translation));
    }
    let mut measured = Vec::new();
    for k in 0..points {
        let xyz = words.numbers("X, Y, Z of a point")?;
        network.points.push(Point { id: k.to_string(), xyz: Some(xyz), ..Point::default() });
        words.numbers::<3>("the colour of a point")?;
        for _ in 0..words.whole("a number of views", usize::MAX)? {
            let camera = words.whole(&format!("a camera from 0, fewer than {cameras}"), cameras)?;
            words.whole("the key of a view", usize::MAX)?;
            measured.push((camera, k, words.numbers::<2>("the measurement x, y")?));
        }
    }
    words.ended()?;
    let size = bal::size(measured.iter().map(|(.., pixel)| *pixel));
    for (k, (lens, rotation, translation)) in read.iter().enumerate() {
        let file = list.get(k).map_or("", String::as_str);
        if lens[0] == 0.0 {
            network.notes.ignore("cameras without orientation", 1);
            continue;
        }
        let at = || Place::photo(k.to_string());
        let invalid = |expected: &str, found: String| Error::Invalid {
            reason: ExchangeReason::ExpectedHere { expected: expected.into(), found }.into(),
            at: at(),
        };
        if lens[0] < 0.0 {
            return Err(invalid("a focal length above 0", lens[0].to_string()));
        }
        let pose = bal::pose(*rotation, *translation);
        let pose = pose.ok_or_else(|| invalid("a rotation", format!("{:?}", rotation.as_slice())))?;
        let camera = bal::camera(&mut network, *lens, size);
        network.photos.push(network::photo(k.to_string(), camera, file, Some(pose)));
    }
    let [w, h] = size.map(f64::from);
    for (camera, point, [x, y]) in measured {
        if read[camera].0[0] == 0.0 {
            network.notes.ignore("measurements in cameras without orientation", 1);
            continue;
        }
        let pixel = [w / 2.0 + x, h / 2.0 - y];
        network.observations.push(network::observation(&camera.to_string(), &point.to_string(), pixel));
    }
    network.notes.ignore("colours of points", points);
    network.notes.assume(Assumed::ImageSizeFromMeasurements);
    network.notes.assume(Assumed::SigmaOnePixel);
    Ok(network)
}

/// Models that are written: the principal point is the centre of the picture.
pub const WRITES: Models<'static> = (&[&SNAVELY], centre);

fn centre(camera: &Camera) -> Lens {
    let mut lens = Lens::default();
    (lens.terms[CX], lens.terms[CY]) = (f64::from(camera.width) / 2.0, f64::from(camera.height) / 2.0);
    lens
}

/// `bundle.out` and `list.txt`.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn write(network: &OutgoingNetwork) -> Result<Files> {
    let mut text = format!("# Bundle file v0.3\n{} {}\n", network.photos.len(), network.points.len());
    let mut list = String::new();
    for photo in &network.photos {
        let [f, k1, k2] = network.cameras[photo.camera].1.values[..] else { continue };
        let (r, [x, y, z]) = bal::backwards(&photo.pose);
        let _ = writeln!(text, "{f:?} {k1:?} {k2:?}");
        for i in 0..3 {
            let _ = writeln!(text, "{:?} {:?} {:?}", r[(i, 0)], r[(i, 1)], r[(i, 2)]);
        }
        let _ = writeln!(text, "{x:?} {y:?} {z:?}");
        let _ = writeln!(list, "{} 0 {f:?}", photo.file.split_whitespace().collect::<Vec<_>>().join("_"));
    }
    for point in &network.points {
        let [x, y, z] = point.xyz;
        let _ = write!(text, "{x:?} {y:?} {z:?}\n128 128 128\n{}", point.seen.len());
        for (photo, place) in &point.seen {
            let of = &network.photos[*photo];
            let camera = &network.cameras[of.camera].0;
            let [u, v] = of.measured[*place].0;
            let (x, y) = (u - f64::from(camera.width) / 2.0, f64::from(camera.height) / 2.0 - v);
            let _ = write!(text, " {photo} {place} {x:?} {y:?}");
        }
        text.push('\n');
    }
    let files = Files::from([("bundle.out".to_owned(), text.into_bytes()), ("list.txt".to_owned(), list.into_bytes())]);
    network::with_companion(files, network)
}
