//! The decoders of HEIC and RAW, in a module of their own beside this one.

use sightline::decode::{self, Packed};
use sightline::detection::Channel;
use sightline::error::{Damage, Error, Place, Result};
use sightline::sensor::{Shot, Unpacked};

use crate::scope::{self, Refusal};

/// A photo ready to be measured, from any decoder.
pub fn shot_of(file: &[u8], channel: Channel) -> Result<Shot> {
    match decode::packed(file) {
        None => decode::photo(file, channel).map(Shot::Photo),
        Some(format) => unpack(file, format, channel, true, 0)?.into_shot(),
    }
}

/// Their output for a file: with its samples where they are wanted, with a small picture where `max_side`
/// is not 0.
pub fn unpack(file: &[u8], format: Packed, channel: Channel, samples: bool, max_side: u32) -> Result<Unpacked> {
    let name = match channel {
        Channel::Grey => "grey",
        Channel::Red => "red",
        Channel::Green => "green",
        Channel::Blue => "blue",
    };
    let (header, samples, small) = scope::unpack(file, name, samples, max_side).map_err(|refusal| match refusal {
        Refusal::Missing(message) => {
            Error::DecoderMissing { format: format.to_string(), message, at: Place::default() }
        }
        Refusal::Error(text) => sightline_protocol::from_text(&text).unwrap_or(Error::BrokenImage {
            reason: Damage::Decoder { message: "the decoder stopped".into() },
            at: Place::default(),
        }),
    })?;
    Unpacked::read(&header, samples, small)
}
