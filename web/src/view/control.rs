//! Step 4: control points, measured distances, unit and datum.

use crate::view::components::coordinates::{AXES_CHOICES, CoordinateHead};
use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::project::{DatumKind, Point, Role};

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::distance_sheet::DistanceSheet;
use super::equipment::BarsOffer;
use super::identities::NamedPhoto;
use super::import::ImportSheet;
use crate::browser::{event, file};
use crate::edit::control::{DistanceFault, Unit};
use crate::format;
use crate::i18n::{Text, lists, text, text::role_word};
use crate::store::control::distance_fault;
use crate::store::texts::ListKind;
use crate::store::{Desk, Step};
use crate::view::components::title::TitleBar;

#[component]
pub fn Control() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let (control, check, distances) = desk.document.with(|d| {
            let of = |role| d.project.points.iter().filter(|p| p.role == role).count();
            (of(Role::Control), of(Role::Check), d.project.distances.len())
        });
        text::control_sentence(format::count(control), format::count(check), format::count(distances))
    };
    view! {
        <TitleBar title=text::control_and_scale sentence=Signal::derive(sentence)>
            <button class="button" on:click=move |_| choose_control(desk)>{text::open_control}</button>
            <button class="button primary" on:click=move |_| desk.go(Step::Adjust)>{text::adjustment} <Glyph icon=Icon::Arrow/></button>
        </TitleBar>
        <main class="control">
            <NamedPhoto/>
            <div class="columns scroll">
                <PasteBox/>
                <ImportSheet/>
                <DistanceSheet/>
                <Known/>
                <Distances/>
                <Centres/>
                <DatumChoice/>
            </div>
        </main>
    }
}

fn choose_control(desk: Desk) {
    file::choose(".csv,.txt,.tsv,.dat,text/plain,text/csv", false, move |files| {
        if let Some(file) = files.into_iter().next() {
            desk.read_text(file, ListKind::Control);
        }
    });
}

/// Rows pasted from a spreadsheet or a list.
#[component]
fn PasteBox() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <section class="panel">
            <h2 class="section-head"><span><label for="paste">{text::control_points}</label></span><UnitChoice/></h2>
            <div class="fields">
                <textarea id="paste" rows="2" placeholder=move || text::paste_control(desk.axes().list(), desk.axes().names().map(|axis| format!("s{axis}")).join(", ")) on:input=move |e| {
                    let typed = event::value(&e);
                    if typed.trim().is_empty() {
                        desk.intake.pasted.set(None);
                    } else {
                        desk.read_control(text::pasted().to_owned(), &typed);
                    }
                }></textarea>
            </div>
        </section>
    }
}

/// The project's unit of length: what every coordinate and length on this page is in.
#[component]
fn UnitChoice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Signal::derive(move || desk.document.with(|d| d.project.unit.clone()));
    view! {
        <label class="unit-field"><span>{text::unit_of_length}</span>
            <Field value=unit commit=move |typed: String| desk.set_unit(&typed) attr:class="short" attr:name="unit" attr:list="units"/>
        </label>
        <label class="unit-field"><span>{lists::shown_axes}</span>
            <select name="axes" on:change=move |e| {
                let value = event::value(&e);
                desk.set_axes(AXES_CHOICES.iter().find(|known| known.0 == value).and_then(|known| known.1));
            }>
                {move || AXES_CHOICES.map(|(value, axes)| {
                    let chosen = desk.document.with(|d| d.project.axes) == axes;
                    view! { <option value=value selected=chosen>{ShownAxes::of(axes).list()}</option> }
                }).collect_view()}
            </select>
        </label>
        <datalist id="units">{Unit::ALL.map(|unit| view! { <option value=unit.symbol()></option> }).collect_view()}</datalist>
        <Show when=move || unit.with(|unit| Unit::named(unit).is_none())>
            <span class="aside warn" data-unit="unknown" role="alert">{move || text::unit_unknown(unit.get())}</span>
        </Show>
    }
}

/// Control and check points of the project.
#[component]
fn Known() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let points = Memo::new(move |_| {
        desk.document.with(|d| d.project.points.iter().filter(|p| p.role != Role::Tie).cloned().collect::<Vec<_>>())
    });
    view! {
        <Show when=move || points.with(|p| !p.is_empty())>
            <section class="panel">
                <div class="scroll preview">
                    <table class="table">
                        <thead><tr><CoordinateHead/></tr></thead>
                        <tbody>{move || {
                            let axes = desk.axes();
                            points.get().into_iter().map(|point| view! { <KnownRow point axes/> }).collect_view()
                        }}</tbody>
                    </table>
                </div>
            </section>
        </Show>
    }
}

#[component]
fn KnownRow(point: Point, axes: ShownAxes) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(point.id.clone());
    let role = point.role;
    let chosen = move || desk.selection.with(|s| s.point == Some(id.get_value()));
    let seen = move || desk.document.with(|d| d.project.observations.iter().any(|o| o.point == id.get_value()));
    let coordinate = |axis: usize| {
        Signal::stored(point.xyz.map(|xyz| format::editable(rounded(xyz[axis], &point))).unwrap_or_default())
    };
    let sigma = |axis: usize| {
        let given = point.sigma.and_then(|sigma| sigma[axis]).filter(|sigma| *sigma > 0.0);
        Signal::stored(given.map(format::editable).unwrap_or_default())
    };
    view! {
        <tr class:chosen=chosen>
            <td class="left id"><button class="link" on:click=move |_| desk.select_point(&id.get_value())>{id.get_value()}</button></td>
            <td class="left">
                <select aria-label=text::role on:change=move |e| desk.set_role(&id.get_value(), match event::value(&e).as_str() {
                    "control" => Role::Control,
                    "check" => Role::Check,
                    _ => Role::Tie,
                })>
                    {[(Role::Control, "control"), (Role::Check, "check"), (Role::Tie, "tie")].into_iter().map(|(r, value)| view! {
                        <option value=value selected=r == role>{move || role_word(r)}</option>
                    }).collect_view()}
                </select>
            </td>
            {axes.order().map(|axis| view! { <td>
                <Field value=coordinate(axis) commit=move |typed: String| desk.set_coordinate(&id.get_value(), axis, &typed)
                    attr:class="value" attr:inputmode="decimal" attr:aria-label=format!("{} {}", id.get_value(), axes.letter(axis))/>
            </td> }).collect_view()}
            {axes.order().map(|axis| view! { <td>
                <Field value=sigma(axis) commit=move |typed: String| desk.set_control_sigma(&id.get_value(), axis, &typed)
                    attr:class="value sigma" attr:inputmode="decimal" attr:placeholder=text::fixed attr:aria-label=format!("{} σ {}", id.get_value(), axes.letter(axis))/>
            </td> }).collect_view()}
            <td class="left wide warn">{move || if seen() { "" } else { text::not_measured() }}</td>
        </tr>
    }
}

/// A coordinate to what its sigma, or a ten-thousandth of the unit, can show: leaving the field changes nothing.
fn rounded(value: f64, point: &Point) -> f64 {
    let least = point.sigma.iter().flatten().flatten().copied().filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    let decimals = if least.is_finite() { format::decimals_for(least).max(3) + 1 } else { 6 };
    let power = 10f64.powi(decimals as i32);
    if value.abs() < 1e8 { (value * power).round() / power } else { value }
}

/// Projection centres that are observed, as from GNSS or a calibrated rig.
#[component]
fn Centres() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let observed = Memo::new(move |_| {
        desk.document.with(|d| {
            let all = d.project.photos.iter().filter(|p| p.sigma_position.is_some());
            all.map(|p| (p.id.clone(), p.position.unwrap_or_default(), p.sigma_position.unwrap_or_default()))
                .collect::<Vec<_>>()
        })
    });
    let others = move || {
        desk.document.with(|d| {
            let all = d.project.photos.iter().filter(|p| p.sigma_position.is_none());
            all.map(|p| p.id.clone()).collect::<Vec<_>>()
        })
    };
    let photo = RwSignal::new(String::new());
    let shown = Memo::new(move |_| desk.axes());
    let fields: [RwSignal<String>; 6] = std::array::from_fn(|_| RwSignal::new(String::new()));
    let add = move || {
        let typed = fields.map(|field| field.get_untracked());
        let [x, y, z, sx, sy, sz] = typed;
        let chosen =
            Some(photo.get_untracked()).filter(|p| !p.is_empty()).or_else(|| untrack(others).into_iter().next());
        if let Some(chosen) = chosen
            && desk.observe_position(
                &chosen,
                &shown.get_untracked().stored([x, y, z]),
                &shown.get_untracked().stored([sx, sy, sz]),
            )
        {
            photo.set(String::new());
            fields.iter().for_each(|field| field.set(String::new()));
        }
    };
    let set = move |id: &str, position: [f64; 3], sigma: [Option<f64>; 3], place: usize, typed: String| {
        let mut numbers = [position.map(format::editable), sigma.map(|s| s.map(format::editable).unwrap_or_default())];
        numbers[place / 3][place % 3] = typed;
        let [position, sigma] = numbers;
        desk.observe_position(id, &position, &sigma);
    };
    // By their places in the order of the user.
    let name = move |place: usize| {
        let letter = shown.get().names()[place % 3];
        if place < 3 { letter.to_owned() } else { format!("σ {letter}") }
    };
    let inside = move |place: usize| shown.get_untracked().order()[place % 3] + place / 3 * 3;
    view! {
        <section class="panel">
            <h2 class="section-head"><span>{text::observed_centres}</span><span class="aside">{text::observed_centres_hint}</span></h2>
            <div class="scroll">
                <table class="table centres">
                    <thead><tr>
                        <th class="left">{text::photo}</th>
                        {(0..6).map(|k| view! { <th>{move || name(k)} " " <u>{unit}</u></th> }).collect_view()}
                        <td class="wide"></td>
                    </tr></thead>
                    <tbody>
                        {move || observed.get().into_iter().map(|(id, position, sigma)| {
                            let id = StoredValue::new(id);
                            view! {
                                <tr>
                                    <td class="left id">{id.get_value()}</td>
                                    {(0..6).map(|place| {
                                        let k = inside(place);
                                        let value = if k < 3 { Some(position[k]) } else { sigma[k - 3] };
                                        view! { <td>
                                            <Field value=Signal::stored(value.map(format::editable).unwrap_or_default())
                                                commit=move |typed: String| set(&id.get_value(), position, sigma, k, typed)
                                                attr:class="value" attr:inputmode="decimal" attr:aria-label=format!("{} {}", id.get_value(), name(place))/>
                                        </td> }
                                    }).collect_view()}
                                    <td class="left wide"><button class="icon-button small" aria-label=text::forget_centre
                                        on:click=move |_| desk.forget_position(&id.get_value())><Glyph icon=Icon::Cross size=12/></button></td>
                                </tr>
                            }
                        }).collect_view()}
                    </tbody>
                </table>
            </div>
            <Show when=move || !others().is_empty()>
                <form class="centre-form" on:submit=move |e| { e.prevent_default(); add(); }>
                    <select name="centre-photo" aria-label=text::photo on:change=move |e| photo.set(event::value(&e))>
                        {move || others().into_iter().map(|id| view! { <option value=id.clone()>{id.clone()}</option> }).collect_view()}
                    </select>
                    {fields.into_iter().enumerate().map(|(k, field)| view! {
                        <input type="text" autocomplete="off" inputmode="decimal" name=format!("centre-{k}") aria-label=move || name(k) placeholder=move || name(k)
                            prop:value=field on:input=move |e| field.set(event::value(&e))/>
                    }).collect_view()}
                    <button class="button small" type="submit">{text::observe}</button>
                </form>
            </Show>
        </section>
    }
}

/// Distances between two points.
#[component]
fn Distances() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let distances = Memo::new(move |_| desk.document.with(|d| d.project.distances.clone()));
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let fields: [RwSignal<String>; 4] = std::array::from_fn(|_| RwSignal::new(String::new()));
    let [from, to, length, sigma] = fields;
    let fault = RwSignal::new(None::<DistanceFault>);
    let add = move || match desk.add_distance(
        &from.get_untracked(),
        &to.get_untracked(),
        &length.get_untracked(),
        &sigma.get_untracked(),
    ) {
        Ok(()) => {
            fault.set(None);
            fields.iter().for_each(|f| f.set(String::new()));
        }
        Err(why) => fault.set(Some(why)),
    };
    let input = move |signal: RwSignal<String>, label: fn() -> &'static str, name: &'static str| {
        view! {
            <input type="text" name=name aria-label=label placeholder=label autocomplete="off" prop:value=signal on:input=move |e| signal.set(event::value(&e))/>
        }
    };
    view! {
        <section class="panel">
            <h2 class="section-head">
                <span>{text::distances}</span>
                <span class="aside">{move || text::in_unit(unit.get())}</span>
            </h2>
            <table class="table">
                <thead><tr>
                    <th class="left">{text::from_point}</th><th class="left">{text::to_point}</th>
                    <th>{text::length} " " <u>{unit}</u></th><th>"σ " <u>{unit}</u></th><th class="left">{text::check_only}</th><td class="wide"></td>
                </tr></thead>
                <tbody>
                    {move || distances.get().into_iter().enumerate().map(|(i, d)| view! {
                        <tr>
                            <td class="left id">{d.from}</td><td class="left id">{d.to}</td>
                            <td><Field value=Signal::stored(format::editable(d.length)) commit=move |typed: String| desk.edit_distance(i, &typed, |d, value| d.length = value)
                                attr:class="value" attr:inputmode="decimal" attr:name="distance-length" attr:aria-label=text::length/></td>
                            <td><Field value=Signal::stored(format::editable(d.sigma)) commit=move |typed: String| desk.edit_distance(i, &typed, |d, value| d.sigma = value)
                                attr:class="value" attr:inputmode="decimal" attr:name="distance-sigma" attr:aria-label="σ"/></td>
                            <td class="left"><input type="checkbox" name="distance-check" aria-label=text::check_only title=text::check_only_means
                                prop:checked=d.check on:change=move |e| desk.set_distance_check(i, event::checked(&e))/></td>
                            <td class="left wide"><button class="icon-button small" aria-label=text::remove_distance on:click=move |_| desk.remove_distance(i)><Glyph icon=Icon::Cross size=12/></button></td>
                        </tr>
                    }).collect_view()}
                </tbody>
            </table>
            <BarsOffer/>
            <form class="distance-form" on:submit=move |e| { e.prevent_default(); add(); }>
                {input(from, text::from_point, "from")}{input(to, text::to_point, "to")}{input(length, text::length, "length")}{input(sigma, || "σ", "sigma")}
                <button class="button small" type="submit">{text::add_distance}</button>
            </form>
            {move || fault.get().map(|why| view! { <p class="note bad" role="alert">{move || distance_fault(why)}</p> })}
        </section>
    }
}

/// The datum; each kind has a sentence that explains it.
#[component]
pub fn DatumChoice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let kinds: [(DatumKind, Text, Text); 3] = [
        (DatumKind::Control, text::datum_control, text::datum_control_means),
        (DatumKind::Minimal, text::datum_minimal, text::datum_minimal_means),
        (DatumKind::Free, text::datum_free, text::datum_free_means),
    ];
    view! {
        <section class="panel">
            <h2 class="section-head"><span>{text::datum}</span></h2>
            <fieldset class="datum">
                <legend class="visually-hidden">{text::datum}</legend>
                {kinds.into_iter().map(|(kind, name, means)| {
                    let on = move || desk.document.with(|d| d.project.datum.kind == kind);
                    view! {
                        <label class="radio" class:chosen=on>
                            <input type="radio" name="datum" prop:checked=on on:change=move |_| desk.set_datum(kind)/>
                            <span><b>{name}</b><span>{means}</span></span>
                        </label>
                    }
                }).collect_view()}
            </fieldset>
        </section>
    }
}
