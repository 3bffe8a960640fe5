//! The small picture that a file contains of its picture: an item that refers to it as its thumbnail (ISO/IEC 23008-12, 6.4.4).

use heifer_isobmff::{HeifFile, ItemId};

use super::colour::Matrix;
use super::{MOST_FROM_A_BYTE, assembled, sized, source, turn};
use crate::damage::check_size;
use crate::small;

/// Of the side that is asked for, at least one in so much: what is smaller shows too little.
const ENOUGH: u32 = 2;

/// Width, height and RGBA of the smallest thumbnail that shows enough, reduced to `max_side`. `None` if there is none, where it is turned
/// otherwise than the picture, or where it is damaged: the picture itself may still be sound.
pub fn thumbnail(file: &HeifFile, length: usize, max_side: u32) -> Option<([u32; 2], Vec<u8>)> {
    let orientation = turn::orientation(file, file.primary_id).ok()?;
    let mut all: Vec<(u64, ItemId)> = file
        .referencing_items(file.primary_id, b"thmb")
        .into_iter()
        .filter(|id| turn::orientation(file, *id).ok() == Some(orientation))
        .filter_map(|id| Some((sized(file, id).ok()?, id)))
        .filter(|([width, height], _)| *width.max(height) >= max_side / ENOUGH)
        .map(|([width, height], id)| (u64::from(width) * u64::from(height), id))
        .collect();
    all.sort_unstable();
    let (_, id) = *all.first()?;
    let source = source(file, id).ok()?;
    check_size(source.size, length, MOST_FROM_A_BYTE).ok()?;
    let crop = turn::crop(file, id, source.size).ok()?;
    let planes = assembled(file, &source, true).ok().filter(|planes| planes.damaged.is_empty())?;
    let matrix = Matrix::of(file, id, source.tiles[0], &planes);
    let at = |x: usize, y: usize| planes.colour(x + crop[0] as usize, y + crop[1] as usize, &matrix);
    Some(small::reduced([crop[2], crop[3]], max_side, at))
}
