//! The object: the result in space, and what is measured on it. A view of step 6, beside the path.

mod features;
mod overview;
mod scene;

use std::collections::BTreeSet;
use std::sync::Arc;

use leptos::html::{Div, Section};
use leptos::prelude::*;
use leptos::task::spawn_local;

use super::icon::{Glyph, Icon};
use super::results::NoNumbers;
use super::results::units::length_unit;
use crate::browser::object::{Met, Scene, State, View, numbered};
use crate::browser::{event, page};
use crate::edit::natural;
use crate::format;
use crate::i18n::{Text, object as words, text};
use crate::store::selection::{Kind, Marking};
use crate::store::{Desk, Step, Until};

use features::Features;
pub use overview::Overview;
use scene::{factors, scene};

/// What features are made of: the points marked on the desk, in the order in which they were, and features.
#[derive(Clone, Copy)]
pub struct Chosen {
    pub points: RwSignal<Vec<String>>,
    pub features: RwSignal<Vec<String>>,
}

/// What is shown, by the view's words, with the word for people.
const SHOWN: [(&str, Text); 7] = [
    ("names", words::show_names),
    ("ellipsoids", words::show_ellipsoids),
    ("photos", text::photos),
    ("rays", words::show_rays),
    ("features", words::features),
    ("deviations", words::show_deviations),
    ("grid", words::show_grid),
];

const SIDES: [(&str, Text); 4] =
    [("home", words::side_home), ("top", words::side_top), ("front", words::side_front), ("right", words::side_right)];

/// Steps of the exaggerations: 1, 2, 5, 10 … a million.
const STEPS: i32 = 18;

fn exaggeration(step: i32) -> f64 {
    [1.0, 2.0, 5.0][step.rem_euclid(3) as usize] * 10f64.powi(step.div_euclid(3))
}

fn step_of(factor: f64) -> i32 {
    let distance = |step: &i32| (exaggeration(*step).ln() - factor.max(1e-9).ln()).abs();
    (0..=STEPS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

/// Marked points in the order in which they were marked, those that came together by their names; None where that is the order there is.
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
            <Shown/>
        </Show>
    }
}

#[component]
fn Shown() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = Chosen { points: RwSignal::default(), features: RwSignal::default() };
    provide_context(chosen);
    Effect::new(move |_| {
        let marked = desk.selection.with(|s| s.marked(Kind::Points).cloned()).unwrap_or_default();
        if let Some(all) = chosen.points.with_untracked(|all| in_order(all, &marked)) {
            chosen.points.set(all);
        }
    });
    // A feature that is undone or removed is chosen no longer.
    Effect::new(move |_| {
        let gone = |id: &String| desk.document.with(|d| d.project.features.iter().all(|f| f.id != *id));
        if chosen.features.with(|all| all.iter().any(gone)) {
            chosen.features.update(|all| all.retain(|id| !gone(id)));
        }
    });
    let shown = RwSignal::new(SHOWN.map(|(name, _)| (name, true)).to_vec());
    let perspective = RwSignal::new(true);
    let (ellipsoid_step, stick_step) = (RwSignal::new(0), RwSignal::new(0));
    // A later project has exaggerations of its own; changes of one and the same keep what was set.
    let suited = StoredValue::new((String::new(), None::<String>, false));
    let made = Memo::new(move |_| {
        let feature = chosen.features.with(|all| all.last().cloned());
        let (scene, factors) = desk.document.with(|d| {
            let Some(result) = d.current() else { return (Scene::default(), (1.0, 1.0)) };
            let scene = scene(result, &d.project, feature.as_deref());
            let factors = factors(result, &scene);
            (scene, factors)
        });
        Made(Arc::new(scene), factors, feature)
    });
    Effect::new(move |_| {
        let Made(scene, (ellipsoids, sticks), feature) = made.get();
        // A new feature has its deviations once it is measured: only then they have a size.
        let now = (scene.key.clone(), feature, !scene.sticks.is_empty());
        let before = suited.get_value();
        if before.0 != now.0 {
            ellipsoid_step.set(step_of(ellipsoids));
        }
        if before != now {
            stick_step.set(step_of(sticks));
        }
        suited.set_value(now);
    });
    let state = Memo::new(move |_| {
        let numbers = made.with(|Made(scene, ..)| {
            let points = numbered(&scene.names);
            let photos = numbered(&scene.photo_names);
            let (point, photo) = desk.selection.with(|s| (s.point.clone(), s.photo.clone()));
            let several =
                chosen.points.with(|all| all.iter().filter_map(|id| points.get(id.as_str()).copied()).collect());
            (
                point.and_then(|id| points.get(id.as_str()).copied()),
                photo.and_then(|id| photos.get(id.as_str()).copied()),
                several,
            )
        });
        let along = chosen.features.with(|all| {
            let id = all.last()?;
            desk.document.with(|d| d.current()?.adjustment.features.iter().find(|f| f.id == *id)?.direction)
        });
        let mut shown = shown.get();
        shown.push(("perspective", perspective.get()));
        State {
            selected: numbers.0,
            photo: numbers.1,
            chosen: numbers.2,
            shown,
            factor: exaggeration(ellipsoid_step.get()),
            sticks: exaggeration(stick_step.get()),
            along,
        }
    });
    let open = StoredValue::new_local(None::<View>);
    let (ready, failed) = (RwSignal::new(false), RwSignal::new(None::<String>));
    let (host, space) = (NodeRef::<Div>::new(), NodeRef::<Section>::new());
    let meet = move |met: Met| match met {
        Met::Point { index, more } => {
            let Some(id) = made.with_untracked(|m| m.0.names.get(index).cloned()) else { return };
            let how = if more { Marking::Besides } else { Marking::Only };
            desk.choose_row(Kind::Points, &id, how, &[]);
        }
        Met::Photo(index) => {
            if let Some(id) = made.with_untracked(|m| m.0.photo_names.get(index).cloned()) {
                desk.select_photo(&id);
            }
        }
        Met::Nothing => desk.selection.update(|s| {
            s.unmark(Kind::Points);
            s.point = None;
        }),
        Met::Lost => failed.set(Some(words::graphics_lost().to_owned())),
    };
    host.on_load(move |element| {
        spawn_local(async move {
            match View::open(element.into(), meet).await {
                // Whoever has left meanwhile has no use for it: it closes as it is dropped.
                Ok(view) => {
                    if open.try_set_value(Some(view)).is_none() {
                        ready.set(true);
                    }
                }
                Err(detail) => {
                    let _ = failed.try_set(Some(detail));
                }
            }
        });
    });
    on_cleanup(move || {
        let _ = open.try_set_value(None);
    });
    let with_view = move |act: &dyn Fn(&View)| {
        open.try_with_value(|view| view.iter().for_each(act));
    };
    Effect::new(move |_| {
        let Made(scene, ..) = made.get();
        let pictures = desk.files.with(|files| {
            let small = |id: &String| files.get(id).map(|file| file.small.clone());
            scene.photo_names.iter().map(small).collect::<Vec<_>>()
        });
        if ready.get() {
            with_view(&|view| view.show(&scene, &pictures));
        }
    });
    Effect::new(move |_| {
        let state = state.get();
        made.track();
        // Colours are the theme's: another one draws anew.
        desk.theme.track();
        if ready.get() {
            with_view(&|view| view.state(&state));
        }
    });
    let look = move |side: &'static str| with_view(&|view| view.look(side));
    let save = move || {
        let (name, unit, points, photos) = desk.document.with_untracked(|d| {
            let all = d.current().map_or((0, 0), |r| (r.adjustment.points.len(), r.adjustment.photos.len()));
            (d.project.name.clone(), length_unit(d), all.0, all.1)
        });
        let factor = format::round(exaggeration(ellipsoid_step.get_untracked()));
        let lines = [name.clone(), words::caption(format::count(points), format::count(photos), factor, unit)];
        let file = format!("{}-object.png", if name.is_empty() { "sightline" } else { &name });
        let fault = move |detail: String| desk.say(true, Until::NextWork, move || text::cannot_save(&detail));
        with_view(&|view| view.save(&file, &lines, fault));
    };
    let sentence = move || {
        desk.document.with(|d| {
            let Some(r) = d.current() else { return String::new() };
            let a = &r.adjustment;
            words::sentence(format::count(a.points.len()), format::count(a.photos.len()), d.project.features.len())
        })
    };
    let keys = move |e: leptos::ev::KeyboardEvent| {
        let key = event::key(&e);
        if key.modifiers.control || key.typing {
            return;
        }
        match key.key.as_str() {
            "f" | "F" => look("fit"),
            "p" | "P" => perspective.update(|on| *on = !*on),
            digit => {
                let number = digit.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
                if let Some((side, _)) = number.and_then(|n| SIDES.get(n)) {
                    look(side);
                }
            }
        }
    };
    let directed = move || state.with(|s| s.along.is_some());
    view! {
        <div class="bar object-bar" role="region" aria-label=words::open_object>
            <button class="link back" on:click=move |_| desk.go(Step::Results)>"← " {text::results}</button>
            <h1>{words::object}</h1>
            <p>{sentence}</p>
            <div class="slot"><div class="action">
                <Show when=move || ready.get()>
                    <button class="button" data-action="picture" on:click=move |_| save()><Glyph icon=Icon::Save/> {words::save_picture}</button>
                </Show>
                <button class="button primary" on:click=move |_| desk.go(Step::Report)>{text::write_report} <Glyph icon=Icon::Arrow/></button>
            </div></div>
        </div>
        <main class="object">
            <section class="space" aria-label=words::object node_ref=space>
                <div class="toggles" role="toolbar" aria-label=words::seen_from>
                    {SIDES.map(|(side, word)| view! {
                        <button class="toggle" data-side=side on:click=move |_| look(side)>{word}</button>
                    }).collect_view()}
                    <Show when=directed><button class="toggle" data-side="along" on:click=move |_| look("along")>{words::side_along}</button></Show>
                    <span class="rule"></span>
                    <button class="toggle" aria-pressed=move || perspective.get().to_string()
                        on:click=move |_| perspective.update(|on| *on = !*on)>{words::perspective}</button>
                    <button class="toggle" on:click=move |_| look("fit")><Glyph icon=Icon::Fit size=14/> " " {text::fit}</button>
                    <span class="gap"></span>
                    {SHOWN.map(|(name, word)| {
                        let on = move || shown.with(|all| all.iter().any(|(n, on)| *n == name && *on));
                        view! {
                            <button class="toggle" data-show=name aria-pressed=move || on().to_string() on:click=move |_| shown.update(|all| {
                                all.iter_mut().filter(|(n, _)| *n == name).for_each(|(_, on)| *on = !*on);
                            })>{word}</button>
                        }
                    }).collect_view()}
                </div>
                <Show when=move || failed.with(Option::is_none) fallback=move || view! {
                    <div class="no-space">
                        <p><Glyph icon=Icon::Warning/> " " {move || words::no_graphics(failed.get().unwrap_or_default())}</p>
                        <Overview/>
                    </div>
                }>
                    <div class="space-host" node_ref=host tabindex="0" role="application" aria-label=words::space_label on:keydown=keys></div>
                </Show>
                <div class="scales">
                    <Scale label=words::show_ellipsoids step=ellipsoid_step suffix="1σ"/>
                    <Show when=move || made.with(|m| !m.0.sticks.is_empty() || !m.0.residuals.is_empty())>
                        <Scale label=words::show_deviations step=stick_step suffix=""/>
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

/// A scene that is compared by where it is, since it is made anew whenever something of it changed.
#[derive(Clone)]
struct Made(Arc<Scene>, (f64, f64), Option<String>);

impl PartialEq for Made {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

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

    #[test]
    fn exaggerations_go_in_steps_of_one_two_five() {
        assert_eq!([0, 1, 2, 3, 10].map(exaggeration), [1.0, 2.0, 5.0, 10.0, 2000.0]);
        assert_eq!([1.0, 480.0, 0.1, 1e9].map(step_of), [0, 8, 0, STEPS]);
    }
}
