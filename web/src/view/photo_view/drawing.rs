//! Drawing of the photo, its marks, and the layers over it.

use super::{Mark, Style};
use crate::browser::canvas::{Surface, TEXT_SIZE};
use crate::store::{Desk, Layers};
use crate::view::components::transform::Placement;
use crate::view::layers::{Stroke, draw_displacements, draw_prediction, draw_residuals, draw_strokes, residuals_in};
use crate::view::pixels::draw_pixels;
use leptos::prelude::*;

/// Draws all layers over a photo that are switched on.
pub fn draw_layers(
    desk: Desk,
    surface: &Surface,
    placement: Placement,
    photo: &str,
    marks: &[Mark],
    strokes: &[Stroke],
) {
    let layers = desk.photo_view.layers.get();
    if layers.pixels {
        draw_pixels(desk, surface, placement, photo);
    }
    if let Some(predicted) = desk.prediction_here() {
        draw_prediction(surface, placement, &predicted, layers);
    }
    draw_marks(surface, placement, marks, layers);
    draw_strokes(surface, placement, strokes);
    if layers.residuals {
        let residuals = desk.document.with(|document| residuals_in(document, photo));
        draw_residuals(surface, placement, &residuals, layers.residual_factor);
    }
    if layers.displacements {
        draw_displacements(surface, placement, &desk.displacements_in(photo));
    }
}

/// Draws the cross that the arrow keys move, at a place on the screen.
pub fn draw_cross(surface: &Surface, [x, y]: [f64; 2]) {
    surface.pen(&surface.token("--p-accent"), 1.0, &[]);
    for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        surface.line(x + 4.0 * dx, y + 4.0 * dy, x + 24.0 * dx, y + 24.0 * dy);
    }
}

/// Draws the photo itself: decoded, as its preview until then, or as a frame if its file is missing.
pub fn draw_photo(desk: Desk, surface: &Surface, photo: &str, [w, h]: [f64; 2], placement: Placement) {
    let map = placement.affine();
    if let Some(picture) = desk.picture(photo) {
        // The picture of a RAW photo is reduced.
        let [width, height] = picture.size();
        let [a, b, c, d, e, f] = map;
        let (sx, sy) = (w / width, h / height);
        surface.pyramid(&picture, [a * sx, b * sx, c * sy, d * sy, e, f], placement.scale >= 2.0);
    } else if let Some(small) = desk.photos.files.with(|files| files.get(photo).map(|f| f.small.clone())) {
        let (sx, sy) = (w / f64::from(small.width), h / f64::from(small.height));
        let [a, b, c, d, e, f] = map;
        surface.picture(&small, [a * sx, b * sx, c * sy, d * sy, e, f], false);
    } else {
        let ([x1, y1], [x2, y2]) = (placement.to_screen([0.0, 0.0]), placement.to_screen([w, h]));
        surface.pen(&surface.token("--photo-edge"), 1.0, &[]);
        surface.rectangle(x1.min(x2), y1.min(y2), (x2 - x1).abs(), (y2 - y1).abs());
    }
}

/// Draws marks with their names.
fn draw_marks(surface: &Surface, placement: Placement, marks: &[Mark], layers: Layers) {
    let pen = |style: Style| match style {
        Style::Measured => surface.pen(&surface.token("--p-a"), 1.25, &[]),
        Style::Selected => surface.pen(&surface.token("--p-accent"), 2.0, &[]),
        Style::Doubtful => surface.pen(&surface.token("--p-warn"), 2.0, &[]),
        Style::Rejected => surface.pen(&surface.token("--p-bad"), 1.5, &[3.0, 2.0]),
        Style::Hidden => surface.pen(&surface.token("--p-warn"), 1.25, &[3.0, 3.0]),
    };
    let visible = |x: f64, y: f64| x > -50.0 && y > -50.0 && x < surface.width + 50.0 && y < surface.height + 50.0;
    let on_screen = |mark: &&Mark| {
        let [x, y] = placement.to_screen([mark.u, mark.v]);
        visible(x, y)
    };
    let shown = marks.iter().filter(on_screen).collect::<Vec<_>>();
    for style in [Style::Hidden, Style::Measured, Style::Rejected, Style::Doubtful, Style::Selected] {
        pen(style);
        let drawn = layers.ellipses || style == Style::Selected;
        for mark in shown.iter().filter(|m| drawn && m.style == style) {
            let [x, y] = placement.to_screen([mark.u, mark.v]);
            let half = |axis: f64| (axis / 2.0 * placement.scale).max(3.0);
            surface.ellipse(x, y, half(mark.major), half(mark.minor), placement.angle_on_screen(mark.angle));
            if mark.major == 0.0 || style == Style::Selected {
                let r = half(mark.major) + 4.0;
                for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                    surface.line(x + dx * r, y + dy * r, x + dx * (r + 12.0), y + dy * (r + 12.0));
                }
            }
            if style == Style::Rejected {
                let r = half(mark.major) + 2.0;
                surface.line(x - r, y - r, x + r, y + r);
                surface.line(x - r, y + r, x + r, y - r);
            }
        }
    }
    if layers.names {
        draw_labels(surface, placement, &shown);
    }
}

/// Names below their targets where there is room; bold for coded ones, a chip for the selected one.
fn draw_labels(surface: &Surface, placement: Placement, marks: &[&Mark]) {
    let mut taken: Vec<[f64; 4]> = Vec::new();
    let (ink, quiet, outline) =
        (surface.token("--photo-ink"), surface.token("--photo-ink-2"), surface.token("--photo"));
    let order = |m: &&&Mark| match m.style {
        Style::Selected => 0,
        Style::Doubtful | Style::Rejected => 1,
        Style::Measured | Style::Hidden => 2 + usize::from(!m.strong),
    };
    let mut sorted = marks.iter().filter(|m| m.label.is_some()).collect::<Vec<_>>();
    sorted.sort_by_key(order);
    for mark in sorted {
        let Some(label) = &mark.label else { continue };
        let [x, y] = placement.to_screen([mark.u, mark.v]);
        let drop = (mark.major / 2.0 * placement.scale).max(3.0);
        let width = label.chars().count() as f64 * 7.0;
        let selected = mark.style == Style::Selected;
        let (left, base) =
            if selected { (x + drop + 8.0, y - drop - 8.0) } else { (x - width / 2.0, y + drop + TEXT_SIZE + 1.0) };
        let field = [left - 2.0, base - TEXT_SIZE, left + width + 2.0, base + 3.0];
        let collides = |t: &[f64; 4]| field[0] < t[2] && field[2] > t[0] && field[1] < t[3] && field[3] > t[1];
        if !selected && taken.iter().any(collides) {
            continue;
        }
        taken.push(field);
        let at = [left, base];
        match mark.style {
            Style::Selected => surface.chip(label, at, &surface.token("--p-accent"), "#06262a"),
            Style::Doubtful => surface.label(label, at, true, &surface.token("--p-warn"), &outline),
            Style::Rejected => surface.label(label, at, false, &surface.token("--p-bad"), &outline),
            Style::Measured | Style::Hidden => {
                let colour = if mark.strong { &ink } else { &quiet };
                surface.label(label, at, mark.strong, colour, &outline);
            }
        }
    }
}
