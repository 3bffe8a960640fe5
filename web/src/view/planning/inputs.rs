//! Inputs of the plan: object, camera, required accuracy.

use leptos::prelude::*;
use sightline::project::{Camera, DatumKind, Form, Plan};
use sightline_protocol::PlanOf;

use super::camera::KnownCameras;
use super::frame::ENDLESS;
use super::object::{Control, Faces, Points, Targets, choose_points, numbers};
use crate::browser::event;
use crate::document::Change;
use crate::edit::control::{Unit, has_lengths};
use crate::edit::plan;
use crate::format;
use crate::i18n::planning as words;
use crate::i18n::{Text, errors, text};
use crate::store::Desk;
use crate::view::components::field::Field;
use crate::view::components::icon::{Glyph, Icon};

/// The ways to begin.
#[component]
pub fn Beginnings() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let forms: [(&str, Text); 3] =
        [("plane", words::form_plane), ("box", words::form_box), ("cylinder", words::form_cylinder)];
    let papers: [(&str, Text); 4] = [
        ("lee-structure", words::example_lee_structure),
        ("lee-calibration", words::example_lee_calibration),
        ("kang", words::example_kang),
        ("kim", words::example_kim),
    ];
    let fresh = Memo::new(move |_| desk.document.with(|d| !has_lengths(&d.project)));
    let measured = Memo::new(move |_| desk.document.with(|d| d.project.points.iter().any(|p| p.xyz.is_some())));
    view! {
        <section class="begin">
            <h2>{words::begin_with}</h2>
            <p class="hint">{words::begin_words}</p>
            <Show when=move || fresh.get()>
                <label class="field unit-to-begin">
                    <span>{words::unit}</span>
                    <select name="unit" on:change=move |e| desk.planning.unit.set(event::value(&e))>
                        {Unit::ALL.map(Unit::symbol).map(|name| view! {
                            <option value=name selected=move || desk.planning.unit.with(|u| u == name)>{name}</option>
                        })}
                    </select>
                </label>
            </Show>
            <div class="row">
                {forms.map(|(kind, label)| view! {
                    <button class="button large" data-form=kind on:click=move |_| desk.begin_plan(kind)>{label}</button>
                }).collect_view()}
                <button class="button large" data-form="list" on:click=move |_| choose_points(desk)>{words::points_file}</button>
                <Show when=move || measured.get()>
                    <button class="button large" data-form="project" on:click=move |_| {
                        let project = desk.document.with_untracked(|d| (*d.project).clone());
                        desk.begin_plan_from(PlanOf::Project(Box::new(project)));
                    }>{words::from_project}</button>
                </Show>
            </div>
            {papers.map(|(name, label)| view! {
                <button class="entry" data-example=name on:click=move |_| desk.begin_plan_from(PlanOf::Example(name.to_owned()))>
                    <b>{label}</b>
                    <Glyph icon=Icon::Arrow/>
                </button>
            }).collect_view()}
            <Points/>
        </section>
    }
}

/// A number of the plan, or nothing where that is allowed; what cannot be is refused.
#[component]
fn Number(
    label: Text,
    name: &'static str,
    #[prop(optional)] unit: Option<&'static str>,
    #[prop(optional)] own_unit: bool,
    #[prop(optional)] empty: Option<Text>,
    read: fn(&Plan) -> Option<f64>,
    write: fn(&mut Plan, Option<f64>) -> bool,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let value = Signal::derive(move || {
        desk.document.with(|d| d.project.plan.as_deref().and_then(read).map_or(String::new(), format::editable))
    });
    let unit = move || {
        if own_unit { desk.document.with(|d| d.project.unit.clone()) } else { unit.unwrap_or_default().to_owned() }
    };
    let commit = move |typed: String| {
        let value = format::parse(&typed).filter(|v| v.is_finite());
        let nothing = typed.trim().is_empty() && empty.is_some();
        let Some(mut trial) = untrack(|| desk.plan()) else { return };
        if (value.is_some() || nothing) && write(&mut trial, value) {
            desk.edit_plan(Change::PlanEdited, |plan| *plan = trial);
        } else {
            desk.warn_here(move || errors::refusal(&typed, text::not_a_length));
        }
    };
    let placeholder = move || empty.map_or("", |words| words());
    view! {
        <label class="field">
            <span>{label}" "<u>{unit}</u></span>
            <Field value commit attr:name=name attr:inputmode="decimal" attr:placeholder=placeholder/>
        </label>
    }
}

/// A number of the form.
#[component]
fn FormNumber(
    #[prop(optional)] label: Option<Text>,
    /// Along which axis it is measured, in place of a label.
    #[prop(optional)]
    along: Option<usize>,
    name: &'static str,
    #[prop(optional)] counts: bool,
    read: fn(&Form) -> Option<f64>,
    write: fn(&mut Form, f64),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let words = move || match (along, label) {
        (Some(axis), _) => words::length_along(desk.axes().letter(axis)),
        (None, label) => label.map_or(String::new(), |label| label().to_owned()),
    };
    let form = move || desk.document.with(|d| d.project.plan.as_ref().and_then(|plan| plan.form));
    let value = Signal::derive(move || form().and_then(|f| read(&f)).map_or(String::new(), format::editable));
    let commit = move |typed: String| {
        let Some(mut trial) = untrack(form) else { return };
        let number = format::parse(&typed).filter(|v| v.is_finite());
        if let Some(number) = number {
            write(&mut trial, number);
        }
        if number.is_none() || !plan::is_form(&trial) {
            return desk.warn_here(move || match counts {
                true => errors::refusal(&typed, text::not_a_count),
                false => errors::refusal(&typed, text::not_a_length),
            });
        }
        match sightline_plan::check_form(&trial) {
            Ok(()) => desk.edit_plan(Change::PlanEdited, |plan| plan::set_form(plan, trial)),
            Err(error) => desk.warn_here(move || errors::sentence(&error)),
        }
    };
    view! {
        <label class="field"><span>{words}</span><Field value commit attr:name=name attr:inputmode="decimal"/></label>
    }
}

/// A size, a count, of whatever form has it.
macro_rules! of_form {
    ($($form:ident)|+, $field:ident) => {
        |form| match form {
            $(Form::$form { $field, .. })|+ => Some(f64::from(*$field)),
            #[allow(unreachable_patterns)]
            _ => None,
        }
    };
}
macro_rules! to_form {
    ($($form:ident)|+, $field:ident, $value:ident => $new:expr) => {
        |form, $value| match form {
            $(Form::$form { $field, .. })|+ => *$field = $new,
            #[allow(unreachable_patterns)]
            _ => {}
        }
    };
}

fn size_of(form: &Form, axis: usize) -> Option<f64> {
    if let Form::Box { size, .. } = form { Some(size[axis]) } else { None }
}

fn set_size(form: &mut Form, axis: usize, value: f64) {
    if let Form::Box { size, .. } = form {
        size[axis] = value;
    }
}

#[component]
fn FormTick(label: Text, name: &'static str, read: fn(&Form) -> bool, write: fn(&mut Form, bool)) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let form = move || desk.document.with(|d| d.project.plan.as_ref().and_then(|plan| plan.form));
    view! {
        <label class="tick">
            <input type="checkbox" name=name prop:checked=move || form().is_some_and(|f| read(&f)) on:change=move |e| {
                if let Some(mut trial) = untrack(form) {
                    write(&mut trial, event::checked(&e));
                    desk.edit_plan(Change::PlanEdited, |plan| plan::set_form(plan, trial));
                }
            }/>
            <span>{label}</span>
        </label>
    }
}

/// Everything that a plan is made of, except its stations.
#[component]
pub fn Inputs() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <ObjectInputs/>
        <Faces/>
        <CameraInputs/>
        <GoalInputs/>
        <Regions/>
        <div class="fields">
            <button class="button" data-action="remove-plan" on:click=move |_| desk.remove_plan()>{words::remove_plan}</button>
        </div>
    }
}

/// The form of the object with its targets, or its points; the scale bar.
#[component]
fn ObjectInputs() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let kind = Memo::new(move |_| {
        desk.document.with(|d| match d.project.plan.as_ref().and_then(|plan| plan.form) {
            Some(Form::Plane { .. }) => "plane",
            Some(Form::Box { .. }) => "box",
            Some(Form::Cylinder { .. }) => "cylinder",
            None => "given",
        })
    });
    let count = move || desk.document.with(|d| d.project.plan.as_ref().map_or(0, |plan| plan.points.len()));
    let fields = move || {
        match kind.get() {
        "plane" => view! {
            <FormNumber label=words::width name="width" read=of_form!(Plane, width) write=to_form!(Plane, width, v => v)/>
            <FormNumber label=words::height name="height" read=of_form!(Plane, height) write=to_form!(Plane, height, v => v)/>
            <FormTick label=words::upright name="upright" read=|f| matches!(f, Form::Plane { upright: true, .. })
                write=|f, on| if let Form::Plane { upright, .. } = f { *upright = on }/>
        }
        .into_any(),
        "box" => view! {
            <FormNumber along=0 name="size-x" read=|f| size_of(f, 0) write=|f, v| set_size(f, 0, v)/>
            <FormNumber along=1 name="size-y" read=|f| size_of(f, 1) write=|f, v| set_size(f, 1, v)/>
            <FormNumber along=2 name="size-z" read=|f| size_of(f, 2) write=|f, v| set_size(f, 2, v)/>
        }
        .into_any(),
        "cylinder" => view! {
            <FormNumber label=words::radius name="radius" read=of_form!(Cylinder, radius) write=to_form!(Cylinder, radius, v => v)/>
            <FormNumber label=words::height name="height" read=of_form!(Cylinder, height) write=to_form!(Cylinder, height, v => v)/>
            <FormNumber label=words::sweep name="sweep" read=|f| if let Form::Cylinder { sweep, .. } = f { Some((1e3 * sweep.to_degrees()).round() / 1e3) } else { None }
                write=to_form!(Cylinder, sweep, v => v.clamp(0.0, 360.0).to_radians())/>
            <FormTick label=words::inside name="inside" read=|f| matches!(f, Form::Cylinder { inside: true, .. })
                write=|f, on| if let Form::Cylinder { inside, .. } = f { *inside = on }/>
        }
        .into_any(),
        _ => view! { <Points/><Targets/> }.into_any(),
    }
    };
    view! {
        <h2 class="section-head"><span>{words::object}</span><span class="aside">{move || words::targets_count(format::count(count()))}</span></h2>
        <div class="fields">
            {fields}
            <Show when=move || kind.get() != "given">
                <FormNumber label=words::columns name="columns" counts=true read=of_form!(Plane | Box | Cylinder, columns)
                    write=to_form!(Plane | Box | Cylinder, columns, v => plan::counted(v))/>
                <FormNumber label=words::rows name="rows" counts=true read=of_form!(Plane | Box | Cylinder, rows)
                    write=to_form!(Plane | Box | Cylinder, rows, v => plan::counted(v))/>
                <FormNumber label=words::diameter name="diameter" read=of_form!(Plane | Box | Cylinder, diameter)
                    write=to_form!(Plane | Box | Cylinder, diameter, v => v)/>
            </Show>
            <Number label=words::bar name="bar" own_unit=true empty=words::no_bar
                read=|p| p.distances.first().map(|d| d.sigma)
                write=|p, v| {
                    let fits = v.is_none_or(|v| v > 0.0);
                    if fits { plan::set_bar(p, v); }
                    fits
                }/>
        </div>
    }
}

/// The camera with its lens, and the standard error of its observations.
#[component]
fn CameraInputs() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let calibrates = move || desk.document.with(|d| d.project.plan.as_deref().is_some_and(plan::calibrates));
    view! {
        <h2 class="section-head"><span>{words::camera}</span></h2>
        <div class="fields">
            <KnownCameras/>
            <Number label=words::principal_distance name="c" unit="mm" read=principal_distance write=set_principal_distance/>
            <Number label=words::sensor_width name="sensor-width" unit="px" read=|p| Some(f64::from(p.cameras.first()?.width))
                write=|p, v| set_size_px(p, v, |camera| &mut camera.width)/>
            <Number label=words::sensor_height name="sensor-height" unit="px" read=|p| Some(f64::from(p.cameras.first()?.height))
                write=|p, v| set_size_px(p, v, |camera| &mut camera.height)/>
            <Number label=words::pitch name="pitch" unit="µm" read=|p| Some(1000.0 * p.cameras.first()?.pixel_pitch?[0]) write=set_pitch/>
            <Number label=words::f_number name="f-number" empty=words::all_sharp read=|p| p.lens.f_number
                write=|p, v| { p.lens.f_number = v; v.is_none_or(|v| v > 0.0) }/>
            <Number label=words::focus name="focus" own_unit=true empty=words::all_sharp read=|p| p.lens.focus
                write=|p, v| { p.lens.focus = v; v.is_none_or(|v| v > 0.0) }/>
            <Number label=words::circle name="circle" unit="px" read=|p| Some(p.lens.circle_px)
                write=|p, v| { p.lens.circle_px = v.unwrap_or(0.0); p.lens.circle_px > 0.0 }/>
            <Number label=words::sigma name="sigma" unit="px" read=|p| Some(p.sigma)
                write=|p, v| { p.sigma = v.unwrap_or(0.0); p.sigma > 0.0 && p.sigma < 1e3 }/>
            <label class="tick">
                <input type="checkbox" name="calibrates" prop:checked=calibrates on:change=move |e| {
                    let on = event::checked(&e);
                    desk.edit_plan(Change::PlanEdited, |p| plan::set_calibrates(p, on));
                }/>
                <span>{words::calibrates}</span>
            </label>
        </div>
    }
}

/// Required accuracy, limits and datum of the plan.
#[component]
fn GoalInputs() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let with = move |read: fn(&Plan) -> bool| desk.document.with(|d| d.project.plan.as_deref().is_some_and(read));
    let controlled = Memo::new(move |_| {
        desk.document.with(|d| {
            let control = |p: &sightline::project::Point| p.role == sightline::project::Role::Control;
            d.project.plan.as_ref().is_some_and(|plan| plan.points.iter().any(control))
        })
    });
    view! {
        <h2 class="section-head"><span>{words::goal}</span></h2>
        <div class="fields">
            <Number label=words::precision name="precision" own_unit=true read=|p| Some(p.wanted.precision)
                write=|p, v| { p.wanted.precision = v.unwrap_or(0.0); p.wanted.precision > 0.0 }/>
            <Number label=words::probability name="probability" unit="%" read=|p| Some((1e5 * p.wanted.probability).round() / 1e3)
                write=|p, v| { p.wanted.probability = v.unwrap_or(0.0) / 100.0; (0.5..=0.999).contains(&p.wanted.probability) }/>
            <Number label=words::incidence name="incidence" unit="°" read=|p| Some((1e3 * p.max_incidence.to_degrees()).round() / 1e3)
                write=|p, v| { p.max_incidence = v.unwrap_or(0.0).to_radians(); p.max_incidence > 0.0 && p.max_incidence < 1.57 }/>
            <Number label=words::least_px name="least-px" unit="px" read=|p| Some(p.least_px)
                write=|p, v| { p.least_px = v.unwrap_or(-1.0); p.least_px >= 0.0 }/>
            <label class="field">
                <span>{words::datum}</span>
                <select name="datum" on:change=move |e| {
                    let kind = match event::value(&e).as_str() {
                        "minimal" => DatumKind::Minimal,
                        "control" => DatumKind::Control,
                        _ => DatumKind::Free,
                    };
                    desk.edit_plan(Change::PlanEdited, |p| plan::set_datum(p, kind));
                }>
                    <option value="free" selected=move || with(|p| p.datum.kind == DatumKind::Free)>{words::datum_free}</option>
                    <option value="minimal" selected=move || with(|p| p.datum.kind == DatumKind::Minimal)>{words::datum_minimal}</option>
                    <Show when=move || controlled.get()>
                        <option value="control" selected=move || with(|p| p.datum.kind == DatumKind::Control)>{words::datum_control}</option>
                    </Show>
                </select>
            </label>
            <Control/>
        </div>
    }
}

/// In millimetres.
fn principal_distance(plan: &Plan) -> Option<f64> {
    let camera = plan.cameras.first()?;
    let model = camera.interior.model();
    let distance = camera.interior.get(model.distance)?;
    Some(if model.in_photo_units { distance } else { distance * camera.pitch()[0] })
}

fn set_principal_distance(plan: &mut Plan, value: Option<f64>) -> bool {
    let (Some(value), Some(camera)) = (value.filter(|v| *v > 0.0), plan.cameras.first_mut()) else { return false };
    let pitch = camera.pitch()[0];
    let model = camera.interior.model();
    camera.interior.set(model.distance, if model.in_photo_units { value } else { value / pitch });
    true
}

fn set_pitch(plan: &mut Plan, value: Option<f64>) -> bool {
    let (Some(value), Some(camera)) = (value.filter(|v| *v > 0.0), plan.cameras.first_mut()) else { return false };
    camera.pixel_pitch = Some([value / 1000.0; 2]);
    true
}

fn set_size_px(plan: &mut Plan, value: Option<f64>, side: fn(&mut Camera) -> &mut u32) -> bool {
    let value = value.filter(|v| (16.0..=100_000.0).contains(v));
    let (Some(value), Some(camera)) = (value, plan.cameras.first_mut()) else { return false };
    *side(camera) = value.round() as u32;
    true
}

/// Regions without access.
#[component]
fn Regions() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rows = move || {
        let axes = desk.axes();
        let regions = desk.document.with(|d| d.project.plan.as_ref().map_or(Vec::new(), |p| p.forbidden.clone()));
        let row = |region: sightline::project::Region| {
            let corner = |c: [f64; 3]| axes.shown(c).map(format::compact).join(", ");
            // Drawn in one view, it reaches from end to end of the others.
            let within = |k: &usize| region.high[*k] < ENDLESS || region.low[*k] > -ENDLESS;
            let bounded: Vec<usize> = axes.order().into_iter().filter(within).collect();
            let told = if bounded.len() == 3 {
                format!("{} … {}", corner(region.low), corner(region.high))
            } else {
                let side = |k: &usize| {
                    format!(
                        "{} {} … {}",
                        axes.letter(*k),
                        format::compact(region.low[*k]),
                        format::compact(region.high[*k])
                    )
                };
                bounded.iter().map(side).collect::<Vec<_>>().join(", ")
            };
            view! {
                <li>
                    <span>{told}</span>
                    <button class="icon-button small" aria-label=words::remove on:click=move |_| {
                        desk.edit_plan(Change::PlanEdited, |plan| plan.forbidden.retain(|r| *r != region));
                    }><Glyph icon=Icon::Cross size=12/></button>
                </li>
            }
        };
        regions.into_iter().map(row).collect_view()
    };
    let commit = move |typed: String| match plan::region(&numbers(&typed)) {
        Some(region) => desk.edit_plan(Change::PlanEdited, |plan| plan.forbidden.push(region)),
        None if typed.trim().is_empty() => {}
        None => desk.warn_here(|| words::forbidden_hint().to_owned()),
    };
    view! {
        <h2 class="section-head"><span>{words::forbidden}</span></h2>
        <ul class="regions">{rows}</ul>
        <div class="fields">
            <label class="field"><span>{words::add_region}</span>
                <Field value=Signal::derive(String::new) commit attr:name="region" attr:placeholder=words::forbidden_hint/>
            </label>
            <button class="button" data-action="fence" class:chosen=move || desk.planning.fencing.get()
                aria-pressed=move || desk.planning.fencing.get().to_string()
                on:click=move |_| desk.planning.fencing.update(|on| *on = !*on)>{words::draw_region}</button>
            <Show when=move || desk.planning.fencing.get()><p class="note">{words::draw_region_hint}</p></Show>
        </div>
    }
}
