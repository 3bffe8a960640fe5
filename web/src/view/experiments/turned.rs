//! The network of an experiment in the 3-D view, to be turned.

use leptos::html::Div;
use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::depiction::{extent, frustum_along, round};
use sightline::project::Role;
use sightline_lab::experiments::Drawing;

use crate::browser::object::{Met, Scene, SceneState, SceneView};
use crate::i18n::{Text, experiments as words, object, text};
use crate::store::Desk;

const SIDES: [(&str, Text); 4] = [
    ("home", object::side_home),
    ("top", object::side_top),
    ("front", object::side_front),
    ("right", object::side_right),
];

/// Points and photos of a drawing about the middle of the points.
fn scene(drawing: &Drawing) -> Scene {
    let (centre, size) = extent(drawing.points.iter().map(|point| point.xyz));
    let about = |xyz: [f64; 3]| -> [f32; 3] { std::array::from_fn(|k| (xyz[k] - centre[k]) as f32) };
    let mut scene = Scene {
        key: format!("{} {size:e}", drawing.id),
        unit: drawing.unit.clone(),
        size,
        grid: round(size / 8.0),
        ..Scene::default()
    };
    for point in &drawing.points {
        scene.names.push(point.id.clone());
        scene.points.extend(about(point.xyz));
        scene.roles.push(match point.role {
            Some(Role::Control) => 1,
            Some(Role::Check) => 2,
            Some(Role::Tie) | None => 0,
        });
    }
    let (mut low, mut high) = ([0.0_f32; 3], [0.0_f32; 3]);
    for point in scene.points.chunks_exact(3) {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(point[k]), high[k].max(point[k]));
        }
    }
    scene.bounds = [low[0], low[1], low[2], high[0], high[1], high[2]];
    for photo in &drawing.photos {
        let along = photo.direction.and_then(|direction| frustum_along(photo.xyz, direction, 0.14 * size));
        if let Some(frustum) = along {
            scene.photo_names.push(photo.id.clone());
            scene.photos.extend(frustum.into_iter().flat_map(about));
        }
    }
    // Rays are drawn of a result.
    scene.ray_start = vec![0; scene.names.len() + 1];
    scene
}

#[component]
pub fn TurnedNetwork(#[prop(into)] drawing: Signal<Option<Drawing>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let open = StoredValue::new_local(None::<SceneView>);
    let (ready, failed) = (RwSignal::new(false), RwSignal::new(None::<String>));
    let selected = RwSignal::new((None::<usize>, None::<usize>));
    let host = NodeRef::<Div>::new();
    let meet = move |met: Met| match met {
        Met::Point { index, .. } => selected.set((Some(index), None)),
        Met::Photo(index) => selected.set((None, Some(index))),
        Met::Nothing => selected.set((None, None)),
        Met::Lost => failed.set(Some(object::graphics_lost().to_owned())),
    };
    host.on_load(move |element| {
        spawn_local(async move {
            match SceneView::open(element.into(), meet).await {
                // A caller that has ended meanwhile does not need it: it closes when it is dropped.
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
    let with_view = move |act: &dyn Fn(&SceneView)| {
        open.try_with_value(|view| view.iter().for_each(act));
    };
    let made = Memo::new(move |_| drawing.with(|drawing| drawing.as_ref().map(scene)));
    Effect::new(move |_| {
        selected.set((None, None));
        made.with(|scene| {
            if let (true, Some(scene)) = (ready.get(), scene) {
                let pictures = vec![None; scene.photo_names.len()];
                with_view(&|view| view.show(scene, &pictures));
            }
        });
    });
    Effect::new(move |_| {
        let (point, photo) = selected.get();
        made.track();
        // Colours are the theme's: another one draws anew.
        desk.window.theme.track();
        if ready.get() {
            let shown = ["names", "photos", "grid", "perspective"].map(|name| (name, true));
            let not_shown = ["ellipsoids", "rays", "features", "deviations"].map(|name| (name, false));
            let shown = shown.into_iter().chain(not_shown).collect();
            let state =
                SceneState { selected: point, photo, chosen: Vec::new(), shown, factor: 1.0, sticks: 1.0, along: None };
            with_view(&|view| view.state(&state));
        }
    });
    view! {
        <section class="turned" aria-label=words::turned>
            <div class="toggles" role="toolbar" aria-label=object::seen_from>
                {SIDES.map(|(side, word)| view! {
                    <button class="toggle" data-side=side on:click=move |_| with_view(&|view| view.look(side))>{word}</button>
                }).collect_view()}
                <button class="toggle" on:click=move |_| with_view(&|view| view.look("fit"))>{text::fit}</button>
                <span class="hint">{object::how_to_move}</span>
            </div>
            <Show when=move || failed.with(Option::is_none) fallback=move || view! {
                <p class="note warn" role="alert">{move || words::not_turned(failed.get().unwrap_or_default())}</p>
            }>
                <div class="space-host" node_ref=host tabindex="0" role="application" aria-label=object::space_label></div>
            </Show>
        </section>
    }
}
