//! A magnified photo pixel by pixel: the grid between them, and the samples as they are stored.

use crate::browser::canvas::Surface;
use crate::store::Desk;
use crate::view::components::transform::Placement;

/// Screen pixels per pixel from which the grid is drawn.
const GRID_FROM: f64 = 12.0;
/// Screen pixels per pixel from which five digits have room.
const VALUES_FROM: f64 = 40.0;

/// Draws the grid of the pixels in sight and their samples, where there is room for them.
pub fn draw_pixels(desk: Desk, surface: &Surface, placement: Placement, photo: &str) {
    if placement.scale < GRID_FROM {
        return;
    }
    let [width, height] = placement.size;
    let [left, top, right, bottom] = surface.sight(placement.affine());
    let [left, top] = [left.max(0.0).floor(), top.max(0.0).floor()];
    let [right, bottom] = [right.min(width).ceil(), bottom.min(height).ceil()];
    if left >= right || top >= bottom {
        return;
    }
    let line = |from: [f64; 2], to: [f64; 2]| {
        let ([x1, y1], [x2, y2]) = (placement.to_screen(from), placement.to_screen(to));
        surface.line(x1, y1, x2, y2);
    };
    surface.pen(&surface.token("--photo-line"), 1.0, &[]);
    for u in left as i64..=right as i64 {
        line([u as f64, top], [u as f64, bottom]);
    }
    for v in top as i64..=bottom as i64 {
        line([left, v as f64], [right, v as f64]);
    }
    if placement.scale < VALUES_FROM {
        return;
    }
    let Some(values) = desk.values(photo, [left, top, right, bottom]) else { return };
    let [first, above, columns, rows] = values.place.map(|n| n as usize);
    let texts = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).filter_map(|(row, column)| {
        let place = [(first + column) as f64 + 0.5, (above + row) as f64 + 0.5];
        let seen = place[0] > left && place[0] < right && place[1] > top && place[1] < bottom;
        let sample = values.samples.get(row * columns + column).filter(|_| seen)?;
        Some((sample.to_string(), placement.to_screen(place)))
    });
    let texts = texts.collect::<Vec<_>>();
    let (ink, outline) = (surface.token("--photo-ink"), surface.token("--photo"));
    surface.values(texts.iter().map(|(text, place)| (text.as_str(), *place)), &ink, &outline);
}
