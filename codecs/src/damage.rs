//! Errors of the decoders as errors of the engine.

use sightline::error::{Damage, Error, PictureKind, Place, shortened};
use sightline::limits;

/// A damaged file.
pub fn broken(reason: Damage) -> Error {
    Error::BrokenImage { reason, at: Place::default() }
}

/// A damaged file, in a decoder's words.
pub fn engine_error(message: &impl ToString) -> Error {
    broken(Damage::Decoder { message: shortened(&message.to_string()) })
}

/// A kind that is not read.
pub fn unsupported(kind: PictureKind) -> Error {
    Error::UnknownImageFormat { recognised: Some(kind), at: Place::default() }
}

/// Refuses sizes that are not worked on, and those that so few bytes cannot hold: a byte describes at most `most` pixels.
pub fn check_size([width, height]: [u32; 2], bytes: usize, most: u64) -> Result<(), Error> {
    let pixels = u64::from(width) * u64::from(height);
    if !(1..=limits::PIXELS).contains(&pixels) {
        let (width, height) = (width.into(), height.into());
        return Err(Error::ImageSize { width, height, limit: limits::PIXELS, at: Place::default() });
    }
    if pixels / most > bytes as u64 {
        return Err(broken(Damage::ClaimsTooMuch { width, height }));
    }
    Ok(())
}
