//! Lens corrections according to maker notes.
//!
//! A note is a TIFF directory in its maker's own way: with a head before it or none, its places counted from the EXIF block or from the
//! note, in the block's byte order or its own. Only settings whose tag and values are publicly known (the tables of ExifTool) are read,
//! and only these notes are reported; phones correct distortion without a note in the file. Entries that do not fit are skipped.
//!
//! | maker | tags |
//! | --- | --- |
//! | Canon | 0x4016, numbers 5 (vignetting), 6 (lateral colour), 7 (distortion); 0x4018, numbers 1 (vignetting), 10 (lens optimiser) |
//! | Fujifilm | 0x1045 (lens modulation optimiser) |
//! | Nikon | 0x002a (vignetting), 0x002b, byte 4 (distortion) |
//! | Olympus, OM | 0x2020: 0x050b (distortion), 0x050c (vignetting); 0x2040: 0x1011 (distortion), 0x1012 (vignetting) |
//! | Panasonic | 0x008a (vignetting) |
//! | Pentax, Ricoh | 0x007d, bytes 0 (distortion), 1 (lateral colour), 2 (vignetting), 3 (diffraction) |
//! | Sony | 0x2011 (vignetting), 0x2012 (lateral colour), 0x2013 (distortion) |

use serde::{Deserialize, Serialize};

/// The quantity that is corrected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aberration {
    /// Straight lines are bent: corrected, places in the photo move.
    Distortion,
    /// Colours are imaged to different sizes: corrected, places move in red and blue.
    LateralColour,
    /// Corners are darker.
    Vignetting,
    /// Small apertures blur.
    Diffraction,
}

/// How a correction is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting {
    /// It is not made.
    Off,
    /// It is made.
    On,
    /// It is applied if the camera knows the lens.
    Auto,
}

/// A correction of the lens that a maker's note lists.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LensCorrection {
    /// Of what.
    pub aberration: Aberration,
    /// Whether the camera makes it in the pictures that it develops.
    pub setting: Setting,
    /// The tag that states it, as "Sony 0x2013".
    pub tag: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Maker {
    Canon,
    Fujifilm,
    Nikon,
    Olympus,
    Panasonic,
    Pentax,
    Sony,
}

impl Maker {
    fn name(self) -> &'static str {
        match self {
            Self::Canon => "Canon",
            Self::Fujifilm => "Fujifilm",
            Self::Nikon => "Nikon",
            Self::Olympus => "Olympus",
            Self::Panasonic => "Panasonic",
            Self::Pentax => "Pentax",
            Self::Sony => "Sony",
        }
    }
}

/// The corrections that the note at place `at` of an EXIF block lists, in the order of their tags; `little` is the block's byte order
/// and `make` its maker.
pub fn corrections(block: &[u8], at: usize, little: bool, make: &str) -> Vec<LensCorrection> {
    let Some((maker, note, directory)) = opened(block, at, little, make) else { return Vec::new() };
    let mut all = Vec::new();
    for entry in note.entries(directory) {
        for (aberration, setting) in corrections_of_entry(maker, &note, &entry) {
            all.push(LensCorrection { aberration, setting, tag: format!("{} {:#06x}", maker.name(), entry.tag) });
        }
        if maker == Maker::Olympus && [0x2020, 0x2040].contains(&entry.tag) {
            // a place, or the directory itself
            let below = if [4, 13].contains(&entry.kind) && entry.count == 1 {
                note.long(entry.place).and_then(|to| note.base.checked_add(to as usize))
            } else {
                Some(entry.place)
            };
            for own in below.map(|place| note.entries(place)).unwrap_or_default() {
                let aberration = match (entry.tag, own.tag) {
                    (0x2020, 0x050b) | (0x2040, 0x1011) => Aberration::Distortion,
                    (0x2020, 0x050c) | (0x2040, 0x1012) => Aberration::Vignetting,
                    _ => continue,
                };
                if let Some(setting) = switch(note.number(&own, 0)) {
                    all.push(LensCorrection { aberration, setting, tag: format!("Olympus {:#06x}", own.tag) });
                }
            }
        }
    }
    all
}

/// Content of one entry.
fn corrections_of_entry(maker: Maker, note: &NoteBlock, entry: &MakerEntry) -> Vec<(Aberration, Setting)> {
    use Aberration::{Diffraction, Distortion, LateralColour, Vignetting};
    let number = |k: usize| note.number(entry, k);
    let each = |list: &[(Aberration, Option<Setting>)]| {
        list.iter().filter_map(|(aberration, setting)| Some((*aberration, (*setting)?))).collect()
    };
    let auto = |value: Option<u32>| match value? {
        0 => Some(Setting::Off),
        2 => Some(Setting::Auto),
        // where the camera has no such setting
        _ => None,
    };
    match (maker, entry.tag) {
        (Maker::Canon, 0x4016) => each(&[
            (Vignetting, switch(number(5))),
            (LateralColour, switch(number(6))),
            (Distortion, switch(number(7))),
        ]),
        (Maker::Canon, 0x4018) => each(&[
            (Vignetting, switch(number(1))),
            (Diffraction, switch(number(10).map(|value| if value == 2 { 1 } else { value }))),
        ]),
        (Maker::Fujifilm, 0x1045) => each(&[(Diffraction, switch(number(0)))]),
        (Maker::Nikon, 0x002a) => {
            // low, normal, high
            each(&[(Vignetting, switch(number(0).map(|value| if [1, 3, 5].contains(&value) { 1 } else { value })))])
        }
        (Maker::Nikon, 0x002b) => {
            // after four letters of a version; 2 is another way of making it, under water
            each(&[(Distortion, switch(number(4).map(|value| if value == 2 { 1 } else { value })))])
        }
        (Maker::Panasonic, 0x008a) => each(&[(Vignetting, switch(number(0)))]),
        (Maker::Pentax, 0x007d) => each(&[
            (Distortion, switch(number(0))),
            (LateralColour, switch(number(1))),
            (Vignetting, switch(number(2))),
            (Diffraction, switch(number(3).map(|value| if value == 16 { 1 } else { 2 * value }))),
        ]),
        (Maker::Sony, 0x2011) => each(&[(Vignetting, auto(number(0)))]),
        (Maker::Sony, 0x2012) => each(&[(LateralColour, auto(number(0)))]),
        (Maker::Sony, 0x2013) => each(&[(Distortion, auto(number(0)))]),
        _ => Vec::new(),
    }
}

/// 0 and 1; other values are not known.
fn switch(value: Option<u32>) -> Option<Setting> {
    match value? {
        0 => Some(Setting::Off),
        1 => Some(Setting::On),
        _ => None,
    }
}

/// Whose note it is, how its places are counted and where its directory begins.
fn opened<'a>(block: &'a [u8], at: usize, little: bool, make: &str) -> Option<(Maker, NoteBlock<'a>, usize)> {
    let head = block.get(at..)?;
    let begins = |text: &[u8]| head.starts_with(text);
    let make = make.to_uppercase();
    let note = |little: bool, base: usize| NoteBlock { block, base, little };
    let order = |place: usize| match block.get(at + place..at + place + 2)? {
        b"II" => Some(true),
        b"MM" => Some(false),
        _ => None,
    };
    Some(if begins(b"Nikon\0\x02") {
        let note = note(order(10)?, at + 10);
        let directory = note.base.checked_add(note.long(at + 14)? as usize)?;
        (Maker::Nikon, note, directory)
    } else if begins(b"FUJIFILM") {
        let note = note(true, at);
        let directory = at.checked_add(note.long(at + 8)? as usize)?;
        (Maker::Fujifilm, note, directory)
    } else if begins(b"OLYMPUS\0") {
        (Maker::Olympus, note(order(8)?, at), at + 12)
    } else if begins(b"OM SYSTEM\0") {
        (Maker::Olympus, note(order(12)?, at), at + 16)
    } else if begins(b"OLYMP\0") {
        (Maker::Olympus, note(little, 0), at + 8)
    } else if begins(b"Panasonic\0") {
        (Maker::Panasonic, note(little, 0), at + 12)
    } else if begins(b"PENTAX \0") {
        (Maker::Pentax, note(order(8)?, at), at + 10)
    } else if begins(b"AOC\0") {
        (Maker::Pentax, note(order(4).unwrap_or(little), 0), at + 6)
    } else if begins(b"SONY DSC ") || begins(b"SONY CAM ") {
        (Maker::Sony, note(little, 0), at + 12)
    } else if make.starts_with("SONY") {
        (Maker::Sony, note(little, 0), at)
    } else if make.starts_with("CANON") {
        (Maker::Canon, note(little, 0), at)
    } else {
        return None;
    })
}

/// A maker note with its byte order and the origin of its offsets.
struct NoteBlock<'a> {
    block: &'a [u8],
    base: usize,
    little: bool,
}

/// One entry of a directory.
struct MakerEntry {
    tag: u16,
    kind: u16,
    count: usize,
    /// Of its first value.
    place: usize,
}

impl MakerEntry {
    /// Bytes of a value.
    fn width(&self) -> usize {
        match self.kind {
            3 | 8 => 2,
            4 | 9 | 11 | 13 => 4,
            5 | 10 | 12 => 8,
            _ => 1,
        }
    }
}

impl NoteBlock<'_> {
    fn bytes(&self, place: usize, width: usize) -> Option<u32> {
        let bytes = self.block.get(place..place.checked_add(width)?)?;
        let add = |sum: u32, byte: &u8| sum << 8 | u32::from(*byte);
        Some(if self.little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) })
    }

    fn long(&self, place: usize) -> Option<u32> {
        self.bytes(place, 4)
    }

    /// The entries of the directory at a place, those alone whose values are in the block.
    fn entries(&self, place: usize) -> Vec<MakerEntry> {
        let count = self.bytes(place, 2).unwrap_or(0).min(1000) as usize;
        let entry = |k: usize| {
            let at = place + 2 + 12 * k;
            let (tag, kind) = (self.bytes(at, 2)? as u16, self.bytes(at + 2, 2)? as u16);
            let mut entry = MakerEntry { tag, kind, count: self.long(at + 4)? as usize, place: at + 8 };
            let size = entry.width().checked_mul(entry.count)?;
            if size > 4 {
                entry.place = self.base.checked_add(self.long(at + 8)? as usize)?;
            }
            (entry.place.checked_add(size)? <= self.block.len()).then_some(entry)
        };
        (0..count).filter_map(entry).collect()
    }

    /// A whole number of an entry.
    fn number(&self, entry: &MakerEntry, k: usize) -> Option<u32> {
        let width = entry.width();
        (k < entry.count && width <= 4).then(|| self.bytes(entry.place + k * width, width)).flatten()
    }
}

#[cfg(test)]
#[path = "makers/tests.rs"]
mod tests;
