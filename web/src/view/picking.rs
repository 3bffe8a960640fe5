//! The action of a click in a photo, the same at every step: select the target, measure, or place freely.

use leptos::html::Input;
use leptos::prelude::*;
use sightline::detection::Target;

use super::photo_view::{Click, Mark, Style};
use crate::browser::event;
use crate::edit::points::observation_of;
use crate::i18n::text;
use crate::store::Desk;
use crate::store::identity::PhotoPlace;

/// Takes the nearest target, with the name it has, or the nearest observation; elsewhere it measures where it is. With Alt,
/// or while points are placed freely, the place itself is taken.
pub fn pick(desk: Desk, click: Click) {
    let Some(photo) = desk.selection.with_untracked(|s| s.photo.clone()) else { return };
    if click.free {
        if click.inside && desk.measuring.series.with_untracked(Option::is_some) {
            desk.take_in_series(&photo, PhotoPlace::Spot([click.u, click.v]));
        } else if click.inside {
            desk.choose_spot(&photo, [click.u, click.v]);
        }
        return;
    }
    let (point, target) = desk.document.with_untracked(|d| {
        let targets = d.detections.get(&photo).map(|d| d.targets.as_slice()).unwrap_or_default();
        let Some(target) = nearest(targets, click) else {
            let distance = |u: f64, v: f64| (u - click.u).hypot(v - click.v);
            let here = d.project.observations.iter().filter(|o| o.photo == photo && distance(o.u, o.v) <= click.reach);
            let free = here.min_by(|a, b| distance(a.u, a.v).total_cmp(&distance(b.u, b.v)));
            return (free.map(|o| o.point.clone()), None);
        };
        (observation_of(&d.project, &photo, targets[target].id).map(|o| o.point.clone()), Some(target))
    });
    let nothing = point.is_none() && target.is_none();
    if desk.measuring.series.with_untracked(Option::is_some) && point.is_none() {
        // The point that is looked for stays chosen while its next place is measured.
        match target {
            Some(target) => desk.take_in_series(&photo, PhotoPlace::Target(target)),
            None if click.inside => desk.measure_at(&photo, click.u, click.v),
            None => {}
        }
        return;
    }
    desk.choose_in_photo(&photo, target, point);
    if nothing && click.inside {
        desk.measure_at(&photo, click.u, click.v);
    }
}

/// The target whose centre or outline is nearest to a click, within reach.
fn nearest(targets: &[Target], click: Click) -> Option<usize> {
    let distance = |t: &Target| (t.u - click.u).hypot(t.v - click.v);
    let near = |(_, t): &(usize, &Target)| distance(t) <= click.reach.max(t.major / 2.0);
    let all = targets.iter().enumerate().filter(near);
    all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map(|(i, _)| i)
}

/// The target that is chosen: by its place in the list, or by the observation that lies on it.
pub fn chosen_target(desk: Desk) -> Option<Target> {
    let (photo, target) = desk.selection.with(|s| (s.photo.clone(), s.target));
    let photo = photo?;
    if let Some(target) = target {
        return desk.document.with(|d| d.detections.get(&photo)?.targets.get(target).cloned());
    }
    let number = desk.chosen_observation()?.target?;
    desk.document.with(|d| d.detections.get(&photo)?.target(number).cloned())
}

/// The place that waits for a name, as a mark.
pub fn spot_mark(desk: Desk) -> Option<Mark> {
    let [u, v] = desk.selection.with(|s| s.spot)?;
    Some(Mark { u, v, major: 0.0, minor: 0.0, angle: 0.0, label: None, strong: false, style: Style::Selected })
}

/// Asks for the name of a target or place that has none; what is typed after the click goes into the field.
#[component]
pub fn Question(
    /// Whether targets are asked for too, or only places set by hand.
    #[prop(default = true)]
    targets: bool,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let typed = RwSignal::new(String::new());
    let input = NodeRef::<Input>::new();
    let asked = Memo::new(move |_| {
        if desk.asked_question().is_some() {
            return None;
        }
        desk.selection.with(|s| {
            let asked = match (s.target.filter(|_| targets && s.point.is_none()), s.spot) {
                (_, Some(spot)) => PhotoPlace::Spot(spot),
                (Some(target), None) => PhotoPlace::Target(target),
                (None, None) => return None,
            };
            Some((s.photo.clone()?, asked))
        })
    });
    let take = move || {
        if let Some((photo, asked)) = asked.get_untracked() {
            let name = typed.get_untracked();
            let name = if name.trim().is_empty() { desk.free_name() } else { name };
            desk.name_place(&photo, asked, &name);
        }
    };
    // What was typed for one target is not offered for the next.
    Effect::new(move |_| {
        let asked = asked.get();
        typed.set(String::new());
        if let (Some(_), Some(input)) = (asked, input.get()) {
            let _ = input.focus();
        }
    });
    let words = move || match asked.get() {
        Some((_, PhotoPlace::Spot(_))) => text::name_this_place(),
        _ => text::name_this_target(),
    };
    view! {
        <Show when=move || asked.with(Option::is_some)>
            <form class="question" on:submit=move |e| {
                e.prevent_default();
                take();
            }>
                <label>
                    <span>{words}</span>
                    <input id="target-name" type="text" autocomplete="off" node_ref=input placeholder=move || untrack(|| desk.free_name())
                        prop:value=typed on:input=move |e| typed.set(event::value(&e))/>
                </label>
                <button class="button small" type="submit">{text::take_name}</button>
                <button class="button small cancel" type="button" on:click=move |_| desk.ask_no_more()>{text::cancel}</button>
            </form>
        </Show>
    }
}
