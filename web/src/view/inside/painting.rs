//! Paints a matrix: its entries by size and by the kind of the unknown of their column, lines between blocks, what is chosen, and numbers where
//! there is room.

use sightline::adjust::{SparseMatrix, UnknownKind};

use super::number;
use super::picture::{Shown, Sight, Which};
use crate::browser::canvas::Surface;

/// CSS pixels that a cell needs for its number.
const NUMBER: [f64; 2] = [56.0, 16.0];
/// More blocks than these would be more lines than cells.
const MOST_LINES: usize = 80;

/// Tints by share of the column's largest entry.
const TINTS: [f64; 4] = [0.25, 0.45, 0.7, 1.0];
/// Colours of entries: of photos, of cameras, of points, and of fill-in.
const COLOURS: [&str; 4] = ["--data-a", "--data-c", "--data-b", "--ink"];
const FILL_IN: u8 = 3;

/// The place of an unknown's colour in [`COLOURS`].
fn colour_of(kind: UnknownKind) -> u8 {
    match kind {
        UnknownKind::Rotation | UnknownKind::ProjectionCentre => 0,
        UnknownKind::InteriorOrientation => 1,
        UnknownKind::Point => 2,
    }
}

/// Red, green and blue of a token such as `#0b5fa8`.
fn colour(surface: &Surface, token: &str) -> [f64; 3] {
    let text = surface.token(token);
    let digits = text.strip_prefix('#').unwrap_or_default();
    let part = |k: usize| {
        let hex = if digits.len() == 3 {
            digits.get(k..=k).map(|d| d.repeat(2))
        } else {
            digits.get(2 * k..2 * k + 2).map(str::to_owned)
        };
        hex.and_then(|hex| u8::from_str_radix(&hex, 16).ok())
    };
    std::array::from_fn(|k| f64::from(part(k).unwrap_or(128)))
}

/// Colours of a pixel by its tint: paper, then [`COLOURS`] of every strength.
fn palette(surface: &Surface) -> Vec<[u8; 4]> {
    let paper = colour(surface, "--paper");
    let inks = COLOURS.map(|token| colour(surface, token));
    let mixed = |ink: [f64; 3], share: f64| -> [u8; 4] {
        let [red, green, blue] = std::array::from_fn(|k| (paper[k] + share * (ink[k] - paper[k])) as u8);
        [red, green, blue, 255]
    };
    let of_none = inks.map(|ink| mixed(ink, 0.0));
    of_none.into_iter().chain(TINTS.into_iter().flat_map(|share| inks.map(|ink| mixed(ink, share)))).collect()
}

/// Pixels of a row or column: the first and the one after the last.
#[derive(Clone, Copy)]
struct Span(usize, usize);

/// The spans of rows or columns that are in sight, from the first of them on.
fn spans(first: f64, count: f64, all: usize, pixels: usize) -> (usize, Vec<Span>) {
    // A gap between cells where they are large enough for one.
    let gap = usize::from(pixels as f64 / count > 5.0);
    let place = |at: f64| ((at - first) / count * pixels as f64).max(0.0);
    let (from, to) = (first.floor() as usize, ((first + count).ceil() as usize).min(all));
    let span = |at: usize| {
        let low = (place(at as f64) as usize).min(pixels - 1);
        let high = place(at as f64 + 1.0).ceil() as usize;
        Span(low, high.saturating_sub(gap).clamp(low + 1, pixels))
    };
    (from, (from..to).map(span).collect())
}

/// The strongest tint of all entries that a pixel covers: of a large matrix none must get lost.
fn tints(which: Which, shown: &Shown, matrix: &SparseMatrix, sight: Sight, [width, height]: [usize; 2]) -> Vec<u8> {
    let [row0, column0, rows, columns] = sight;
    let filled = shown.factor.as_ref().map_or(&[][..], |factor| &factor.filled);
    let mut largest = vec![f64::MIN_POSITIVE; matrix.columns];
    for (column, value) in matrix.column_indices.iter().zip(&matrix.values) {
        largest[*column] = largest[*column].max(value.abs());
    }
    let colours: Vec<u8> = (0..matrix.columns)
        .map(|column| {
            shown.looked.unknowns().get(which.unknown(shown, column)).map_or(0, |unknown| colour_of(unknown.kind))
        })
        .collect();
    let (first_row, row_spans) = spans(row0, rows, matrix.rows, height);
    let (first_column, column_spans) = spans(column0, columns, matrix.columns, width);
    let mut tints = vec![0u8; width * height];
    for (row, Span(top, bottom)) in (first_row..).zip(row_spans) {
        for (k, (column, value)) in (matrix.row_starts[row]..).zip(matrix.row(row)) {
            let Some(&Span(left, right)) = column.checked_sub(first_column).and_then(|at| column_spans.get(at)) else {
                continue;
            };
            let (size, of) = (value.abs(), largest[column]);
            let strength = 1 + u8::from(size > 0.05 * of) + u8::from(size > 0.25 * of) + u8::from(size > 0.6 * of);
            let colour = if filled.get(k) == Some(&true) { FILL_IN } else { colours[column] };
            // The stronger entry of two at a pixel counts, whatever their colours.
            let tint = strength * COLOURS.len() as u8 + colour;
            for line in tints[top * width..bottom * width].chunks_exact_mut(width) {
                line[left..right].iter_mut().for_each(|pixel| *pixel = tint.max(*pixel));
            }
        }
    }
    tints
}

/// Paints the part in sight of a matrix, with the chosen row of A and the chosen unknown.
pub fn paint(surface: &Surface, which: Which, shown: &Shown, sight: Sight, chosen: (Option<usize>, Option<usize>)) {
    let Some(matrix) = which.of(shown) else { return };
    let [row0, column0, rows, columns] = sight;
    let (width, height) = ((surface.width * surface.ratio()) as usize, (surface.height * surface.ratio()) as usize);
    if width == 0 || height == 0 {
        return;
    }
    let palette = palette(surface);
    let tints = tints(which, shown, matrix, sight, [width, height]);
    let mut rgba = vec![0; 4 * tints.len()];
    for (pixel, tint) in rgba.chunks_exact_mut(4).zip(&tints) {
        pixel.copy_from_slice(&palette[usize::from(*tint)]);
    }
    surface.raster(&rgba, width as u32, height as u32);
    let x = |column: f64| (column - column0) / columns * surface.width;
    let y = |row: f64| (row - row0) / rows * surface.height;
    let blocks = shown.looked.blocks();
    if blocks.len() <= MOST_LINES {
        surface.pen(&surface.token("--line"), 1.0, &[]);
        for block in blocks {
            let Some(at) = which.column(shown, block.first).filter(|at| *at > 0) else { continue };
            surface.line(x(at as f64), 0.0, x(at as f64), surface.height);
            if which != Which::A {
                surface.line(0.0, y(at as f64), surface.width, y(at as f64));
            }
        }
    }
    surface.pen(&surface.token("--accent"), 2.0, &[]);
    let (row, column) = chosen;
    if let Some(row) = row.filter(|_| which == Which::A) {
        surface.rectangle(0.0, y(row as f64) - 1.0, surface.width, (surface.height / rows).max(2.0) + 2.0);
    }
    let column = column.and_then(|unknown| which.column(shown, unknown));
    if let Some(column) = column {
        surface.rectangle(x(column as f64) - 1.0, 0.0, (surface.width / columns).max(2.0) + 2.0, surface.height);
        if which != Which::A {
            surface.rectangle(0.0, y(column as f64) - 1.0, surface.width, (surface.height / rows).max(2.0) + 2.0);
        }
    }
    if surface.width / columns >= NUMBER[0] && surface.height / rows >= NUMBER[1] {
        let (first, last) = (row0.floor() as usize, ((row0 + rows).ceil() as usize).min(matrix.rows));
        let in_sight = (first..last).flat_map(|row| matrix.row(row).map(move |(column, value)| (row, column, value)));
        let texts: Vec<_> = in_sight
            .map(|(row, column, value)| (number(value), [x(column as f64 + 0.5), y(row as f64 + 0.5)]))
            .filter(|(_, [x, y])| *x > 0.0 && *x < surface.width && *y > 0.0 && *y < surface.height)
            .collect();
        let all = texts.iter().map(|(text, place)| (text.as_str(), *place));
        surface.values(all, &surface.token("--ink"), &surface.token("--paper"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_share_all_pixels() {
        // 100 columns on 30 pixels: each has a pixel, and none is left over.
        let (first, all) = spans(0.0, 100.0, 100, 30);
        assert_eq!((first, all.len()), (0, 100));
        assert!(all.iter().all(|Span(low, high)| low < high && *high <= 30));
        assert_eq!((all[0].0, all[99].1), (0, 30));
        // Large cells have gaps, except at the border of what is visible: the first and the last are cut there.
        let (first, all) = spans(2.5, 4.0, 8, 80);
        assert_eq!(
            (first, all.iter().map(|Span(low, high)| (*low, *high)).collect::<Vec<_>>()),
            (2, vec![(0, 9), (10, 29), (30, 49), (50, 69), (70, 80)])
        );
    }
}
