//! Preview of a list of points before its import: how it was read, open questions, rejected lines, and resulting points. On step 4 it stands
//! among the other tables, on every other step over what is there.

mod words;

use std::collections::{BTreeMap, HashSet};

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::exchange::control_csv::{
    Assumption, Axes, Basis, ControlTable, Decimal, Field as ControlField, Separator,
};
use sightline::exchange::encoding::Encoding;
use sightline::project::{Point, Role};
use sightline::units::Unit;

use words::{assumption_words, field_word};

use super::control::{AXES_CHOICES, CoordinateHead, sigma_cells, xyz_cells};
use super::field::Field;
use super::icon::{Glyph, Icon};
use crate::browser::{event, page};
use crate::format;
use crate::i18n::{Text, errors, language, lists, text, text::role_word};
use crate::store::Desk;
use crate::store::control::Pasted;

/// Lines of the list that are shown around the first ones; the rejected ones are all listed.
const LINES: usize = 60;

/// The sheet over a step that is not that of control points.
#[component]
pub fn ImportOver() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <div class="import-over" role="dialog" aria-label=lists::import_points
            on:keydown=move |e| if event::key(&e).key == "Escape" {
                desk.pasted.set(None);
            }>
            <div class="import-title"><h1>{lists::import_points}</h1> <p>{lists::nothing_stored}</p></div>
            <ImportSheet/>
        </div>
    }
}

/// What was read, row by row, before it is taken.
#[component]
pub fn ImportSheet() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sheet = move || {
        // The words of menus do not change by themselves, and every choice reads the list anew.
        language();
        if let Some(field) = page::focused_field() {
            page::after(0, move || page::focus_first(&format!(".import {field}")));
        }
        desk.pasted.get().map(|pasted| view! { <Sheet pasted/> })
    };
    view! { {sheet} }
}

#[component]
fn Sheet(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = pasted.table.rows.len();
    let good = pasted.table.rows.iter().filter(|r| r.is_ok()).count();
    let (typed_sigma, sigma_fault) = pasted.typed_sigma.clone();
    let unasked = pasted.is_asked() || sigma_fault.is_some();
    let unit = pasted.unit.clone();
    let by_list = pasted.unit_of_the_list();
    let mut units: Vec<String> = Unit::ALL.map(|unit| unit.symbol().to_owned()).into();
    if let Some(other) = unit.clone().filter(|unit| !units.contains(unit)) {
        units.push(other);
    }
    view! {
        <section class="panel import">
            <h2 class="section-head">
                <span>{pasted.source.clone()}</span>
                <span class="aside" class:warn=good < all>
                    {move || text::rows_read(format::count(all), format::count(all - good))}
                </span>
                <label class="unit-field" class:asked=unit.is_none()><span>{text::unit_of_these}</span>
                    <select name="pasted-unit" disabled=by_list on:change=move |e| desk.set_pasted_unit(&event::value(&e))>
                        {unit.is_none().then(|| view! { <option value="" selected=true>{text::choose_unit}</option> })}
                        {units.into_iter().map(|name| view! {
                            <option value=name.clone() selected=unit.as_ref() == Some(&name)>{name.clone()}</option>
                        }).collect_view()}
                    </select>
                </label>
                <button class="link" on:click=move |_| desk.pasted.set(None)>{text::discard}</button>
                <button class="button small primary" disabled=good == 0 || unasked on:click=move |_| desk.take_control()>
                    {move || text::take_points(format::count(good))}
                </button>
            </h2>
            <div class="import-parts">
                <div class="import-part">
                    <Lines pasted=pasted.clone()/>
                </div>
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::how_read}</span><span class="aside">{lists::how_read_hint}</span></h3>
                    <Ways pasted=pasted.clone() typed_sigma/>
                    {sigma_fault.map(|error| view! { <p class="note bad" role="alert">{move || errors::sentence(&error)}</p> })}
                    <Reading table=pasted.table.clone() axes=pasted.shown_axes()/>
                    <Columns pasted=pasted.clone()/>
                </div>
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::resulting_points} " " <span class="id">{format::count(good)}</span></span></h3>
                    <Rows pasted/>
                </div>
            </div>
        </section>
    }
}

/// The list as it is, with what became of each line.
#[component]
fn Lines(pasted: Pasted) -> impl IntoView {
    let place = |row: &sightline::Result<sightline::exchange::control_csv::ControlRow>| match row {
        Ok(row) => (row.line, None),
        Err(error) => (error.place().line.unwrap_or_default(), Some(error.clone())),
    };
    let fates: BTreeMap<usize, Option<sightline::Error>> = pasted.table.rows.iter().map(place).collect();
    let count = pasted.content.lines().count();
    let lines = pasted.content.lines().take(LINES).enumerate().map(|(k, line)| {
        let fate = fates.get(&(k + 1));
        let (taken, rejected) = (matches!(fate, Some(None)), matches!(fate, Some(Some(_))));
        view! {
            <li class:taken=taken class:rejected=rejected>
                <span class="number">{k + 1}</span>
                <span class="fate">{taken.then(|| view! { <Glyph icon=Icon::Check size=12/> })}{rejected.then(|| view! { <Glyph icon=Icon::Cross size=12/> })}</span>
                <code>{line.chars().take(160).collect::<String>()}</code>
            </li>
        }
    });
    let lines = lines.collect_view();
    let rejected: Vec<(usize, sightline::Error)> =
        fates.into_iter().filter_map(|(line, error)| Some((line, error?))).collect();
    let any = !rejected.is_empty();
    let number = rejected.len();
    view! {
        <h3 class="section-head"><span>{lists::the_list}</span><span class="aside">{move || lists::lines_count(format::count(count))}</span></h3>
        <ol class="list-lines scroll" tabindex="0" aria-label=lists::the_list>{lines}</ol>
        <h3 class="section-head" class:warn=any><span>{lists::rejected_lines} " " <span class="id">{format::count(number)}</span></span>
            {(!any).then(|| view! { <span class="aside">{lists::none_rejected}</span> })}</h3>
        <ul class="rejected-lines scroll" data-rejected=number.to_string()>
            {rejected.into_iter().map(|(line, error)| view! {
                <li><b>{line}</b> <span>{move || errors::sentence(&error)}</span></li>
            }).collect_view()}
        </ul>
    }
}

/// A choice with its name: an option's value, its word, whether it is the one.
#[component]
fn Way(
    name: &'static str,
    label: Text,
    options: Vec<(String, String, bool)>,
    choose: Callback<String>,
) -> impl IntoView {
    view! {
        <label class="way"><span>{label}</span>
            <select name=name on:change=move |e| choose.run(event::value(&e))>
                {options.into_iter().map(|(value, word, chosen)| view! { <option value=value selected=chosen>{word}</option> }).collect_view()}
            </select>
        </label>
    }
}

/// How the list is read: each with what was recognised, and every other choice.
#[component]
fn Ways(pasted: Pasted, typed_sigma: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let table = &pasted.table;
    let is_table = !table.assumptions.iter().any(|a| matches!(a, Assumption::Format { .. }));
    let choices = &pasted.choices;
    let option = |value: &str, word: String, chosen: bool| (value.to_owned(), word, chosen);
    let automatic = |found: Option<String>, chosen: bool| {
        let word =
            found.map_or_else(|| lists::automatic().to_owned(), |found| format!("{}: {found}", lists::automatic()));
        option("", word, chosen)
    };
    let order = table.assumptions.iter().find_map(|a| match a {
        Assumption::AxisOrder { order, by } if *by != Basis::Undecided => Some(*order),
        _ => None,
    });
    let order_word = |order| match order {
        Axes::Xy => lists::east_first().to_owned(),
        Axes::Yx => lists::north_first().to_owned(),
    };
    // Where the columns are chosen, their menus say the axes.
    let by_columns = choices.columns.is_some();
    let axes = (!by_columns).then(|| {
        let options = vec![
            automatic(order.map(order_word).filter(|_| choices.axes.is_none()), choices.axes.is_none()),
            option("xy", lists::east_first().to_owned(), choices.axes == Some(Axes::Xy)),
            option("yx", lists::north_first().to_owned(), choices.axes == Some(Axes::Yx)),
        ];
        let choose = move |value: String| {
            desk.choose_reading(|choices, _| {
                choices.axes = match value.as_str() {
                    "xy" => Some(Axes::Xy),
                    "yx" => Some(Axes::Yx),
                    _ => None,
                };
            });
        };
        view! { <Way name="list-axes" label=lists::axes options choose=Callback::new(choose)/> }
    });
    let shown = pasted.shown();
    let options = AXES_CHOICES.map(|(value, axes)| option(value, ShownAxes::of(axes).list(), axes == shown)).to_vec();
    let choose = move |value: String| {
        let axes = AXES_CHOICES.iter().find(|known| known.0 == value).and_then(|known| known.1);
        desk.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.chosen_axes = Some(axes);
            }
        });
    };
    let shown = view! { <Way name="list-shown-axes" label=lists::project_axes options choose=Callback::new(choose)/> };
    let sign = table.assumptions.iter().find_map(|a| match a {
        Assumption::DecimalSign { sign, by, .. } if *by == Basis::Content => Some(*sign),
        _ => None,
    });
    let sign_word = |sign| match sign {
        Decimal::Point => lists::decimal_point().to_owned(),
        Decimal::Comma => lists::decimal_comma().to_owned(),
    };
    let decimal = is_table.then(|| {
        let options = vec![
            automatic(sign.map(sign_word), choices.decimal.is_none()),
            option("point", lists::decimal_point().to_owned(), choices.decimal == Some(Decimal::Point)),
            option("comma", lists::decimal_comma().to_owned(), choices.decimal == Some(Decimal::Comma)),
        ];
        let choose = move |value: String| {
            desk.choose_reading(|choices, _| {
                choices.decimal = match value.as_str() {
                    "point" => Some(Decimal::Point),
                    "comma" => Some(Decimal::Comma),
                    _ => None,
                };
            });
        };
        view! { <Way name="list-decimal" label=lists::decimal_mark options choose=Callback::new(choose)/> }
    });
    let separators: [(&str, Separator, Text); 4] = [
        ("comma", Separator::Comma, text::separator_comma),
        ("semicolon", Separator::Semicolon, text::separator_semicolon),
        ("tab", Separator::Tab, text::separator_tab),
        ("blanks", Separator::Blanks, text::separator_blanks),
    ];
    let separator = is_table.then(|| {
        let found = table.assumptions.iter().find_map(|a| match a {
            Assumption::Separator { separator, by: Basis::Content } => Some(*separator),
            _ => None,
        });
        let found = separators.iter().find(|known| Some(known.1) == found).map(|known| (known.2)().to_owned());
        let mut options = vec![automatic(found, choices.separator.is_none())];
        options.extend(
            separators
                .iter()
                .map(|(value, one, word)| option(value, word().to_owned(), choices.separator == Some(*one))),
        );
        let choose = move |value: String| {
            let one = separators.iter().find(|known| known.0 == value).map(|known| known.1);
            desk.choose_reading(|choices, _| {
                choices.separator = one;
                // Other fields are other columns.
                choices.columns = None;
            });
        };
        view! { <Way name="list-separator" label=lists::separator options choose=Callback::new(choose)/> }
    });
    const ENCODINGS: [(&str, Encoding); 4] = [
        ("UTF-8", Encoding::Utf8),
        ("UTF-16", Encoding::Utf16),
        ("CP949", Encoding::Cp949),
        ("Windows-1252", Encoding::Windows1252),
    ];
    let encoding = pasted.from_file.then(|| {
        let found = table.assumptions.iter().find_map(|a| match a {
            Assumption::Encoding { encoding, by } if *by != Basis::Given => Some(*encoding),
            _ => None,
        });
        let found = found.or(choices.encoding.is_none().then_some(Encoding::Utf8));
        let found = ENCODINGS.iter().find(|known| Some(known.1) == found).map(|known| known.0.to_owned());
        let mut options = vec![automatic(found, choices.encoding.is_none())];
        options.extend(ENCODINGS.map(|(name, one)| option(name, name.to_owned(), choices.encoding == Some(one))));
        let choose = move |value: String| {
            let one = ENCODINGS.iter().find(|known| known.0 == value).map(|known| known.1);
            desk.choose_reading(|choices, _| choices.encoding = one);
        };
        view! { <Way name="list-encoding" label=lists::encoding options choose=Callback::new(choose)/> }
    });
    let has_sigmas = table.assumptions.iter().any(|a| matches!(a, Assumption::SigmaColumns { .. }));
    let sigma_unit = has_sigmas.then(|| {
        let mut options = vec![option("", lists::as_coordinates().to_owned(), choices.sigma_unit.is_none())];
        options.extend(
            Unit::ALL.map(|unit| option(unit.symbol(), unit.symbol().to_owned(), choices.sigma_unit == Some(unit))),
        );
        let choose = move |value: String| desk.choose_reading(|choices, _| choices.sigma_unit = Unit::named(&value));
        view! { <Way name="list-sigma-unit" label=lists::unit_of_sigmas options choose=Callback::new(choose)/> }
    });
    let roles: [(&str, Role, Text); 3] = [
        ("control", Role::Control, lists::as_control),
        ("check", Role::Check, lists::as_check),
        ("tie", Role::Tie, lists::as_approximate),
    ];
    // A column of roles says it point by point.
    let role = (!pasted.has_roles()).then(|| {
        let options =
            roles.iter().map(|(value, role, word)| option(value, word().to_owned(), pasted.role == *role)).collect();
        let choose = move |value: String| {
            let one = roles.iter().find(|known| known.0 == value).map_or(Role::Control, |known| known.1);
            desk.pasted.update(|pasted| {
                if let Some(pasted) = pasted {
                    pasted.role = one;
                }
            });
        };
        view! { <Way name="list-role" label=lists::taken_as options choose=Callback::new(choose)/> }
    });
    let first = choices.first_line.map(|line| line.to_string()).unwrap_or_default();
    let found = table.rows.first().map(|row| match row {
        Ok(row) => row.line,
        Err(error) => error.place().line.unwrap_or_default(),
    });
    let first_line = is_table.then(|| view! {
        <label class="way"><span>{lists::first_line}</span>
            <Field value=Signal::stored(first) commit=move |typed: String| {
                let line = typed.trim().parse::<usize>().ok().filter(|line| *line > 0);
                desk.choose_reading(|choices, _| choices.first_line = line);
            } attr:name="list-first-line" attr:class="short" attr:inputmode="numeric" attr:placeholder=found.map(|line| line.to_string()).unwrap_or_default()/>
        </label>
    });
    view! {
        <div class="ways">
            {role}{axes}{shown}{decimal}{separator}{encoding}{sigma_unit}{first_line}
            <label class="way"><span>{lists::sigma_of_all}</span>
                <Field value=Signal::stored(typed_sigma) commit=move |typed: String| desk.set_list_sigma(&typed)
                    attr:name="list-sigma" attr:placeholder="2 mm + 2 ppm"/>
            </label>
        </div>
    }
}

/// How a list was read, and what has to be answered before it is taken.
#[component]
fn Reading(table: ControlTable, axes: ShownAxes) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let lines: Vec<usize> = table.rows.iter().flatten().map(|row| row.line).collect();
    let assumptions = table.assumptions;
    let sentence = {
        let assumptions = assumptions.clone();
        move || {
            let points = match (lines.first(), lines.last()) {
                (Some(first), Some(last)) => lists::understood_points(format::count(lines.len()), first, last),
                _ => lists::understood_none().to_owned(),
            };
            std::iter::once(points)
                .chain(assumptions.iter().filter_map(|assumption| assumption_words(axes, assumption)))
                .collect::<Vec<_>>()
                .join(" ")
        }
    };
    let questions = assumptions
        .into_iter()
        .filter(|assumption| assumption.by() == Basis::Undecided)
        .filter_map(|assumption| match assumption {
            Assumption::DecimalSign { example, .. } => {
                let [decimal, thousands] = format::ambiguous(&example?)?;
                let pick = move |sign| move |_| desk.choose_reading(|choices, _| choices.decimal = Some(sign));
                Some(
                    view! {
                        <p class="note warn" data-asked="decimal">{text::ask_decimal} " "
                            <button class="button small" on:click=pick(Decimal::Comma)>{decimal}</button> " "
                            <button class="button small" on:click=pick(Decimal::Point)>{thousands}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            Assumption::AxisOrder { .. } => {
                let pick = move |order| move |_| desk.choose_reading(|choices, _| choices.axes = Some(order));
                Some(
                    view! {
                        <p class="note warn" data-asked="axes">{text::ask_axes} " "
                            <button class="button small" on:click=pick(Axes::Xy)>{text::axes_xy}</button> " "
                            <button class="button small" on:click=pick(Axes::Yx)>{text::axes_yx}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            Assumption::Columns { .. } => {
                let agree = move |_| desk.choose_reading(|choices, columns| choices.columns = Some(columns.to_vec()));
                Some(
                    view! {
                        <p class="note warn" data-asked="columns">{lists::ask_columns} " "
                            <button class="button small" on:click=agree>{lists::columns_right}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            _ => None,
        })
        .collect_view();
    view! {
        <p class="note understood" data-reading=""><b>{lists::understood}</b> " " {sentence}</p>
        {questions}
    }
}

/// What columns can hold.
const FIELDS: [ControlField; 12] = [
    ControlField::Id,
    ControlField::X,
    ControlField::Y,
    ControlField::Z,
    ControlField::Sx,
    ControlField::Sy,
    ControlField::Sz,
    ControlField::Sxy,
    ControlField::Sigma,
    ControlField::Label,
    ControlField::Diameter,
    ControlField::Role,
];

/// The columns as the text has them, each with a menu of what it holds.
#[component]
fn Columns(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let columns = pasted.columns();
    if columns.is_empty() {
        return ().into_any();
    }
    let heading = pasted.table.heading.clone();
    let axes = pasted.shown_axes();
    let menu = move |(place, holds): (usize, Option<ControlField>)| {
        let name = heading.get(place).cloned().unwrap_or_default();
        let label = move || lists::column_number(place + 1);
        view! {
            <th class="left" class:ignored=holds.is_none()><small>{name}</small>
                <select data-column=place.to_string() aria-label=label on:change=move |e| {
                    let chosen = event::value(&e);
                    desk.set_column(place, FIELDS.into_iter().find(|field| field.name() == chosen));
                }>
                    <option value="" selected=holds.is_none()>{lists::column_ignored}</option>
                    {FIELDS.map(|field| view! {
                        <option value=field.name() selected=holds == Some(field)>{move || field_word(axes, field)}</option>
                    }).collect_view()}
                </select>
            </th>
        }
    };
    let row = |fields: Vec<String>| view! { <tr>{fields.into_iter().map(|field| view! { <td class="left">{field}</td> }).collect_view()}</tr> };
    view! {
        <h3 class="section-head"><span>{lists::columns}</span><span class="aside">{lists::columns_hint}</span></h3>
        {pasted.remembered.then(|| view! {
            <p class="note row" data-remembered=""><span>{lists::as_before}</span> " "
                <button class="link" on:click=move |_| desk.forget_reading()>{lists::by_itself}</button></p>
        })}
        <div class="scroll list-columns" tabindex="0" role="region" aria-label=lists::columns>
            <table class="table"><thead><tr>{columns.into_iter().enumerate().map(menu).collect_view()}</tr></thead>
                <tbody>{pasted.table.sample.into_iter().map(row).collect_view()}</tbody></table>
        </div>
    }
    .into_any()
}

/// The points as the project will have them; bad rows with line and reason.
#[component]
fn Rows(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let measured: HashSet<String> =
        desk.document.with(|d| d.project.observations.iter().map(|o| o.point.clone()).collect());
    let (by_column, chosen, axes) = (pasted.has_roles(), pasted.role, pasted.shown_axes());
    let rows = pasted.table.rows.into_iter().map(|row| match row {
        Ok(row) => {
            let role = match (by_column, row.point.role) {
                (true, Role::Tie) => Role::Control,
                (true, own) => own,
                (false, _) => chosen,
            };
            let point = Point { role, ..row.point };
            let seen = measured.contains(&point.id);
            let label = row.label.map(|label| format!(" {label}"));
            view! {
                <tr class="new">
                    <td class="left id">{point.id.clone()} <span class="quiet">{label}</span></td>
                    <td class="left">{move || role_word(role)}</td>
                    {xyz_cells(axes, &point, 4)}
                    {sigma_cells(axes, &point)}
                    <td class="left wide" class:warn=!seen>{move || if seen { text::measured() } else { text::not_measured() }}</td>
                </tr>
            }.into_any()
        }
        Err(error) => view! {
            <tr class="wrong"><td class="left bad" colspan="9"><Glyph icon=Icon::Cross size=12/> " " {move || errors::sentence(&error)}</td></tr>
        }.into_any(),
    }).collect_view();
    let unit = pasted.unit.unwrap_or_else(|| "?".to_owned());
    view! {
        <div class="scroll preview" tabindex="0" role="region" aria-label=lists::resulting_points>
            <table class="table"><thead><tr><CoordinateHead unit axes/></tr></thead><tbody>{rows}</tbody></table>
        </div>
    }
}
