//! HEIC and HEIF (ISO/IEC 23008-12): the luma plane as it is stored, tile by tile.
//!
//! The planes are those of HEVC (ITU-T H.265), neither converted nor rotated. The crop given in the file is applied, as what lies outside is
//! padding; rotation and mirror become an orientation for showing, so that coordinates stay on the stored grid. EXIF's own
//! orientation says the same a second time in such files and is not read.

mod colour;
mod thumbnail;
mod turn;

use std::borrow::Cow;

use heifer_hevc_dec::decoder::{DecodeOptions, decode_picture};
use heifer_hevc_dec::recon::Frame;
use heifer_isobmff::boxes::Property;
use heifer_isobmff::{HeifFile, ItemId, read_box_header};

use sightline::detection::Channel;
use sightline::error::{Damage, PictureKind, Result};
use sightline::image::Samples;
use sightline::sensor::{Header, Unpacked};
use sightline::{exif, limits};

use crate::damage::{broken, check_size, engine_error, unsupported};
use crate::{Wanted, small};
use colour::Matrix;

/// Pixels that a byte describes at most: a block of 64 x 64 without detail takes more than a byte.
const MOST_FROM_A_BYTE: u64 = 4096;
/// Side of the largest block, to whose multiple a coded picture is filled up at most.
const BLOCK: u64 = 64;
/// Deepest nesting of pictures that are made of others.
const DEPTH: u32 = 4;

/// Opens a file.
pub fn unpack(bytes: &[u8], wanted: Wanted) -> Result<Unpacked> {
    let readable = readable(bytes);
    let file = HeifFile::parse(&readable).map_err(|error| engine_error(&error))?;
    let source = source(&file, file.primary_id)?;
    check_size(source.size, bytes.len(), MOST_FROM_A_BYTE)?;
    let crop = turn::crop(&file, file.primary_id, source.size)?;
    let exif = file.exif(file.primary_id).ok().flatten().unwrap_or_default();
    let info = exif::PhotoInfo { orientation: turn::orientation(&file, file.primary_id)?, ..exif::read(&exif) };
    let mut header =
        Header { format: "HEIC".into(), width: crop[2], height: crop[3], bits: source.bits, info, ..Header::default() };
    let (mut samples, mut rgba) = (Samples::U8(Vec::new()), Vec::new());
    if !wanted.samples
        && wanted.max_side > 0
        && let Some((size, small)) = thumbnail::thumbnail(&file, bytes.len(), wanted.max_side)
    {
        header.small = size;
        return Ok(Unpacked { header, samples, small });
    }
    if wanted.samples || wanted.max_side > 0 {
        let coloured = wanted.max_side > 0 || wanted.channel != Channel::Grey;
        let planes = assembled(&file, &source, coloured)?;
        header.damaged_rows = planes.damaged.iter().filter_map(|rows| turn::cut(*rows, crop)).collect();
        let matrix = Matrix::of(&file, file.primary_id, source.tiles[0], &planes);
        if wanted.max_side > 0 {
            let at = |x: usize, y: usize| planes.colour(x + crop[0] as usize, y + crop[1] as usize, &matrix);
            (header.small, rgba) = small::reduced([crop[2], crop[3]], wanted.max_side, at);
        }
        if wanted.samples {
            samples = planes.channel(wanted.channel, crop, &matrix);
        }
    }
    Ok(Unpacked { header, samples, small: rgba })
}

/// The file with its last box ending where the file does: of one that was cut short the tiles before the cut are whole.
fn readable(bytes: &[u8]) -> Cow<'_, [u8]> {
    let mut at = 0;
    while let Ok(header) = read_box_header(&bytes[at..]) {
        let end = header.size.and_then(|size| usize::try_from(size).ok()).and_then(|size| at.checked_add(size));
        match end {
            Some(end) if end < bytes.len() && end > at => at = end,
            Some(end) if end > bytes.len() => {
                let mut cut = bytes.to_vec();
                // a size of 0 is all that is left
                cut[at..at + 4].fill(0);
                return Cow::Owned(cut);
            }
            _ => break,
        }
    }
    Cow::Borrowed(bytes)
}

/// Contents of the picture.
struct Source {
    /// Coded pictures, row by row.
    tiles: Vec<ItemId>,
    /// How many of them stand beside each other.
    columns: usize,
    /// Width and height of a tile.
    tile: [u32; 2],
    /// Width and height of the whole.
    size: [u32; 2],
    bits: u32,
}

/// Finds the coded pictures of an item.
fn source(file: &HeifFile, mut id: ItemId) -> Result<Source> {
    let container = |error: heifer_isobmff::Error| engine_error(&error);
    for _ in 0..DEPTH {
        let kind = file.item(id).map_err(container)?.item_type.0;
        match &kind {
            b"iden" => {
                let [only] = file.referenced_items(id, b"dimg") else { return Err(broken(Damage::NoPicture)) };
                id = *only;
            }
            b"hvc1" | b"hev1" => {
                let size = sized(file, id)?;
                return Ok(Source { tiles: vec![id], columns: 1, tile: size, size, bits: bits(file, id)? });
            }
            b"grid" => {
                let grid = file.grid(id).map_err(container)?;
                let tiles = file.referenced_items(id, b"dimg").to_vec();
                if tiles.len() != usize::from(grid.rows) * usize::from(grid.columns) {
                    return Err(broken(Damage::Header));
                }
                let mut distinct = tiles.clone();
                distinct.sort_unstable();
                distinct.dedup();
                let tile = sized(file, tiles[0])?;
                let [across, down] = [(grid.columns, tile[0]), (grid.rows, tile[1])]
                    .map(|(count, side)| u64::from(count) * u64::from(side));
                let size = [grid.output_width, grid.output_height];
                // one tile at many places would cost time, and no camera writes that
                let covers = across >= u64::from(size[0]) && down >= u64::from(size[1]);
                let tight =
                    across - u64::from(tile[0]) < u64::from(size[0]) && down - u64::from(tile[1]) < u64::from(size[1]);
                if distinct.len() != tiles.len() || !covers || !tight {
                    return Err(broken(Damage::Header));
                }
                let bits = bits(file, tiles[0])?;
                return Ok(Source { tiles, columns: grid.columns.into(), tile, size, bits });
            }
            b"av01" => return Err(unsupported(PictureKind::Named("AVIF".into()))),
            b"iovl" => return Err(unsupported(PictureKind::HeifOverlay)),
            other => return Err(unsupported(PictureKind::HeifOf(String::from_utf8_lossy(other).into()))),
        }
    }
    Err(broken(Damage::Header))
}

fn sized(file: &HeifFile, id: ItemId) -> Result<[u32; 2]> {
    let (width, height) = file.image_size(id).map_err(|e| engine_error(&e))?.ok_or_else(|| broken(Damage::Header))?;
    if width == 0 || height == 0 { Err(broken(Damage::Header)) } else { Ok([width, height]) }
}

fn bits(file: &HeifFile, id: ItemId) -> Result<u32> {
    let config = file.hevc_config(id).map_err(|e| engine_error(&e))?.ok_or_else(|| broken(Damage::Header))?;
    let bits = u32::from(config.bit_depth_luma);
    if (8..=16).contains(&bits) { Ok(bits) } else { Err(broken(Damage::Header)) }
}

/// Cb and Cr of 8 bits.
struct Chroma {
    planes: [Vec<u8>; 2],
    /// Width and height of a plane.
    size: [usize; 2],
    /// Luma samples that one of chroma covers, across and down.
    step: [usize; 2],
}

/// The planes of the whole picture, before the crop.
struct Planes {
    width: usize,
    height: usize,
    bits: u32,
    luma: Samples,
    chroma: Option<Chroma>,
    damaged: Vec<[u32; 2]>,
    full_range: bool,
    matrix: u8,
}

/// Decodes all tiles. One that does not decode costs its rows.
fn assembled(file: &HeifFile, source: &Source, coloured: bool) -> Result<Planes> {
    let [width, height] = source.size.map(|side| side as usize);
    let samples = width * height;
    let luma = if source.bits == 8 { Samples::U8(vec![128; samples]) } else { Samples::U16(vec![1 << 15; samples]) };
    let mut planes = Planes {
        width,
        height,
        bits: source.bits,
        luma,
        chroma: None,
        damaged: Vec::new(),
        full_range: false,
        matrix: 2,
    };
    let mut reason = None;
    let mut whole = 0;
    for (k, id) in source.tiles.iter().enumerate() {
        let place = [k % source.columns, k / source.columns];
        let corner = [0, 1].map(|axis| place[axis] * source.tile[axis] as usize);
        let decoded = file.hevc_bitstream(*id).map_err(|error| engine_error(&error)).and_then(|stream| {
            decode_picture(&stream, options(source.tile, stream.len())).map_err(|error| engine_error(&error))
        });
        match decoded.and_then(|frame| planes.put(&frame, corner, source, coloured)) {
            Ok(()) => whole += 1,
            Err(error) => {
                let last = (corner[1] + source.tile[1] as usize).min(height);
                planes.damaged.push([corner[1] as u32, last as u32]);
                reason.get_or_insert(error);
            }
        }
    }
    match reason {
        Some(error) if whole == 0 => Err(error),
        _ => Ok(planes),
    }
}

/// A tile's stream states the size that is coded, of which a part is cut away: what fills the last blocks, or whatever the encoder was asked to
/// leave out. Memory is taken for that size, so it is at most what the tile needs, or what that many bytes can describe.
fn options(tile: [u32; 2], bytes: usize) -> DecodeOptions {
    let [across, down] = tile.map(|side| u64::from(side).next_multiple_of(BLOCK));
    let described = (bytes as u64).saturating_mul(MOST_FROM_A_BYTE);
    let max_pixels = across.saturating_mul(down).max(described).min(limits::PIXELS);
    DecodeOptions { max_pixels, ..DecodeOptions::default() }
}

impl Planes {
    /// Copies a decoded tile to its place.
    fn put(&mut self, frame: &Frame, corner: [usize; 2], source: &Source, coloured: bool) -> Result<()> {
        let size = [frame.widths[0], frame.heights[0]];
        if u32::from(frame.bit_depth[0]) != self.bits || size[0] < source.tile[0] || size[1] < source.tile[1] {
            return Err(broken(Damage::Header));
        }
        let [across, down] = [0, 1]
            .map(|axis| (source.tile[axis] as usize).min([self.width, self.height][axis].saturating_sub(corner[axis])));
        let shift = 16 - self.bits;
        for row in 0..down {
            let from = row * size[0] as usize;
            let line = &frame.planes[0][from..from + across];
            let to = (corner[1] + row) * self.width + corner[0];
            match &mut self.luma {
                Samples::U8(luma) => {
                    luma[to..to + across].iter_mut().zip(line).for_each(|(to, from)| *to = *from as u8)
                }
                Samples::U16(luma) => {
                    luma[to..to + across].iter_mut().zip(line).for_each(|(to, from)| *to = from << shift)
                }
            }
        }
        (self.full_range, self.matrix) = (frame.full_range, frame.matrix_coeffs);
        if coloured && frame.widths[1] > 0 {
            self.put_chroma(frame, corner, [across, down]);
        }
        Ok(())
    }

    fn put_chroma(&mut self, frame: &Frame, corner: [usize; 2], covered: [usize; 2]) {
        let step = match frame.chroma_format {
            1 => [2, 2],
            2 => [2, 1],
            _ => [1, 1],
        };
        let size = [self.width.div_ceil(step[0]), self.height.div_ceil(step[1])];
        let fresh = || [0, 1].map(|_| vec![128u8; size[0] * size[1]]);
        let chroma = self.chroma.get_or_insert_with(|| Chroma { planes: fresh(), size, step });
        if chroma.step != step {
            return;
        }
        let shift = frame.bit_depth[1].saturating_sub(8);
        for (plane, to) in frame.planes[1..].iter().zip(&mut chroma.planes) {
            for row in 0..covered[1].div_ceil(step[1]) {
                let y = corner[1] / step[1] + row;
                let count = covered[0].div_ceil(step[0]).min(size[0] - corner[0] / step[0]);
                let from = row * frame.widths[1] as usize;
                let (Some(line), true) = (plane.get(from..from + count), y < size[1]) else { continue };
                let start = y * size[0] + corner[0] / step[0];
                to[start..start + count].iter_mut().zip(line).for_each(|(to, from)| *to = (from >> shift) as u8);
            }
        }
    }

    fn luma(&self, x: usize, y: usize) -> f32 {
        match &self.luma {
            Samples::U8(luma) => f32::from(luma[y * self.width + x]),
            Samples::U16(luma) => f32::from(luma[y * self.width + x]) / 257.0,
        }
    }

    /// Cb and Cr at a luma sample, less their middle. Columns of chroma lie on even ones of luma, rows between two (H.265, E.3.1).
    fn chroma(&self, x: usize, y: usize) -> [f32; 2] {
        let Some(Chroma { planes, size, step }) = &self.chroma else { return [0.0; 2] };
        let place = |at: usize, axis: usize, offset: f32| {
            let at = ((at as f32 - offset) / step[axis] as f32).clamp(0.0, (size[axis] - 1) as f32);
            let first = (at as usize).min(size[axis] - 1);
            (first, (first + 1).min(size[axis] - 1), at - first as f32)
        };
        let (left, right, fx) = place(x, 0, 0.0);
        let (above, below, fy) = place(y, 1, (step[1] as f32 - 1.0) / 2.0);
        [0, 1].map(|k| {
            let at = |x: usize, y: usize| f32::from(planes[k][y * size[0] + x]);
            let line = |y: usize| at(left, y) * (1.0 - fx) + at(right, y) * fx;
            line(above) * (1.0 - fy) + line(below) * fy - 128.0
        })
    }

    /// Red, green and blue of a pixel.
    fn colour(&self, x: usize, y: usize, matrix: &Matrix) -> [u8; 3] {
        matrix.rgb(self.luma(x, y), self.chroma(x, y)).map(|level| level.round().clamp(0.0, 255.0) as u8)
    }

    /// The samples of a channel inside the crop. Without colours every choice is the luma plane.
    fn channel(self, channel: Channel, [left, top, width, height]: [u32; 4], matrix: &Matrix) -> Samples {
        let [left, top, across, down] = [left, top, width, height].map(|side| side as usize);
        let which = match channel {
            Channel::Red => 0,
            Channel::Green => 1,
            Channel::Blue => 2,
            Channel::Grey => 3,
        };
        if which < 3 && self.chroma.is_some() {
            let level = |x: usize, y: usize| matrix.rgb(self.luma(x, y), self.chroma(x, y))[which];
            let places = (top..top + down).flat_map(|y| (left..left + across).map(move |x| (x, y)));
            return match self.bits {
                8 => Samples::U8(places.map(|(x, y)| level(x, y).round().clamp(0.0, 255.0) as u8).collect()),
                _ => Samples::U16(
                    places.map(|(x, y)| (257.0 * level(x, y)).round().clamp(0.0, 65535.0) as u16).collect(),
                ),
            };
        }
        if (across, down) == (self.width, self.height) {
            return self.luma;
        }
        let rows = (top..top + down).map(|y| y * self.width + left);
        match &self.luma {
            Samples::U8(luma) => Samples::U8(rows.flat_map(|from| &luma[from..from + across]).copied().collect()),
            Samples::U16(luma) => Samples::U16(rows.flat_map(|from| &luma[from..from + across]).copied().collect()),
        }
    }
}

/// A property of an item, where it has one.
fn property<'a, T>(file: &'a HeifFile, id: ItemId, which: impl Fn(&'a Property) -> Option<T>) -> Result<Option<T>> {
    Ok(file.item_properties(id).map_err(|error| engine_error(&error))?.find_map(which))
}
