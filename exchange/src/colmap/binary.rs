//! COLMAP's binary files, little-endian.

use super::super::Files;
use super::super::network::OutgoingNetwork;
use super::{ALL, Image, Numbered, OTHERS, lens};
use crate::reason::ExchangeReason;
use sightline::error::{Error, Place, Result};

/// Bytes that are read from the front.
struct Bytes<'a> {
    rest: &'a [u8],
}

impl Bytes<'_> {
    fn take<const N: usize>(&mut self, expected: &str) -> Result<[u8; N]> {
        let ends = || Error::Invalid {
            reason: ExchangeReason::EndsWhere { expected: expected.into() }.into(),
            at: Place::default(),
        };
        let (head, rest) = self.rest.split_first_chunk::<N>().ok_or_else(ends)?;
        self.rest = rest;
        Ok(*head)
    }

    fn u32(&mut self, expected: &str) -> Result<u32> {
        self.take(expected).map(u32::from_le_bytes)
    }

    fn u64(&mut self, expected: &str) -> Result<u64> {
        self.take(expected).map(u64::from_le_bytes)
    }

    fn number(&mut self, expected: &str) -> Result<f64> {
        let number = f64::from_le_bytes(self.take(expected)?);
        if number.is_finite() { Ok(number) } else { Err(wrong(expected, &number.to_string())) }
    }

    fn numbers<const N: usize>(&mut self, expected: &str) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number(expected)?;
        }
        Ok(numbers)
    }

    /// A count of records, refused before anything is reserved where the file is too short for them.
    fn count(&mut self, expected: &str, smallest: usize) -> Result<usize> {
        let count = self.u64(expected)?;
        let fits = usize::try_from(count).ok().filter(|count| count.saturating_mul(smallest) <= self.rest.len());
        fits.ok_or_else(|| {
            wrong(expected, &format!("{count}, of which the file holds at most {}", self.rest.len() / smallest))
        })
    }

    fn text(&mut self, expected: &str) -> Result<String> {
        let ends = || Error::Invalid {
            reason: ExchangeReason::EndsWhere { expected: expected.into() }.into(),
            at: Place::default(),
        };
        let end = self.rest.iter().position(|byte| *byte == 0).ok_or_else(ends)?;
        let text = String::from_utf8_lossy(&self.rest[..end]).into_owned();
        self.rest = &self.rest[end + 1..];
        Ok(text)
    }

    fn ended(&self) -> Result<()> {
        if self.rest.is_empty() {
            return Ok(());
        }
        Err(wrong("the end of the file", &format!("{} further bytes", self.rest.len())))
    }
}

fn wrong(expected: &str, found: &str) -> Error {
    let reason = ExchangeReason::ExpectedHere { expected: expected.into(), found: found.into() }.into();
    Error::Invalid { reason, at: Place::default() }
}

/// `cameras.bin`.
pub fn cameras(bytes: &[u8]) -> Result<Vec<Numbered>> {
    let mut bytes = Bytes { rest: bytes };
    let mut cameras = Vec::new();
    for _ in 0..bytes.count("the number of cameras", 48)? {
        let id = bytes.u32("the id of a camera")?;
        let place = |error: Error| match error {
            Error::Invalid { reason, .. } => Error::Invalid { reason, at: Place::camera(id.to_string()) },
            other => other,
        };
        let model = i32::from_le_bytes(bytes.take("the model of a camera")?);
        let shape = ALL.iter().find(|(number, _)| *number == model).map(|(_, shape)| shape).ok_or_else(|| {
            let name = OTHERS.iter().find(|(number, _)| *number == model).map(|(_, name)| (*name).to_owned());
            let reason = ExchangeReason::NoSuchCameraModel { model: name.unwrap_or_else(|| model.to_string()) }.into();
            Error::Invalid { reason, at: Place::camera(id.to_string()) }
        })?;
        let size = [bytes.u64("the width of a picture")?, bytes.u64("the height of a picture")?];
        let fits = size.map(|size| u32::try_from(size).ok().filter(|size| *size > 0));
        let [Some(width), Some(height)] = fits else {
            return Err(place(wrong("width and height in pixels", &format!("{size:?}"))));
        };
        let values: Result<Vec<f64>> = shape.parameters.iter().map(|(name, _)| bytes.number(name)).collect();
        let values = values.map_err(place)?;
        let lens = lens(shape, &values);
        let lens = lens.ok_or_else(|| place(wrong("a focal length above 0", &format!("{:?}", values[0]))))?;
        cameras.push((id, shape, lens, [width, height]));
    }
    bytes.ended()?;
    Ok(cameras)
}

/// `images.bin`.
pub fn images(bytes: &[u8]) -> Result<Vec<Image>> {
    let mut bytes = Bytes { rest: bytes };
    let mut images = Vec::new();
    for _ in 0..bytes.count("the number of images", 73)? {
        let mut image = Image {
            id: bytes.u32("the id of an image")?,
            quaternion: bytes.numbers("a quaternion")?,
            translation: bytes.numbers("a translation")?,
            camera: bytes.u32("the camera of an image")?,
            name: bytes.text("the name of an image")?,
            ..Image::default()
        };
        for _ in 0..bytes.count("the number of keypoints", 24)? {
            let pixel = bytes.numbers("a keypoint")?;
            match bytes.u64("the point of a keypoint")? {
                u64::MAX => image.free += 1,
                id => image.measured.push((pixel, id)),
            }
        }
        images.push(image);
    }
    bytes.ended()?;
    Ok(images)
}

/// `points3D.bin`.
pub fn points(bytes: &[u8]) -> Result<Vec<(u64, [f64; 3])>> {
    let mut bytes = Bytes { rest: bytes };
    let mut points = Vec::new();
    for _ in 0..bytes.count("the number of points", 51)? {
        let id = bytes.u64("the id of a point")?;
        points.push((id, bytes.numbers("the coordinates of a point")?));
        // Colour and error.
        bytes.take::<11>("the colour of a point")?;
        let track = bytes.count("the length of a track", 8)?;
        bytes.rest = &bytes.rest[8 * track..];
    }
    bytes.ended()?;
    Ok(points)
}

/// The three files.
pub fn write(network: &OutgoingNetwork) -> Files {
    let number = |count: usize| (count as u64).to_le_bytes();
    let mut cameras = number(network.cameras.len()).to_vec();
    for (k, (camera, out)) in network.cameras.iter().enumerate() {
        let model = ALL.iter().find(|(_, shape)| shape.name == out.shape.name).map_or(-1, |(number, _)| *number);
        cameras.extend((k as u32 + 1).to_le_bytes());
        cameras.extend(model.to_le_bytes());
        cameras.extend(u64::from(camera.width).to_le_bytes());
        cameras.extend(u64::from(camera.height).to_le_bytes());
        out.values.iter().for_each(|value| cameras.extend(value.to_le_bytes()));
    }
    let mut images = number(network.photos.len()).to_vec();
    for photo in &network.photos {
        images.extend((photo.number as u32).to_le_bytes());
        let values = photo.pose.quaternion().into_iter().chain(photo.pose.translation());
        values.for_each(|value| images.extend(value.to_le_bytes()));
        images.extend((photo.camera as u32 + 1).to_le_bytes());
        images.extend(photo.file.replace('\0', "").as_bytes());
        images.push(0);
        images.extend(number(photo.measured.len()));
        for ([u, v], point) in &photo.measured {
            images.extend(u.to_le_bytes());
            images.extend(v.to_le_bytes());
            images.extend(number(network.points[*point].number));
        }
    }
    let mut points = number(network.points.len()).to_vec();
    for point in &network.points {
        points.extend(number(point.number));
        point.xyz.iter().for_each(|value| points.extend(value.to_le_bytes()));
        points.extend([128, 128, 128]);
        points.extend((-1.0f64).to_le_bytes());
        points.extend(number(point.seen.len()));
        for (photo, place) in &point.seen {
            points.extend((network.photos[*photo].number as u32).to_le_bytes());
            points.extend((*place as u32).to_le_bytes());
        }
    }
    Files::from([
        ("cameras.bin".to_owned(), cameras),
        ("images.bin".to_owned(), images),
        ("points3D.bin".to_owned(), points),
    ])
}
