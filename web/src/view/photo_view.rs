//! The photo with what was measured in it: zoom at the pointer, pan, fit, 1:1; overlay strokes keep their screen size.

mod corner;
mod drawing;
mod gestures;
mod viewport;

use std::f64::consts::TAU;

use leptos::html::Canvas;
use leptos::prelude::*;

use super::components::icon::{Glyph, Icon};
use super::layers::{LayerChoice, Stroke};
use crate::browser::canvas::{SizeWatch, Surface};
use crate::format;
use crate::i18n::{first, monitoring, text};
use crate::store::{Desk, Layers};
use corner::{CORNERS, overlay_corner};
use drawing::{draw_cross, draw_layers, draw_photo};
use gestures::Gestures;
use viewport::Viewport;

/// How a mark is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    Measured,
    Selected,
    Doubtful,
    Rejected,
    /// Reported as occluded, and not measured.
    Hidden,
}

/// Something drawn over the photo; places and sizes in its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    pub u: f64,
    pub v: f64,
    /// Full axes of the ellipse; 0 for a place without a measured shape.
    pub major: f64,
    pub minor: f64,
    pub angle: f64,
    pub label: Option<String>,
    /// Coded: its name is drawn bold.
    pub strong: bool,
    pub style: Style,
}

/// A click in the photo.
#[derive(Clone, Copy, Debug)]
pub struct Click {
    pub u: f64,
    pub v: f64,
    /// How far 12 screen pixels reach, in photo pixels: near enough to snap.
    pub reach: f64,
    /// Whether it lies on the photo and not beside it.
    pub inside: bool,
    /// The place itself is meant, and not what can be measured there.
    pub free: bool,
}

#[component]
pub fn PhotoView(
    #[prop(into)] marks: Signal<Vec<Mark>>,
    #[prop(into)] strokes: Signal<Vec<Stroke>>,
    #[prop(into)] summary: Signal<String>,
    on_click: Callback<Click>,
    /// Lies over a corner of the photo, and makes way for the pointer.
    #[prop(optional)]
    over: Option<AnyView>,
    /// A question about the photo, in a row above it.
    #[prop(optional)]
    children: Option<Children>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    desk.begin_showing();
    desk.follow_displacements();
    on_cleanup(move || desk.end_showing());
    let photo = Memo::new(move |_| desk.selection.with(|s| s.photo.clone()));
    let viewport = Viewport::new(desk, photo);
    let gestures = Gestures::new(desk, viewport, on_click);
    let chosen_at = Memo::new(move |_| {
        let place = viewport.placement.get()?;
        let chosen =
            marks.with(|all| all.iter().find(|mark| mark.style == Style::Selected).map(|mark| [mark.u, mark.v]));
        let predicted = || desk.prediction_here().filter(|p| p.inside).and_then(|p| p.place);
        chosen.or_else(predicted).map(|at| place.to_screen(at))
    });
    let seen = move || [gestures.at.get(), chosen_at.get()].into_iter().flatten().collect::<Vec<_>>();
    let corner = overlay_corner(viewport.bounds, seen);
    viewport.keep_fitted();
    viewport.follow_requests(desk, gestures.cross);

    // The picture has a canvas of its own, so that brightness and contrast leave the marks alone.
    let (below, canvas) = (NodeRef::<Canvas>::new(), NodeRef::<Canvas>::new());
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| viewport.bounds.set(size)));
    });
    let surface = move |canvas: NodeRef<Canvas>| {
        let size = viewport.bounds.get();
        desk.window.theme.track();
        let (element, placement) = (canvas.get(), viewport.placement.get());
        Some((Surface::new(&element?, size)?, placement?))
    };
    Effect::new(move |_| {
        let Some((surface, placement)) = surface(below) else { return };
        if let Some((photo, size, _)) = viewport.frame.get() {
            draw_photo(desk, &surface, &photo, size, placement);
        }
    });
    Effect::new(move |_| {
        let Some((surface, placement)) = surface(canvas) else { return };
        if let Some((photo, ..)) = viewport.frame.get() {
            marks.with(|marks| {
                strokes.with(|strokes| draw_layers(desk, &surface, placement, &photo, marks, strokes));
            });
            if let Some(at) = gestures.cross.get() {
                draw_cross(&surface, at);
            }
        }
    });

    let absent = move || {
        photo.get().filter(|id| desk.photos.files.with(|files| !files.contains_key(id))).map(|id| {
            let file = file_name(desk, &id);
            view! { <p class="stage-note">{move || text::photo_file_missing(file.clone())}</p> }
        })
    };
    view! {
        <div class="stage">
            <StageHead photo summary viewport/>
            <div class="stage-asked">
                {children.map(|children| children())}
                <Legend photo marks/>
            </div>
            <div class="stage-body">
                <canvas node_ref=below class="picture" aria-hidden="true" style:filter=move || desk.photo_view.layers.with(filter)></canvas>
                <canvas
                    node_ref=canvas
                    class="photo"
                    tabindex="0"
                    role="img"
                    aria-label=move || text::photo_view(photo.get().unwrap_or_default())
                    class:panning=gestures.space
                    class:placing=desk.measuring.placing
                    on:pointerdown=move |e| gestures.down(&e)
                    on:pointermove=move |e| gestures.moved(&e)
                    on:pointerup=move |e| gestures.up(&e)
                    // No mouse is imitated after a touch: it would take the focus from the field that asks for a name.
                    on:touchend=move |e| e.prevent_default()
                    on:pointercancel=move |e| gestures.cancel(&e)
                    on:pointerleave=move |_| gestures.leave()
                    on:wheel=move |e| gestures.wheel(&e)
                    on:keydown=move |e| gestures.key(&e, true)
                    on:keyup=move |e| gestures.key(&e, false)
                    on:blur=move |_| gestures.space.set(false)
                    on:dblclick=move |_| viewport.fit()
                ></canvas>
                {absent}
                {over.map(|over| view! { <div class="over" class:left=move || !CORNERS[corner.get()][0] class:top=move || !CORNERS[corner.get()][1]>{over}</div> })}
            </div>
        </div>
    }
}

/// Name of the photo's file.
fn file_name(desk: Desk, photo: &str) -> String {
    desk.document.with(|d| d.project.photos.iter().find(|p| p.id == photo).map(|p| p.file.clone())).unwrap_or_default()
}

/// The row above the photo: its name, what is measured in it, modes and zoom.
#[component]
fn StageHead(photo: Memo<Option<String>>, summary: Signal<String>, viewport: Viewport) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let title = move || {
        photo.get().map(|id| {
            let file = file_name(desk, &id);
            view! { <b>{id}</b> " " <b>{file}</b> }
        })
    };
    let percent = move || viewport.placement.get().map(|p| format!("{} %", format::fixed(p.scale * 100.0, 0)));
    let placing = desk.measuring.placing;
    view! {
        <div class="stage-head">
            {title}
            <span class="summary">{move || summary.get()}</span>
            <span class="gap"></span>
            <button class="stage-button words" title=text::point_by_point_how aria-pressed=move || desk.in_series().to_string() data-action="series"
                on:click=move |_| desk.switch_series()>{text::point_by_point}</button>
            <button class="stage-button words" title=text::place_freely_how aria-pressed=move || placing.get().to_string()
                on:click=move |_| placing.update(|on| *on = !*on)>{text::place_freely}</button>
            <LayerChoice/>
            <button class="stage-button" aria-label=text::fit title=text::fit on:click=move |_| viewport.fit()><Glyph icon=Icon::Fit/></button>
            <button class="stage-button one-to-one" on:click=move |_| viewport.zoom_to(1.0)>"1:1"</button>
            <span class="zoom">{percent}</span>
        </div>
    }
}

/// Meaning of the marks, displacements that are not drawn, and what a click does.
#[component]
fn Legend(photo: Memo<Option<String>>, marks: Signal<Vec<Mark>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let not_drawn = move || {
        let names = photo.get().map(|id| desk.displacements_not_drawn_in(&id)).unwrap_or_default();
        let times = format::count(desk.monitoring.shown_factor().round() as usize);
        let sentence = monitoring::not_drawn(names.join(", "), times);
        (!names.is_empty())
            .then(|| view! { <span class="warn" role="status" data-result="not-drawn">{sentence}</span> })
    };
    let placing = desk.measuring.placing;
    view! {
        <div class="legend">
            <span class="key"></span>{text::legend_measured}
            <span class="key selected"></span>{text::legend_selected}
            <span class="key doubtful"></span>{text::legend_doubtful}
            <span class="key rejected"></span>{text::legend_excluded}
            <Show when=move || marks.with(|marks| marks.iter().any(|mark| mark.style == Style::Hidden))>
                <span class="key occluded"></span>{text::reason_occluded}
            </Show>
            {not_drawn}
            <span class="gap"></span>
            <span class="how" class:mode=placing>{move || if placing.get() { first::placing_on() } else { text::click_measures() }}</span>
        </div>
    }
}

/// Brightness and contrast as a CSS filter.
fn filter(layers: &Layers) -> String {
    format!("brightness({}) contrast({})", layers.brightness, layers.contrast)
}

/// The angle of an ellipse between 0 and 180 degrees.
pub fn half_turn_degrees(angle: f64) -> f64 {
    angle.rem_euclid(TAU / 2.0).to_degrees()
}
