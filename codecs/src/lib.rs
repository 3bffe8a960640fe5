//! The decoders that are not in the engine: what they make of a file, in the engine's own types ([`sightline::sensor`]).
//!
//! They are kept crates behind one file of ours each. Natively this is a plain library; as wasm it is a module of its own
//! that is loaded when the first such file comes.

mod damage;
mod heic;
#[cfg(target_arch = "wasm32")]
mod module;
mod raw;
mod small;

use sightline::decode::{Packed, packed};
use sightline::detection::Channel;
use sightline::error::{Error, Place, Result};
use sightline::sensor::Unpacked;

/// Requested contents of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Channel of a developed picture; a sensor's samples come all.
    pub channel: Channel,
    /// Whether the samples are wanted.
    pub samples: bool,
    /// Longest side of the small picture; 0 if none is wanted. That of a RAW is the one its camera embedded, and so is that of a HEIC without
    /// its samples, where it has one of at least half this side.
    pub max_side: u32,
}

impl Wanted {
    /// The samples of a channel alone.
    pub fn samples(channel: Channel) -> Self {
        Self { channel, samples: true, max_side: 0 }
    }
}

/// Opens a file that [`sightline::decode::packed`] names.
///
/// # Errors
/// [`Error::UnknownImageFormat`] for kinds that are not read, named; [`Error::BrokenImage`] for damaged ones;
/// [`Error::ImageSize`], before memory is taken.
pub fn unpack(bytes: &[u8], wanted: Wanted) -> Result<Unpacked> {
    match packed(bytes) {
        Some(Packed::Heif(_)) => heic::unpack(bytes, wanted),
        Some(Packed::Raw(format)) => raw::unpack(bytes, format, wanted),
        None => Err(Error::UnknownImageFormat { recognised: None, at: Place::default() }),
    }
}
