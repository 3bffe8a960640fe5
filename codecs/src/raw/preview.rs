//! The picture that a camera embeds in its RAW.

use flashraw::{FlashRaw, PreviewEncoding, PreviewInfo};

use sightline::decode;

use crate::damage::check_size;
use crate::small;

/// Pixels that a byte of a JPEG describes at most: a block of 64 takes a bit at least.
const MOST_FROM_A_BYTE: u64 = 512;

/// The smallest embedded picture that is no smaller than wanted, else the largest, reduced.
pub fn small(raw: &FlashRaw, max_side: u32) -> Option<([u32; 2], Vec<u8>)> {
    let side = |preview: &PreviewInfo| preview.width.max(preview.height);
    let mut all: Vec<&PreviewInfo> = raw.previews().iter().filter(|preview| is_known(preview)).collect();
    all.sort_by_key(|preview| side(preview));
    let first = all.iter().position(|preview| side(preview) >= max_side).unwrap_or(all.len());
    // what does not decode leaves it to the next larger one, then to the smaller ones
    let (smaller, larger) = all.split_at(first);
    larger.iter().chain(smaller.iter().rev()).find_map(|preview| {
        if preview.encoding == PreviewEncoding::Jpeg {
            // memory is reserved for the size in the JPEG itself, not for that in the directory
            let size = decode::jpeg_size(raw.preview_bytes(preview).ok()?).ok()?;
            check_size([size.width, size.height], preview.length as usize, MOST_FROM_A_BYTE).ok()?;
        }
        let picture = raw.decode_preview_rgb(preview).ok()?;
        let [width, height] = [picture.width, picture.height].map(|side| side as usize);
        if width == 0 || height == 0 || picture.rgb.len() < 3 * width * height {
            return None;
        }
        let colour = |x: usize, y: usize| {
            let at = 3 * (y * width + x);
            [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
        };
        Some(small::reduced([picture.width, picture.height], max_side, colour))
    })
}

fn is_known(preview: &PreviewInfo) -> bool {
    matches!(preview.encoding, PreviewEncoding::Jpeg | PreviewEncoding::Rgb8)
}
