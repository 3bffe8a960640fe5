//! Picture files to samples: PNG, JPEG and TIFF of 8 or 16 bits, one grey or colour channel at a time.
//!
//! Samples are what the file holds: no colour management, no EXIF rotation, no resampling. The luminance of colour
//! pictures is computed in floating point from the decoded channels and rounded once.

mod bytes;
mod signature;

use std::io::Cursor;

use image::codecs::{jpeg::JpegDecoder, png::PngDecoder, tiff::TiffDecoder};
use image::{ColorType, DynamicImage, ImageDecoder, ImageError, Limits};

use crate::detection::Channel;
use crate::error::{Damage, Error, Place, Result};
use crate::image::{Grey, Samples};
use signature::{Signature, signature};

/// Largest picture worked on: 250 million pixels, more than any camera or film scanner of today delivers.
pub const PIXEL_LIMIT: u64 = 250_000_000;

/// Largest buffer a decoder may ask for, in bytes; half the address space of WebAssembly.
const BYTE_LIMIT: u64 = 1 << 31;

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

/// A picture for showing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue and opacity of each pixel, row by row.
    pub rgba: Vec<u8>,
}

/// Size and depth of a picture, without decoding it.
///
/// # Errors
/// [`Error::UnknownImageFormat`], [`Error::BrokenImage`], [`Error::ImageSize`].
pub fn size(bytes: &[u8]) -> Result<Size> {
    let decoder = decoder(bytes)?;
    let (width, height) = decoder.dimensions();
    Ok(Size { width, height, bits: bits(decoder.color_type())? })
}

/// One channel of a picture; 16 bits stay 16 bits. Opacity is ignored, palettes are resolved.
///
/// A picture without colours gives its grey for every choice. For [`Channel::Grey`] of a coloured one it is
/// 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709), rounded to the depth of the picture.
///
/// # Errors
/// [`Error::UnknownImageFormat`] for other formats and depths, [`Error::BrokenImage`] for damaged or cut files,
/// [`Error::ImageSize`] for pictures beyond [`PIXEL_LIMIT`], before anything of that size is allocated.
pub fn grey(bytes: &[u8], channel: Channel) -> Result<Grey> {
    let decoder = decoder(bytes)?;
    let (width, height) = decoder.dimensions();
    let colour = decoder.color_type();
    let channels = usize::from(colour.channel_count());
    let mut raw = vec![0; usize::try_from(decoder.total_bytes()).map_err(|_| too_large(width, height))?];
    let wide = bits(colour)? == 16;
    decoder.read_image_boxed(&mut raw).map_err(decoding_error)?;
    let samples = if wide {
        // The decoders write 16-bit samples in the byte order of the machine.
        let sample = |pixel: &[u8], c: usize| u16::from_ne_bytes([pixel[2 * c], pixel[2 * c + 1]]);
        let one = |pixel: &[u8]| match pick(channels, channel) {
            Some(c) => sample(pixel, c),
            None => luminance([0, 1, 2].map(|c| f64::from(sample(pixel, c)))) as u16,
        };
        Samples::U16(raw.chunks_exact(2 * channels).map(one).collect())
    } else {
        // In place: sample i never lies behind its pixel.
        for i in 0..raw.len() / channels {
            let at = i * channels;
            raw[i] = match pick(channels, channel) {
                Some(c) => raw[at + c],
                None => luminance([0, 1, 2].map(|c| f64::from(raw[at + c]))) as u8,
            };
        }
        raw.truncate(raw.len() / channels);
        raw.shrink_to_fit();
        Samples::U8(raw)
    };
    Ok(Grey { width: width as usize, height: height as usize, samples })
}

/// A picture for showing, reduced so that neither side exceeds `max_side`.
///
/// 16-bit pictures are stretched to their brightest sample, since many use 10 or 12 bits of the 16.
///
/// # Errors
/// As [`grey`].
pub fn picture(bytes: &[u8], max_side: Option<u32>) -> Result<Picture> {
    let decoder = decoder(bytes)?;
    bits(decoder.color_type())?;
    let mut image = DynamicImage::from_decoder(decoder).map_err(decoding_error)?;
    let side = image.width().max(image.height());
    if let Some(limit) = max_side.filter(|limit| *limit < side) {
        image = image.thumbnail(limit.max(1), limit.max(1));
    }
    if image.color().bytes_per_pixel() / image.color().channel_count() == 2 {
        stretch(&mut image);
    }
    let rgba = image.into_rgba8();
    Ok(Picture { width: rgba.width(), height: rgba.height(), rgba: rgba.into_raw() })
}

/// Scales 16-bit samples so that the brightest is white.
fn stretch(image: &mut DynamicImage) {
    let opaque = !image.color().has_alpha();
    let apply = |samples: &mut [u16]| {
        let top = samples.iter().copied().max().unwrap_or(0);
        if top > 0 && opaque {
            samples.iter_mut().for_each(|s| *s = (u64::from(*s) * 65535 / u64::from(top)) as u16);
        }
    };
    match image {
        DynamicImage::ImageLuma16(buffer) => apply(buffer),
        DynamicImage::ImageRgb16(buffer) => apply(buffer),
        _ => {}
    }
}

/// Index of the chosen sample in a pixel; none where luminance has to be computed.
fn pick(channels: usize, channel: Channel) -> Option<usize> {
    match channel {
        _ if channels < 3 => Some(0),
        Channel::Grey => None,
        Channel::Red => Some(0),
        Channel::Green => Some(1),
        Channel::Blue => Some(2),
    }
}

fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    (0.2126 * red + 0.7152 * green + 0.0722 * blue).round()
}

/// The decoder of a file whose kind, completeness and size are already known to be good.
fn decoder(bytes: &[u8]) -> Result<Box<dyn ImageDecoder + '_>> {
    let stream = Cursor::new(bytes);
    let mut decoder: Box<dyn ImageDecoder> = match signature(bytes) {
        Signature::Jpeg => {
            if !bytes::jpeg_is_complete(bytes) {
                return Err(broken(Damage::EndsEarly));
            }
            Box::new(JpegDecoder::new(stream).map_err(decoding_error)?)
        }
        Signature::Png => {
            if let Some((width, height)) = bytes::png_size(bytes).filter(|size| exceeds_limit(*size)) {
                return Err(too_large(width, height));
            }
            Box::new(PngDecoder::with_limits(stream, limits()).map_err(decoding_error)?)
        }
        Signature::Tiff => Box::new(TiffDecoder::new(stream).map_err(decoding_error)?),
        Signature::Other(name) => {
            return Err(Error::UnknownImageFormat { recognised: Some(name.to_owned()), at: Place::default() });
        }
        Signature::Unknown => return Err(Error::UnknownImageFormat { recognised: None, at: Place::default() }),
    };
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 || exceeds_limit((width, height)) || decoder.total_bytes() > BYTE_LIMIT {
        return Err(too_large(width, height));
    }
    decoder.set_limits(limits()).map_err(decoding_error)?;
    Ok(decoder)
}

fn exceeds_limit((width, height): (u32, u32)) -> bool {
    u64::from(width) * u64::from(height) > PIXEL_LIMIT
}

fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(2 * BYTE_LIMIT - 1);
    limits
}

/// Depth of the samples.
fn bits(colour: ColorType) -> Result<u32> {
    match colour {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Ok(8),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Ok(16),
        other => Err(Error::UnknownImageFormat {
            recognised: Some(format!("picture with samples of kind {other:?}")),
            at: Place::default(),
        }),
    }
}

fn too_large(width: u32, height: u32) -> Error {
    Error::ImageSize { width: width.into(), height: height.into(), limit: PIXEL_LIMIT, at: Place::default() }
}

fn broken(reason: Damage) -> Error {
    Error::BrokenImage { reason, at: Place::default() }
}

fn decoding_error(error: ImageError) -> Error {
    match error {
        ImageError::Unsupported(unsupported) => {
            Error::UnknownImageFormat { recognised: Some(unsupported.to_string()), at: Place::default() }
        }
        other => broken(Damage::Decoder { message: other.to_string() }),
    }
}

#[cfg(test)]
mod tests;
