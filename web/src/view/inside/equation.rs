//! One observation: its equation with numbers, misclosure and weight, its row of A beside difference quotients, and where an error of it goes.

use leptos::prelude::*;
use sightline::adjust::Equation as Observation;
use sightline_lab::teaching::{Collinearity, Explained};

use super::number;
use crate::browser::event;
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;

#[component]
pub fn Equation() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    // A step changes no name: the list of a large network takes longer than the step.
    let first = inside.first();
    let rows = Memo::new(move |_| first.get().map_or(0, |looked| looked.system.observations.len()));
    let now = move || {
        let looked = inside.looked()?;
        let row = inside.row.get().filter(|row| *row < looked.observations().len())?;
        Some((looked, row))
    };
    let explained = move |row: usize| {
        let step = inside.step.get();
        inside.explained.get().filter(|(at, explained)| *at == step && explained.row == row).map(|found| found.1)
    };
    let names = move || {
        let all =
            first.get().map(|looked| looked.system.observations.iter().map(|row| row.name.clone()).collect::<Vec<_>>());
        all.unwrap_or_default()
    };
    view! {
        <h2 class="section-head"><span>{words::observation}</span><span class="aside">{move || {
            inside.row.get().map(|row| words::row_of(format::count(row + 1), format::count(rows.get())))
        }}</span></h2>
        <div class="find">
            <label><span class="visually-hidden">{words::find}</span>
                <input type="text" list="inside-rows" name="observation" autocomplete="off" placeholder=words::find
                    prop:value=move || now().map(|(looked, row)| looked.observations()[row].name.clone()).unwrap_or_default()
                    on:change=move |e| {
                        let typed = event::value(&e);
                        let found = untrack(names).iter().position(|name| *name == typed.trim());
                        desk.choose_equation(found);
                    }/></label>
            <datalist id="inside-rows">{move || names().into_iter().map(|name| view! { <option value=name></option> }).collect_view()}</datalist>
        </div>
        {move || match now() {
            None => view! { <p class="hint">{words::choose_observation}</p> }.into_any(),
            Some((looked, row)) => {
                let observation = Observation { value: looked.observed[row], ..looked.observations()[row].clone() };
                let (l, p) = (looked.system.l[row], looked.system.p[row]);
                let found = explained(row);
                view! {
                    {found.as_ref().and_then(|found| found.collinearity.clone()).map(|c| formula(&observation, &c))}
                    {figures(&observation, l, p, found.as_ref())}
                    <Derivatives row found/>
                }.into_any()
            }
        }}
    }
}

/// The collinearity equation in symbols and in numbers.
fn formula(observation: &Observation, c: &Collinearity) -> impl IntoView + use<> {
    let second = observation.axis.as_deref() == Some("y");
    let (axis, numerator) = if second { ("y", "V") } else { ("x", "U") };
    let sign = if c.sign < 0.0 { "−" } else { "+" };
    let plus = |value: f64| format!("{} {}", if value < 0.0 { "−" } else { "+" }, format::fixed(value.abs(), 4));
    let unit = observation.unit.clone();
    view! {
        <div class="formula">
            <p><i>{axis}</i>" = "<i>{axis}"₀"</i>" "{sign}" "<i>"c"</i>" "<span class="fraction"><i>{numerator}</i><i>"W"</i></span>" + "<i>"Δ"{axis}</i></p>
            <p class="numbers">{format::fixed(c.principal_point, 4)}" "{sign}" "{format::fixed(c.principal_distance, 4)}" · "
                <span class="fraction"><span>{format::fixed(c.uvw[usize::from(second)], 3)}</span><span>{format::fixed(c.uvw[2], 3)}</span></span>
                " "{plus(c.correction)}</p>
            <p class="numbers"><b>"= "{format::fixed(c.computed, 5)}" "{unit}</b></p>
            <small>{words::uvw_are}</small>
        </div>
    }
}

fn figures(observation: &Observation, l: f64, p: f64, found: Option<&Explained>) -> impl IntoView + use<> {
    let unit = observation.unit.clone();
    let axis = observation.axis.clone().unwrap_or_default();
    let line = |name: String, value: String, unit: String| {
        view! { <tr><td class="left">{name}</td><td><b>{value}</b></td><td class="left">{unit}</td></tr> }
    };
    let redundancy = found.and_then(|found| found.redundancy);
    view! {
        <table class="table words observed"><tbody>
            {line(words::observed(&axis), format::fixed(observation.value, 5), unit.clone())}
            {line(words::computed(&axis), format::fixed(observation.value - l, 5), unit.clone())}
            {line(words::misclosure().to_owned(), number(l), unit.clone())}
            {line(words::sigma_of_observation().to_owned(), number(observation.sigma), unit.clone())}
            {line(words::weight().to_owned(), number(p), format!("{unit}⁻²"))}
            {line("l / σ".to_owned(), format::fixed(l / observation.sigma, 2), String::new())}
            {redundancy.map(|r| line(words::redundancy_number().to_owned(), format::fixed(r, 3), String::new()))}
        </tbody></table>
        {redundancy.map(|r| view! { <p class="hint">{words::shows(format::fixed(100.0 * r, 0), format::fixed(100.0 - 100.0 * r, 0))}</p> })}
    }
}

#[component]
fn Derivatives(row: usize, found: Option<Explained>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let Some(looked) = untrack(|| inside.looked()) else { return ().into_any() };
    let entries: Vec<(usize, f64)> = looked.system.a.row(row).collect();
    let counted = words::not_zero(format::count(entries.len()), format::count(looked.unknowns().len()));
    let lines = entries.into_iter().map(|(column, value)| {
        let unknown = looked.unknowns()[column].clone();
        let derivative = found.as_ref().and_then(|found| found.derivatives.iter().find(|one| one.unknown == column));
        let numerical = derivative.and_then(|one| one.numerical).map(number);
        let moved = derivative.and_then(|one| one.moved).map(number);
        view! {
            <tr class:chosen=move || inside.column.get() == Some(column) on:click=move |_| inside.column.set(Some(column))>
                <td class="left">{unknown.name}</td><td><b>{number(value)}</b></td><td>{numerical}</td><td>{moved}</td><td class="left wide">{unknown.unit}</td>
            </tr>
        }
    });
    let lines = lines.collect_view();
    view! {
        <h2 class="section-head"><span>{words::derivatives}</span><span class="aside">{counted}</span></h2>
        <table class="table derivatives">
            <thead><tr><th class="left">{words::unknown}</th><th>{words::analytic}</th><th>{words::numerical}</th><th title=words::moved_title>{words::moved_by_sigma}</th><td class="left wide"></td></tr></thead>
            <tbody>{lines}</tbody>
        </table>
        <p class="hint">{words::derivative_units}</p>
    }.into_any()
}
