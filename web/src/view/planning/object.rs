//! The plan's object where its points were given: typed or from a list, which way their targets face, what hides them, which are control.

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::project::PlanFace;
use sightline_exchange::encoding;

use crate::browser::{event, file};
use crate::document::Change;
use crate::edit::plan::{self, Facing};
use crate::format;
use crate::i18n::planning as words;
use crate::i18n::{errors, text};
use crate::store::Desk;
use crate::view::components::field::Field;
use crate::view::components::icon::{Glyph, Icon};

/// Maximum number of points that are shown as text.
const SHOWN: usize = 1000;

/// Opens the chooser for a list of points: a new plan of them, or other points of the present plan.
pub fn choose_points(desk: Desk) {
    file::choose(".csv,.txt,.tsv,.xyz,text/*", false, move |files| {
        let Some(list) = files.into_iter().next() else { return };
        spawn_local(async move {
            match list.content.read().await {
                Ok(bytes) => match encoding::text(&bytes) {
                    Ok(content) => desk.take_plan_points(&content),
                    Err(error) => desk.warn_error(error),
                },
                Err(detail) => desk.warn_here(move || text::unreadable(&detail)),
            }
        });
    });
}

/// Points as text, a line each, to be typed and pasted.
#[component]
pub fn Points() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let shown = Signal::derive(move || {
        desk.document.with(|d| {
            let plan = d.project.plan.as_deref();
            plan.filter(|plan| plan.form.is_none() && plan.points.len() <= SHOWN)
                .map_or(String::new(), |plan| plan::points_text(plan, d.project.shown_axes()))
        })
    });
    view! {
        <label class="points-text">
            <span>{words::points_list}</span>
            <textarea name="plan-points" rows="5" spellcheck="false" placeholder=move || words::points_hint(desk.axes().list()) prop:value=shown
                on:change=move |e| {
                    let typed = event::value(&e);
                    if !typed.trim().is_empty() {
                        desk.take_plan_points(&typed);
                    }
                }></textarea>
        </label>
        <button class="button small" data-action="points-file" on:click=move |_| choose_points(desk)>{words::points_file}</button>
    }
}

/// Diameter and facing of given targets.
#[component]
pub fn Targets() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let diameter = Signal::derive(move || {
        let first = desk.document.with(|d| d.project.plan.as_ref().and_then(|plan| plan.points.first()?.diameter));
        first.map_or(String::new(), format::editable)
    });
    let commit = move |typed: String| {
        let value = format::parse(&typed).filter(|v| *v > 0.0 && *v < 1e9);
        if value.is_none() && !typed.trim().is_empty() {
            return desk.warn_here(move || errors::refusal(&typed, text::not_a_length));
        }
        desk.edit_plan(Change::PlanEdited, |p| plan::set_diameter(p, value));
    };
    let facing = Memo::new(move |_| desk.document.with(|d| d.project.plan.as_deref().and_then(plan::facing)));
    let choices =
        [(Facing::Every, "every"), (Facing::Front, "front"), (Facing::Up, "up"), (Facing::Outward, "outward")];
    let label = move |way: Facing| match way {
        Facing::Every => words::facing_every().to_owned(),
        Facing::Front => words::facing_front(desk.axes().letter(1)),
        Facing::Up => words::facing_up(desk.axes().letter(2)),
        Facing::Outward => words::facing_outward().to_owned(),
    };
    view! {
        <label class="field">
            <span>{words::diameter}</span>
            <Field value=diameter commit attr:name="target-diameter" attr:inputmode="decimal" attr:placeholder=words::not_known/>
        </label>
        <label class="field">
            <span>{words::facing}</span>
            <select name="facing" on:change=move |e| {
                let name = event::value(&e);
                if let Some((way, _)) = choices.iter().find(|(_, n)| *n == name) {
                    let way = *way;
                    desk.edit_plan(Change::PlanEdited, |p| plan::set_facing(p, way));
                }
            }>
                {choices.map(|(way, name)| view! {
                    <option value=name selected=move || facing.get() == Some(way)>{move || label(way)}</option>
                })}
                <Show when=move || facing.get().is_none()>
                    <option value="own" selected=true>{words::facing_own}</option>
                </Show>
            </select>
        </label>
    }
}

/// Faces that hide what is behind them.
#[component]
pub fn Faces() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let given = move || desk.document.with(|d| d.project.plan.as_ref().map_or(Vec::new(), |p| p.faces.clone()));
    let rows = move || {
        let row = |(k, face): (usize, PlanFace)| {
            let told = face.corner.map(format::compact).join(", ");
            let sides =
                [face.along, face.across].map(|v| v.iter().map(|x| x * x).sum::<f64>().sqrt()).map(format::compact);
            view! {
                <li>
                    <span>{told} ": " {sides.join(" × ")}</span>
                    <button class="icon-button small" aria-label=words::remove on:click=move |_| {
                        desk.edit_plan(Change::PlanEdited, |plan| if k < plan.faces.len() { plan.faces.remove(k); });
                    }><Glyph icon=Icon::Cross size=12/></button>
                </li>
            }
        };
        // A form's own faces come and go with it.
        let own = desk.document.with(|d| d.project.plan.as_ref().map_or(0, |plan| plan::faces_of_form(plan)));
        given().into_iter().enumerate().skip(own).map(row).collect_view()
    };
    let commit = move |typed: String| match plan::face(&numbers(&typed)) {
        Some(face) => desk.edit_plan(Change::PlanEdited, |plan| plan.faces.push(face)),
        None if typed.trim().is_empty() => {}
        None => desk.warn_here(|| words::face_hint().to_owned()),
    };
    view! {
        <h2 class="section-head"><span>{words::hiding_faces}</span></h2>
        <ul class="regions">{rows}</ul>
        <div class="fields">
            <label class="field"><span>{words::add_region}</span>
                <Field value=Signal::derive(String::new) commit attr:name="face" attr:placeholder=words::face_hint/>
            </label>
        </div>
    }
}

/// Which points are control points, and how well they are known.
#[component]
pub fn Control() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let known = Signal::derive(move || {
        desk.document.with(|d| d.project.plan.as_deref().map_or(String::new(), |plan| plan::control(plan).join(", ")))
    });
    let sigma = Signal::derive(move || {
        let first = desk.document.with(|d| d.project.plan.as_deref().and_then(plan::control_sigma));
        first.map_or(String::new(), format::editable)
    });
    let commit = move |typed: String| {
        let names: Vec<String> =
            typed.split([',', ';', ' ']).map(str::trim).filter(|n| !n.is_empty()).map(str::to_owned).collect();
        let Some(mut trial) = untrack(|| desk.plan()) else { return };
        match plan::set_control(&mut trial, &names) {
            Ok(()) => desk.edit_plan(Change::PlanEdited, |plan| *plan = trial),
            Err(error) => desk.warn_here(move || errors::sentence(&error)),
        }
    };
    let commit_sigma = move |typed: String| {
        let value = format::parse(&typed).filter(|v| *v >= 0.0);
        if value.is_none() && !typed.trim().is_empty() {
            return desk.warn_here(move || errors::refusal(&typed, text::not_a_length));
        }
        desk.edit_plan(Change::PlanEdited, |p| plan::set_control_sigma(p, value.filter(|v| *v > 0.0)));
    };
    view! {
        <label class="field">
            <span>{words::control_points}</span>
            <Field value=known commit attr:name="control" attr:placeholder=words::no_bar/>
        </label>
        <Show when=move || !known.with(String::is_empty)>
            <label class="field">
                <span>{words::control_sigma}</span>
                <Field value=sigma commit=commit_sigma attr:name="control-sigma" attr:inputmode="decimal" attr:placeholder=words::free_of_error/>
            </label>
        </Show>
    }
}

/// The numbers of a line.
pub fn numbers(typed: &str) -> Vec<f64> {
    let parts = typed.split([',', ';', ' ', '…']).map(str::trim).filter(|part| !part.is_empty());
    // One that is none leaves too few.
    parts.map_while(format::parse).collect()
}
