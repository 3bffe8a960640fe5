//! Opens decoders of whole pictures only if the file can hold as many pixels as its header claims.

use std::borrow::Cow;
use std::io::Cursor;

use image::codecs::{bmp::BmpDecoder, jpeg::JpegDecoder, png::PngDecoder, tiff::TiffDecoder};
use image::{ColorType, ImageDecoder, ImageError, Limits};

use super::palette::PaletteDecoder;
use super::planar::PlanarDecoder;
use super::signature::{Signature, signature};
use super::{PIXEL_LIMIT, broken, bytes, jpeg, pages};
use crate::error::{Damage, Error, PictureKind, Place, Result};
use crate::limits::DECODED;

/// The file without what decoders stumble over and pictures do not need.
///
/// Compressed profiles and texts of PNG are unpacked by its decoder whatever their size. A JPEG that names its components R, G
/// and B stores them; its decoder uses only that of Adobe's marker. Of a TIFF the picture that is measured comes first.
pub fn prepared(file: &[u8]) -> Result<Cow<'_, [u8]>> {
    Ok(match signature(file) {
        Signature::Png => bytes::without_texts(file),
        Signature::Jpeg if stores_rgb(file) => {
            let mut marked = file[..2].to_vec();
            marked.extend(b"\xff\xee\x00\x0eAdobe\x00\x64\0\0\0\0\0");
            marked.extend(&file[2..]);
            Cow::Owned(marked)
        }
        Signature::Tiff => pages::measured_first(file),
        _ => Cow::Borrowed(file),
    })
}

fn stores_rgb(file: &[u8]) -> bool {
    jpeg::header(file).is_ok_and(|frame| frame.colours == jpeg::Colours::Others && frame.components.len() == 3)
}

/// The decoder of a file whose kind and size are already known to be good.
pub fn decoder(file: &[u8]) -> Result<Box<dyn ImageDecoder + '_>> {
    let stream = Cursor::new(file);
    let mut decoder: Box<dyn ImageDecoder> = match signature(file) {
        Signature::Jpeg => Box::new(JpegDecoder::new(stream).map_err(decoding_error)?),
        Signature::Png => {
            if let Some((width, height)) = bytes::png_size(file) {
                check_size(width.into(), height.into())?;
            }
            Box::new(PngDecoder::with_limits(stream, limits()).map_err(decoding_error)?)
        }
        Signature::Tiff => match PaletteDecoder::new(file)? {
            Some(decoder) => Box::new(decoder),
            None => match PlanarDecoder::new(file)? {
                Some(decoder) => Box::new(decoder),
                None => Box::new(TiffDecoder::new(stream).map_err(decoding_error)?),
            },
        },
        Signature::Bmp => Box::new(BmpDecoder::new(stream).map_err(decoding_error)?),
        Signature::Packed(format) => return Err(unread(format.into())),
        Signature::Other(name) => return Err(unread(PictureKind::Named(name.into()))),
        Signature::Video => return Err(unread(PictureKind::Video)),
        Signature::Unknown => return Err(Error::UnknownImageFormat { recognised: None, at: Place::default() }),
    };
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into())?;
    let least = decoder.total_bytes() / bytes::most_from_a_byte(file);
    if least > file.len() as u64 {
        return Err(too_few_bytes(width, height));
    }
    if decoder.total_bytes() > DECODED {
        return Err(too_large(width.into(), height.into()));
    }
    decoder.set_limits(limits()).map_err(decoding_error)?;
    Ok(decoder)
}

/// Refuses pictures without pixels and with more than are worked on.
pub fn check_size(width: u64, height: u64) -> Result<()> {
    if (1..=PIXEL_LIMIT).contains(&(width * height)) { Ok(()) } else { Err(too_large(width, height)) }
}

fn too_large(width: u64, height: u64) -> Error {
    Error::ImageSize { width, height, limit: PIXEL_LIMIT, at: Place::default() }
}

/// A size in a header that exceeds what the bytes can hold.
pub fn too_few_bytes(width: u32, height: u32) -> Error {
    broken(Damage::ClaimsTooMuch { width, height })
}

/// A kind that is not read.
pub fn unread(kind: PictureKind) -> Error {
    Error::UnknownImageFormat { recognised: Some(kind), at: Place::default() }
}

fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(2 * DECODED - 1);
    limits
}

/// Depth of the samples.
pub fn bits(colour: ColorType) -> Result<u32> {
    match colour {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Ok(8),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Ok(16),
        _ => Err(unread(PictureKind::FloatingPoint)),
    }
}

/// The engine's error for an error of the picture decoder.
pub fn decoding_error(error: ImageError) -> Error {
    match error {
        ImageError::Unsupported(unsupported) => {
            let format = unsupported.format_hint().to_string();
            unread(PictureKind::Rare(format.trim_matches('`').to_uppercase()))
        }
        other => broken(Damage::Decoder { message: other.to_string() }),
    }
}
