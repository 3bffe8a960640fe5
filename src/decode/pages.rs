//! Selects the page of a TIFF file to measure: the first that is neither a reduced-resolution copy nor a mask.
//!
//! TIFF 6.0, `NewSubfileType` (254): bit 0 is a reduced-resolution version of another image of the file, bit 2 a transparency mask; the older
//! `SubfileType` (255) has 2 for a reduced one. Candidates are the directories of the main chain only. A file whose first directory is
//! a reduced copy with further directories below it (`SubIFDs`) is a RAW file and is handled elsewhere.

use std::borrow::Cow;

use super::bytes::TiffReader;
use crate::detection::Page;

/// Maximum number of directories that are read: damaged files can have long chains.
const MAX_DIRECTORIES: usize = 64;

/// The page of a TIFF file to measure and the offset of its directory; `None` if the file has only one page.
fn chosen(file: &[u8]) -> Option<(Page, u64)> {
    let first = TiffReader::tiff(file)?;
    let mut all: Vec<(u64, bool)> = Vec::new();
    let mut next = first.start();
    while let Some(at) = next.filter(|at| *at != 0 && all.iter().all(|(known, _)| known != at)) {
        if all.len() >= MAX_DIRECTORIES {
            break;
        }
        let reader = first.at(at);
        all.push((at, is_copy(&reader)));
        next = reader.next();
    }
    let number = all.iter().position(|(_, copy)| !copy).unwrap_or(0);
    let (at, _) = *all.get(number)?;
    (all.len() > 1).then_some((Page { number: number + 1, of: all.len(), skipped: number }, at))
}

/// Whether a directory holds a reduced-resolution copy or a mask.
fn is_copy(reader: &TiffReader) -> bool {
    let entries = reader.entries();
    let value = |tag| entries.iter().find(|entry| entry.tag == tag).and_then(|entry| reader.first(entry));
    value(254).unwrap_or(0) & 0b101 != 0 || value(255) == Some(2)
}

/// The page of a TIFF file to measure; `None` for other formats and for files of one page.
pub fn page(file: &[u8]) -> Option<Page> {
    chosen(file).map(|(page, _)| page)
}

/// The file with its first-directory offset moved to the page to measure, since decoders read the first page; unchanged if that is the
/// first page already.
pub fn measured_first(file: &[u8]) -> Cow<'_, [u8]> {
    match (chosen(file), TiffReader::tiff(file)) {
        (Some((page, at)), Some(reader)) if page.skipped > 0 => {
            let mut copy = file.to_vec();
            reader.set_start(&mut copy, at);
            Cow::Owned(copy)
        }
        _ => Cow::Borrowed(file),
    }
}
