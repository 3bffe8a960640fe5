//! What is drawn over photos and how bright these are shown; and the drawing of what is predicted and of residuals.

use leptos::prelude::*;
use sightline::adjustment::PhotoUnit;
use sightline::matching::{PhotoPrediction, PhotoVector};

use crate::browser::canvas::Surface;
use crate::browser::event;
use crate::document::Document;
use crate::format;
use crate::i18n::{Text, monitoring, text};
use crate::store::{Desk, Layers};
use crate::view::components::transform::Placement;

/// Colours and dashes of epipolar lines, one for each of the first photos they come from.
const LINES: [(&str, &[f64]); 3] = [("--p-a", &[]), ("--p-b", &[8.0, 4.0]), ("--photo-ink-2", &[2.0, 4.0])];

/// Draws where the chosen point should be: its epipolar lines and the ellipse of three standard errors, or a cross where these are
/// not known.
pub fn draw_prediction(surface: &Surface, placement: Placement, predicted: &PhotoPrediction, layers: Layers) {
    if layers.epipolar {
        for (line, (colour, dashes)) in predicted.lines.iter().zip(LINES.iter().cycle()) {
            surface.pen(&surface.token(colour), 1.5, dashes);
            for piece in line.course.windows(2) {
                let ([x1, y1], [x2, y2]) = (placement.to_screen(piece[0]), placement.to_screen(piece[1]));
                surface.line(x1, y1, x2, y2);
            }
        }
    }
    if let (true, Some(place)) = (layers.predicted, predicted.place) {
        let [x, y] = placement.to_screen(place);
        surface.pen(&surface.token("--p-accent"), 2.0, &[5.0, 4.0]);
        let half = |axis: f64| (axis * placement.scale).max(6.0);
        match predicted.ellipse(3.0) {
            Some([a, b, angle]) => surface.ellipse(x, y, half(a), half(b), placement.angle_on_screen(angle)),
            None => {
                surface.line(x - 8.0, y - 8.0, x + 8.0, y + 8.0);
                surface.line(x - 8.0, y + 8.0, x + 8.0, y - 8.0);
            }
        }
    }
}

/// Factors that residuals may be drawn with.
const FACTORS: [f64; 7] = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];

/// Where a measurement lies in its photo and by how much the adjustment moves it, pixels to the right and down.
pub struct Residual {
    pub at: [f64; 2],
    pub by: [f64; 2],
    /// Whether a test calls it a gross error.
    pub over: bool,
}

/// The residuals of a photo's measurements that took part in the last adjustment.
pub fn residuals_in(document: &Document, photo: &str) -> Vec<Residual> {
    let Some(result) = &document.result else { return Vec::new() };
    let (project, adjustment) = (&result.oriented, &result.adjustment);
    let camera = project.photos.iter().find(|p| p.id == photo).map(|p| &p.camera);
    let Some(camera) = project.cameras.iter().find(|c| Some(&c.id) == camera) else { return Vec::new() };
    let [px, py] = PhotoUnit::of(camera).1;
    // photo coordinates of the brown model count upwards
    let down = if camera.interior.model().in_photo_units { -1.0 } else { 1.0 };
    let pairs = project.observations.iter().zip(&adjustment.observations);
    let here = pairs.filter(|(o, r)| r.enabled && o.photo == photo && o.photo == r.photo && o.point == r.point);
    let residual = here.filter_map(|(o, r)| {
        let over = |w: Option<f64>| w.is_some_and(|w| w.abs() > adjustment.criteria.w);
        Some(Residual { at: [o.u, o.v], by: [r.vx? / px, down * r.vy? / py], over: over(r.wx) || over(r.wy) })
    });
    residual.collect()
}

/// Draws residuals as vectors from where was measured, so many times their length; what a test calls a gross error in its colour.
pub fn draw_residuals(surface: &Surface, placement: Placement, residuals: &[Residual], factor: f64) {
    for over in [false, true] {
        surface.pen(&surface.token(if over { "--p-bad" } else { "--p-b" }), 2.0, &[]);
        for residual in residuals.iter().filter(|r| r.over == over) {
            let [x, y] = placement.to_screen(residual.at);
            let [x2, y2] = placement.to_screen([0, 1].map(|k| residual.at[k] + factor * residual.by[k]));
            surface.line(x, y, x2, y2);
            draw_head(surface, [x, y], [x2, y2]);
        }
    }
}

/// The head of an arrow at a place of the screen that comes from another; none of a short one.
fn draw_head(surface: &Surface, [x, y]: [f64; 2], [x2, y2]: [f64; 2]) {
    let (length, angle) = ((x2 - x).hypot(y2 - y), (y2 - y).atan2(x2 - x));
    if length > 6.0 {
        for turn in [-2.6, 2.6] {
            surface.line(x2, y2, x2 + 6.0 * (angle + turn).cos(), y2 + 6.0 * (angle + turn).sin());
        }
    }
}

/// Draws displacements between epochs from where the targets are; those that moved in their colour, above the others.
pub fn draw_displacements(surface: &Surface, placement: Placement, vectors: &[PhotoVector]) {
    for moved in [false, true] {
        surface.pen(&surface.token(if moved { "--p-bad" } else { "--p-a" }), if moved { 2.5 } else { 1.5 }, &[]);
        for vector in vectors.iter().filter(|v| v.moved == moved) {
            let (from, to) = (placement.to_screen(vector.from), placement.to_screen(vector.to));
            surface.line(from[0], from[1], to[0], to[1]);
            draw_head(surface, from, to);
        }
    }
}

/// Draws strokes.
pub fn draw_strokes(surface: &Surface, placement: Placement, strokes: &[Stroke]) {
    if strokes.is_empty() {
        return;
    }
    surface.pen(&surface.token("--p-b"), 1.5, &[]);
    for stroke in strokes {
        let ([x1, y1], [x2, y2]) = (placement.to_screen(stroke.from), placement.to_screen(stroke.to));
        surface.line(x1, y1, x2, y2);
    }
}

/// The choice of layers, folded.
#[component]
pub fn LayerChoice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let open = RwSignal::new(false);
    let tick = move |words: Text, name: &'static str, get: fn(&Layers) -> bool, set: fn(&mut Layers, bool)| {
        view! {
            <label class="tick">
                <input type="checkbox" name=name prop:checked=move || desk.photo_view.layers.with(get)
                    on:change=move |e| desk.photo_view.layers.update(|l| set(l, event::checked(&e)))/>
                <span>{words}</span>
            </label>
        }
    };
    let slide = move |words: Text, name: &'static str, get: fn(&Layers) -> f64, set: fn(&mut Layers, f64)| {
        view! {
            <label class="slide"><span>{words}</span>
                <input type="range" name=name min="0.4" max="4" step="0.1" prop:value=move || desk.photo_view.layers.with(get).to_string()
                    on:input=move |e| if let Ok(value) = event::value(&e).parse() { desk.photo_view.layers.update(|l| set(l, value)) }/>
            </label>
        }
    };
    view! {
        <button class="stage-button words" type="button" aria-expanded=move || open.get().to_string() data-action="layers"
            on:click=move |_| open.update(|on| *on = !*on)>{text::layers}</button>
        <Show when=move || open.get()>
            <div class="layers" role="group" aria-label=text::layers>
                {tick(text::layer_ellipses, "layer-ellipses", |l| l.ellipses, |l, on| l.ellipses = on)}
                {tick(text::layer_names, "layer-names", |l| l.names, |l, on| l.names = on)}
                {tick(text::layer_predicted, "layer-predicted", |l| l.predicted, |l, on| l.predicted = on)}
                {tick(text::layer_pixels, "layer-pixels", |l| l.pixels, |l, on| l.pixels = on)}
                {tick(text::layer_epipolar, "layer-epipolar", |l| l.epipolar, |l, on| l.epipolar = on)}
                <Show when=move || desk.document.with(|d| d.result.is_some())>
                    {tick(text::layer_residuals, "layer-residuals", |l| l.residuals, |l, on| l.residuals = on)}
                    <label class="slide"><span>{move || text::times(format::fixed(desk.photo_view.layers.with(|l| l.residual_factor), 0))}</span>
                        <input type="range" name="residual-factor" aria-label=text::residual_factor min="0" max=FACTORS.len() - 1 step="1"
                            prop:value=move || FACTORS.iter().position(|f| *f == desk.photo_view.layers.with(|l| l.residual_factor)).unwrap_or(3).to_string()
                            on:input=move |e| {
                                let chosen = event::value(&e).parse::<usize>().ok().and_then(|k| FACTORS.get(k));
                                if let Some(factor) = chosen { desk.photo_view.layers.update(|l| l.residual_factor = *factor) }
                            }/>
                    </label>
                </Show>
                <Show when=move || desk.shows_displacements()>
                    <label class="tick">
                        <input type="checkbox" name="layer-displacements" prop:checked=move || desk.photo_view.layers.with(|l| l.displacements)
                            on:change=move |e| desk.photo_view.layers.update(|l| l.displacements = event::checked(&e))/>
                        <span>{move || monitoring::layer_displacements(format::count(desk.monitoring.shown_factor().round() as usize))}</span>
                    </label>
                </Show>
                {slide(text::brightness, "brightness", |l| l.brightness, |l, v| l.brightness = v)}
                {slide(text::picture_contrast, "contrast", |l| l.contrast, |l, v| l.contrast = v)}
                <button class="button small" type="button" on:click=move |_| desk.photo_view.layers.set(Layers::default())>{text::as_it_is}</button>
            </div>
        </Show>
    }
}

/// A straight stroke over the photo, in its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    pub from: [f64; 2],
    pub to: [f64; 2],
}
