//! Scans of a JPEG file: sequential ones into samples, unit by unit, with a record of the units that could not be decoded.
//!
//! Restart markers limit damage: after each, decoding starts anew, and their numbers tell how many were lost (T.81, F.1.2.3).
//! Damage that still reads as codes is found by what it does to the end of a run of units: data that are left over, or missing.

use super::bits::Bits;
use super::frame::{Coding, Colours, Component, FrameHeader, Refusal, Scan, Tables};
use super::huffman::{BadCode, Table};
use super::transform::{self, CoefficientBlock, PLACES};
use super::{Luma, Plane8};
use crate::error::Damage;

/// Bytes that may be left over at the end of a run: writers pad.
const SPARE: usize = 16;
/// So many equal bytes in a row are no picture: lost sectors and preallocated files are full of them.
const EQUAL: usize = 48;
/// So many restart markers may be missing; a number further on is one that came too late.
const MOST_LOST: usize = 4;
/// Largest mean of a block about grey, with room for what quantising adds: 128 levels times 8.
pub const LARGEST_DIRECT: i32 = 2 * 1024;

/// The planes of a file while they are read.
pub struct Planes {
    pub frame: FrameHeader,
    /// Whether damage is looked for in all components, and no samples are wanted; else the first is read.
    all: bool,
    plane: Plane8,
    chroma: Option<[Plane8; 2]>,
    /// Per row of units, whether all of it was decoded.
    whole: Vec<bool>,
    /// Per component, whether it came at all.
    seen: Vec<bool>,
    /// Of progressive files: per component that is wanted, its coefficients, and per coefficient the bits that are still left out.
    pub(super) coefficients: Vec<Vec<i16>>,
    pub(super) finest: Vec<[u32; 64]>,
    pub(super) steps: Option<[u16; 64]>,
}

/// Decodes the blocks of one component in a sequential scan.
struct ComponentDecoder<'a> {
    component: usize,
    blocks: [usize; 2],
    direct: &'a Table,
    alternating: &'a Table,
    steps: [u16; 64],
    weights: CoefficientBlock,
    previous: i32,
}

impl Planes {
    /// Room for what is wanted of a frame's planes.
    pub fn new(frame: FrameHeader, all: bool) -> Self {
        let [across, down] = frame.units();
        let [width, height] = if all { [0, 0] } else { [frame.width, frame.height] };
        let plane = Plane8 { width, height, samples: vec![128; width * height] };
        let means = |c: &Component| {
            let (width, height) = (across * c.blocks[0], down * c.blocks[1]);
            Plane8 { width, height, samples: vec![128; width * height] }
        };
        let chroma = match &frame.components[..] {
            [_, blue, red] if frame.colours == Colours::Luma && !all => Some([means(blue), means(red)]),
            _ => None,
        };
        let count = frame.components.len();
        let coefficients = match frame.coding {
            Coding::Sequential => Vec::new(),
            Coding::Progressive => (frame.components.iter().take(if all { count } else { 1 }))
                .map(|c| vec![0; across * down * c.blocks[0] * c.blocks[1] * 64])
                .collect(),
        };
        let (whole, seen, finest) = (vec![true; down], vec![false; count], vec![[u32::MAX; 64]; count]);
        Self { frame, all, plane, chroma, whole, seen, coefficients, finest, steps: None }
    }

    /// Whether damage of a component is damage of what is wanted.
    pub(super) fn wants(&self, component: usize) -> bool {
        self.all || component == 0
    }

    /// Decodes one scan whose data begin at `at`; where the next segment may begin.
    pub fn scan(&mut self, bytes: &[u8], at: usize, scan: &Scan, tables: &Tables) -> usize {
        match self.frame.coding {
            Coding::Sequential => self.sequential(bytes, at, scan, tables),
            Coding::Progressive => self.progressive(bytes, at, scan, tables),
        }
    }

    fn sequential(&mut self, bytes: &[u8], at: usize, scan: &Scan, tables: &Tables) -> usize {
        let read = |part: &super::frame::ScanComponent| {
            let component = &self.frame.components[part.component];
            let steps = tables.steps[component.steps]?;
            Some(ComponentDecoder {
                component: part.component,
                blocks: component.blocks,
                direct: tables.direct[part.direct].as_ref()?,
                alternating: tables.alternating[part.alternating].as_ref()?,
                weights: transform::weights(&steps),
                steps,
                previous: 0,
            })
        };
        let Some(mut readers) = scan.parts.iter().map(read).collect::<Option<Vec<_>>>() else { return at };
        let units = match &mut readers[..] {
            [alone] => {
                alone.blocks = [1, 1];
                self.frame.blocks_alone(alone.component)
            }
            _ => self.frame.units(),
        };
        let mut whole = vec![true; units[1]];
        let at = walk(bytes, at, units, tables.restart, &mut whole, |bits, place, anew| {
            if anew {
                readers.iter_mut().for_each(|reader| reader.previous = 0);
            }
            self.unit(bits, &mut readers, place)
        });
        self.note(scan, &whole);
        at
    }

    /// Takes over which rows a scan gave: rows of units, or of blocks where a component came alone.
    pub(super) fn note(&mut self, scan: &Scan, whole: &[bool]) {
        scan.parts.iter().for_each(|part| self.seen[part.component] = true);
        if !scan.parts.iter().any(|part| self.wants(part.component)) {
            return;
        }
        let each = match &scan.parts[..] {
            [part] => self.frame.components[part.component].blocks[1],
            _ => 1,
        };
        for (row, part) in self.whole.iter_mut().zip(whole.chunks(each)) {
            *row &= part.iter().all(|whole| *whole);
        }
    }

    /// Spoils everything: a scan is lost.
    pub(super) fn spoil(&mut self) {
        self.whole.fill(false);
    }

    #[inline(always)]
    fn unit(
        &mut self,
        bits: &mut Bits,
        readers: &mut [ComponentDecoder],
        [across, down]: [usize; 2],
    ) -> Result<Content, BadCode> {
        let mut content = Content::Flat;
        for reader in readers {
            for y in 0..reader.blocks[1] {
                for x in 0..reader.blocks[0] {
                    let at = [across * reader.blocks[0] + x, down * reader.blocks[1] + y];
                    let block = if reader.component == 0 && !self.all {
                        luma_block(bits, reader, &mut self.plane, at)?
                    } else {
                        let (mean, content) = mean_block(bits, reader)?;
                        self.set_mean(reader.component, at, mean);
                        content
                    };
                    if block == Content::Structure {
                        content = block;
                    }
                }
            }
        }
        Ok(content)
    }

    /// What was read, with the rows that were not; `ended` is whether the file does, `data` are its scans.
    ///
    /// # Errors
    /// [`Refusal::Broken`] if no row is whole.
    pub fn finish(mut self, ended: bool, data: &[u8]) -> Result<Luma, Refusal> {
        let none = || Refusal::Broken(Damage::NoWholeRow);
        let mut wanted = (0..self.seen.len()).filter(|component| self.wants(*component));
        if wanted.any(|component| !self.seen[component]) {
            return Err(if ended { none() } else { Refusal::Broken(Damage::EndsEarly) });
        }
        if self.frame.coding == Coding::Progressive {
            let mut wanted = (0..self.finest.len()).filter(|component| self.wants(*component));
            // what only missing scans would have refined is whole nowhere; damage may have taken them with their headers
            let sound = || ended && self.whole.iter().all(|whole| *whole) && equal_bytes(data).next().is_none();
            if wanted.any(|component| self.finest[component] != [0; 64]) && !sound() {
                return Err(none());
            }
            if !self.all {
                self.develop();
            }
        }
        let rows = 8 * self.frame.unit[1];
        let height = self.frame.height;
        let mut damaged: Vec<[u32; 2]> = Vec::new();
        for (row, _) in self.whole.iter().enumerate().filter(|(_, whole)| !**whole) {
            let (from, to) = (row * rows, ((row + 1) * rows).min(height));
            if let Some(samples) = self.plane.samples.get_mut(from * self.plane.width..to * self.plane.width) {
                samples.fill(128);
            }
            match damaged.last_mut() {
                Some(last) if last[1] as usize == from => last[1] = to as u32,
                _ => damaged.push([from as u32, to as u32]),
            }
        }
        if damaged == [[0, height as u32]] {
            return Err(none());
        }
        Ok(Luma { plane: self.plane, chroma: self.chroma, damaged })
    }

    /// Writes a block of luma.
    pub(super) fn put(&mut self, at: [usize; 2], samples: &[u8; 64]) {
        put(&mut self.plane, at, samples);
    }

    /// Takes over the mean of a block of chroma.
    #[inline(always)]
    pub(super) fn set_mean(&mut self, component: usize, at: [usize; 2], mean: u8) {
        if let Some(plane) = self.chroma.as_mut().and_then(|c| c.get_mut(component.wrapping_sub(1)))
            && let Some(sample) = plane.samples.get_mut(at[1] * plane.width + at[0])
        {
            *sample = mean;
        }
    }
}

/// One block of luma, from codes to samples.
#[inline(never)]
fn luma_block(
    bits: &mut Bits,
    reader: &mut ComponentDecoder,
    plane: &mut Plane8,
    at: [usize; 2],
) -> Result<Content, BadCode> {
    let direct = next_direct(bits, reader)?;
    let mut block: CoefficientBlock = [0.0; 80];
    let weights = &reader.weights;
    let last = reader.alternating.alternating(bits, |k, value| {
        let place = usize::from(PLACES[k.min(79)]);
        block[place] = value as f32 * weights[place];
    })?;
    if last == 0 {
        put(plane, at, &[transform::mean(direct, reader.steps[0]); 64]);
        return Ok(Content::Flat);
    }
    block[0] = direct as f32 * weights[0];
    put(plane, at, &transform::samples(&block));
    Ok(Content::Structure)
}

/// The mean of one block, and what else there is of it.
#[inline(never)]
fn mean_block(bits: &mut Bits, reader: &mut ComponentDecoder) -> Result<(u8, Content), BadCode> {
    let direct = next_direct(bits, reader)?;
    let content = if reader.alternating.pass(bits)? { Content::Structure } else { Content::Flat };
    Ok((transform::mean(direct, reader.steps[0]), content))
}

#[inline(always)]
fn next_direct(bits: &mut Bits, reader: &mut ComponentDecoder) -> Result<i32, BadCode> {
    // steps of 0 hold nothing back
    reader.previous = reader.previous.wrapping_add(reader.direct.direct(bits)?);
    let level = reader.previous.saturating_mul(i32::from(reader.steps[0]));
    if level.saturating_abs() > LARGEST_DIRECT + i32::from(reader.steps[0]) {
        Err(BadCode)
    } else {
        Ok(reader.previous)
    }
}

/// Writes a block where it lies in the plane; at the border only what belongs to it.
#[inline(always)]
fn put(plane: &mut Plane8, at: [usize; 2], samples: &[u8; 64]) {
    let (x, y) = (8 * at[0], 8 * at[1]);
    let width = plane.width;
    if x + 8 <= width && y + 8 <= plane.height {
        for (k, row) in samples.chunks_exact(8).enumerate() {
            let from = (y + k) * width + x;
            if let Some(to) = plane.samples.get_mut(from..from + 8) {
                to.copy_from_slice(row);
            }
        }
        return;
    }
    for (k, row) in samples.chunks_exact(8).enumerate().take(plane.height.saturating_sub(y)) {
        let count = width.saturating_sub(x).min(8);
        let from = (y + k) * width + x;
        if count > 0 {
            plane.samples[from..from + count].copy_from_slice(&row[..count]);
        }
    }
}

/// Layout of the data of a unit.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// Nothing but means: equal bytes may be such units.
    Flat,
    Structure,
}

/// Goes through the runs of units between restart markers: `decode` does the unit at a place, the first of a run with `anew`.
/// `whole` is marked for the rows of units. Returns where the next segment may begin.
pub fn walk(
    bytes: &[u8],
    mut at: usize,
    [across, down]: [usize; 2],
    restart: usize,
    whole: &mut [bool],
    mut decode: impl FnMut(&mut Bits, [usize; 2], bool) -> Result<Content, BadCode>,
) -> usize {
    let all = across * down;
    let length = if restart == 0 { all } else { restart };
    let runs = all.div_ceil(length.max(1));
    let mut first_spoilt = all;
    let mut spoil = |from: usize, to: usize, first_spoilt: &mut usize| {
        if from < to {
            *first_spoilt = from.min(*first_spoilt);
            whole[from / across..=(to - 1) / across].fill(false);
        }
    };
    // per unit of a run, where its data begin, and what they are
    let mut begins: Vec<(usize, Content)> = Vec::with_capacity(length.min(all));
    let mut run = 0;
    loop {
        let (from, to) = (run * length, ((run + 1) * length).min(all));
        let mut bits = Bits::new(bytes, at);
        begins.clear();
        while from + begins.len() < to {
            let unit = from + begins.len();
            let position = bits.position();
            match decode(&mut bits, [unit % across, unit / across], unit == from) {
                Ok(content) if !bits.overrun() => begins.push((position, content)),
                _ => break,
            }
        }
        let (ran_out, position) = (bits.overrun(), bits.position());
        let mut end = marker(bytes, if ran_out { position } else { position.saturating_sub(1).max(at) });
        let last = run + 1 == runs;
        let ending = Ending { units: to - from, across, of: all, last, ran_out, position, end };
        if let Some(unit) = ending.doubtful(bytes, at, &begins) {
            spoil(from + unit, to, &mut first_spoilt);
        }
        run += 1;
        if run == runs {
            return end;
        }
        // to the restart marker; anything else there is damage
        loop {
            match bytes.get(end + 1) {
                Some(number @ 0xd0..=0xd7) => {
                    at = end + 2;
                    let lost = (usize::from(*number) + 16 - 0xd0 - (run - 1) % 8) % 8;
                    if lost <= MOST_LOST {
                        let next = (run + lost).min(runs);
                        // what took markers may have begun in the data before them
                        let from = if lost > 0 { run - 1 } else { run } * length;
                        spoil(from, (next * length).min(all), &mut first_spoilt);
                        run = next;
                        break;
                    }
                    end = marker(bytes, at);
                }
                // of markers that damage has taken the number is known to eight: with too few, none behind it is sure
                number if matches!(number, Some(0xd9) | None) || is_segment(bytes, end) => {
                    let from = first_spoilt.min((run - 1) * length);
                    spoil(from, all, &mut first_spoilt);
                    return end;
                }
                _ => end = marker(bytes, end + 2),
            }
        }
        if run == runs {
            return at;
        }
    }
}

/// How the data of a run ended.
struct Ending {
    /// Units that should have come, in a row, and in the picture.
    units: usize,
    across: usize,
    of: usize,
    /// Whether it is the last run, which files may be filled up behind.
    last: bool,
    /// Whether a marker or the end of the file came too early; else a code was none.
    ran_out: bool,
    /// Up to where the data were used, and where they end.
    position: usize,
    end: usize,
}

impl Ending {
    /// First unit of the run that is not sure, by what came.
    fn doubtful(&self, bytes: &[u8], at: usize, begins: &[(usize, Content)]) -> Option<usize> {
        let used = &bytes[at..self.position.clamp(at, bytes.len())];
        let missing = self.units - begins.len();
        let rest = &bytes[self.position.min(self.end)..self.end];
        let fill = || rest[2..].iter().all(|byte| *byte == rest[2]) && (self.last || rest.len() < EQUAL);
        let spare = rest.len() <= SPARE || fill();
        let sound = missing == 0 && spare;
        // the unit before the one that a run of equal bytes begins in: its data are not placed to the bit
        let unit_at = |place: usize| begins.partition_point(|(begin, _)| *begin <= place).saturating_sub(2);
        let sector = equal_bytes(used).find_map(|[first, last]| {
            let unit = unit_at(at + first);
            let inside = begins[unit..].iter().take_while(|(begin, _)| *begin < at + last);
            let units =
                inside.filter(|(begin, content)| *begin >= at + first && *content == Content::Structure).count();
            // a pattern's blocks, of few bits each, can be equal bytes too
            let structure = (1..=(last - first) / 2).contains(&units);
            (structure || !sound).then_some(unit)
        });
        if sector.is_some() || sound {
            return sector;
        }
        if missing == 0 {
            // it ended in step, yet not with its data: somewhere before it was out of step
            return Some(0);
        }
        let cut = self.end >= bytes.len() || missing > self.of / 8;
        match self.ran_out {
            true if cut => Some(begins.len()),
            // all data, and too few codes: somewhere they were misread
            true => Some(0),
            false => Some(begins.len().saturating_sub(self.across)),
        }
    }
}

/// Place of the next marker, or the end of the file.
fn marker(bytes: &[u8], from: usize) -> usize {
    let mut at = from.min(bytes.len());
    loop {
        match bytes[at..].iter().position(|byte| *byte == 0xff) {
            None => return bytes.len(),
            Some(step) => at += step,
        }
        match bytes.get(at + 1) {
            None => return bytes.len(),
            Some(0x00 | 0x01) => at += 2,
            Some(0xff) => at += 1,
            Some(_) => return at,
        }
    }
}

/// Whether a marker of codes or of a scan begins what can be one, and not noise: its length leads to the next, or to a scan's data.
fn is_segment(bytes: &[u8], at: usize) -> bool {
    let Some([marker, high, low]) = bytes.get(at + 1..at + 4) else { return false };
    let length = usize::from(u16::from_be_bytes([*high, *low]));
    match marker {
        0xc4 => bytes.get(at + 2 + length) == Some(&0xff),
        0xda => bytes.get(at + 4).is_some_and(|count| length == 6 + 2 * usize::from(*count)),
        _ => false,
    }
}

/// Long runs of equal bytes: first byte and the byte after the last.
fn equal_bytes(data: &[u8]) -> impl Iterator<Item = [usize; 2]> {
    let mut at = 0;
    std::iter::from_fn(move || {
        // a run of that length has two such neighbours
        while at + EQUAL / 2 < data.len() {
            let middle = at;
            at += EQUAL / 2;
            if data[middle] != data[middle + 1] || data[middle] != data[middle + 2] {
                continue;
            }
            let before = data[..middle].iter().rev().take_while(|byte| **byte == data[middle]).count();
            let after = data[middle..].iter().take_while(|byte| **byte == data[middle]).count();
            at = at.max(middle + after);
            if before + after >= EQUAL {
                return Some([middle - before, middle + after]);
            }
        }
        None
    })
}
