//! Results of an experiment: key figures, charts, tables, and assumptions.

use std::sync::Arc;

use leptos::prelude::*;
use sightline_lab::experiments::{Assumption, Cell, Column, Experiment, Figure, Table};

use super::chart::LineChart;
use super::names;
use crate::format;
use crate::i18n::experiments as words;
use crate::i18n::text;
use crate::store::Desk;
use crate::store::experiments::ExperimentRun;

/// Numbers of more decimals than this are shown with a power of ten.
const PLAIN: usize = 6;

/// The figures shown large, by experiment.
fn key_figures(name: &str) -> &'static [&'static str] {
    match name {
        "kang" => &["m0_mean/3", "m0_mean/4", "m0_up_to/5", "base_0.3/1.4", "base_0.4/1.4"],
        "film" => &["marks_sigma0/similarity", "marks_sigma0/affine", "sigma0/affine", "sigma0/affine-corrected"],
        "lee-calibration" => {
            &["relative/reduced", "residual_px_x/reduced", "residual_px_y/reduced", "centre_rms/least_squares"]
        }
        "sensor" => {
            &["centre_rms/sites", "centre_rms/jpeg-92", "object_rms/sites", "object_rms/jpeg-92", "object_rms/jpeg-75"]
        }
        "lee-structure" => &["sy/I-free", "sy/II-free", "sy/III-free", "gain_y/I", "gain_y/III"],
        _ => &["iterations", "rms/x", "rms/y", "rms/z"],
    }
}

#[component]
pub fn Outcome(ran: Arc<ExperimentRun>) -> impl IntoView {
    let experiment: &Experiment = &ran.experiment;
    // What no paper has is compared with none.
    let of_paper = experiment.figures.iter().any(|figure| figure.paper.is_some());
    let keys = key_figures(&experiment.name)
        .iter()
        .filter_map(|id| experiment.figures.iter().find(|f| f.id == *id))
        .map(|figure| view! { <KeyFigure figure=figure.clone() of_paper=of_paper/> })
        .collect_view();
    let charts = experiment.charts.iter().map(|chart| view! { <LineChart chart=chart.clone()/> }).collect_view();
    let tables = experiment.tables.iter().map(|table| view! { <Numbers table=table.clone()/> }).collect_view();
    let seconds = ran.seconds;
    view! {
        <div class="hero keys">{keys}</div>
        <div class="charts">{charts}</div>
        <Assumed assumptions=experiment.assumptions.clone() of_paper=of_paper/>
        <Figures figures=experiment.figures.clone()/>
        {tables}
        <p class="note ran">{move || words::ran_in(format::fixed(seconds, 1))}</p>
    }
}

/// Decimals of a figure, by its unit.
fn decimals(figure: &Figure) -> usize {
    match figure.unit.as_str() {
        "%" => 1,
        "mm" => 3,
        "px" => 4,
        "µm" | "σ" => 2,
        "" if figure.ours.fract() != 0.0 => 2,
        _ => 0,
    }
}

/// A figure with its unit: `38.2 %`, `1 : 48 000`.
fn with_unit(value: f64, figure: &Figure) -> String {
    let number = format::fixed(value, decimals(figure));
    match figure.unit.as_str() {
        "1 : N" => format!("1 : {number}"),
        "" => number,
        unit => format!("{number} {unit}"),
    }
}

#[component]
fn KeyFigure(figure: Figure, of_paper: bool) -> impl IntoView {
    let named = figure.clone();
    let ours = with_unit(figure.ours, &figure);
    let paper = figure.paper.map(|value| with_unit(value, &figure));
    view! {
        <div data-key=figure.id.clone()>
            <span>{move || names::figure(&named)}</span>
            <b>{ours}</b>
            {of_paper.then(|| view! { <small>{move || paper.as_ref().map_or(words::no_paper_figure().to_owned(), |p| format!("{} {p}", words::paper()))}</small> })}
        </div>
    }
}

#[component]
fn Assumed(assumptions: Vec<Assumption>, of_paper: bool) -> impl IntoView {
    let sentences = assumptions
        .into_iter()
        .map(|a| {
            let id = a.id.clone();
            view! { <li data-assumption=id>{move || names::assumption(&a)}</li> }
        })
        .collect_view();
    view! {
        <h2 class="section-head"><span>{words::assumed}</span>
            {of_paper.then(|| view! { <span class="aside">{words::assumed_aside}</span> })}</h2>
        <ul class="assumed">{sentences}</ul>
    }
}

#[component]
fn Figures(figures: Vec<Figure>) -> impl IntoView {
    let independent = figures.iter().any(|f| f.independent.is_some());
    let of_paper = figures.iter().any(|f| f.paper.is_some());
    let rows = figures
        .into_iter()
        .map(|f| {
            let shown = |value: Option<f64>| value.map(|v| with_unit(v, &f)).unwrap_or_default();
            let (ours, paper, other) = (shown(Some(f.ours)), shown(f.paper), shown(f.independent));
            let difference = f.paper.map(|p| format::fixed(f.ours - p, decimals(&f))).unwrap_or_default();
            let id = f.id.clone();
            view! {
                <tr data-figure=id>
                    <td class="left">{move || names::figure(&f)}</td>
                    <td><b>{ours}</b></td>
                    {of_paper.then(|| view! { <td class="of-paper">{paper}</td><td>{difference}</td> })}
                    {independent.then_some(view! { <td>{other}</td> })}
                </tr>
            }
        })
        .collect_view();
    view! {
        <TableHead id="figures" title=Signal::derive(|| words::figures().to_owned()) aside=Signal::derive(String::new)/>
        <div class="framed scroll" tabindex="0">
            <table class="table">
                <thead><tr>
                    <th class="left">{words::figure}</th>
                    <th>{words::ours}</th>
                    {of_paper.then(|| view! { <th class="of-paper">{words::paper}</th><th>{words::difference}</th> })}
                    {independent.then(|| view! { <th>{words::independent}</th> })}
                </tr></thead>
                <tbody>{rows}</tbody>
            </table>
        </div>
    }
}

/// Title of a table with its own CSV file.
#[component]
fn TableHead(
    #[prop(into)] id: String,
    #[prop(into)] title: Signal<String>,
    #[prop(into)] aside: Signal<String>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <h2 class="section-head">
            <span>{title}</span>
            <span class="aside">{aside}</span>
            <button class="link" aria-label=move || format!("{}, {}", text::export_csv(), title.get())
                on:click=move |_| desk.export_experiment(Some(&id))>"CSV"</button>
        </h2>
    }
}

#[component]
fn Numbers(table: Table) -> impl IntoView {
    let id = table.id.clone();
    let named = id.clone();
    let count = table.rows.len();
    let text_columns: Vec<bool> = (0..table.columns.len())
        .map(|k| table.rows.iter().any(|row| matches!(row.get(k), Some(Cell::Text(_)))))
        .collect();
    let heads = table
        .columns
        .iter()
        .zip(&text_columns)
        .map(|(column, text)| {
            let Column { id, unit, paper, .. } = column.clone();
            let words = move || {
                let label = names::label(&id);
                if paper && id != "planted" { words::paper_of(label) } else { label }
            };
            let unit = Some(unit).filter(|u| !u.is_empty() && u != "1 : N");
            let class = if *text {
                "left"
            } else if paper {
                "of-paper"
            } else {
                ""
            };
            view! { <th class=class>{words}{unit.map(|u| view! { " " <u>{u}</u> })}</th> }
        })
        .collect_view();
    let body = table
        .rows
        .iter()
        .map(|row| {
            let cells = row.iter().zip(&table.columns).zip(&text_columns).map(|((cell, column), text)| {
                let class = if *text {
                    "left"
                } else if column.paper {
                    "of-paper"
                } else {
                    ""
                };
                match cell.clone() {
                    Cell::Number(value) => {
                        let shown = match column.decimals {
                            decimals if decimals <= PLAIN => format::fixed(value, decimals),
                            _ if value.abs() >= 0.01 => format::fixed(value, PLAIN - 1),
                            _ => format::compact(value),
                        };
                        view! { <td class=class>{shown}</td> }.into_any()
                    }
                    Cell::Text(word) => view! { <td class=class>{move || names::name(&word)}</td> }.into_any(),
                    Cell::Empty(()) => view! { <td class=class></td> }.into_any(),
                }
            });
            view! { <tr>{cells.collect_view()}</tr> }
        })
        .collect_view();
    let title = Signal::derive(move || names::table(&named));
    let aside = Signal::derive(move || words::rows(format::count(count)));
    view! {
        <TableHead id=id.clone() title aside/>
        <div class="framed scroll" data-table=id tabindex="0">
            <table class="table"><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>
        </div>
    }
}
