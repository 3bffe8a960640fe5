//! TIFF files with palette samples: read as grey, then looked up.

use std::io::Cursor;

use image::{ColorType, ImageDecoder, ImageError, ImageResult};
use tiff::decoder::{Decoder, DecodingResult, Limits};

use super::broken;
use super::bytes::TiffReader;
use super::open::unread;
use crate::error::{Damage, PictureKind, Result};

const PHOTOMETRIC: u16 = 262;
const BITS: u16 = 258;
const COLOUR_MAP: u16 = 320;
const PALETTE: u64 = 3;

/// A decoder of such a file.
pub struct PaletteDecoder {
    /// The file, now marked as grey.
    file: Vec<u8>,
    size: (u32, u32),
    bits: u32,
    palette: Vec<[u8; 3]>,
}

impl PaletteDecoder {
    /// `None` for TIFF files without a palette.
    ///
    /// # Errors
    /// [`UnknownImageFormat`](crate::Error::UnknownImageFormat) for palettes of more than 8 bits, [`BrokenImage`](crate::Error::BrokenImage).
    pub fn new(file: &[u8]) -> Result<Option<Self>> {
        let Some(reader) = TiffReader::tiff(file) else { return Ok(None) };
        let entries = reader.entries();
        let find = |tag| entries.iter().find(|entry| entry.tag == tag);
        let Some(photometric) = find(PHOTOMETRIC).filter(|entry| reader.values(entry) == [PALETTE]) else {
            return Ok(None);
        };
        let bits = match find(BITS).map(|entry| reader.values(entry)).as_deref() {
            Some([bits @ (1 | 2 | 4 | 8)]) => *bits as u32,
            None => 1,
            _ => return Err(unread(PictureKind::DeepPalette)),
        };
        let colours = find(COLOUR_MAP).map(|entry| reader.values(entry)).unwrap_or_default();
        let count = 1 << bits;
        if colours.len() < 3 * count {
            return Err(broken(Damage::NoPalette));
        }
        // all red ones, then all green ones, then all blue ones; some writers leave them at 8 bits
        let shift = if colours.iter().all(|colour| *colour < 256) { 0 } else { 8 };
        let colour = |k: usize| [0, 1, 2].map(|c| (colours[c * count + k] >> shift) as u8);
        let palette = (0..count).map(colour).collect();
        let mut file = file.to_vec();
        reader.overwrite(&mut file, photometric, 1);
        let size = Decoder::new(Cursor::new(&file)).and_then(|mut decoder| decoder.dimensions());
        let size = size.map_err(|error| broken(Damage::Decoder { message: error.to_string() }))?;
        Ok(Some(Self { file, size, bits, palette }))
    }
}

impl ImageDecoder for PaletteDecoder {
    fn dimensions(&self) -> (u32, u32) {
        self.size
    }

    fn color_type(&self) -> ColorType {
        ColorType::Rgb8
    }

    fn read_image(self, buffer: &mut [u8]) -> ImageResult<()> {
        let failed = |error: tiff::TiffError| {
            ImageError::Decoding(image::error::DecodingError::new(image::ImageFormat::Tiff.into(), error))
        };
        let decoder = Decoder::new(Cursor::new(&self.file)).map_err(failed)?;
        let samples = decoder.with_limits(Limits::unlimited()).read_image().map_err(failed)?;
        let DecodingResult::U8(samples) = samples else { return Ok(()) };
        let width = self.size.0 as usize;
        let stride = (width * self.bits as usize).div_ceil(8);
        let mask = ((1u16 << self.bits) - 1) as u8;
        for (row, colours) in samples.chunks(stride).zip(buffer.chunks_mut(3 * width)) {
            for (x, colour) in colours.chunks_exact_mut(3).enumerate() {
                let bit = x * self.bits as usize;
                let shift = 8 - self.bits as usize - bit % 8;
                let place = row.get(bit / 8).map_or(0, |byte| byte >> shift & mask);
                colour.copy_from_slice(&self.palette[usize::from(place)]);
            }
        }
        Ok(())
    }

    fn read_image_boxed(self: Box<Self>, buffer: &mut [u8]) -> ImageResult<()> {
        (*self).read_image(buffer)
    }
}
