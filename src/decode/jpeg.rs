//! The luma plane of a JPEG as stored, without colour conversion and without the chroma planes, and its damaged rows.
//!
//! ITU-T T.81: sequential and progressive coding with Huffman codes, 8 bits. Of the chroma planes only the means of blocks are
//! kept, for small pictures. General decoders give a picture without saying which of its rows they made up.

mod bits;
mod frame;
mod huffman;
mod progressive;
mod scan;
mod transform;
mod usual;

pub use frame::{Colours, FrameHeader, Refusal};

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

/// Contents of a JPEG file: the first plane, usually luma, and whether it has colours.
pub struct Luma {
    /// The plane.
    pub plane: Plane8,
    /// Means of the blocks of blue and red difference, where there are such planes.
    pub chroma: Option<[Plane8; 2]>,
    /// Rows of pixels that could not be decoded: first row and the row after the last, in rising order.
    pub damaged: Vec<[u32; 2]>,
}

/// Reads the first plane, which has to be of full size ([`FrameHeader::has_full_luma`]).
///
/// # Errors
/// [`Refusal`] for kinds of JPEG that are not read and for files of which no row is whole.
pub fn luma(bytes: &[u8]) -> Result<Luma, Refusal> {
    Ok(read(bytes, false)?.0)
}

/// First row of pixels of which any plane could not be decoded; `None` if all are whole.
///
/// General decoders lose their place at damage: what they give below it, and in the scans after it, is not sure.
///
/// # Errors
/// As [`luma`]; [`Refusal::Broken`] where damage is in a file of several scans.
pub fn damaged_from(bytes: &[u8]) -> Result<Option<u32>, Refusal> {
    let (luma, scans) = read(bytes, true)?;
    match luma.damaged.first() {
        Some(_) if scans > 1 => Err(Refusal::Broken(Damage::NoWholeRow)),
        first => Ok(first.map(|rows| rows[0])),
    }
}

/// Goes through a file, for its first plane or for the damage of all; with the number of scans.
fn read(bytes: &[u8], all: bool) -> Result<(Luma, usize), Refusal> {
    let mut tables = Tables::default();
    let mut planes: Option<Planes> = None;
    let mut at = 2;
    let mut ended = false;
    let (mut data, mut scans) = (bytes.len(), 0);
    while let Some(segment) = frame::next(bytes, &mut at) {
        match segment {
            Segment::Frame(kind, payload) => {
                if planes.is_some() {
                    break;
                }
                let frame = FrameHeader::read(kind, payload, &tables)?;
                frame.check_size(bytes.len())?;
                planes = Some(Planes::new(frame, all));
            }
            Segment::Scan(payload) => {
                let Some(planes) = &mut planes else { break };
                let Some(scan) = Scan::read(payload, &planes.frame) else { break };
                scans += 1;
                data = data.min(at);
                // frames of films leave the usual codes out
                if tables.direct.iter().chain(&tables.alternating).all(Option::is_none) {
                    let _ = tables.read(0xc4, &usual::segment());
                }
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
    Ok((planes.ok_or(Refusal::Broken(Damage::NoPicture))?.finish(ended, &bytes[data..])?, scans))
}

/// Headers of a file before its first scan.
///
/// # Errors
/// As [`luma`].
pub fn header(bytes: &[u8]) -> Result<FrameHeader, Refusal> {
    let mut tables = Tables::default();
    let mut at = 2;
    while let Some(segment) = frame::next(bytes, &mut at) {
        match segment {
            Segment::Frame(kind, payload) => {
                let frame = FrameHeader::read(kind, payload, &tables)?;
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
