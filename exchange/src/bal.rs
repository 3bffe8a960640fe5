//! Problems of "Bundle Adjustment in the Large": cameras, points, measurements in one text.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the principal point, x right, y up |
//! | axes | camera: x right, y up, z backwards: ours; p = -P / P.z |
//! | rotation | rotation vector and translation, object to camera: P = R X + t |
//! | distortion | ideal to image: f (1 + k1 p² + k2 p⁴) p |
//!
//! Source: S. Agarwal et al., Bundle Adjustment in the Large, "Data format". The file has no size of the picture: it is as large as
//! its measurements need, with the principal point in its centre. Photos and points are named by their places from 0.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::Files;
use super::foreign::{Assumed, ForeignCamera, Pose};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork, Models, OutgoingNetwork};
use super::tree;
use sightline::error::{Error, Place, Result, shortened};
use sightline::project::{Camera, Point};

/// The model; the principal point is the origin.
pub static SNAVELY: LensModel =
    LensModel { name: "f k1 k2", parameters: &[("f", &[FX, FY]), ("k1", &[K1]), ("k2", &[K2])], equidistant: false };

/// Numbers of a text with their lines.
pub struct Words<'a> {
    words: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    line: usize,
}

impl<'a> Words<'a> {
    /// Words of a text; lines that begin with # are skipped.
    pub fn new(text: &'a str) -> Self {
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with('#'));
        Self {
            words: Box::new(lines.flat_map(|(k, line)| line.split_whitespace().map(move |word| (k + 1, word)))),
            line: 1,
        }
    }

    /// A word.
    pub fn word(&mut self, expected: &str) -> Result<&'a str> {
        match self.words.next() {
            Some((line, word)) => {
                self.line = line;
                Ok(word)
            }
            None => Err(Error::Invalid {
                reason: ExchangeReason::EndsWhere { expected: expected.into() }.into(),
                at: Place::line(self.line),
            }),
        }
    }

    /// An error at the word that was read last.
    pub fn wrong(&self, expected: &str, found: &str) -> Error {
        let reason = ExchangeReason::ExpectedHere { expected: expected.into(), found: shortened(found) }.into();
        Error::Invalid { reason, at: Place::line(self.line) }
    }

    /// A number.
    pub fn number(&mut self, expected: &str) -> Result<f64> {
        let word = self.word(expected)?;
        tree::number(word).ok_or_else(|| self.wrong(expected, word))
    }

    /// So many numbers.
    pub fn numbers<const N: usize>(&mut self, expected: &str) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number(expected)?;
        }
        Ok(numbers)
    }

    /// A whole number below a limit.
    pub fn whole(&mut self, expected: &str, below: usize) -> Result<usize> {
        let word = self.word(expected)?;
        word.parse().ok().filter(|number| *number < below).ok_or_else(|| self.wrong(expected, word))
    }

    /// The next word, where there is one.
    pub fn next_word(&mut self) -> Option<&'a str> {
        let (line, word) = self.words.next()?;
        self.line = line;
        Some(word)
    }

    /// All words that are left.
    pub fn rest(self) -> Vec<&'a str> {
        self.words.map(|(_, word)| word).collect()
    }

    /// Checks that nothing is left in the file.
    pub fn ended(&mut self) -> Result<()> {
        match self.words.next() {
            None => Ok(()),
            Some((line, word)) => {
                self.line = line;
                Err(self.wrong("the end of the file", word))
            }
        }
    }
}

/// Whether a text is of this format: three whole numbers, then four numbers a line.
pub fn recognises(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let whole = |line: &str, count: usize| {
        line.split_whitespace().count() == count && line.split_whitespace().all(|word| word.parse::<usize>().is_ok())
    };
    let measured = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        words.len() == 4
            && whole(&words[..2].join(" "), 2)
            && words[2..].iter().all(|word| tree::number(word).is_some())
    };
    lines.next().is_some_and(|line| whole(line, 3)) && lines.next().is_some_and(measured)
}

/// Size of a picture that holds measurements from its centre.
pub fn size(measured: impl Iterator<Item = [f64; 2]>) -> [u32; 2] {
    let mut largest = [0.0f64; 2];
    for [x, y] in measured {
        largest = [largest[0].max(x.abs()), largest[1].max(y.abs())];
    }
    largest.map(|side| (2.0 * (side.floor() + 1.0)).min(1e6) as u32)
}

/// A pose in the axes of this format.
pub fn pose(rotation: Matrix3<f64>, translation: [f64; 3]) -> Option<Pose> {
    let over = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    Pose::new(over * rotation, (over * Vector3::from(translation)).into())
}

/// The place of a camera of these parameters among those of a network, which is as large as `size`.
pub fn camera(network: &mut ForeignNetwork, [f, k1, k2]: [f64; 3], size: [u32; 2]) -> String {
    let mut lens = SNAVELY.lens(&Lens::default(), &[f, k1, k2]);
    (lens.terms[CX], lens.terms[CY]) = (f64::from(size[0]) / 2.0, f64::from(size[1]) / 2.0);
    let same = |camera: &&ForeignCamera| matches!(&camera.model, super::foreign::ForeignModel::Lens(_, other) if *other == lens);
    if let Some(known) = network.cameras.iter().rev().take(1).find(same) {
        return known.id.clone();
    }
    let id = (network.cameras.len() + 1).to_string();
    network.cameras.push(ForeignCamera::new(id.clone(), size, &SNAVELY, lens));
    id
}

/// A problem.
///
/// # Errors
/// [`Error::Invalid`] with the line and what was expected there.
pub fn read(text: &str) -> Result<ForeignNetwork> {
    let mut words = Words::new(text);
    let mut network = ForeignNetwork::default();
    let [cameras, points, measurements] = {
        let mut count = |what: &str| words.whole(what, usize::MAX);
        [count("a number of cameras")?, count("a number of points")?, count("a number of measurements")?]
    };
    let mut measured = Vec::new();
    for _ in 0..measurements {
        let camera = words.whole(&format!("a camera from 0, fewer than {cameras}"), cameras)?;
        let point = words.whole(&format!("a point from 0, fewer than {points}"), points)?;
        measured.push((camera, point, words.numbers::<2>("the measurement x, y")?));
    }
    let size = size(measured.iter().map(|(.., pixel)| *pixel));
    for k in 0..cameras {
        let [rx, ry, rz, tx, ty, tz, f, k1, k2] = words.numbers("rotation, translation, f, k1, k2 of a camera")?;
        if !(f > 0.0) {
            return Err(words.wrong("a focal length above 0", &f.to_string()));
        }
        let pose = pose(*Rotation3::new(Vector3::new(rx, ry, rz)).matrix(), [tx, ty, tz]);
        let camera = camera(&mut network, [f, k1, k2], size);
        network.photos.push(network::photo(k.to_string(), camera, "", pose));
    }
    for k in 0..points {
        let xyz = words.numbers("X, Y, Z of a point")?;
        network.points.push(Point { id: k.to_string(), xyz: Some(xyz), ..Point::default() });
    }
    words.ended()?;
    let [w, h] = size.map(f64::from);
    for (camera, point, [x, y]) in measured {
        let pixel = [w / 2.0 + x, h / 2.0 - y];
        network.observations.push(network::observation(&camera.to_string(), &point.to_string(), pixel));
    }
    network.notes.assume(Assumed::ImageSizeFromMeasurements);
    network.notes.assume(Assumed::SigmaOnePixel);
    Ok(network)
}

/// Models that are written: the principal point is the camera's own, and the origin of the coordinates.
pub const WRITES: Models<'static> = (&[&SNAVELY], principal_point);

fn principal_point(camera: &Camera) -> Lens {
    let mut lens = Lens::default();
    // A camera without a principal distance cannot be converted; `write` returns the error.
    if let Ok(own) = super::foreign::undistorted(camera) {
        (lens.terms[CX], lens.terms[CY]) = (own.terms[CX], own.terms[CY]);
    }
    lens
}

/// A problem.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn write(network: &mut OutgoingNetwork) -> Result<Files> {
    network.notes.ignore("principal points and sizes of pictures", network.cameras.len());
    let measured: usize = network.photos.iter().map(|photo| photo.measured.len()).sum();
    let mut text = format!("{} {} {measured}\n", network.photos.len(), network.points.len());
    for (k, photo) in network.photos.iter().enumerate() {
        let lens = &network.cameras[photo.camera].1.lens;
        for ([u, v], point) in &photo.measured {
            let _ = writeln!(text, "{k} {point} {:?} {:?}", u - lens.terms[CX], lens.terms[CY] - v);
        }
    }
    for photo in &network.photos {
        let (rotation, translation) = backwards(&photo.pose);
        let turn: [f64; 3] = Rotation3::from_matrix_unchecked(rotation).scaled_axis().into();
        let values = turn.iter().chain(&translation).chain(&network.cameras[photo.camera].1.values);
        values.for_each(|value| text += &format!("{value:?}\n"));
    }
    for point in &network.points {
        point.xyz.iter().for_each(|value| text += &format!("{value:?}\n"));
    }
    network::with_companion(Files::from([("problem.txt".to_owned(), text.into_bytes())]), network)
}

/// Rotation and translation of a pose in the axes of this format.
pub fn backwards(pose: &Pose) -> (Matrix3<f64>, [f64; 3]) {
    let over = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    (over * pose.rotation, (over * Vector3::from(pose.translation())).into())
}
