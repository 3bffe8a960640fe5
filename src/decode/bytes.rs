//! Minimal parsing of the TIFF, PNG and JPEG containers, to check a file before it is decoded.

use std::borrow::Cow;

/// Reads numbers of a TIFF file in its byte order, at one of its directories: at first the first one.
pub struct TiffReader<'a> {
    bytes: &'a [u8],
    little: bool,
    big_tiff: bool,
    directory: Option<u64>,
}

impl<'a> TiffReader<'a> {
    /// A reader of a TIFF or BigTIFF file; `None` if the header is neither.
    pub fn tiff(bytes: &'a [u8]) -> Option<Self> {
        let little = match bytes.get(..2)? {
            b"II" => true,
            b"MM" => false,
            _ => return None,
        };
        let mut reader = Self { bytes, little, big_tiff: false, directory: None };
        reader.big_tiff = reader.number(2, 2)? == 43;
        Some(reader)
    }

    /// Where the first directory is.
    pub fn start(&self) -> Option<u64> {
        if self.big_tiff { self.number(8, 8) } else { self.number(4, 4) }
    }

    /// Writes where the first directory is, in a copy of the file.
    pub fn set_start(&self, copy: &mut [u8], at: u64) {
        let (place, width) = if self.big_tiff { (8, 8) } else { (4, 4) };
        let bytes = ordered(at, width, self.little);
        if let Some(place) = copy.get_mut(place..place + width) {
            place.copy_from_slice(&bytes);
        }
    }

    /// The same file at another directory.
    pub fn at(&self, directory: u64) -> Self {
        Self { directory: Some(directory), ..*self }
    }

    /// Where the directory after this one is; 0 for none.
    pub fn next(&self) -> Option<u64> {
        let (width, count_width, size) = if self.big_tiff { (8, 8, 20) } else { (4, 2, 12) };
        let start = usize::try_from(self.directory.or_else(|| self.start())?).ok()?;
        let count = usize::try_from(self.number(start, count_width)?).ok()?;
        let end = count.checked_mul(size)?.checked_add(start)?.checked_add(count_width)?;
        self.number(end, width)
    }

    fn number(&self, offset: usize, length: usize) -> Option<u64> {
        let bytes = self.bytes.get(offset..offset.checked_add(length)?)?;
        let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        Some(if self.little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) })
    }

    /// Every entry of the directory. Stops where the file does.
    pub fn entries(&self) -> Vec<DirectoryEntry> {
        let (width, count_width, size) = if self.big_tiff { (8, 8, 20) } else { (4, 2, 12) };
        let mut entries = Vec::new();
        let inside = |n: u64| usize::try_from(n).ok().filter(|n| *n < self.bytes.len());
        let Some(start) = self.directory.or_else(|| self.start()).and_then(inside) else { return entries };
        let Some(count) = self.number(start, count_width) else { return entries };
        for index in 0..count.min(1000) as usize {
            let at = start + count_width + index * size;
            let (Some(tag), Some(kind)) = (self.number(at, 2), self.number(at + 2, 2)) else { break };
            let length = match kind {
                3 => 2,
                1 | 2 | 6 | 7 => 1,
                16..=18 => 8,
                _ => 4,
            };
            let Some(count) = self.number(at + 4, width) else { break };
            let (here, all) = (at + 4 + width, count.saturating_mul(length as u64));
            let begins = if all <= width as u64 { Some(here) } else { self.number(here, width).and_then(inside) };
            let Some(begins) = begins else { continue };
            entries.push(DirectoryEntry { tag: tag as u16, length, count, at: begins });
        }
        entries
    }

    /// First value of an entry.
    pub fn first(&self, entry: &DirectoryEntry) -> Option<u64> {
        self.number(entry.at, entry.length)
    }

    /// All values of an entry, as far as the file has them; no more than a palette has.
    pub fn values(&self, entry: &DirectoryEntry) -> Vec<u64> {
        (0..entry.count.min(3 << 8) as usize)
            .map_while(|k| self.number(entry.at + k * entry.length, entry.length))
            .collect()
    }

    /// All values of an entry, as far as the file has them.
    pub fn all(&self, entry: &DirectoryEntry) -> Vec<u64> {
        let count = entry.count.min(self.bytes.len() as u64) as usize;
        (0..count).map_while(|k| self.number(entry.at + k * entry.length, entry.length)).collect()
    }

    /// Writes a number over the first value of an entry, in a copy of the file.
    pub fn overwrite(&self, copy: &mut [u8], entry: &DirectoryEntry, value: u16) {
        if let Some(bytes) = copy.get_mut(entry.at..entry.at + entry.length) {
            for (k, byte) in bytes.iter_mut().enumerate() {
                let place = if self.little { k } else { entry.length - 1 - k };
                *byte = (u64::from(value) >> (8 * place.min(7))) as u8;
            }
        }
    }
}

/// A number in so many bytes.
fn ordered(number: u64, width: usize, little: bool) -> Vec<u8> {
    let place = |k: usize| if little { k } else { width - 1 - k };
    (0..width).map(|k| (number >> (8 * place(k).min(7))) as u8).collect()
}

/// Writes a directory of whole numbers behind a TIFF file and makes it the first one. Entries are in the order of their tags.
pub fn append_directory(file: &mut Vec<u8>, entries: &[(u16, Vec<u64>)]) {
    let Some(TiffReader { little, big_tiff, .. }) = TiffReader::tiff(file) else { return };
    let (width, count_width, kind) = if big_tiff { (8, 8, 16) } else { (4, 2, 4) };
    let start = file.len();
    let put = |to: &mut Vec<u8>, number: u64, width: usize| to.extend(ordered(number, width, little));
    let size = count_width + entries.len() * (4 + 2 * width) + width;
    let (mut directory, mut behind) = (Vec::new(), Vec::new());
    put(&mut directory, entries.len() as u64, count_width);
    for (tag, values) in entries {
        put(&mut directory, (*tag).into(), 2);
        put(&mut directory, kind, 2);
        put(&mut directory, values.len() as u64, width);
        match values[..] {
            [value] => put(&mut directory, value, width),
            _ => {
                put(&mut directory, (start + size + behind.len()) as u64, width);
                values.iter().for_each(|value| put(&mut behind, *value, width));
            }
        }
    }
    put(&mut directory, 0, width);
    file.extend(directory);
    file.extend(behind);
    let reader = TiffReader { bytes: &[], little, big_tiff, directory: None };
    reader.set_start(file, start as u64);
}

/// One entry of a TIFF directory.
#[derive(Clone, Copy, Debug)]
pub struct DirectoryEntry {
    /// What it is.
    pub tag: u16,
    /// Bytes of a value, how many there are and where they stand.
    length: usize,
    count: u64,
    at: usize,
}

/// Maximum number of bytes of samples that one byte of the file can represent, by its compression.
pub fn most_from_a_byte(file: &[u8]) -> u64 {
    // deflate: 258 bytes from two bits
    const DEFLATE: u64 = 1032;
    match file {
        [0x89, b'P', ..] => DEFLATE,
        [b'B', b'M', ..] => most_of_bmp(file),
        [b'I' | b'M', ..] => {
            let Some(reader) = TiffReader::tiff(file) else { return DEFLATE };
            let entries = reader.entries();
            let value = |tag: u16| entries.iter().find(|entry| entry.tag == tag).and_then(|entry| reader.first(entry));
            // bits and places of a palette become bytes, three where they are colours
            let wider = if value(258).unwrap_or(1) < 8 || value(262) == Some(3) { 24 } else { 1 };
            match value(259) {
                None | Some(1) => 2 * wider,
                Some(32773) => 64 * wider,
                // of twelve bits a string of 4096 bytes
                Some(5) => 2731 * wider,
                Some(8 | 32946) => DEFLATE * wider,
                // a row of white from some bits; a block of 64 pixels from two
                _ => 8192,
            }
        }
        _ => 8192,
    }
}

/// The same of a BMP file, by the bits of a pixel and the compression in its header, which is OS/2's of 12 bytes or begins as Windows' of 40.
fn most_of_bmp(file: &[u8]) -> u64 {
    let reader = TiffReader { bytes: file, little: true, big_tiff: false, directory: None };
    let (bits, compression) = match reader.number(14, 4) {
        Some(12) => (reader.number(24, 2), None),
        _ => (reader.number(28, 2), reader.number(30, 4)),
    };
    match compression {
        // runs of 255 pixels of three bytes from two bytes
        Some(1 | 2) => 384,
        // a pixel of so many bits is three bytes, or four with its opacity
        _ => 32 / bits.unwrap_or(1).clamp(1, 32),
    }
}

/// A PNG file without compressed profiles and texts.
pub fn without_texts(file: &[u8]) -> Cow<'_, [u8]> {
    let mut kept = Cow::Borrowed(file);
    let (mut at, mut copied) = (8, 0);
    while let Some(length) = file.get(at..at + 4).and_then(|n| n.try_into().ok()).map(u32::from_be_bytes) {
        let next = at.saturating_add(length as usize).saturating_add(12).min(file.len());
        if matches!(file.get(at + 4..at + 8), Some(b"iCCP" | b"zTXt" | b"iTXt")) {
            let before = &file[copied..at];
            match &mut kept {
                Cow::Owned(kept) => kept.extend(before),
                Cow::Borrowed(_) => kept = Cow::Owned(before.to_vec()),
            }
            copied = next;
        }
        at = next;
    }
    if let Cow::Owned(kept) = &mut kept {
        kept.extend(&file[copied..]);
    }
    kept
}

/// Width and height of a PNG file as its header chunk states them.
///
/// The decoder itself refuses rows that a 32-bit machine cannot address before it tells the size.
pub fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    (bytes.get(12..16)? == b"IHDR").then_some(())?;
    Some((number(16)?, number(20)?))
}
