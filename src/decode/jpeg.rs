//! JPEG's luma plane as it is stored, without colour conversion and without the chroma planes, and what of it is damaged.
//!
//! ITU-T T.81: sequential and progressive coding with Huffman codes, 8 bits. Of the chroma planes only the means of blocks are
//! kept, for small pictures. General decoders give a picture without saying which of its rows they made up.

mod bits;
mod frame;
mod huffman;
mod progressive;
mod scan;
mod transform;

pub use frame::{Colours, Frame, Refusal};

use crate::error::Damage;
use frame::{Scan, Segment, Tables};
use scan::Planes;

/// A plane of one byte a sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plane8 {
    /// Samples in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row by row.
    pub samples: Vec<u8>,
}

/// What a JPEG file holds of its first plane, which is luma in most, and a hint of its colours.
pub struct Luma {
    /// The plane.
    pub plane: Plane8,
    /// Means of the blocks of blue and red difference, where there are such planes.
    pub chroma: Option<[Plane8; 2]>,
    /// Rows of pixels that could not be decoded: first row and the row after the last, in rising order.
    pub damaged: Vec<[u32; 2]>,
}

/// Reads the first plane; none where it is not of full size, or its codes are not in the file.
///
/// # Errors
/// [`Refusal`] for kinds of JPEG that are not read and for files of which no row is whole.
pub fn luma(bytes: &[u8]) -> Result<Option<Luma>, Refusal> {
    let mut tables = Tables::default();
    let mut planes: Option<Planes> = None;
    let mut at = 2;
    let mut ended = false;
    while let Some(segment) = frame::next(bytes, &mut at) {
        match segment {
            Segment::Frame(kind, payload) => {
                if planes.is_some() {
                    break;
                }
                let frame = Frame::read(kind, payload, &tables)?;
                frame.check_size(bytes.len())?;
                match Planes::new(frame) {
                    Some(new) => planes = Some(new),
                    None => return Ok(None),
                }
            }
            Segment::Scan(payload) => {
                let Some(planes) = &mut planes else { break };
                let Some(scan) = Scan::read(payload, &planes.frame) else { break };
                at = planes.scan(bytes, at, &scan, &tables);
            }
            Segment::End => {
                ended = true;
                break;
            }
            Segment::Other(marker, payload) => {
                if tables.read(marker, payload).is_none() {
                    break;
                }
            }
        }
    }
    let Some(planes) = planes else { return Err(Refusal::Broken(Damage::NoPicture)) };
    // frames of films leave the usual codes out
    if tables.direct.iter().all(Option::is_none) {
        return Ok(None);
    }
    planes.finish(ended).map(Some)
}

/// Whether the file reaches the end of its picture, for those whose first plane is not of full size.
pub fn is_complete(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(segment) = frame::next(bytes, &mut at) {
        if matches!(segment, Segment::End) {
            return true;
        }
    }
    false
}

/// What a file says of itself before its first scan.
///
/// # Errors
/// As [`luma`].
pub fn header(bytes: &[u8]) -> Result<Frame, Refusal> {
    let mut tables = Tables::default();
    let mut at = 2;
    while let Some(segment) = frame::next(bytes, &mut at) {
        match segment {
            Segment::Frame(kind, payload) => {
                let frame = Frame::read(kind, payload, &tables)?;
                frame.check_size(bytes.len())?;
                return Ok(frame);
            }
            Segment::Scan(_) | Segment::End => break,
            Segment::Other(marker, payload) => {
                let _ = tables.read(marker, payload);
            }
        }
    }
    Err(Refusal::Broken(Damage::NoPicture))
}
