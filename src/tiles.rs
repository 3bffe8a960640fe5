//! A photo for the screen in levels, each half the one before, cut into tiles: only what is in sight is drawn, at the size it is seen.

use serde::{Deserialize, Serialize};

use crate::decode::Picture;

/// Columns and rows of a tile, without its seam.
const SIDE: u32 = 1024;
/// Columns and rows that a tile has of the next one, so that no gap shows where the two meet at a fraction of a pixel.
const SEAM: u32 = 2;

/// Sizes of a picture's levels and of their tiles.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pyramid {
    /// Columns and rows of a tile, without its seam; fewer at the right and below.
    pub side: u32,
    /// Columns and rows that a tile has of the next one, as far as there are any.
    pub seam: u32,
    /// Width and height of the levels in pixels; a pixel of level k is 2^k by 2^k pixels of the picture.
    pub levels: Vec<[u32; 2]>,
}

impl Pyramid {
    /// The tiles of a level: left, top, width and height, in pixels of the level, with their seams, row by row.
    pub fn tiles(&self, level: usize) -> Vec<[u32; 4]> {
        let Some(&[width, height]) = self.levels.get(level) else { return Vec::new() };
        let ends = self.side + self.seam;
        let place = |left: u32, top: u32| [left, top, ends.min(width - left), ends.min(height - top)];
        let corners = |size: u32| (0..size.div_ceil(self.side)).map(move |k| k * self.side);
        corners(height).flat_map(|top| corners(width).map(move |left| place(left, top))).collect()
    }
}

/// The levels of a picture down to one tile, and their tiles: level by level, row by row.
pub fn pyramid(picture: Picture) -> (Pyramid, Vec<Vec<u8>>) {
    let mut made = Pyramid { side: SIDE, seam: SEAM, levels: Vec::new() };
    let mut tiles = Vec::new();
    let mut level = picture;
    loop {
        made.levels.push([level.width, level.height]);
        tiles.extend(made.tiles(made.levels.len() - 1).into_iter().map(|place| cut(&level, place)));
        if level.width.max(level.height) <= SIDE {
            return (made, tiles);
        }
        level = half(&level);
    }
}

fn cut(picture: &Picture, [left, top, width, height]: [u32; 4]) -> Vec<u8> {
    let line = |y: u32| {
        let begin = (y as usize * picture.width as usize + left as usize) * 4;
        &picture.rgba[begin..begin + width as usize * 4]
    };
    // Of its size from the beginning: tiles that grew would take twice the memory of the picture.
    let mut tile = Vec::with_capacity(width as usize * height as usize * 4);
    for y in top..top + height {
        tile.extend_from_slice(line(y));
    }
    tile
}

/// Half as wide and high, rounded up: the mean of two by two pixels, the last column and row taken twice where they are odd.
fn half(picture: &Picture) -> Picture {
    let (width, height) = (picture.width.div_ceil(2), picture.height.div_ceil(2));
    let bytes = picture.width as usize * 4;
    let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height as usize {
        let lower = (2 * y + 1).min(picture.height as usize - 1);
        let rows = [2 * y, lower].map(|row| &picture.rgba[row * bytes..(row + 1) * bytes]);
        for x in 0..width as usize {
            let right = (2 * x + 1).min(picture.width as usize - 1);
            for channel in 0..4 {
                let sum: u16 =
                    rows.iter().flat_map(|row| [2 * x, right].map(|c| u16::from(row[4 * c + channel]))).sum();
                rgba.push(((sum + 2) / 4) as u8);
            }
        }
    }
    Picture { width, height, rgba }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn picture(width: u32, height: u32) -> Picture {
        let level = |k: u32| [(k % 251) as u8, (k % 241) as u8, (k / 7 % 256) as u8, 255];
        Picture { width, height, rgba: (0..width * height).flat_map(level).collect() }
    }

    #[test]
    fn every_tile_is_its_part_of_the_level() {
        for (width, height) in [(1, 1), (1024, 7), (1025, 1024), (2050, 1500), (3000, 2049)] {
            let whole = picture(width, height);
            let (made, tiles) = pyramid(whole.clone());
            assert_eq!(made.levels[0], [width, height]);
            assert!(made.levels.last().is_some_and(|level| level.iter().all(|side| *side <= made.side)));
            assert_eq!(tiles.len(), (0..made.levels.len()).map(|level| made.tiles(level).len()).sum::<usize>());
            assert!(tiles.iter().all(|tile| tile.capacity() == tile.len()));
            let mut covered = 0;
            for ([left, top, across, down], tile) in made.tiles(0).into_iter().zip(&tiles) {
                assert_eq!(tile.len() as u32, 4 * across * down);
                let at = |x: u32, y: u32| whole.rgba[4 * (y * width + x) as usize..][..4].to_vec();
                assert_eq!(tile[..4], at(left, top));
                assert_eq!(tile[tile.len() - 4..], at(left + across - 1, top + down - 1));
                covered += across.min(made.side) * down.min(made.side);
            }
            assert_eq!(covered, width * height);
        }
    }

    #[test]
    fn half_is_the_mean_and_odd_edges_are_kept() {
        let whole = Picture { width: 3, height: 1, rgba: vec![10, 0, 0, 255, 20, 0, 0, 255, 50, 100, 200, 255] };
        let small = half(&whole);
        assert_eq!((small.width, small.height), (2, 1));
        assert_eq!(small.rgba, [15, 0, 0, 255, 50, 100, 200, 255]);
    }
}
