//! Transformations of the picture that a file requires before it is shown: crop, rotation, mirror.

use heifer_isobmff::boxes::Property;
use heifer_isobmff::{HeifFile, ItemId};

use sightline::error::{Damage, Result};

use super::property;
use crate::damage::{broken, engine_error};

/// Left, top, width and height of the clean aperture (ISO/IEC 14496-12, 12.1.4); the whole picture where there is none.
pub fn crop(file: &HeifFile, id: ItemId, size: [u32; 2]) -> Result<[u32; 4]> {
    let clap = |property: &Property| match property {
        Property::CleanAperture { width, height, horiz_offset, vert_offset } => {
            Some([(*width, *horiz_offset), (*height, *vert_offset)])
        }
        _ => None,
    };
    let Some(sides) = property(file, id, clap)? else { return Ok([0, 0, size[0], size[1]]) };
    let mut crop = [0; 4];
    for (axis, ((count, of), (offset, offset_of))) in sides.into_iter().enumerate() {
        if of == 0 || offset_of == 0 {
            return Err(broken(Damage::Header));
        }
        let count = f64::from(count) / f64::from(of);
        let middle = f64::from(offset) / f64::from(offset_of) + (f64::from(size[axis]) - 1.0) / 2.0;
        let first = (middle - (count - 1.0) / 2.0).round().max(0.0) as u32;
        let count = count.round() as u32;
        if count == 0 || first.checked_add(count).is_none_or(|end| end > size[axis]) {
            return Err(broken(Damage::Header));
        }
        (crop[axis], crop[axis + 2]) = (first, count);
    }
    Ok(crop)
}

/// Rows of the whole picture as rows of the crop.
pub fn cut([first, last]: [u32; 2], [_, top, _, height]: [u32; 4]) -> Option<[u32; 2]> {
    let rows = [first, last].map(|row| row.saturating_sub(top).min(height));
    (rows[0] < rows[1]).then_some(rows)
}

/// A turn or a mirror: where the axes of the stored grid (right, down) point when shown.
type Turn = [[i8; 2]; 2];

/// EXIF's orientations 1 to 8.
const TURNS: [Turn; 8] = [
    [[1, 0], [0, 1]],
    [[-1, 0], [0, 1]],
    [[-1, 0], [0, -1]],
    [[1, 0], [0, -1]],
    [[0, 1], [1, 0]],
    [[0, -1], [1, 0]],
    [[0, -1], [-1, 0]],
    [[0, 1], [-1, 0]],
];
/// A quarter turn to the left.
const LEFT: Turn = TURNS[7];

/// The EXIF orientation that is equivalent to the rotations and mirrors of an item, in their order.
pub fn orientation(file: &HeifFile, id: ItemId) -> Result<u8> {
    let mut turn = TURNS[0];
    for property in file.item_properties(id).map_err(|error| engine_error(&error))? {
        match property {
            Property::Rotation(quarters) => (0..*quarters).for_each(|_| turn = after(LEFT, turn)),
            // from top to bottom, or from left to right
            Property::Mirror(true) => turn = after(TURNS[3], turn),
            Property::Mirror(false) => turn = after(TURNS[1], turn),
            _ => {}
        }
    }
    Ok(TURNS.iter().position(|known| *known == turn).map_or(1, |at| at as u8 + 1))
}

/// One turn after another.
fn after(next: Turn, first: Turn) -> Turn {
    std::array::from_fn(|i| std::array::from_fn(|j| next[i][0] * first[0][j] + next[i][1] * first[1][j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_follow_each_other() {
        let half = after(LEFT, LEFT);
        assert_eq!(half, TURNS[2]);
        assert_eq!(after(LEFT, half), TURNS[5]);
        assert_eq!(after(half, half), TURNS[0]);
        assert_eq!(after(TURNS[1], LEFT), TURNS[6]);
    }

    #[test]
    fn rows_are_cut_to_the_crop() {
        assert_eq!(cut([0, 10], [0, 4, 8, 3]), Some([0, 3]));
        assert_eq!(cut([0, 4], [0, 4, 8, 3]), None);
        assert_eq!(cut([5, 6], [0, 4, 8, 3]), Some([1, 2]));
    }
}
