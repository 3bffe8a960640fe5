//! The object: the result in space, and what is measured on it. A view of step 6, beside the path.

mod display;
mod features;
mod host;
mod overview;
mod scene;
mod systems;

use std::collections::BTreeSet;

use leptos::html::Section;
use leptos::prelude::*;

use super::components::icon::{Glyph, Icon};
use crate::browser::object::Met;
use crate::browser::{event, page};
use crate::document::keys::Kind;
use crate::edit::natural;
use crate::format;
use crate::i18n::{Text, object as words, text};
use crate::store::selection::Marking;
use crate::store::{Desk, Step, Until};
use crate::view::components::no_result::NoNumbers;
use crate::view::components::units::length_unit;

use display::{Display, STEPS, ShownScene, exaggeration, shown_scene};
use features::Features;
use host::Host;
pub use overview::Overview;

/// Inputs of features: the points marked on the desk, in the order in which they were, and features.
#[derive(Clone, Copy)]
pub struct Chosen {
    pub points: RwSignal<Vec<String>>,
    pub features: RwSignal<Vec<String>>,
}

/// Layers by the view's own names, with their names in the interface.
const LAYERS: [(&str, Text); 7] = [
    ("names", words::show_names),
    ("ellipsoids", words::show_ellipsoids),
    ("photos", text::photos),
    ("rays", words::show_rays),
    ("features", words::features),
    ("deviations", words::show_deviations),
    ("grid", words::show_grid),
];

/// Sides that the object can be seen from, by the view's own names.
const SIDES: [(&str, Text); 4] =
    [("home", words::side_home), ("top", words::side_top), ("front", words::side_front), ("right", words::side_right)];

/// Marked points in the order in which they were marked, those that came together by their names; `None` if that is the order there is.
fn in_order(before: &[String], marked: &BTreeSet<String>) -> Option<Vec<String>> {
    let mut all: Vec<String> = before.iter().filter(|id| marked.contains(*id)).cloned().collect();
    let mut more: Vec<String> = marked.iter().filter(|id| !before.contains(*id)).cloned().collect();
    more.sort_by(|a, b| natural(a, b));
    all.append(&mut more);
    (all != before).then_some(all)
}

#[component]
pub fn Object() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let current = Memo::new(move |_| desk.document.with(|d| d.current().is_some()));
    view! {
        <Show when=move || current.get() fallback=|| view! { <NoNumbers/> }>
            <ObjectPage/>
        </Show>
    }
}

/// Keeps the chosen points and features at what is marked on the desk and still exists.
fn follow_marked(desk: Desk, chosen: Chosen) {
    Effect::new(move |_| {
        let marked = desk.selection.with(|s| s.marked(Kind::Points).cloned()).unwrap_or_default();
        if let Some(all) = chosen.points.with_untracked(|all| in_order(all, &marked)) {
            chosen.points.set(all);
        }
    });
    // A feature that is undone or removed is no longer chosen.
    Effect::new(move |_| {
        let gone = |id: &String| desk.document.with(|d| d.project.features.iter().all(|f| f.id != *id));
        if chosen.features.with(|all| all.iter().any(gone)) {
            chosen.features.update(|all| all.retain(|id| !gone(id)));
        }
    });
}

/// A click in the 3-D view.
fn meet(desk: Desk, shown: Memo<ShownScene>, host: Host, met: Met) {
    match met {
        Met::Point { index, more } => {
            let Some(id) = shown.with_untracked(|m| m.scene.names.get(index).cloned()) else { return };
            let how = if more { Marking::Besides } else { Marking::Only };
            desk.choose_row(Kind::Points, &id, how, &[]);
        }
        Met::Photo(index) => {
            if let Some(id) = shown.with_untracked(|m| m.scene.photo_names.get(index).cloned()) {
                desk.select_photo(&id);
            }
        }
        Met::Nothing => desk.selection.update(|s| {
            s.unmark(Kind::Points);
            s.point = None;
        }),
        Met::Lost => host.failure.set(Some(words::graphics_lost().to_owned())),
    }
}

/// Saves the view as a picture with a caption.
fn save_picture(desk: Desk, host: Host, display: Display) {
    let (name, unit, points, photos) = desk.document.with_untracked(|d| {
        let all = d.current().map_or((0, 0), |r| (r.adjustment.points.len(), r.adjustment.photos.len()));
        (d.project.name.clone(), length_unit(d), all.0, all.1)
    });
    let factor = format::round(exaggeration(display.ellipsoids.get_untracked()));
    let lines = [name.clone(), words::caption(format::count(points), format::count(photos), factor, unit)];
    let file = format!("{}-object.png", if name.is_empty() { "sightline" } else { &name });
    let fault = move |detail: String| desk.say(true, Until::NextWork, move || text::cannot_save(&detail));
    host.with_view(|view| view.save(&file, &lines, fault));
}

#[component]
fn ObjectPage() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = Chosen { points: RwSignal::default(), features: RwSignal::default() };
    provide_context(chosen);
    follow_marked(desk, chosen);
    let shown = shown_scene(desk, chosen);
    let display = Display::new(LAYERS.map(|(name, _)| name));
    display.suit(shown);
    let state = display.state(desk, chosen, shown);
    let host = Host::new();
    host.open(move |met| meet(desk, shown, host, met));
    host.follow(desk, shown, state);
    let space = NodeRef::<Section>::new();
    let along = Memo::new(move |_| state.with(|s| s.along.is_some()));
    view! {
        <ObjectBar host display/>
        <main class="object">
            <section class="space" aria-label=words::object node_ref=space>
                <Toggles host display along/>
                <Show when=move || host.failure.with(Option::is_none) fallback=move || view! {
                    <div class="no-space">
                        <p><Glyph icon=Icon::Warning/> " " {move || words::no_graphics(host.failure.get().unwrap_or_default())}</p>
                        <Overview/>
                    </div>
                }>
                    <div class="space-host" node_ref=host.element tabindex="0" role="application" aria-label=words::space_label
                        on:keydown=move |e| keys(host, display, &e)></div>
                </Show>
                <div class="scales">
                    <Scale label=words::show_ellipsoids step=display.ellipsoids suffix="1σ"/>
                    <Show when=move || shown.with(|m| !m.scene.sticks.is_empty() || !m.scene.residuals.is_empty())>
                        <Scale label=words::show_deviations step=display.deviations suffix=""/>
                    </Show>
                    <span class="gap"></span>
                    <button class="toggle" data-action="full-screen" on:click=move |_| {
                        if let Some(element) = space.get_untracked() {
                            page::switch_full_screen(&element);
                        }
                    }>{words::full_screen}</button>
                    <span class="how">{words::how_to_move}</span>
                </div>
            </section>
            <Features/>
        </main>
    }
}

/// Keys of the 3-D view: F fits, P switches the projection, digits turn it to a side.
fn keys(host: Host, display: Display, e: &leptos::ev::KeyboardEvent) {
    let key = event::key(e);
    if key.modifiers.control || key.typing {
        return;
    }
    match key.key.as_str() {
        "f" | "F" => host.look("fit"),
        "p" | "P" => display.perspective.update(|on| *on = !*on),
        digit => {
            let number = digit.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
            if let Some((side, _)) = number.and_then(|n| SIDES.get(n)) {
                host.look(side);
            }
        }
    }
}

/// The bar above the page: counts, saving the picture, the way on.
#[component]
fn ObjectBar(host: Host, display: Display) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        desk.document.with(|d| {
            let Some(r) = d.current() else { return String::new() };
            let a = &r.adjustment;
            words::sentence(format::count(a.points.len()), format::count(a.photos.len()), d.project.features.len())
        })
    };
    view! {
        <div class="bar object-bar" role="region" aria-label=words::open_object>
            <button class="link back" on:click=move |_| desk.go(Step::Results)>"← " {text::results}</button>
            <h1>{words::object}</h1>
            <p>{sentence}</p>
            <div class="slot"><div class="action">
                <Show when=move || host.ready.get()>
                    <button class="button" data-action="picture" on:click=move |_| save_picture(desk, host, display)><Glyph icon=Icon::Save/> {words::save_picture}</button>
                </Show>
                <button class="button primary" on:click=move |_| desk.go(Step::Report)>{text::write_report} <Glyph icon=Icon::Arrow/></button>
            </div></div>
        </div>
    }
}

/// Buttons above the 3-D view: sides, projection, layers. A chosen feature can have a direction to look along.
#[component]
fn Toggles(host: Host, display: Display, along: Memo<bool>) -> impl IntoView {
    let perspective = display.perspective;
    view! {
        <div class="toggles" role="toolbar" aria-label=words::seen_from>
            {SIDES.map(|(side, word)| view! {
                <button class="toggle" data-side=side on:click=move |_| host.look(side)>{word}</button>
            }).collect_view()}
            <Show when=move || along.get()><button class="toggle" data-side="along" on:click=move |_| host.look("along")>{words::side_along}</button></Show>
            <span class="rule"></span>
            <button class="toggle" aria-pressed=move || perspective.get().to_string()
                on:click=move |_| perspective.update(|on| *on = !*on)>{words::perspective}</button>
            <button class="toggle" on:click=move |_| host.look("fit")><Glyph icon=Icon::Fit size=14/> " " {text::fit}</button>
            <span class="gap"></span>
            {LAYERS.map(|(name, word)| view! {
                <button class="toggle" data-show=name aria-pressed=move || display.is_shown(name).to_string()
                    on:click=move |_| display.switch(name)>{word}</button>
            }).collect_view()}
        </div>
    }
}

/// An exaggeration.
#[component]
fn Scale(label: Text, step: RwSignal<i32>, suffix: &'static str) -> impl IntoView {
    let factor = move || format::round(exaggeration(step.get()));
    view! {
        <label class="scale">
            <span>{label}</span>
            <input type="range" min="0" max=STEPS step="1" prop:value=move || step.get().to_string()
                aria-valuetext=move || format!("× {}", factor())
                on:input=move |e| { event::value(&e).parse().into_iter().for_each(|n| step.set(n)); }/>
            <b>"× " {factor} {(!suffix.is_empty()).then(|| format!(", {suffix}"))}</b>
        </label>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_keep_the_order_in_which_they_were_marked() {
        let names = |all: &[&str]| all.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
        let marked = |all: &[&str]| names(all).into_iter().collect::<BTreeSet<_>>();
        assert_eq!(in_order(&names(&["3", "1"]), &marked(&["1", "3", "10", "2"])), Some(names(&["3", "1", "2", "10"])));
        assert_eq!(in_order(&names(&["3", "1"]), &marked(&["1"])), Some(names(&["1"])));
        assert_eq!(in_order(&names(&["3", "1"]), &marked(&["1", "3"])), None);
    }
}
