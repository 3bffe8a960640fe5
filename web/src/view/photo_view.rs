//! The photo with what was measured in it: zoom at the pointer, pan, fit, 1:1; overlay strokes keep their screen size.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use leptos::html::Canvas;
use leptos::prelude::*;

use super::icon::{Glyph, Icon};
use super::keys;
use super::layers::{LayerChoice, draw_displacements, draw_prediction, draw_residuals, draw_strokes, residuals_in};
use super::pixels::draw_pixels;
use super::transform::Placement;
use crate::browser::canvas::{SizeWatch, Surface, TEXT_SIZE};
use crate::browser::event::{self, Key, Pointer};
use crate::format;
use crate::i18n::{first, text};
use crate::store::{Desk, Layers, ViewVerb};

/// How a mark is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    Measured,
    Selected,
    Doubtful,
    Rejected,
    /// Said to be hidden, and not measured: thin, for little can be done with it, but seen on paper and on ink.
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

/// A straight stroke over the photo, in its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    pub from: [f64; 2],
    pub to: [f64; 2],
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

/// Width and height of what may lie over a corner of the photo, with room around it.
const OVER: [f64; 2] = [230.0, 260.0];
/// Corners that it may lie in: whether on the right, whether at the bottom; the ones before are taken first.
const CORNERS: [[bool; 2]; 4] = [[true, true], [false, true], [true, false], [false, false]];

/// The corner for what lies over the photo: the present one as long as it covers no place that has to be seen, else the first that
/// covers none, else the one farthest from them.
fn free_corner(now: usize, [w, h]: [f64; 2], seen: &[[f64; 2]]) -> usize {
    let covers = |corner: usize| {
        let [right, bottom] = CORNERS[corner];
        let across = |x: f64| if right { x > w - OVER[0] } else { x < OVER[0] };
        let along = |y: f64| if bottom { y > h - OVER[1] } else { y < OVER[1] };
        seen.iter().filter(|[x, y]| across(*x) && along(*y)).count()
    };
    let others = (0..CORNERS.len()).filter(|corner| *corner != now);
    // The first of those that cover least.
    std::iter::once(now).chain(others).min_by_key(|corner| covers(*corner)).unwrap_or(now)
}

#[component]
pub fn PhotoView(
    #[prop(into)] marks: Signal<Vec<Mark>>,
    #[prop(into)] strokes: Signal<Vec<Stroke>>,
    #[prop(into)] summary: Signal<String>,
    on_click: Callback<Click>,
    /// What lies over a corner of the photo, and gives way to the pointer.
    #[prop(optional)]
    over: Option<AnyView>,
    /// What is asked about the photo: it has a row above it.
    #[prop(optional)]
    children: Option<Children>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    desk.begin_showing();
    desk.follow_displacements();
    on_cleanup(move || desk.end_showing());
    let canvas = NodeRef::<Canvas>::new();
    // The picture has a canvas of its own, so that brightness and contrast leave the marks alone.
    let below = NodeRef::<Canvas>::new();
    let bounds = RwSignal::new([0.0_f64; 2]);
    let placement = RwSignal::new(None::<Placement>);
    let fitted = StoredValue::new(None::<Placement>);
    let cross = RwSignal::new(None::<[f64; 2]>);
    // What lies over a corner goes to another one before the pointer is there, and never covers what is chosen.
    let corner = RwSignal::new(0_usize);
    let pointer_at = RwSignal::new(None::<[f64; 2]>);
    let chosen_at = Memo::new(move |_| {
        let place = placement.get()?;
        let chosen =
            marks.with(|all| all.iter().find(|mark| mark.style == Style::Selected).map(|mark| [mark.u, mark.v]));
        let looked_for = || desk.prediction_here().filter(|p| p.inside).and_then(|p| p.place);
        chosen.or_else(looked_for).map(|at| place.to_screen(at))
    });
    Effect::new(move |_| {
        let seen = [pointer_at.get(), chosen_at.get()].into_iter().flatten().collect::<Vec<_>>();
        let now = corner.get_untracked();
        let free = free_corner(now, bounds.get(), &seen);
        if free != now {
            corner.set(free);
        }
    });
    let give_way = move |at: [f64; 2]| pointer_at.set(Some(at));
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| bounds.set(size)));
    });
    let photo = Memo::new(move |_| desk.selection.with(|s| s.photo.clone()));
    // Size and orientation: from the file, or from the camera where the file is not here.
    let frame = Memo::new(move |_| {
        let photo = photo.get()?;
        let file = desk.files.with(|f| f.get(&photo).map(|f| (f.size, f.info.orientation)));
        let camera = || {
            desk.document.with(|d| {
                let camera = &d.project.photos.iter().find(|p| p.id == photo)?.camera;
                d.project.cameras.iter().find(|c| c.id == *camera).map(|c| ([c.width, c.height], 1))
            })
        };
        let (size, orientation) = file.or_else(camera)?;
        Some((photo, size.map(f64::from), orientation))
    });
    let fit = move || {
        let [w, h] = bounds.get_untracked();
        if let Some((_, size, orientation)) = frame.get_untracked().filter(|_| w > 0.0) {
            let whole = Placement::fitted(size, orientation, w, h);
            fitted.set_value(Some(whole));
            placement.set(Some(whole));
        }
    };
    let zoom_to = move |scale: f64| {
        let [w, h] = bounds.get_untracked();
        placement.update(|p| {
            if let Some(p) = p {
                *p = p.zoomed(scale / p.scale, [w / 2.0, h / 2.0]);
            }
        });
    };
    // Another photo, or a first size, fits the photo; after a later change of size a photo shown whole stays whole, and another
    // keeps its zoom.
    Effect::new(move |last: Option<Option<String>>| {
        let [w, _] = bounds.get();
        let now = frame.get().map(|(photo, ..)| photo);
        if w > 0.0 && last.flatten() != now {
            fit();
            now
        } else if w > 0.0 {
            if placement.get_untracked().is_some_and(|p| fitted.get_value() == Some(p)) {
                fit();
            }
            now
        } else {
            None
        }
    });
    Effect::new(move |_| {
        let Some(verb) = desk.view_verb.get() else { return };
        let [w, h] = bounds.get_untracked();
        let centre = cross.get_untracked().unwrap_or([w / 2.0, h / 2.0]);
        let zoom = |factor: f64| {
            placement.update(|p| {
                if let Some(p) = p {
                    *p = p.zoomed(factor, centre);
                }
            });
        };
        match verb {
            ViewVerb::Fit => fit(),
            ViewVerb::OneToOne => zoom_to(1.0),
            ViewVerb::Nearer => zoom(1.5),
            ViewVerb::Farther => zoom(1.0 / 1.5),
        }
        desk.view_verb.set(None);
    });
    // A selection made elsewhere is brought into view.
    Effect::new(move |_| {
        let Some([u, v]) = desk.centre_on.get() else { return };
        let [w, h] = bounds.get();
        if w > 0.0 {
            placement.update(|p| {
                if let Some(p) = p {
                    let [x, y] = p.to_screen([u, v]);
                    if !(20.0..w - 20.0).contains(&x) || !(20.0..h - 20.0).contains(&y) {
                        *p = p.centred([u, v], p.scale, w, h);
                    }
                }
            });
            desk.centre_on.set(None);
        }
    });
    // A place looked for is shown closely, as far as the photo has pixels for it.
    Effect::new(move |_| {
        let Some((place, reach)) = desk.show_place.get() else { return };
        let [w, h] = bounds.get();
        if w > 0.0 && frame.get().is_some() {
            placement.update(|p| {
                if let Some(p) = p {
                    let scale = (w.min(h) / (2.0 * reach)).clamp(p.scale.min(1.0), 4.0);
                    *p = p.centred(place, scale, w, h);
                }
            });
            desk.show_place.set(None);
        }
    });
    Effect::new(move |_| {
        let size_here = bounds.get();
        desk.theme.track();
        let (Some(element), Some(placement)) = (below.get(), placement.get()) else { return };
        let Some(surface) = Surface::new(&element, size_here) else { return };
        if let Some((photo, size, _)) = frame.get() {
            draw_photo(desk, &surface, &photo, size, placement);
        }
    });
    Effect::new(move |_| {
        let size_here = bounds.get();
        desk.theme.track();
        let (Some(element), Some(placement)) = (canvas.get(), placement.get()) else { return };
        let Some(surface) = Surface::new(&element, size_here) else { return };
        let layers = desk.layers.get();
        if let Some((photo, ..)) = frame.get() {
            if layers.pixels {
                draw_pixels(desk, &surface, placement, &photo);
            }
            if let Some(predicted) = desk.prediction_here() {
                draw_prediction(&surface, placement, &predicted, layers);
            }
            marks.with(|marks| draw_marks(&surface, placement, marks, layers));
            strokes.with(|strokes| draw_strokes(&surface, placement, strokes));
            if layers.residuals {
                let residuals = desk.document.with(|document| residuals_in(document, &photo));
                draw_residuals(&surface, placement, &residuals, layers.residual_factor);
            }
            if layers.displacements {
                draw_displacements(&surface, placement, &desk.displacements_in(&photo));
            }
            if let Some([x, y]) = cross.get() {
                surface.pen(&surface.token("--p-accent"), 1.0, &[]);
                for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                    surface.line(x + 4.0 * dx, y + 4.0 * dy, x + 24.0 * dx, y + 24.0 * dy);
                }
            }
        }
    });

    let pointers = StoredValue::new(BTreeMap::<i32, Pointer>::new());
    let travelled = StoredValue::new(0.0_f64);
    let space = RwSignal::new(false);
    // Where the keys have taken the cross, on the screen: Enter there is a click.
    let steer = move |key: &Key| {
        let [w, h] = bounds.get_untracked();
        let Some(p) = placement.get_untracked() else { return false };
        let at = cross.get_untracked().unwrap_or([w / 2.0, h / 2.0]);
        let pixel = |at: [f64; 2]| {
            let [u, v] = p.to_pixel(at);
            ([u, v], (0.0..=p.size[0]).contains(&u) && (0.0..=p.size[1]).contains(&v))
        };
        let step = match (key.modifiers.shift, key.modifiers.alt) {
            (true, _) => 64.0,
            (_, true) => 1.0,
            _ => 12.0,
        };
        let by = match key.key.as_str() {
            "ArrowLeft" => [-step, 0.0],
            "ArrowRight" => [step, 0.0],
            "ArrowUp" => [0.0, -step],
            "ArrowDown" => [0.0, step],
            "Enter" => {
                let ([u, v], inside) = pixel(at);
                let free = key.modifiers.alt || desk.placing.get_untracked();
                on_click.run(Click { u, v, reach: 12.0 / p.scale, inside, free });
                return true;
            }
            _ => return false,
        };
        let at = [(at[0] + by[0]).clamp(0.0, w), (at[1] + by[1]).clamp(0.0, h)];
        cross.set(Some(at));
        give_way(at);
        let (place, inside) = pixel(at);
        desk.cursor.set(inside.then_some(place));
        true
    };
    let hold = move |e: leptos::ev::KeyboardEvent, held: bool| {
        let key = event::key(&e);
        let used = if key.key == " " {
            space.set(held);
            true
        } else {
            held && !key.modifiers.control && (keys::in_photo(desk, &key) || steer(&key))
        };
        if used {
            e.prevent_default();
        }
    };
    let down = move |e: leptos::ev::PointerEvent| {
        let pointer = event::pointer(&e);
        cross.set(None);
        event::capture(&e);
        travelled.set_value(if pointer.button == 0 && !space.get_untracked() { 0.0 } else { 100.0 });
        pointers.update_value(|all| {
            all.insert(pointer.id, pointer);
        });
    };
    let moved = move |e: leptos::ev::PointerEvent| {
        let pointer = event::pointer(&e);
        give_way([pointer.x, pointer.y]);
        if let Some(p) = placement.get_untracked() {
            let [u, v] = p.to_pixel([pointer.x, pointer.y]);
            let inside = (0.0..=p.size[0]).contains(&u) && (0.0..=p.size[1]).contains(&v);
            desk.cursor.set(inside.then_some([u, v]));
        }
        pointers.update_value(|all| {
            let Some(before) = all.insert(pointer.id, pointer).filter(|_| e.buttons() != 0) else {
                all.remove(&pointer.id);
                return;
            };
            let others = all.values().filter(|p| p.id != pointer.id).copied().collect::<Vec<_>>();
            let step = [pointer.x - before.x, pointer.y - before.y];
            travelled.update_value(|t| *t += step[0].hypot(step[1]));
            if travelled.get_value() < 4.0 {
                return;
            }
            placement.update(|p| {
                let Some(p) = p else { return };
                match others.first() {
                    // Two fingers: zoom by their distance about the one at rest.
                    Some(other) => {
                        let spread = |p: &Pointer| (p.x - other.x).hypot(p.y - other.y).max(1.0);
                        *p = p.zoomed(spread(&pointer) / spread(&before), [other.x, other.y]);
                    }
                    None => *p = p.shifted(step),
                }
            });
        });
    };
    let up = move |e: leptos::ev::PointerEvent| {
        let pointer = event::pointer(&e);
        pointers.update_value(|all| {
            all.remove(&pointer.id);
        });
        if travelled.get_value() < 4.0
            && pointer.button == 0
            && let Some(p) = placement.get_untracked()
        {
            let [u, v] = p.to_pixel([pointer.x, pointer.y]);
            let reach = if pointer.touch { 22.0 } else { 12.0 } / p.scale;
            let inside = (0.0..=p.size[0]).contains(&u) && (0.0..=p.size[1]).contains(&v);
            let free = pointer.modifiers.alt || desk.placing.get_untracked();
            on_click.run(Click { u, v, reach, inside, free });
        }
    };
    let wheel = move |e: leptos::ev::WheelEvent| {
        let wheel = event::wheel(&e);
        placement.update(|p| {
            if let Some(p) = p {
                *p = if wheel.zoom {
                    p.zoomed((-wheel.dy * 0.0022).exp(), [wheel.x, wheel.y])
                } else {
                    p.shifted([-wheel.dx, -wheel.dy])
                };
            }
        });
    };
    let title = move || {
        photo.get().map(|id| {
            let file = desk.document.with(|d| d.project.photos.iter().find(|p| p.id == id).map(|p| p.file.clone()));
            view! { <b>{id}</b> " " <b>{file.unwrap_or_default()}</b> }
        })
    };
    let percent = move || placement.get().map(|p| format!("{} %", format::fixed(p.scale * 100.0, 0)));
    let absent = move || {
        photo.get().filter(|id| desk.files.with(|files| !files.contains_key(id))).map(|id| {
            let file = desk.document.with(|d| d.project.photos.iter().find(|p| p.id == id).map(|p| p.file.clone()));
            view! { <p class="stage-note">{move || text::photo_file_missing(file.clone().unwrap_or_default())}</p> }
        })
    };
    view! {
        <div class="stage">
            <div class="stage-head">
                {title}
                <span class="summary">{move || summary.get()}</span>
                <span class="gap"></span>
                <button class="stage-button words" title=text::point_by_point_how aria-pressed=move || desk.in_series().to_string() data-action="series"
                    on:click=move |_| desk.switch_series()>{text::point_by_point}</button>
                <button class="stage-button words" title=text::place_freely_how aria-pressed=move || desk.placing.get().to_string()
                    on:click=move |_| desk.placing.update(|on| *on = !*on)>{text::place_freely}</button>
                <LayerChoice/>
                <button class="stage-button" aria-label=text::fit title=text::fit on:click=move |_| fit()><Glyph icon=Icon::Fit/></button>
                <button class="stage-button one-to-one" on:click=move |_| zoom_to(1.0)>"1:1"</button>
                <span class="zoom">{percent}</span>
            </div>
            <div class="stage-asked">
                {children.map(|children| children())}
                <div class="legend">
                    <span class="key"></span>{text::legend_measured}
                    <span class="key selected"></span>{text::legend_selected}
                    <span class="key doubtful"></span>{text::legend_doubtful}
                    <span class="key rejected"></span>{text::legend_excluded}
                    <Show when=move || marks.with(|marks| marks.iter().any(|mark| mark.style == Style::Hidden))>
                        <span class="key occluded"></span>{text::reason_occluded}
                    </Show>
                    <span class="gap"></span>
                    <span class="how" class:mode=desk.placing>{move || if desk.placing.get() { first::placing_on() } else { text::click_measures() }}</span>
                </div>
            </div>
            <div class="stage-body">
                <canvas node_ref=below class="picture" aria-hidden="true" style:filter=move || desk.layers.with(filter)></canvas>
                <canvas
                    node_ref=canvas
                    class="photo"
                    tabindex="0"
                    role="img"
                    aria-label=move || text::photo_view(photo.get().unwrap_or_default())
                    class:panning=space
                    class:placing=desk.placing
                    on:pointerdown=down
                    on:pointermove=moved
                    on:pointerup=up
                    // No mouse is imitated after a touch: it would take the focus from the field that asks for a name.
                    on:touchend=move |e| e.prevent_default()
                    on:pointercancel=move |e| pointers.update_value(|all| { all.remove(&event::pointer(&e).id); })
                    on:pointerleave=move |_| {
                        desk.cursor.set(None);
                        pointer_at.set(None);
                    }
                    on:wheel=wheel
                    on:keydown=move |e| hold(e, true)
                    on:keyup=move |e| hold(e, false)
                    on:blur=move |_| space.set(false)
                    on:dblclick=move |_| fit()
                ></canvas>
                {absent}
                {over.map(|over| view! { <div class="over" class:left=move || !CORNERS[corner.get()][0] class:top=move || !CORNERS[corner.get()][1]>{over}</div> })}
            </div>
        </div>
    }
}

/// Brightness and contrast as a style sheet says it.
fn filter(layers: &Layers) -> String {
    format!("brightness({}) contrast({})", layers.brightness, layers.contrast)
}

fn draw_photo(desk: Desk, surface: &Surface, photo: &str, [w, h]: [f64; 2], placement: Placement) {
    let map = placement.affine();
    if let Some(picture) = desk.picture(photo) {
        // Of a sensor's samples a reduced picture is shown.
        let [width, height] = picture.size();
        let [a, b, c, d, e, f] = map;
        let (sx, sy) = (w / width, h / height);
        surface.pyramid(&picture, [a * sx, b * sx, c * sy, d * sy, e, f], placement.scale >= 2.0);
    } else if let Some(small) = desk.files.with(|files| files.get(photo).map(|f| f.small.clone())) {
        let (sx, sy) = (w / f64::from(small.width), h / f64::from(small.height));
        let [a, b, c, d, e, f] = map;
        surface.picture(&small, [a * sx, b * sx, c * sy, d * sy, e, f], false);
    } else {
        let ([x1, y1], [x2, y2]) = (placement.to_screen([0.0, 0.0]), placement.to_screen([w, h]));
        surface.pen(&surface.token("--photo-edge"), 1.0, &[]);
        surface.rectangle(x1.min(x2), y1.min(y2), (x2 - x1).abs(), (y2 - y1).abs());
    }
}

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

/// The angle of an ellipse between 0 and 180 degrees.
pub fn half_turn_degrees(angle: f64) -> f64 {
    angle.rem_euclid(TAU / 2.0).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_over_a_corner_covers_neither_the_pointer_nor_what_is_chosen() {
        let bounds = [700.0, 560.0];
        for k in 0..4000_u32 {
            let at = |salt: u32| f64::from((k * 7919 + salt * 104_729) % 1000) / 1000.0;
            let seen = [[700.0 * at(1), 560.0 * at(2)], [700.0 * at(3), 560.0 * at(4)]];
            let now = (k % 4) as usize;
            let free = free_corner(now, bounds, &seen);
            let [right, bottom] = CORNERS[free];
            for [x, y] in seen {
                let across = if right { x > 700.0 - OVER[0] } else { x < OVER[0] };
                let along = if bottom { y > 560.0 - OVER[1] } else { y < OVER[1] };
                assert!(!(across && along), "{seen:?} {free}");
            }
            // It does not wander as long as it is in nobody's way.
            assert_eq!(free_corner(free, bounds, &seen), free);
        }
    }
}
