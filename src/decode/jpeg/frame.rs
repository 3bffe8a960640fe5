//! Segments of a JPEG file: tables, the frame with its components, the scans.

use super::huffman::Table;
use crate::error::{Damage, PictureKind};

/// Why a JPEG file is not read.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// A kind that is not read.
    Kind(PictureKind),
    /// Damage.
    Broken(Damage),
    /// It claims to be larger than its bytes can hold.
    Size([u16; 2]),
}

/// How coefficients are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// One after the other.
    Sequential,
    /// From coarse to fine.
    Progressive,
}

/// Meaning of the components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Grey alone.
    Grey,
    /// Luma, blue difference, red difference.
    Luma,
    /// Red, green, blue; or four inks.
    Others,
}

/// One component of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Component {
    pub id: u8,
    /// Blocks of a unit, across and down.
    pub blocks: [usize; 2],
    /// Which quantisation table.
    pub steps: usize,
}

/// The frame header.
#[derive(Clone, Debug)]
pub struct FrameHeader {
    pub width: usize,
    pub height: usize,
    pub coding: Coding,
    pub colours: Colours,
    pub components: Vec<Component>,
    /// Maximum number of blocks of a unit, across and down.
    pub unit: [usize; 2],
}

/// Tables that hold until they are defined anew.
#[derive(Default)]
pub struct Tables {
    /// Quantisation steps in zigzag order.
    pub steps: [Option<[u16; 64]>; 4],
    pub direct: [Option<Table>; 4],
    pub alternating: [Option<Table>; 4],
    /// Units between two restart markers; 0 for none.
    pub restart: usize,
    jfif: bool,
    adobe: Option<u8>,
}

/// A part of the file; its payload is without the length.
pub enum Segment<'a> {
    /// A frame header and its marker.
    Frame(u8, &'a [u8]),
    /// A scan header; data follow.
    Scan(&'a [u8]),
    /// Any other.
    Other(u8, &'a [u8]),
    /// The end of the picture.
    End,
}

/// The next segment; `at` is moved behind it. `None` if the file ends.
pub fn next<'a>(bytes: &'a [u8], at: &mut usize) -> Option<Segment<'a>> {
    loop {
        // what does not belong there is passed, as by every decoder
        *at += bytes.get(*at..)?.iter().position(|byte| *byte == 0xff)?;
        let marker = *bytes.get(*at + 1)?;
        match marker {
            0xff => *at += 1,
            0x00 | 0x01 | 0xd0..=0xd8 => *at += 2,
            0xd9 => return Some(Segment::End),
            _ => {
                let length = usize::from(u16::from_be_bytes([*bytes.get(*at + 2)?, *bytes.get(*at + 3)?])).max(2);
                let payload = bytes.get(*at + 4..*at + 2 + length)?;
                *at += 2 + length;
                return Some(match marker {
                    0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf => Segment::Frame(marker, payload),
                    0xda => Segment::Scan(payload),
                    _ => Segment::Other(marker, payload),
                });
            }
        }
    }
}

impl Tables {
    /// Takes over what a segment defines; `None` if it is damaged.
    pub fn read(&mut self, marker: u8, payload: &[u8]) -> Option<()> {
        match marker {
            0xc4 => self.read_codes(payload),
            0xdb => self.read_steps(payload),
            0xdd => {
                self.restart = usize::from(u16::from_be_bytes([*payload.first()?, *payload.get(1)?]));
                Some(())
            }
            0xe0 => {
                self.jfif |= payload.starts_with(b"JFIF\0");
                Some(())
            }
            0xee => {
                if payload.starts_with(b"Adobe") {
                    self.adobe = payload.get(11).copied();
                }
                Some(())
            }
            _ => Some(()),
        }
    }

    fn read_codes(&mut self, mut payload: &[u8]) -> Option<()> {
        while let Some((kind, rest)) = payload.split_first() {
            let (counts, rest) = rest.split_first_chunk::<16>()?;
            let count = counts.iter().map(|count| usize::from(*count)).sum::<usize>();
            let (symbols, rest) = rest.split_at_checked(count)?;
            let tables = if kind >> 4 == 0 { &mut self.direct } else { &mut self.alternating };
            *tables.get_mut(usize::from(kind & 15))? = Some(Table::new(counts, symbols)?);
            payload = rest;
        }
        Some(())
    }

    fn read_steps(&mut self, mut payload: &[u8]) -> Option<()> {
        while let Some((kind, rest)) = payload.split_first() {
            let wide = kind >> 4 != 0;
            let (values, rest) = rest.split_at_checked(if wide { 128 } else { 64 })?;
            let value = |k: usize| {
                if wide { u16::from_be_bytes([values[2 * k], values[2 * k + 1]]) } else { u16::from(values[k]) }
            };
            *self.steps.get_mut(usize::from(kind & 15))? = Some(std::array::from_fn(value));
            payload = rest;
        }
        Some(())
    }
}

impl FrameHeader {
    /// Reads a frame header.
    pub fn read(marker: u8, payload: &[u8], tables: &Tables) -> Result<Self, Refusal> {
        let broken = || Refusal::Broken(Damage::Header);
        let coding = match marker {
            0xc0 | 0xc1 => Coding::Sequential,
            0xc2 => Coding::Progressive,
            0xc3 => return Err(Refusal::Kind(PictureKind::LosslessJpeg)),
            0xc5..=0xc7 => return Err(Refusal::Kind(PictureKind::HierarchicalJpeg)),
            _ => return Err(Refusal::Kind(PictureKind::ArithmeticJpeg)),
        };
        let [precision, h1, h0, w1, w0, count, rest @ ..] = payload else { return Err(broken()) };
        if *precision != 8 {
            return Err(Refusal::Kind(match precision {
                12 => PictureKind::TwelveBitJpeg,
                _ => PictureKind::OddJpeg,
            }));
        }
        let (width, height) = (u16::from_be_bytes([*w1, *w0]), u16::from_be_bytes([*h1, *h0]));
        if !matches!(count, 1 | 3 | 4) || rest.len() < 3 * usize::from(*count) || width == 0 {
            return Err(broken());
        }
        if height == 0 {
            return Err(Refusal::Kind(PictureKind::JpegWithoutHeight));
        }
        let mut components = Vec::new();
        for part in rest.chunks_exact(3).take(usize::from(*count)) {
            let blocks = [part[1] >> 4, part[1] & 15].map(usize::from);
            if blocks.iter().any(|n| !(1..=4).contains(n)) || part[2] > 3 {
                return Err(broken());
            }
            components.push(Component { id: part[0], blocks, steps: usize::from(part[2]) });
        }
        if let [grey] = &mut components[..] {
            // a single component is not interleaved, whatever its header states
            grey.blocks = [1, 1];
        }
        let most = |axis: usize| components.iter().map(|c| c.blocks[axis]).max().unwrap_or(1);
        let unit = [most(0), most(1)];
        let ids = components.iter().map(|c| c.id).collect::<Vec<_>>();
        let colours = match (*count, tables.adobe) {
            (1, _) => Colours::Grey,
            (3, _) if tables.jfif => Colours::Luma,
            (3, Some(0)) => Colours::Others,
            (3, None) if ids == *b"RGB" => Colours::Others,
            (3, _) => Colours::Luma,
            _ => Colours::Others,
        };
        let (width, height) = (usize::from(width), usize::from(height));
        Ok(Self { width, height, coding, colours, components, unit })
    }

    /// Units of the picture, across and down.
    pub fn units(&self) -> [usize; 2] {
        [self.width.div_ceil(8 * self.unit[0]), self.height.div_ceil(8 * self.unit[1])]
    }

    /// Blocks of a component that comes alone: those beyond the border are left out then.
    pub fn blocks_alone(&self, component: usize) -> [usize; 2] {
        let blocks = self.components[component].blocks;
        let size = |pixels: usize, axis: usize| (pixels * blocks[axis]).div_ceil(8 * self.unit[axis]);
        [size(self.width, 0), size(self.height, 1)]
    }

    /// Whether the first plane has a sample for each pixel.
    pub fn has_full_luma(&self) -> bool {
        self.components[0].blocks == self.unit
    }

    /// Maximum number of pixels that the bytes can hold, with codes of at least one bit.
    ///
    /// A sequential block is a direct coefficient and an end: two bits. Of a progressive one every row of blocks takes part in all
    /// scans, and the first one of luma has a bit of each block: with fewer bytes no row can be whole.
    pub fn check_size(&self, bytes: usize) -> Result<(), Refusal> {
        let blocks = |component| self.blocks_alone(component).iter().product::<usize>() as u64;
        let least = match self.coding {
            // a file that lost nine tenths of its bytes is still one of its size
            Coding::Sequential => (0..self.components.len()).map(blocks).sum::<u64>() * 2 / 8 / 10,
            Coding::Progressive => blocks(0) / 8,
        };
        if least > bytes as u64 { Err(Refusal::Size([self.width as u16, self.height as u16])) } else { Ok(()) }
    }
}

/// A component in a scan.
#[derive(Clone, Copy)]
pub struct ScanComponent {
    /// Which component of the frame.
    pub component: usize,
    /// Which tables.
    pub direct: usize,
    pub alternating: usize,
}

/// A scan header.
pub struct Scan {
    pub parts: Vec<ScanComponent>,
    /// First and last coefficient.
    pub band: [usize; 2],
    /// Bits left out before this scan, 0 if it is the first, and after it.
    pub bits: [u32; 2],
}

impl Scan {
    /// Reads a scan header; `None` if it is damaged.
    pub fn read(payload: &[u8], frame: &FrameHeader) -> Option<Self> {
        let (count, rest) = payload.split_first()?;
        let (parts, rest) = rest.split_at_checked(2 * usize::from(*count))?;
        let part = |part: &[u8]| {
            let component = frame.components.iter().position(|c| c.id == part[0])?;
            let (direct, alternating) = (usize::from(part[1] >> 4), usize::from(part[1] & 15));
            (direct < 4 && alternating < 4).then_some(ScanComponent { component, direct, alternating })
        };
        let parts = parts.chunks_exact(2).map(part).collect::<Option<Vec<_>>>()?;
        let [first, last, bits, ..] = rest else { return None };
        let (band, bits) = ([usize::from(*first), usize::from(*last)], [u32::from(bits >> 4), u32::from(bits & 15)]);
        let sound = !parts.is_empty() && band[0] <= band[1] && band[1] < 64 && bits.iter().all(|bits| *bits < 14);
        sound.then_some(Self { parts, band, bits })
    }
}
