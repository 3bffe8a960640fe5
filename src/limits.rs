//! Limits of input: claims of a file are checked against these before memory is allocated.
//!
//! WebAssembly has 4 GB for everything, and a worker holds a file beside what is made from it.

/// Largest picture worked on: 250 million pixels, more than any camera or film scanner of today delivers.
pub const PIXELS: u64 = 250_000_000;

/// Largest buffer a decoder may ask for, in bytes.
pub const DECODED: u64 = 1 << 31;

/// Maximum number of bytes that a document may have when unpacked.
pub const DOCUMENT: u64 = 512 << 20;

/// Maximum number of bytes that a document may take when read: about two million observations with their statistics.
pub const PARSED: u64 = 1 << 30;

/// Maximum number of bytes that all photos of a project file may have.
pub const PHOTOS: u64 = 2 << 30;

/// Maximum number of entries of a project file.
pub const ENTRIES: usize = 20_000;

/// Photos are compressed already: those of a project file unpack to no more than so many times the file, and this much.
pub const PHOTOS_RATIO: u64 = 20;
/// See [`PHOTOS_RATIO`].
pub const PHOTOS_FREE: u64 = 64 << 20;

/// Maximum number of targets on a form of a plan: the page draws each of them in every view.
pub const TARGETS: usize = 10_000;

/// Maximum number of targets times stations of a plan.
pub const RAYS: usize = 1_000_000;

/// Maximum number of sheets of targets that are made at once.
pub const SHEETS: usize = 2000;

/// Maximum number of targets that are printed at once, more than any family has codes: each takes some three kilobytes with its marks and its label.
pub const PRINTED: usize = 30_000;

/// Maximum number of bytes of equipment: some hundred thousand calibrations.
pub const EQUIPMENT_BYTES: usize = 64 << 20;

/// Bytes that a document takes when read, at most: every object and list as large as the largest kind of entry with the room that
/// lists grow into, every further value as a number, and all text.
///
/// Brackets and commas are counted as they stand; those in text make the figure larger.
pub fn parsed(document: &[u8]) -> u64 {
    const ENTRY: u64 = 320;
    const VALUE: u64 = 24;
    let count = |byte: &u8| match byte {
        b'{' | b'[' => ENTRY,
        b',' => VALUE,
        _ => 0,
    };
    document.len() as u64 + document.iter().map(count).sum::<u64>()
}
