//! What a decoder outside of the engine makes of a file: the luma plane of a HEIC as it is stored, or the samples of a sensor.
//!
//! The decoders of HEIC and RAW are larger than the engine and needed by few: they are a module of their own (`codecs/`). A header
//! as JSON and the samples cross from there to here, and nothing else of them is known here.

mod develop;
mod mosaic;
mod part;

use serde::{Deserialize, Serialize};

use crate::decode::{DecodedPhoto, Picture};
use crate::detection::{Channel, Colour};
use crate::error::{Damage, Error, Place, Result};
use crate::exif::PhotoInfo;
use crate::image::{Grey, Samples};
use crate::limits;
pub use mosaic::{Black, BlackRow, Mosaic, Pattern};
pub use part::{part, values};

/// Header information about the samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Header {
    /// Name of the file's format: HEIC, DNG, NEF …
    pub format: String,
    /// Width of the stored grid in pixels, of all of it: masked borders too.
    pub width: u32,
    /// Height of the stored grid in pixels.
    pub height: u32,
    /// Bits that a sample was stored with.
    pub bits: u32,
    /// Camera data in the file.
    pub info: PhotoInfo,
    /// How the samples of a sensor are to be understood; absent for a developed picture.
    pub mosaic: Option<Mosaic>,
    /// Rows that could not be decoded: first row and the row after the last.
    pub damaged_rows: Vec<[u32; 2]>,
    /// Corrections of the lens that the file names, in its own words.
    pub corrections: Vec<String>,
    /// Lists of corrections that could not be read: what they name is not known, and may be none.
    pub unread_corrections: usize,
    /// Width and height of the small picture; 0 if there is none.
    pub small: [u32; 2],
}

/// A file as its decoder leaves it.
#[derive(Clone, Debug, PartialEq)]
pub struct Unpacked {
    /// Header information about the samples.
    pub header: Header,
    /// Row by row; empty if only the header was wanted.
    pub samples: Samples,
    /// The small picture: red, green, blue and opacity of each pixel.
    pub small: Vec<u8>,
}

/// A photo ready to be measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Shot {
    /// One channel of a developed picture.
    Photo(DecodedPhoto),
    /// The samples of a sensor.
    Sensor(Sensor),
}

/// The samples of a sensor, as they were read out.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Name of the file's format.
    pub format: String,
    /// Width of the whole grid in pixels.
    pub width: usize,
    /// Height of the whole grid in pixels.
    pub height: usize,
    /// Bits of a sample.
    pub bits: u32,
    /// Filters, levels and the part that light reaches.
    pub mosaic: Mosaic,
    /// Row by row; black not taken off.
    pub samples: Vec<u16>,
    /// Rows that could not be decoded.
    pub damaged_rows: Vec<[u32; 2]>,
    /// Corrections of the lens that the file names, in its own words.
    pub corrections: Vec<String>,
    /// Lists of corrections that could not be read.
    pub unread_corrections: usize,
}

impl Shot {
    /// Memory that the samples take.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Photo(photo) => photo.bytes(),
            Self::Sensor(sensor) => 2 * sensor.samples.len(),
        }
    }

    /// Width and height of the stored grid.
    pub fn size(&self) -> [usize; 2] {
        match self {
            Self::Photo(photo) => [photo.grey.width, photo.grey.height],
            Self::Sensor(sensor) => [sensor.width, sensor.height],
        }
    }
}

impl Unpacked {
    /// From what crossed the border: the header as JSON, and the samples.
    ///
    /// # Errors
    /// [`Error::BrokenImage`] if the header is none.
    pub fn read(header: &str, samples: Samples, small: Vec<u8>) -> Result<Self> {
        let header = serde_json::from_str(header)
            .map_err(|error| broken(Damage::Decoder { message: format!("the decoder's header: {error}") }))?;
        Ok(Self { header, samples, small })
    }

    /// The header as JSON.
    pub fn header_text(&self) -> String {
        serde_json::to_string(&self.header).unwrap_or_default()
    }

    /// The photo, checked: the number of samples agrees with the size, levels are in order, rows inside of it.
    ///
    /// # Errors
    /// [`Error::ImageSize`], [`Error::BrokenImage`] for levels that leave nothing between black and white.
    pub fn into_shot(self) -> Result<Shot> {
        let Self { header, samples, .. } = self;
        let pixels = u64::from(header.width) * u64::from(header.height);
        if !(1..=limits::PIXELS).contains(&pixels) {
            let (width, height) = (header.width.into(), header.height.into());
            return Err(Error::ImageSize { width, height, limit: limits::PIXELS, at: Place::default() });
        }
        let (width, height) = (header.width as usize, header.height as usize);
        let count = match &samples {
            Samples::U8(samples) => samples.len(),
            Samples::U16(samples) => samples.len(),
        };
        if count != width * height {
            return Err(broken(Damage::NoPicture));
        }
        let damaged_rows = ordered(header.damaged_rows, header.height);
        if damaged_rows.first() == Some(&[0, header.height]) {
            return Err(broken(Damage::NoWholeRow));
        }
        match (header.mosaic, samples) {
            (Some(mosaic), Samples::U16(samples)) => {
                let mosaic = mosaic.checked([header.width, header.height]).ok_or_else(|| broken(Damage::Header))?;
                let Header { format, bits, corrections, unread_corrections, .. } = header;
                let sensor = Sensor {
                    format,
                    width,
                    height,
                    bits,
                    mosaic,
                    samples,
                    damaged_rows,
                    corrections,
                    unread_corrections,
                };
                Ok(Shot::Sensor(sensor))
            }
            (Some(_), Samples::U8(_)) => Err(broken(Damage::Header)),
            (None, samples) => {
                Ok(Shot::Photo(DecodedPhoto { grey: Grey { width, height, samples }, damaged_rows, page: None }))
            }
        }
    }
}

/// A picture for showing of what is measured: grey as it is, the filters of a sensor as colours. `max_side` bounds its sides.
pub fn picture(shot: &Shot, max_side: u32) -> Picture {
    match shot {
        Shot::Photo(photo) => develop::grey(&photo.grey, max_side),
        Shot::Sensor(sensor) => develop::colours(sensor, max_side),
    }
}

/// The colour whose sites are measured for a choice of channel: green unless chosen, and where there is no such colour the one that
/// there is.
pub fn measured_colour(mosaic: &Mosaic, channel: Channel) -> Colour {
    let wanted = match channel {
        Channel::Grey | Channel::Green => Colour::Green,
        Channel::Red => Colour::Red,
        Channel::Blue => Colour::Blue,
    };
    if mosaic.pattern.has(wanted) { wanted } else { mosaic.pattern.most() }
}

/// Ranges of rows in order, inside the picture, none touching the next.
fn ordered(mut rows: Vec<[u32; 2]>, height: u32) -> Vec<[u32; 2]> {
    rows.iter_mut().for_each(|range| range[1] = range[1].min(height));
    rows.retain(|range| range[0] < range[1]);
    rows.sort_unstable();
    let mut merged: Vec<[u32; 2]> = Vec::new();
    for range in rows {
        match merged.last_mut() {
            Some(before) if before[1] >= range[0] => before[1] = before[1].max(range[1]),
            _ => merged.push(range),
        }
    }
    merged
}

fn broken(reason: Damage) -> Error {
    Error::BrokenImage { reason, at: Place::default() }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn unpacked(mosaic: Option<Mosaic>, samples: usize) -> Unpacked {
        let header = Header { width: 4, height: 2, bits: 12, mosaic, ..Header::default() };
        Unpacked { header, samples: Samples::U16(vec![100; samples]), small: Vec::new() }
    }

    fn bayer() -> Mosaic {
        Mosaic {
            pattern: Pattern::parse("RGGB", 2).expect("a pattern"),
            active_area: [0, 0, 4, 2],
            black: Black::uniform(64.0),
            white: 4095.0,
        }
    }

    #[test]
    fn a_header_comes_back_as_it_went() {
        let there = unpacked(Some(bayer()), 8);
        let back = Unpacked::read(&there.header_text(), there.samples.clone(), Vec::new()).expect("a header");
        assert_eq!(back, there);
        assert!(Unpacked::read("{", Samples::U8(Vec::new()), Vec::new()).is_err());
    }

    #[test]
    fn what_cannot_be_is_refused() {
        assert!(matches!(unpacked(None, 8).into_shot(), Ok(Shot::Photo(_))));
        assert!(matches!(unpacked(Some(bayer()), 8).into_shot(), Ok(Shot::Sensor(_))));
        assert!(unpacked(None, 7).into_shot().is_err());
        assert!(unpacked(Some(Mosaic { white: 64.0, ..bayer() }), 8).into_shot().is_err());
        assert!(unpacked(Some(Mosaic { active_area: [2, 0, 4, 2], ..bayer() }), 8).into_shot().is_err());
        let mut none = unpacked(None, 8);
        none.header.damaged_rows = vec![[0, 1], [1, 9]];
        assert!(none.into_shot().is_err());
        assert_eq!(ordered(vec![[5, 9], [1, 3], [3, 4], [9, 9]], 7), [[1, 4], [5, 7]]);
    }

    #[test]
    fn the_colour_is_green_unless_chosen() {
        let mosaic = bayer();
        assert_eq!(measured_colour(&mosaic, Channel::Grey), Colour::Green);
        assert_eq!(measured_colour(&mosaic, Channel::Red), Colour::Red);
        let grey = Mosaic { pattern: Pattern::parse("W", 1).expect("a pattern"), ..bayer() };
        assert_eq!(measured_colour(&grey, Channel::Blue), Colour::White);
    }
}
