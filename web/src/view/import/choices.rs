//! Choices of how a list is read and taken; each menu names what was recognised.

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::project::Role;
use sightline::units::Unit;
use sightline_exchange::control_csv::{Assumption, Axes, Basis, Decimal, Separator};
use sightline_exchange::encoding::Encoding;

use crate::browser::event;
use crate::i18n::{Text, lists, text};
use crate::store::Desk;
use crate::store::control::Pasted;
use crate::view::components::coordinates::AXES_CHOICES;
use crate::view::components::field::Field;

/// A menu with its name.
#[component]
fn Choice(name: &'static str, label: Text, options: Vec<MenuOption>, choose: Callback<String>) -> impl IntoView {
    view! {
        <label class="way"><span>{label}</span>
            <select name=name on:change=move |e| choose.run(event::value(&e))>
                {options.into_iter().map(|(value, word, chosen)| view! { <option value=value selected=chosen>{word}</option> }).collect_view()}
            </select>
        </label>
    }
}

/// An option of a menu: its value, its word, whether it is chosen.
type MenuOption = (String, String, bool);

fn option(value: &str, word: impl Into<String>, chosen: bool) -> MenuOption {
    (value.to_owned(), word.into(), chosen)
}

/// The option that leaves a choice to recognition, with what was recognised.
fn automatic(found: Option<String>, chosen: bool) -> MenuOption {
    let word = found.map_or_else(|| lists::automatic().to_owned(), |found| format!("{}: {found}", lists::automatic()));
    option("", word, chosen)
}

const SEPARATORS: [(&str, Separator, Text); 4] = [
    ("comma", Separator::Comma, text::separator_comma),
    ("semicolon", Separator::Semicolon, text::separator_semicolon),
    ("tab", Separator::Tab, text::separator_tab),
    ("blanks", Separator::Blanks, text::separator_blanks),
];

const ENCODINGS: [(&str, Encoding); 4] = [
    ("UTF-8", Encoding::Utf8),
    ("UTF-16", Encoding::Utf16),
    ("CP949", Encoding::Cp949),
    ("Windows-1252", Encoding::Windows1252),
];

const ROLES: [(&str, Role, Text); 3] = [
    ("control", Role::Control, lists::as_control),
    ("check", Role::Check, lists::as_check),
    ("tie", Role::Tie, lists::as_approximate),
];

/// The order of the axes in the list.
fn axes_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let order = pasted.table.assumptions.iter().find_map(|a| match a {
        Assumption::AxisOrder { order, by } if *by != Basis::Undecided => Some(*order),
        _ => None,
    });
    let order_word = |order| match order {
        Axes::Xy => lists::east_first().to_owned(),
        Axes::Yx => lists::north_first().to_owned(),
    };
    let axes = pasted.choices.axes;
    let options = vec![
        automatic(order.map(order_word).filter(|_| axes.is_none()), axes.is_none()),
        option("xy", lists::east_first(), axes == Some(Axes::Xy)),
        option("yx", lists::north_first(), axes == Some(Axes::Yx)),
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
    view! { <Choice name="list-axes" label=lists::axes options choose=Callback::new(choose)/> }
}

/// The axes of the project.
fn project_axes_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let shown = pasted.shown();
    let options = AXES_CHOICES.map(|(value, axes)| option(value, ShownAxes::of(axes).list(), axes == shown)).to_vec();
    let choose = move |value: String| {
        let axes = AXES_CHOICES.iter().find(|known| known.0 == value).and_then(|known| known.1);
        desk.intake.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.chosen_axes = Some(axes);
            }
        });
    };
    view! { <Choice name="list-shown-axes" label=lists::project_axes options choose=Callback::new(choose)/> }
}

/// The decimal mark.
#[component]
pub fn DecimalChoice(
    name: &'static str,
    assumptions: Vec<Assumption>,
    chosen: Option<Decimal>,
    choose: Callback<Option<Decimal>>,
) -> impl IntoView {
    let sign = assumptions.iter().find_map(|a| match a {
        Assumption::DecimalSign { sign, by, .. } if *by == Basis::Content => Some(*sign),
        _ => None,
    });
    let sign_word = |sign| match sign {
        Decimal::Point => lists::decimal_point().to_owned(),
        Decimal::Comma => lists::decimal_comma().to_owned(),
    };
    let options = vec![
        automatic(sign.map(sign_word), chosen.is_none()),
        option("point", lists::decimal_point(), chosen == Some(Decimal::Point)),
        option("comma", lists::decimal_comma(), chosen == Some(Decimal::Comma)),
    ];
    let choose = move |value: String| {
        choose.run(match value.as_str() {
            "point" => Some(Decimal::Point),
            "comma" => Some(Decimal::Comma),
            _ => None,
        });
    };
    view! { <Choice name label=lists::decimal_mark options choose=Callback::new(choose)/> }
}

fn separator_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let found = pasted.table.assumptions.iter().find_map(|a| match a {
        Assumption::Separator { separator, by: Basis::Content } => Some(*separator),
        _ => None,
    });
    let found = SEPARATORS.iter().find(|known| Some(known.1) == found).map(|known| (known.2)().to_owned());
    let separator = pasted.choices.separator;
    let mut options = vec![automatic(found, separator.is_none())];
    options.extend(SEPARATORS.map(|(value, one, word)| option(value, word(), separator == Some(one))));
    let choose = move |value: String| {
        let one = SEPARATORS.iter().find(|known| known.0 == value).map(|known| known.1);
        desk.choose_reading(|choices, _| {
            choices.separator = one;
            // Other fields are other columns.
            choices.columns = None;
        });
    };
    view! { <Choice name="list-separator" label=lists::separator options choose=Callback::new(choose)/> }
}

fn encoding_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let found = pasted.table.assumptions.iter().find_map(|a| match a {
        Assumption::Encoding { encoding, by } if *by != Basis::Given => Some(*encoding),
        _ => None,
    });
    let encoding = pasted.choices.encoding;
    let found = found.or(encoding.is_none().then_some(Encoding::Utf8));
    let found = ENCODINGS.iter().find(|known| Some(known.1) == found).map(|known| known.0.to_owned());
    let mut options = vec![automatic(found, encoding.is_none())];
    options.extend(ENCODINGS.map(|(name, one)| option(name, name, encoding == Some(one))));
    let choose = move |value: String| {
        let one = ENCODINGS.iter().find(|known| known.0 == value).map(|known| known.1);
        desk.choose_reading(|choices, _| choices.encoding = one);
    };
    view! { <Choice name="list-encoding" label=lists::encoding options choose=Callback::new(choose)/> }
}

/// The unit of standard errors, if the list has them.
fn sigma_unit_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let chosen = pasted.choices.sigma_unit;
    let mut options = vec![option("", lists::as_coordinates(), chosen.is_none())];
    options.extend(Unit::ALL.map(|unit| option(unit.symbol(), unit.symbol(), chosen == Some(unit))));
    let choose = move |value: String| desk.choose_reading(|choices, _| choices.sigma_unit = Unit::named(&value));
    view! { <Choice name="list-sigma-unit" label=lists::unit_of_sigmas options choose=Callback::new(choose)/> }
}

fn role_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let options = ROLES.map(|(value, role, word)| option(value, word(), pasted.role == role)).to_vec();
    let choose = move |value: String| {
        let one = ROLES.iter().find(|known| known.0 == value).map_or(Role::Control, |known| known.1);
        desk.intake.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.role = one;
            }
        });
    };
    view! { <Choice name="list-role" label=lists::taken_as options choose=Callback::new(choose)/> }
}

/// The first line that is read; the field shows the recognised one.
fn first_line_choice(desk: Desk, pasted: &Pasted) -> impl IntoView + use<> {
    let first = pasted.choices.first_line.map(|line| line.to_string()).unwrap_or_default();
    let found = pasted.table.rows.first().map(|row| match row {
        Ok(row) => row.line,
        Err(error) => error.place().line.unwrap_or_default(),
    });
    view! {
        <label class="way"><span>{lists::first_line}</span>
            <Field value=Signal::stored(first) commit=move |typed: String| {
                let line = typed.trim().parse::<usize>().ok().filter(|line| *line > 0);
                desk.choose_reading(|choices, _| choices.first_line = line);
            } attr:name="list-first-line" attr:class="short" attr:inputmode="numeric" attr:placeholder=found.map(|line| line.to_string()).unwrap_or_default()/>
        </label>
    }
}

/// How the list is read: each choice with what was recognised, and its alternatives.
#[component]
pub fn ReadingChoices(pasted: Pasted, typed_sigma: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let assumptions = &pasted.table.assumptions;
    let is_table = !assumptions.iter().any(|a| matches!(a, Assumption::Format { .. }));
    let has_sigmas = assumptions.iter().any(|a| matches!(a, Assumption::SigmaColumns { .. }));
    view! {
        <div class="ways">
            // A column of roles has the role of each point.
            {(!pasted.has_roles()).then(|| role_choice(desk, &pasted))}
            // Where the columns are chosen, their menus have the axes; latitude and longitude have no order.
            {(pasted.choices.columns.is_none() && pasted.table.local_system().is_none()).then(|| axes_choice(desk, &pasted))}
            {project_axes_choice(desk, &pasted)}
            {is_table.then(|| view! {
                <DecimalChoice name="list-decimal" assumptions=pasted.table.assumptions.clone() chosen=pasted.choices.decimal
                    choose=Callback::new(move |sign| desk.choose_reading(|choices, _| choices.decimal = sign))/>
            })}
            {is_table.then(|| separator_choice(desk, &pasted))}
            {pasted.from_file.then(|| encoding_choice(desk, &pasted))}
            {has_sigmas.then(|| sigma_unit_choice(desk, &pasted))}
            {is_table.then(|| first_line_choice(desk, &pasted))}
            <label class="way"><span>{lists::sigma_of_all}</span>
                <Field value=Signal::stored(typed_sigma) commit=move |typed: String| desk.set_list_sigma(&typed)
                    attr:name="list-sigma" attr:placeholder="2 mm + 2 ppm"/>
            </label>
        </div>
    }
}
