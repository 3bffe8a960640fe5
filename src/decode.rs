//! Picture files to samples: PNG, JPEG, TIFF and BMP of 8 or 16 bits, one grey or colour channel at a time.
//!
//! Samples are what the file holds: no colour management, no EXIF rotation, no resampling. The grey of a JPEG is its own luma
//! plane, as it is stored: not converted, free of the chroma planes, which cameras store at a quarter of its size. The luminance
//! of other coloured pictures is computed in floating point from the decoded channels and rounded once.
//!
//! What a file claims is held against its bytes before memory is taken for it, and rows that a damaged JPEG does not give are
//! named ([`DecodedPhoto::damaged_rows`]).

mod bytes;
mod embedded;
mod jpeg;
mod open;
mod pages;
mod palette;
mod planar;
mod show;
mod signature;

use image::{DynamicImage, ImageDecoder};

use crate::detection::{Channel, Page};
use crate::error::{Damage, Error, Place, Result};
use crate::image::{Grey, Samples};
use crate::limits;
pub use embedded::{Embedded, embedded};
use open::{bits, decoding_error, prepared};
pub use pages::page;
pub use show::{Picture, picture};
pub use signature::Packed;
use signature::{Signature, signature};

/// Largest picture worked on.
pub const PIXEL_LIMIT: u64 = limits::PIXELS;

/// Rows that a row of chroma reaches beyond its own.
const CHROMA_REACH: u32 = 2;

/// Size of a picture, from its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Bits of a sample, 8 or 16.
    pub bits: u32,
}

/// One channel of a decoded photo.
#[derive(Clone, Debug, PartialEq)]
pub struct DecodedPhoto {
    /// The samples; mid-grey in rows that are damaged.
    pub grey: Grey,
    /// Rows that could not be decoded: first row and the row after the last, in rising order. Empty for a sound file.
    pub damaged_rows: Vec<[u32; 2]>,
    /// Which picture of the file it is, where the file has several.
    pub page: Option<Page>,
}

impl DecodedPhoto {
    /// Memory that the samples take.
    pub fn bytes(&self) -> usize {
        match &self.grey.samples {
            Samples::U8(samples) => samples.len(),
            Samples::U16(samples) => 2 * samples.len(),
        }
    }
}

/// The format, where a file is of one whose decoder is not in the engine: HEIC, or a RAW.
pub fn packed(bytes: &[u8]) -> Option<Packed> {
    match signature(bytes) {
        Signature::Packed(format) => Some(format),
        _ => None,
    }
}

/// Size and depth of a picture, without decoding it.
///
/// # Errors
/// [`Error::UnknownImageFormat`], [`Error::BrokenImage`], [`Error::ImageSize`].
pub fn size(bytes: &[u8]) -> Result<Size> {
    if signature(bytes) == Signature::Jpeg {
        return jpeg_size(bytes);
    }
    let bytes = prepared(bytes)?;
    let decoder = open::decoder(&bytes)?;
    let (width, height) = decoder.dimensions();
    Ok(Size { width, height, bits: bits(decoder.color_type())? })
}

/// The same of a JPEG, for decoders outside the engine that have one inside their files.
///
/// # Errors
/// As [`size`].
pub fn jpeg_size(bytes: &[u8]) -> Result<Size> {
    let frame = jpeg::header(bytes).map_err(refused)?;
    Ok(Size { width: frame.width as u32, height: frame.height as u32, bits: 8 })
}

/// One channel of a picture; 16 bits stay 16 bits. Opacity is ignored, palettes are resolved.
///
/// A picture without colours gives its grey for every choice. [`Channel::Grey`] of a coloured JPEG is its luma plane Y as stored,
/// 0.299 R + 0.587 G + 0.114 B of the camera's own making (JFIF); of other coloured pictures, and of JPEGs that store red, green
/// and blue or inks, it is 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709), rounded to the depth of the picture.
///
/// # Errors
/// [`Error::UnknownImageFormat`] for other formats and depths, [`Error::BrokenImage`] for damaged files of which nothing is sure
/// to be whole, [`Error::ImageSize`] for pictures beyond [`PIXEL_LIMIT`] or beyond what the file's bytes can hold, before
/// anything of that size is allocated.
pub fn photo(bytes: &[u8], channel: Channel) -> Result<DecodedPhoto> {
    Ok(open_photo(bytes, channel, None)?.0)
}

/// The same where every row is wanted.
///
/// # Errors
/// As [`photo`]; [`Error::BrokenImage`] with the rows where some are damaged.
pub fn grey(bytes: &[u8], channel: Channel) -> Result<Grey> {
    let photo = photo(bytes, channel)?;
    match photo.damaged_rows.first() {
        None => Ok(photo.grey),
        Some([first, last]) => Err(broken(Damage::Rows { first: *first, last: last - 1 })),
    }
}

/// One decoding for both: a channel, and a picture for showing whose sides do not exceed `max_side`.
///
/// The colours of a JPEG's small picture come from the means of its chroma blocks.
///
/// # Errors
/// As [`photo`].
pub fn photo_and_picture(bytes: &[u8], channel: Channel, max_side: u32) -> Result<(DecodedPhoto, Picture)> {
    let (photo, picture) = open_photo(bytes, channel, Some(max_side))?;
    Ok((photo, picture.unwrap_or_default()))
}

fn open_photo(bytes: &[u8], channel: Channel, max_side: Option<u32>) -> Result<(DecodedPhoto, Option<Picture>)> {
    let mut damaged_rows = Vec::new();
    if signature(bytes) == Signature::Jpeg {
        let frame = jpeg::header(bytes).map_err(refused)?;
        open::check_size(frame.width as u64, frame.height as u64)?;
        if is_grey(&frame, channel) {
            let luma = jpeg::luma(bytes).map_err(refused)?;
            let picture = max_side.map(|side| show::reduced_luma(&luma, side));
            let jpeg::Plane8 { width, height, samples } = luma.plane;
            let grey = Grey { width, height, samples: Samples::U8(samples) };
            return Ok((DecodedPhoto { grey, damaged_rows: luma.damaged, page: None }, picture));
        }
        if let Some(first) = jpeg::damaged_from(bytes).map_err(refused)? {
            // chroma is interpolated from damaged rows too
            if first <= CHROMA_REACH {
                return Err(broken(Damage::NoWholeRow));
            }
            damaged_rows.push([first - CHROMA_REACH, frame.height as u32]);
        }
    }
    let page = page(bytes);
    let bytes = prepared(bytes)?;
    let mut image = DynamicImage::from_decoder(open::decoder(&bytes)?).map_err(decoding_error)?;
    bits(image.color())?;
    let picture = max_side.map(|side| show::reduced(&image, side));
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut samples = chosen(&mut image, channel);
    if let Samples::U8(samples) = &mut samples {
        for rows in &damaged_rows {
            let [first, last] = rows.map(|row| row as usize * width);
            samples[first..last].fill(128);
        }
    }
    Ok((DecodedPhoto { grey: Grey { width, height, samples }, damaged_rows, page }, picture))
}

/// Whether the first plane of a JPEG is the channel that is wanted.
fn is_grey(frame: &jpeg::FrameHeader, channel: Channel) -> bool {
    let named = match frame.colours {
        jpeg::Colours::Grey => true,
        jpeg::Colours::Luma => channel == Channel::Grey,
        jpeg::Colours::Others => false,
    };
    named && frame.has_full_luma()
}

/// The chosen samples of a picture, in the place of all.
fn chosen(image: &mut DynamicImage, channel: Channel) -> Samples {
    let channels = usize::from(image.color().channel_count());
    match std::mem::take(image) {
        DynamicImage::ImageLuma8(buffer) => Samples::U8(buffer.into_raw()),
        DynamicImage::ImageLumaA8(buffer) => Samples::U8(gathered(buffer.into_raw(), channels, channel)),
        DynamicImage::ImageRgb8(buffer) => Samples::U8(gathered(buffer.into_raw(), channels, channel)),
        DynamicImage::ImageRgba8(buffer) => Samples::U8(gathered(buffer.into_raw(), channels, channel)),
        DynamicImage::ImageLuma16(buffer) => Samples::U16(buffer.into_raw()),
        DynamicImage::ImageLumaA16(buffer) => Samples::U16(gathered(buffer.into_raw(), channels, channel)),
        DynamicImage::ImageRgb16(buffer) => Samples::U16(gathered(buffer.into_raw(), channels, channel)),
        DynamicImage::ImageRgba16(buffer) => Samples::U16(gathered(buffer.into_raw(), channels, channel)),
        // refused by its kind of samples before
        _ => Samples::U8(Vec::new()),
    }
}

/// One sample of each pixel, or its luminance, moved to the front: sample i never lies behind its pixel.
fn gathered<T: Copy + Into<f64> + FromLevel>(mut raw: Vec<T>, channels: usize, channel: Channel) -> Vec<T> {
    let pixels = raw.len() / channels;
    for i in 0..pixels {
        let at = i * channels;
        raw[i] = match channel {
            _ if channels < 3 => raw[at],
            Channel::Grey => T::from_level(luminance([0, 1, 2].map(|c| raw[at + c].into()))),
            Channel::Red => raw[at],
            Channel::Green => raw[at + 1],
            Channel::Blue => raw[at + 2],
        };
    }
    raw.truncate(pixels);
    raw.shrink_to_fit();
    raw
}

/// A sample from a level that is rounded already.
trait FromLevel {
    fn from_level(level: f64) -> Self;
}

impl FromLevel for u8 {
    fn from_level(level: f64) -> Self {
        level as u8
    }
}

impl FromLevel for u16 {
    fn from_level(level: f64) -> Self {
        level as u16
    }
}

fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    (0.2126 * red + 0.7152 * green + 0.0722 * blue).round()
}

fn broken(reason: Damage) -> Error {
    Error::BrokenImage { reason, at: Place::default() }
}

/// Why a JPEG is not read.
fn refused(refusal: jpeg::Refusal) -> Error {
    match refusal {
        jpeg::Refusal::Kind(kind) => Error::UnknownImageFormat { recognised: Some(kind), at: Place::default() },
        jpeg::Refusal::Broken(damage) => broken(damage),
        jpeg::Refusal::Size([width, height]) => open::check_size(width.into(), height.into())
            .err()
            .unwrap_or_else(|| open::too_few_bytes(width.into(), height.into())),
    }
}

#[cfg(test)]
mod tests;
