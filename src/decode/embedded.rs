//! The picture that a camera put into its file to be shown at once, found from the first bytes and read alone: of fifty RAW files of
//! 40 megabytes each some hundred kilobytes are read.
//!
//! TIFF 6.0 and what is built on it (DNG, NEF, CR2, ARW, PEF, ORF, RW2): a JPEG that a directory, the next one or one below points to
//! (tags 513 and 514, or one strip), and reduced pictures that are not packed. JPEG: the thumbnail of its EXIF block (Exif 2.32, 4.5.6).
//! RAF: the JPEG that its head points to. CR3: the JPEG in the preview box beside `moov`. It is for the screen, never for measuring.

use std::io::{Read, Seek, SeekFrom};

use super::show::{Picture, cropped};
use super::{jpeg, photo_and_picture};
use crate::detection::Channel;

/// Bytes that are read at a time at least: directories stand close to each other, and each reading takes its time.
const PIECE: usize = 1 << 15;

/// Largest embedded picture that is decoded, in bytes and in pixels: a larger one takes as long as the photo.
const MOST_BYTES: u64 = 4 << 20;
const MOST_PIXELS: u64 = 5_000_000;

/// Directories of one file that are examined, files within the file, and bytes that are read in all: what points in circles ends.
const MOST_DIRECTORIES: usize = 24;
const MOST_FILES: usize = 8;
const MOST_READ: usize = 24 << 20;

/// A photo before it is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Embedded {
    /// The embedded preview, reduced, on the stored grid.
    pub picture: Picture,
    /// How it has to be turned for showing, 1 to 8.
    pub orientation: u8,
}

/// Finds the smallest embedded picture that is no smaller than `max_side`, else the largest; it is reduced to `max_side`. `None` if
/// there is none, or where it is damaged: the photo itself may still be sound.
pub fn embedded(file: &mut (impl Read + Seek), max_side: u32) -> Option<Embedded> {
    let file = Pieces { file, pieces: Vec::new(), read: 0 };
    let mut search = PictureSearch { file, found: FoundPictures::default(), files: 0 };
    search.file_at(0);
    let FoundPictures { candidates, largest, orientation } = search.found;
    let picture = best(&mut search.file, candidates, max_side)?;
    // thumbnails of one shape have bars where the photo has another
    let picture = match largest {
        [0, _] | [_, 0] => picture,
        shape => cropped(picture, shape),
    };
    Some(Embedded { picture, orientation: if (1..=8).contains(&orientation) { orientation } else { 1 } })
}

/// A picture embedded in the file.
#[derive(Clone, Copy, Debug)]
enum EmbeddedPicture {
    /// A file of its own within the file.
    Jpeg { at: u64, length: u64 },
    /// Red, green and blue bytes, row by row.
    Rgb { at: u64, size: [u32; 2] },
}

#[derive(Default)]
struct FoundPictures {
    candidates: Vec<EmbeddedPicture>,
    /// Width and height of the largest picture that is spoken of.
    largest: [u64; 2],
    orientation: u8,
}

/// A file of which pieces are read and kept.
struct Pieces<'a, F> {
    file: &'a mut F,
    pieces: Vec<(u64, Vec<u8>)>,
    read: usize,
}

impl<F: Read + Seek> Pieces<'_, F> {
    /// So many bytes at a place; `None` if the file ends before.
    fn bytes(&mut self, at: u64, length: usize) -> Option<&[u8]> {
        let holds = |(start, piece): &(u64, Vec<u8>)| *start <= at && at - start + length as u64 <= piece.len() as u64;
        let place = match self.pieces.iter().position(holds) {
            Some(place) => place,
            None => {
                self.read += length.max(PIECE);
                (self.read <= MOST_READ).then_some(())?;
                let mut piece = Vec::new();
                self.file.seek(SeekFrom::Start(at)).ok()?;
                (&mut *self.file).take(length.max(PIECE) as u64).read_to_end(&mut piece).ok()?;
                self.pieces.push((at, piece));
                self.pieces.len() - 1
            }
        };
        let (start, piece) = &self.pieces[place];
        let from = (at - start) as usize;
        piece.get(from..from + length)
    }

    /// A number of up to four bytes.
    fn number(&mut self, at: u64, length: usize, little: bool) -> Option<u64> {
        let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        let bytes = self.bytes(at, length)?;
        Some(if little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) })
    }
}

struct PictureSearch<'a, F> {
    file: Pieces<'a, F>,
    found: FoundPictures,
    files: usize,
}

impl<F: Read + Seek> PictureSearch<'_, F> {
    /// Looks into whatever begins at a place, as far as it is known.
    fn file_at(&mut self, at: u64) -> Option<()> {
        self.files += 1;
        (self.files <= MOST_FILES).then_some(())?;
        let head: [u8; 16] = self.file.bytes(at, 16)?.try_into().ok()?;
        match &head {
            [0xff, 0xd8, ..] => self.jpeg(at),
            [b'I', b'I', b'*' | b'U', 0, ..] | [b'I', b'I', b'R', b'O' | b'S', ..] => self.tiff(at, true),
            [b'M', b'M', 0, b'*', ..] | [b'M', b'M', b'O', b'R', ..] => self.tiff(at, false),
            [b'F', b'U', b'J', b'I', b'F', b'I', b'L', b'M', ..] => {
                let [at, length] = [84, 88].map(|place| self.file.number(place, 4, false));
                self.candidate(at?, length?);
                self.file_at(at.filter(|at| *at > 0)?)
            }
            [_, _, _, _, b'f', b't', b'y', b'p', b'c', b'r', b'x', ..] => self.preview_box(),
            _ => None,
        }
    }

    fn candidate(&mut self, at: u64, length: u64) {
        if (1..=MOST_BYTES).contains(&length) {
            self.found.candidates.push(EmbeddedPicture::Jpeg { at, length });
        }
    }

    fn has_size(&mut self, [width, height]: [u64; 2]) {
        if width.saturating_mul(height) > self.found.largest[0].saturating_mul(self.found.largest[1]) {
            self.found.largest = [width, height];
        }
    }

    /// The segments of a JPEG up to its frame.
    fn jpeg(&mut self, begin: u64) -> Option<()> {
        let mut at = begin + 2;
        loop {
            let [0xff, marker, ..] = *self.file.bytes(at, 4)? else { return None };
            if marker == 0xff {
                at += 1;
                continue;
            }
            let length = self.file.number(at + 2, 2, false)?;
            match marker {
                0xe1 if length >= 16 && self.file.bytes(at + 4, 6)? == b"Exif\0\0" => {
                    // a damaged block leaves the rest as it is
                    let _ = self.file_at(at + 10);
                }
                0xc0..=0xcf if ![0xc4, 0xc8, 0xcc].contains(&marker) => {
                    let [height, width] = [at + 5, at + 7].map(|place| self.file.number(place, 2, false));
                    self.has_size([width?, height?]);
                    return Some(());
                }
                0xda | 0xd9 => return None,
                _ => {}
            }
            at += 2 + length.max(2);
        }
    }

    /// The directories of a TIFF file that begins at `base`, those below the others too.
    fn tiff(&mut self, base: u64, little: bool) -> Option<()> {
        let mut waiting = vec![self.file.number(base + 4, 4, little)?];
        let mut seen: Vec<u64> = Vec::new();
        while let Some(start) = waiting.pop() {
            if start == 0 || seen.contains(&start) || seen.len() == MOST_DIRECTORIES {
                continue;
            }
            // in the first one stands how the photo is to be turned
            let first = seen.is_empty();
            seen.push(start);
            let _ = self.directory(base, start, little, first, &mut waiting);
        }
        Some(())
    }

    fn directory(&mut self, base: u64, start: u64, little: bool, first: bool, waiting: &mut Vec<u64>) -> Option<()> {
        let begin = base + start;
        let count = self.file.number(begin, 2, little)?.min(1000);
        let next = self.file.number(begin + 2 + 12 * count, 4, little);
        let mut of = Directory::default();
        for entry in (0..count).map(|k| begin + 2 + 12 * k) {
            let [tag, kind] = [0, 2].map(|by| self.file.number(entry + by, 2, little));
            let (tag, kind, values) = (tag?, kind?, self.file.number(entry + 4, 4, little)?);
            let length = match kind {
                3 => 2,
                4 | 13 => 4,
                _ => 1,
            };
            let here = values.saturating_mul(length) <= 4;
            let place = if here { entry + 8 } else { base + self.file.number(entry + 8, 4, little)? };
            // entries that point beyond the file are ignored
            let value = self.file.number(place, length as usize, little).unwrap_or(0);
            match tag {
                46 if !here => {
                    self.candidate(place, values);
                    let _ = self.file_at(place);
                }
                254 => of.reduced = value == 1,
                256 => of.size[0] = value,
                257 => of.size[1] = value,
                258 => of.bits = value,
                259 => of.compression = value,
                262 => of.kind = value,
                273 => (of.strip, of.strips) = (value, values),
                274 if first => self.found.orientation = value.min(9) as u8,
                277 => of.samples = value,
                279 => of.length = value,
                330 => waiting.extend((0..values.min(8)).filter_map(|k| self.file.number(place + 4 * k, 4, little))),
                513 => of.jpeg[0] = value,
                514 => of.jpeg[1] = value,
                _ => {}
            }
        }
        waiting.extend(next);
        self.offer(base, &of);
        Some(())
    }

    /// Keeps the picture of a directory if it is a suitable preview.
    fn offer(&mut self, base: u64, of: &Directory) {
        const FILTERS: u64 = 32803;
        const LINEAR: u64 = 34892;
        self.has_size(of.size);
        if of.jpeg[0] > 0 {
            self.candidate(base + of.jpeg[0], of.jpeg[1]);
        }
        if of.strip == 0 || of.kind == FILTERS || of.kind == LINEAR {
            return;
        }
        match of.compression {
            6 | 7 if of.strips == 1 => self.candidate(base + of.strip, of.length),
            1 if of.reduced && of.bits == 8 && of.samples == 3 && of.kind == 2 => {
                if let [Ok(width), Ok(height)] = of.size.map(u32::try_from)
                    && (1..=MOST_BYTES / 3).contains(&(u64::from(width) * u64::from(height)))
                {
                    self.found.candidates.push(EmbeddedPicture::Rgb { at: base + of.strip, size: [width, height] });
                }
            }
            _ => {}
        }
    }

    /// The box that Canon's CR3 has beside `moov` with a JPEG in it (ISO/IEC 14496-12: size, kind, for `uuid` 16 bytes more).
    fn preview_box(&mut self) -> Option<()> {
        const PREVIEW: [u8; 4] = [0xea, 0xf4, 0x2b, 0x5e];
        let mut at = 0;
        for _ in 0..16 {
            let size = self.file.number(at, 4, false)?;
            if self.file.bytes(at + 4, 4)? == b"uuid" && *self.file.bytes(at + 8, 4)? == PREVIEW {
                let begins = self.file.bytes(at + 24, 64)?.windows(3).position(|bytes| bytes == [0xff, 0xd8, 0xff])?;
                let begins = 24 + begins as u64;
                self.candidate(at + begins, size.checked_sub(begins)?);
                return Some(());
            }
            // one without an end, or of 64 bits, is the one with the samples
            at += Some(size).filter(|size| *size >= 8)?;
        }
        None
    }
}

/// Description of a picture in one directory.
#[derive(Default)]
struct Directory {
    reduced: bool,
    size: [u64; 2],
    bits: u64,
    compression: u64,
    kind: u64,
    samples: u64,
    strip: u64,
    strips: u64,
    length: u64,
    jpeg: [u64; 2],
}

/// The smaller of bytes first: they are the smaller ones of pixels.
fn best<F: Read + Seek>(
    file: &mut Pieces<'_, F>,
    mut candidates: Vec<EmbeddedPicture>,
    max_side: u32,
) -> Option<Picture> {
    candidates.sort_by_key(|candidate| match *candidate {
        EmbeddedPicture::Jpeg { length, .. } => length,
        EmbeddedPicture::Rgb { size: [width, height], .. } => 3 * u64::from(width) * u64::from(height),
    });
    let mut kept: Option<Picture> = None;
    for candidate in candidates {
        let Some((size, picture)) = decoded(file, candidate, max_side) else { continue };
        let better = kept.as_ref().is_none_or(|kept| picture.width.max(picture.height) > kept.width.max(kept.height));
        if better {
            kept = Some(picture);
        }
        if size.into_iter().max() >= Some(max_side) {
            break;
        }
    }
    kept
}

/// Its size in the file, and the picture reduced.
fn decoded<F: Read + Seek>(
    file: &mut Pieces<'_, F>,
    candidate: EmbeddedPicture,
    max_side: u32,
) -> Option<([u32; 2], Picture)> {
    match candidate {
        EmbeddedPicture::Jpeg { at, length } => {
            let bytes = file.bytes(at, length as usize)?;
            let frame = jpeg::header(bytes).ok()?;
            ((frame.width * frame.height) as u64 <= MOST_PIXELS).then_some(())?;
            let size = [frame.width as u32, frame.height as u32];
            let (_, picture) = photo_and_picture(bytes, Channel::Grey, max_side).ok()?;
            Some((size, picture))
        }
        EmbeddedPicture::Rgb { at, size } => {
            let bytes = file.bytes(at, 3 * size[0] as usize * size[1] as usize)?.to_vec();
            let image = image::RgbImage::from_raw(size[0], size[1], bytes)?;
            Some((size, super::show::reduced(&image.into(), max_side)))
        }
    }
}
