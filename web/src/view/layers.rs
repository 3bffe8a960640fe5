//! What is drawn over photos and how bright these are shown; and the drawing of what is predicted.

use leptos::prelude::*;
use sightline::matching::PhotoPrediction;

use super::transform::Placement;
use crate::browser::canvas::Surface;
use crate::browser::event;
use crate::i18n::{Text, text};
use crate::store::{Desk, Layers};

/// Colours and dashes of epipolar lines, one for each of the first photos they come from.
const LINES: [(&str, &[f64]); 3] = [("--p-a", &[]), ("--p-b", &[8.0, 4.0]), ("--photo-ink-2", &[2.0, 4.0])];

/// Draws where the chosen point should be: its epipolar lines and the ellipse of three standard errors.
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
    if let (true, Some(place), Some([a, b, angle])) = (layers.predicted, predicted.place, predicted.ellipse(3.0)) {
        let [x, y] = placement.to_screen(place);
        surface.pen(&surface.token("--p-accent"), 2.0, &[5.0, 4.0]);
        let half = |axis: f64| (axis * placement.scale).max(6.0);
        surface.ellipse(x, y, half(a), half(b), placement.angle_on_screen(angle));
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
                <input type="checkbox" name=name prop:checked=move || desk.layers.with(get)
                    on:change=move |e| desk.layers.update(|l| set(l, event::checked(&e)))/>
                <span>{words}</span>
            </label>
        }
    };
    let slide = move |words: Text, name: &'static str, get: fn(&Layers) -> f64, set: fn(&mut Layers, f64)| {
        view! {
            <label class="slide"><span>{words}</span>
                <input type="range" name=name min="0.4" max="4" step="0.1" prop:value=move || desk.layers.with(get).to_string()
                    on:input=move |e| if let Ok(value) = event::value(&e).parse() { desk.layers.update(|l| set(l, value)) }/>
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
                {tick(text::layer_epipolar, "layer-epipolar", |l| l.epipolar, |l, on| l.epipolar = on)}
                {slide(text::brightness, "brightness", |l| l.brightness, |l, v| l.brightness = v)}
                {slide(text::picture_contrast, "contrast", |l| l.contrast, |l, v| l.contrast = v)}
                <button class="button small" type="button" on:click=move |_| desk.layers.set(Layers::default())>{text::as_it_is}</button>
            </div>
        </Show>
    }
}
