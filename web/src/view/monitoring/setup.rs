//! The epochs to compare, and their data.

use leptos::prelude::*;
use sightline::monitoring::{ControlUse, Epoch};
use sightline::project::DatumKind;
use sightline::units::Unit;

use super::options::Options;
use crate::browser::{event, file};
use crate::format;
use crate::i18n::{errors, monitoring as words, text};
use crate::store::Desk;
use crate::store::intake::problem_sentence;
use crate::store::monitoring::{EpochEntry, SAMPLE};
use crate::view::components::field::Field;
use crate::view::components::icon::{Glyph, Icon};
use crate::view::components::progress::Progress;

#[component]
pub fn Setup() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let failure = move || {
        monitored.failure.get().map(|error| {
            view! {
                <div class="epochs-failure" role="alert" tabindex="-1" data-found="failure">
                    <Glyph icon=Icon::Warning/> <p><b>{words::not_compared}</b> " " {errors::sentence(&error)}</p>
                </div>
            }
        })
    };
    let problems = move || {
        let all = monitored.problems.get();
        (!all.is_empty()).then(|| view! {
            <div class="epochs-failure" role="alert" data-found="problems">
                <Glyph icon=Icon::Warning/>
                <div><p><b>{words::not_taken}</b></p>
                <ul>{all.into_iter().map(|p| view! { <li><b>{p.file}</b> ": " {problem_sentence(&p.reason)}</li> }).collect_view()}</ul></div>
                <button class="icon-button" aria-label=text::dismiss on:click=move |_| monitored.problems.set(Vec::new())><Glyph icon=Icon::Cross size=14/></button>
            </div>
        })
    };
    let entries = move || {
        let all = monitored.epochs.get();
        let count = all.len();
        all.into_iter().enumerate().map(|(k, entry)| view! { <EpochRow k entry count/> }).collect_view()
    };
    let some = Memo::new(move |_| monitored.epochs.with(|all| !all.is_empty()));
    let lists = Memo::new(move |_| monitored.epochs.with(|all| all.iter().any(EpochEntry::is_list)));
    let few = Memo::new(move |_| monitored.epochs.with(|all| all.len() < 2));
    view! {
        <main class="epochs-setup scroll" tabindex="0" aria-label=words::setup>
            {failure}{problems}
            <section class="panel">
                <h2 class="section-head"><span>{words::epochs}</span></h2>
                <Show when=move || some.get()>
                    <div class="scroll-x">
                    <table class="table epochs-table">
                        <thead><tr>
                            <th>{words::number}</th><th class="left">{words::name}</th><th class="left">{words::date}</th><th>{words::points}</th>
                            <th>"σ₀"</th><th>{words::redundancy}</th><th class="left">{words::unit}</th><th class="left">{words::own_scale}</th>
                            <th>{words::temperature}</th><th class="left">{words::source}</th><td class="left wide"></td>
                        </tr></thead>
                        <tbody>{entries}</tbody>
                    </table>
                    </div>
                </Show>
                <Show when=move || few.get()><p class="hint">{words::two_needed}</p></Show>
                <Show when=move || lists.get()><p class="hint">{words::details_hint}</p></Show>
                <div class="row epochs-add">
                    <KeptChoice/>
                    <button class="button" data-action="add-files" on:click=move |_| {
                        file::choose(".sightline,.zip,.json,.csv,.txt,.tsv,.dat", true, move |files| desk.take_epochs(files));
                    }>{words::add_files}</button>
                </div>
                <p class="hint">{words::files_words}</p>
                <Show when=move || !some.get()>
                    <button class="sample" data-open="sample-epochs" disabled=move || desk.tasks.job.with(Option::is_some) on:click=move |_| desk.open_sample_epochs()>
                        <span><b>{words::sample}</b><span>{words::sample_words}</span></span>
                        <Glyph icon=Icon::Arrow/>
                    </button>
                    <div class="slot start-slot narrow-only"><Progress/></div>
                </Show>
            </section>
            <Show when=move || some.get()><Options/></Show>
        </main>
    }
}

/// The projects of this browser that are not in the list.
#[component]
fn KeptChoice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let offered = move || {
        let taken = monitored.epochs.with(|all| all.iter().filter_map(|e| e.key.clone()).collect::<Vec<_>>());
        let all = desk.shelf.projects.get().unwrap_or_default();
        let open = |p: &crate::store::shelf::Shelved| !taken.contains(&p.id) && !p.unreadable && p.card.photos > 0;
        all.into_iter().filter(open).map(|p| (p.id, p.card.name)).collect::<Vec<_>>()
    };
    view! {
        {move || {
            let offered = offered();
            (!offered.is_empty()).then(|| {
                let names = StoredValue::new(offered.clone());
                view! {
                    <label class="kept-choice"><span>{words::add_project}</span>
                        <select name="kept-epoch" on:change=move |e| {
                            let key = event::value(&e);
                            event::choose_first(&e);
                            if let Some((key, name)) = names.with_value(|all| all.iter().find(|(id, _)| *id == key).cloned()) {
                                monitored.problems.set(Vec::new());
                                desk.add_kept_epoch(key, name);
                            }
                        }>
                            <option value="">{words::choose_project}</option>
                            {offered.into_iter().map(|(id, name)| {
                                let name = if name.is_empty() { text::without_name().to_owned() } else { name };
                                view! { <option value=id>{name}</option> }
                            }).collect_view()}
                        </select>
                    </label>
                }
            })
        }}
    }
}

/// The row of an epoch: what can be edited of it calls `edit_epoch`.
#[derive(Clone, Copy)]
struct EpochEditor {
    desk: Desk,
    id: u64,
}

impl EpochEditor {
    fn edit(self, edit: impl FnOnce(&mut Epoch)) {
        self.desk.edit_epoch(self.id, edit);
    }

    fn rename(self, typed: &str) {
        let name = typed.trim().to_owned();
        let others = |all: &Vec<EpochEntry>| all.iter().any(|e| e.id != self.id && e.epoch.name == name);
        if name.is_empty() || self.desk.monitoring.epochs.with_untracked(others) {
            let typed = typed.to_owned();
            return self.desk.warn_here(move || text::name_taken(&typed));
        }
        self.edit(|epoch| epoch.name = name);
    }

    fn set_date(self, typed: String) {
        let date = Some(typed.trim().to_owned()).filter(|date| !date.is_empty());
        match date.as_deref().is_none_or(|date| sightline::monitoring::days(date).is_some()) {
            true => self.edit(|epoch| epoch.date = date),
            false => self.desk.warn_here(move || words::date_refused(&typed)),
        }
    }

    /// Takes a number; an empty field is an unknown one.
    fn number(self, set: fn(&mut Epoch, Option<f64>), positive: bool) -> Callback<String> {
        Callback::new(move |typed: String| {
            let value = format::parse(&typed).filter(|v| !positive || *v > 0.0);
            match value.is_some() || typed.trim().is_empty() {
                true => self.edit(|epoch| set(epoch, value)),
                false => self.desk.warn_here(move || words::number_refused(&typed)),
            }
        })
    }
}

/// A number as its field shows it.
fn typed_number(value: Option<f64>) -> Signal<String> {
    Signal::stored(value.map(format::editable).unwrap_or_default())
}

/// sigma0 and redundancy: typed for a list of points, else those of the adjustment.
fn statistics(editor: EpochEditor, entry: &EpochEntry) -> AnyView {
    let epoch = &entry.epoch;
    if entry.is_list() {
        let (sigma0, redundancy) = (typed_number(epoch.sigma0), typed_number(epoch.redundancy));
        return view! {
            <td class="typed" data-field="sigma0"><Field value=sigma0 commit=editor.number(|e, v| e.sigma0 = v, true)/></td>
            <td class="typed" data-field="redundancy"><Field value=redundancy commit=editor.number(|e, v| e.redundancy = v, true)/></td>
        }
        .into_any();
    }
    let adjusted = epoch.adjustment.as_ref();
    view! {
        <td>{format::maybe(adjusted.and_then(|a| a.sigma0), 3)}</td>
        <td>{adjusted.map(|a| format::count(a.redundancy)).unwrap_or_else(|| "–".to_owned())}</td>
    }
    .into_any()
}

/// Unit of length: chosen for a list of points, else that of the project.
fn unit_choice(editor: EpochEditor, entry: &EpochEntry) -> AnyView {
    let epoch = &entry.epoch;
    if entry.is_list() {
        let own = epoch.unit.clone().unwrap_or_default();
        let known: Vec<&'static str> = Unit::ALL.map(Unit::symbol).into();
        let foreign = (!own.is_empty() && !known.contains(&own.as_str())).then(|| own.clone());
        return view! {
            <select name="epoch-unit" aria-label=words::unit on:change=move |e| {
                let unit = Some(event::value(&e)).filter(|unit| !unit.is_empty());
                editor.edit(|epoch| epoch.unit = unit);
            }>
                <option value="" selected=own.is_empty()>"–"</option>
                {foreign.map(|unit| { let value = unit.clone(); view! { <option value=value selected=true>{unit}</option> } })}
                {known.into_iter().map(|unit| view! { <option value=unit selected=own == unit>{unit}</option> }).collect_view()}
            </select>
        }
        .into_any();
    }
    let own = epoch.project.as_ref().map(|p| p.unit.clone()).unwrap_or_default();
    let own = Unit::named(&own).map_or(own, |unit| unit.symbol().to_owned());
    view! { <span>{own}</span> }.into_any()
}

/// Whether the epoch has a scale of its own, for a list of points; whether control points keep their coordinates, for a project with
/// such a datum.
fn datum_choices(editor: EpochEditor, entry: &EpochEntry) -> impl IntoView + use<> {
    let epoch = &entry.epoch;
    let scale = entry.is_list().then(|| {
        let own = epoch.scale.unwrap_or(true);
        view! {
            <input type="checkbox" name="own-scale" aria-label=words::own_scale prop:checked=own on:change=move |e| {
                let on = event::checked(&e);
                editor.edit(|epoch| epoch.scale = (!on).then_some(false));
            }/>
        }
    });
    let by_control = epoch.project.as_ref().is_some_and(|p| p.datum.kind == DatumKind::Control);
    let kept = by_control.then(|| {
        let on = epoch.control == ControlUse::Kept;
        view! {
            <label class="kept-control"><input type="checkbox" name="control-kept" prop:checked=on on:change=move |e| {
                let on = event::checked(&e);
                editor.edit(|epoch| epoch.control = if on { ControlUse::Kept } else { ControlUse::Released });
            }/> <span>{words::control_kept}</span></label>
        }
    });
    view! { {scale}{kept} }
}

/// Where the epoch comes from.
fn source_words(entry: &EpochEntry) -> String {
    match (&entry.matrix, entry.is_list(), entry.source.as_str()) {
        (Some(matrix), ..) => words::with_matrix(matrix),
        (None, true, _) => words::list_of_points().to_owned(),
        (None, false, "") => words::kept_project().to_owned(),
        (None, false, SAMPLE) => words::simulated().to_owned(),
        (None, false, source) => source.to_owned(),
    }
}

#[component]
fn EpochRow(k: usize, entry: EpochEntry, count: usize) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let (id, epoch) = (entry.id, entry.epoch.clone());
    let editor = EpochEditor { desk, id };
    let rename = Callback::new(move |typed: String| editor.rename(&typed));
    let set_date = Callback::new(move |typed: String| editor.set_date(typed));
    let name = Signal::stored(epoch.name.clone());
    let date = Signal::stored(epoch.date.clone().unwrap_or_default());
    let (up, away) = (epoch.name.clone(), epoch.name.clone());
    let (points, statistics) = (entry.points(), statistics(editor, &entry));
    let (unit, datum) = (unit_choice(editor, &entry), datum_choices(editor, &entry));
    view! {
        <tr data-epoch=k.to_string()>
            <td><b>{k}</b></td>
            <td class="left typed name" data-field="name"><Field value=name commit=rename/></td>
            <td class="left typed date" data-field="date"><Field value=date commit=set_date/></td>
            <td>{format::count(points)}</td>
            {statistics}
            <td class="left">{unit}</td>
            <td class="left">{datum}</td>
            <td class="typed" data-field="temperature"><Field value=typed_number(epoch.temperature) commit=editor.number(|e, v| e.temperature = v, false)/></td>
            <td class="left">{move || source_words(&entry)}</td>
            <td class="left wide">
                <button class="icon-button small up" disabled=k == 0 || count < 2 aria-label=move || words::raise(&up) on:click=move |_| desk.raise_epoch(id)><Glyph icon=Icon::Arrow size=12/></button>
                <button class="icon-button small" aria-label=move || words::remove(&away) on:click=move |_| desk.remove_epoch(id)><Glyph icon=Icon::Cross size=12/></button>
            </td>
        </tr>
    }
}
