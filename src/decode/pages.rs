//! Selects the page of a TIFF file to measure: the first that is neither a reduced-resolution copy nor a mask.
//!
//! TIFF 6.0, `NewSubfileType` (254): bit 0 is a reduced-resolution version of another image of the file, bit 2 a transparency mask; the older
//! `SubfileType` (255) has 2 for a reduced one. The pictures are those of the chain of directories; a file whose first one is a
//! reduced copy with others below it (`SubIFDs`) is a RAW.

use std::borrow::Cow;

use super::bytes::Reader;
use crate::detection::Page;

/// Most directories that are looked at.
const MOST: usize = 64;

/// The picture of a TIFF file that is measured, and where its directory is; none where the file has only one.
fn chosen(file: &[u8]) -> Option<(Page, u64)> {
    let first = Reader::tiff(file)?;
    let mut all: Vec<(u64, bool)> = Vec::new();
    let mut next = first.start();
    while let Some(at) = next.filter(|at| *at != 0 && all.iter().all(|(known, _)| known != at)) {
        if all.len() >= MOST {
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

fn is_copy(reader: &Reader) -> bool {
    let entries = reader.entries();
    let value = |tag| entries.iter().find(|entry| entry.tag == tag).and_then(|entry| reader.first(entry));
    value(254).unwrap_or(0) & 0b101 != 0 || value(255) == Some(2)
}

/// Which picture of a file is measured; none for files of one picture.
pub fn page(file: &[u8]) -> Option<Page> {
    chosen(file).map(|(page, _)| page)
}

/// The file with the picture that is measured as its first.
pub fn measured_first(file: &[u8]) -> Cow<'_, [u8]> {
    match (chosen(file), Reader::tiff(file)) {
        (Some((page, at)), Some(reader)) if page.skipped > 0 => {
            let mut copy = file.to_vec();
            reader.set_start(&mut copy, at);
            Cow::Owned(copy)
        }
        _ => Cow::Borrowed(file),
    }
}
