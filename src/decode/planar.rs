//! TIFF files with one plane per channel (`PlanarConfiguration` 2, TIFF 6.0), in strips or tiles.
//!
//! Each plane is read as a grey picture of its own: a directory is written behind a copy of the file that names the strips or tiles of one plane
//! only. The decoder of whole pictures takes the tiles of the later planes for lower rows of the picture.

use std::io::Cursor;

use image::{ColorType, ImageDecoder, ImageError, ImageResult};
use tiff::decoder::{Decoder, DecodingResult, Limits};

use super::bytes::TiffReader;
use super::open::{check_size, too_few_bytes, unread};
use super::{broken, bytes};
use crate::error::{Damage, PictureKind, Result};

const WIDTH: u16 = 256;
const HEIGHT: u16 = 257;
const BITS: u16 = 258;
const PHOTOMETRIC: u16 = 262;
const SAMPLES: u16 = 277;
const PLANAR: u16 = 284;
/// Offsets and byte counts of strips, of tiles.
const CHUNKS: [[u16; 2]; 2] = [[273, 279], [324, 325]];
const SAMPLE_FORMAT: u16 = 339;
/// Entries that a plane has as the whole picture has them: compression, fill order, rows of a strip, predictor, size of a tile.
const COMMON: [u16; 6] = [259, 266, 278, 317, 322, 323];

/// A decoder of such a file.
pub struct PlanarDecoder {
    /// The file with room for a directory behind it, and where that begins.
    file: Vec<u8>,
    directory: usize,
    size: (u32, u32),
    bits: u32,
    inverted: bool,
    /// Entries that all planes have.
    common: Vec<(u16, u64)>,
    /// Offsets and byte counts of each plane's strips or tiles, and which they are.
    planes: Vec<[Vec<u64>; 2]>,
    tags: [u16; 2],
}

impl PlanarDecoder {
    /// `None` for files whose samples lie together, and for those of one sample.
    ///
    /// # Errors
    /// [`UnknownImageFormat`](crate::Error::UnknownImageFormat) for kinds of samples that are not read,
    /// [`BrokenImage`](crate::Error::BrokenImage), [`ImageSize`](crate::Error::ImageSize).
    pub fn new(file: &[u8]) -> Result<Option<Self>> {
        let Some(reader) = TiffReader::tiff(file) else { return Ok(None) };
        let entries = reader.entries();
        let find = |tag| entries.iter().find(|entry| entry.tag == tag);
        let value = |tag| find(tag).and_then(|entry| reader.first(entry));
        let samples = value(SAMPLES).unwrap_or(1);
        if value(PLANAR) != Some(2) || samples < 2 {
            return Ok(None);
        }
        let rare = || unread(PictureKind::Rare("TIFF".into()));
        let bits = find(BITS).map(|entry| reader.values(entry)).unwrap_or_default();
        let plain = find(SAMPLE_FORMAT).is_none_or(|entry| reader.values(entry).iter().all(|format| *format == 1));
        let depth = match bits.first() {
            Some(depth @ (8 | 16)) if bits.iter().all(|other| other == depth) => *depth as u32,
            _ => return Err(rare()),
        };
        // Samples beyond those of the colours are opacity, which is ignored.
        let wanted = match value(PHOTOMETRIC) {
            Some(0 | 1) => 1,
            Some(2) if samples >= 3 => 3,
            _ => return Err(rare()),
        };
        if !plain {
            return Err(rare());
        }
        let header = || broken(Damage::Header);
        let side = |tag| value(tag).and_then(|side| u32::try_from(side).ok()).ok_or_else(header);
        let size = (side(WIDTH)?, side(HEIGHT)?);
        check_size(size.0.into(), size.1.into())?;
        let bytes = u64::from(size.0) * u64::from(size.1) * samples * u64::from(depth / 8);
        if bytes / bytes::most_from_a_byte(file) > file.len() as u64 {
            return Err(too_few_bytes(size.0, size.1));
        }
        let tags = CHUNKS.into_iter().find(|[offsets, _]| find(*offsets).is_some()).ok_or_else(header)?;
        let lists = tags.map(|tag| find(tag).map(|entry| reader.all(entry)).unwrap_or_default());
        let chunks = lists[0].len() / samples as usize;
        if chunks == 0 || lists[0].len() != lists[1].len() || lists[0].len() != chunks * samples as usize {
            return Err(header());
        }
        let part = |plane: usize, list: &Vec<u64>| list[plane * chunks..(plane + 1) * chunks].to_vec();
        let planes = (0..wanted).map(|plane| [part(plane, &lists[0]), part(plane, &lists[1])]).collect();
        let common = COMMON.iter().filter_map(|tag| Some((*tag, value(*tag)?))).collect();
        let mut file = file.to_vec();
        file.resize(file.len().next_multiple_of(8), 0);
        let directory = file.len();
        let inverted = value(PHOTOMETRIC) == Some(0);
        Ok(Some(Self { file, directory, size, bits: depth, inverted, common, planes, tags }))
    }

    /// The samples of a plane.
    fn plane(&mut self, plane: usize) -> std::result::Result<DecodingResult, tiff::TiffError> {
        let mut entries: Vec<(u16, Vec<u64>)> = self.common.iter().map(|(tag, value)| (*tag, vec![*value])).collect();
        let photometric = u64::from(!self.inverted);
        for (tag, value) in [
            (WIDTH, self.size.0.into()),
            (HEIGHT, self.size.1.into()),
            (BITS, self.bits.into()),
            (PHOTOMETRIC, photometric),
            (SAMPLES, 1),
            (PLANAR, 1),
        ] {
            entries.push((tag, vec![value]));
        }
        for (tag, list) in self.tags.iter().zip(&self.planes[plane]) {
            entries.push((*tag, list.clone()));
        }
        entries.sort_by_key(|(tag, _)| *tag);
        self.file.truncate(self.directory);
        bytes::append_directory(&mut self.file, &entries);
        let decoder = Decoder::new(Cursor::new(&self.file))?;
        decoder.with_limits(Limits::unlimited()).read_image()
    }
}

impl ImageDecoder for PlanarDecoder {
    fn dimensions(&self) -> (u32, u32) {
        self.size
    }

    fn color_type(&self) -> ColorType {
        match (self.planes.len(), self.bits) {
            (1, 8) => ColorType::L8,
            (1, _) => ColorType::L16,
            (_, 8) => ColorType::Rgb8,
            _ => ColorType::Rgb16,
        }
    }

    fn read_image(mut self, buffer: &mut [u8]) -> ImageResult<()> {
        let failed = |error: String| {
            ImageError::Decoding(image::error::DecodingError::new(image::ImageFormat::Tiff.into(), error))
        };
        let count = self.planes.len();
        for plane in 0..count {
            let samples = self.plane(plane).map_err(|error| failed(error.to_string()))?;
            match samples {
                DecodingResult::U8(samples) if self.bits == 8 && samples.len() * count == buffer.len() => {
                    for (sample, place) in samples.iter().zip(buffer[plane..].iter_mut().step_by(count)) {
                        *place = *sample;
                    }
                }
                DecodingResult::U16(samples) if self.bits == 16 && 2 * samples.len() * count == buffer.len() => {
                    for (sample, pixel) in samples.iter().zip(buffer.chunks_exact_mut(2 * count)) {
                        pixel[2 * plane..2 * plane + 2].copy_from_slice(&sample.to_ne_bytes());
                    }
                }
                _ => return Err(failed("the planes have not the size that the header claims".into())),
            }
        }
        Ok(())
    }

    fn read_image_boxed(self: Box<Self>, buffer: &mut [u8]) -> ImageResult<()> {
        (*self).read_image(buffer)
    }
}
