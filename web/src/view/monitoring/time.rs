//! One point through all epochs: components over time with their error bars, velocity, thresholds.

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::monitoring::{Limits, Monitoring, Series, SeriesValue, ThresholdState, days};
use sightline_report::epochs::{MONTH, speed};

use super::unit;
use super::words::{p_words, state_words};
use crate::format;
use crate::i18n::{monitoring as words, name_list, text};
use crate::store::Desk;
use crate::view::components::icon::{Glyph, Icon};
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 86.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 42.0;
/// Small charts beside the one of the chosen point.
const OTHERS: usize = 6;
const CLASSES: [&str; 3] = ["x", "y", "z"];

fn length(d: [f64; 3]) -> f64 {
    d.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Standard error along the displacement, without the correlations of the axes.
fn sigma_along(value: &SeriesValue) -> Option<f64> {
    let l = length(value.difference);
    (l > 0.0).then(|| (0..3).map(|k| (value.difference[k] * value.sigma[k] / l).powi(2)).sum::<f64>().sqrt())
}

/// Places of the epochs on the axis of time, by date where all have one, else by number; and whether by date.
fn times(found: &Monitoring) -> (Vec<f64>, bool) {
    let dated: Option<Vec<f64>> = found.epochs.iter().map(|e| days(e.date.as_deref()?)).collect();
    let dated = dated.filter(|all| all.windows(2).any(|w| w[0] != w[1]));
    let by_date = dated.is_some();
    (dated.unwrap_or_else(|| (0..found.epochs.len()).map(|k| k as f64).collect()), by_date)
}

fn decimals(found: &Monitoring) -> usize {
    let sigmas = found
        .series
        .iter()
        .flat_map(|s| &s.values)
        .flat_map(|v| v.sigma)
        .filter(|s| *s > 0.0)
        .fold(f64::INFINITY, f64::min);
    if sigmas.is_finite() { format::decimals_for(sigmas) } else { 3 }
}

/// Thresholds of a point.
fn limits(desk: Desk, id: &str) -> Option<Limits> {
    desk.monitoring.options.with(|o| o.thresholds.as_ref().map(|t| *t.points.get(id).unwrap_or(&t.all)))
}

fn moves(series: &Series) -> bool {
    series.velocity_test.is_some_and(|test| !test.passed)
}

#[component]
pub fn OverTime() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let enough = Memo::new(move |_| monitored.current().is_some_and(|ran| ran.found.epochs.len() > 2));
    view! {
        <Show when=move || enough.get() fallback=|| view! { <main class="out-of-date"><h1>{words::three_needed}</h1></main> }>
            {move || head(desk)}
            <main class="over-time">
                <section class="scroll" tabindex="0" aria-label=words::over_time>
                    {move || chart_of_chosen(desk)}
                    {move || others(desk)}
                </section>
                <aside class="scroll" tabindex="0" aria-label=words::velocity>
                    {move || velocity(desk)}
                    {move || since_first(desk)}
                    <AllPoints/>
                </aside>
            </main>
        </Show>
    }
}

fn chosen(desk: Desk) -> Option<(std::sync::Arc<crate::store::monitoring::ComparisonRun>, Series)> {
    let ran = desk.monitoring.current()?;
    let id = desk.monitoring.point.get();
    let known = ran.found.series.iter().find(|s| Some(&s.id) == id.as_ref());
    let series = known.or_else(|| ran.found.series.first())?.clone();
    Some((ran, series))
}

/// The sentence of the chosen point.
fn head(desk: Desk) -> Option<impl IntoView> {
    let (ran, series) = chosen(desk)?;
    let unit = unit(&ran);
    let sentence = match speed(&series) {
        Some((v, s)) => {
            let places = s.filter(|s| *s > 0.0).map_or(3, format::decimals_for);
            let (value, sigma) = (format::fixed(v, places), format::maybe(s, places));
            if moves(&series) {
                words::velocity_moves(&series.id, value, sigma, &unit)
            } else {
                words::velocity_still(&series.id, value, sigma, &unit)
            }
        }
        None => words::velocity_none().to_owned(),
    };
    let state = series.state.map(|state| {
        let class = match state {
            ThresholdState::Quiet => "pass",
            ThresholdState::Warning => "warn",
            ThresholdState::Alarm => "bad",
        };
        let icon = match state {
            ThresholdState::Quiet => Icon::Check,
            ThresholdState::Warning => Icon::Warning,
            ThresholdState::Alarm => Icon::Cross,
        };
        view! { <span class=class data-found="state"><Glyph icon size=14/> " " {state_words(state)}</span> }
    });
    let datum = match ran.found.series_datum.as_slice() {
        [] => words::series_no_datum().to_owned(),
        names => words::series_datum(name_list(names)),
    };
    let last = series.values.last().map(|v| {
        let places = decimals(&ran.found);
        let sigma = sigma_along(v).map(|s| format!(" ± {}", format::fixed(s, places))).unwrap_or_default();
        view! { <div><span>{words::length} " " <u>{unit.clone()}</u></span><b>{format::fixed(length(v.difference), places)}<small>{sigma}</small></b><small>{v.epoch.clone()}</small></div> }
    });
    Some(view! {
        <div class="moved-verdict" class:calm=!moves(&series) aria-live="polite">
            <div class="words"><p class="said"><b data-found="velocity">{sentence}</b> {state}</p><p>{datum}</p></div>
            {last}
        </div>
    })
}

/// Values of the axis: a round step that cuts it into three to eight.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let step = sightline::depiction::round((high - low) / 4.0);
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first).clamp(0.0, 20.0) as usize;
    (0..=count).map(|k| (first + k as f64) * step).collect()
}

/// Lowest and highest value that all charts show.
fn range(desk: Desk, of: &[&Series]) -> [f64; 2] {
    let values = of.iter().flat_map(|s| &s.values);
    let ends = values.flat_map(|v| (0..3).flat_map(|k| [v.difference[k] - v.sigma[k], v.difference[k] + v.sigma[k]]));
    let (mut low, mut high) = ends.fold((0.0_f64, 0.0_f64), |(low, high), e| (low.min(e), high.max(e)));
    let size = (high - low).max(1e-12);
    // Thresholds are shown where the displacements come near them.
    for limits in of.iter().filter_map(|s| limits(desk, &s.id)) {
        for limit in [limits.warning, limits.alarm] {
            if limit < 3.0 * size {
                (low, high) = (low.min(-limit), high.max(limit));
            }
        }
    }
    let margin = 0.06 * (high - low).max(1e-12);
    [low - margin, high + margin]
}

fn symbol(axis: usize, x: f64, y: f64, r: f64) -> AnyView {
    match axis {
        0 => view! { <rect class="spot" x=x - r y=y - r width=2.0 * r height=2.0 * r></rect> }.into_any(),
        1 => view! { <circle class="spot" cx=x cy=y r=1.1 * r></circle> }.into_any(),
        _ => view! { <path class="spot" d=format!("M{x:.1} {:.1}l{:.1} {:.1}h-{:.1}z", y - 1.3 * r, 1.2 * r, 2.3 * r, 2.4 * r)></path> }.into_any(),
    }
}

/// Components of a point over time with error bars, the straight line of its velocity and thresholds.
fn chart(desk: Desk, found: &Monitoring, series: &Series, [low, high]: [f64; 2], small: bool) -> impl IntoView + use<> {
    let (width, height) = if small { (330.0, 140.0) } else { (WIDTH, HEIGHT) };
    let (left, right, top, bottom) = if small { (40.0, 10.0, 8.0, 18.0) } else { (LEFT, RIGHT, TOP, BOTTOM) };
    let (times, dated) = times(found);
    let (first, last) = times.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(*t), b.max(*t)));
    let across = move |t: f64| left + 12.0 + (t - first) / (last - first).max(1e-12) * (width - left - right - 24.0);
    let down = move |v: f64| top + (high - v) / (high - low) * (height - top - bottom);
    let unit = found.unit.clone().unwrap_or_default();
    let places = {
        let step = sightline::depiction::round((high - low) / 4.0);
        (-step.log10()).ceil().clamp(0.0, 8.0) as usize
    };
    let grid = ticks(low, high).into_iter().filter(|v| !small || *v == 0.0 || v.abs() * 2.5 > high.max(-low)).map(|v| view! {
        <line class=if v == 0.0 { "zero" } else { "grid" } x1=left x2=width - right y1=down(v) y2=down(v)></line>
        <text class="axis" x=left - 6.0 y=down(v) + 4.0 text-anchor="end">{format::fixed(v, places)}</text>
    });
    let grid = grid.collect_view();
    let lines = limits(desk, &series.id).map(|limits| {
        let one = |value: f64, class: &'static str, name: fn() -> &'static str| {
            (value < high && value > low).then(|| {
                let label = (!small).then(|| view! { <text class=format!("axis {class}") x=width - right + 6.0 y=down(value) + 4.0>{name} " " {format::editable(value.abs())}</text> });
                view! { <line class=format!("limit {class}") x1=left x2=width - right y1=down(value) y2=down(value)></line>{label} }
            })
        };
        view! {
            {one(limits.warning, "warning", words::warning)}{one(-limits.warning, "warning", words::warning)}
            {one(limits.alarm, "alarm", words::alarm)}{one(-limits.alarm, "alarm", words::alarm)}
        }
    });
    let dates = found.epochs.iter().enumerate().filter(|(k, _)| !small || *k == 0 || *k + 1 == found.epochs.len()).map(|(k, epoch)| {
        let x = across(times[k]);
        let date = epoch.date.clone().map_or(String::new(), |date| date.chars().take(10).collect());
        let date = (!small).then(|| view! { <text class="axis" x=x y=height - 10.0 text-anchor="middle">{date}</text> });
        view! { <text class="axis strong" x=x y=height - if small { 4.0 } else { 24.0 } text-anchor="middle">{k}</text>{date} }
    });
    let dates = dates.collect_view();
    let place = |name: &String| found.epochs.iter().position(|e| e.name == *name);
    let spread = if small { 2.5 } else { 5.0 };
    let components = (0..3).map(|axis| {
        let shift = (axis as f64 - 1.0) * spread;
        let mut spots = vec![symbol(axis, across(times[0]) + shift, down(0.0), if small { 2.0 } else { 3.5 })];
        for value in &series.values {
            let Some(k) = place(&value.epoch) else { continue };
            let (x, d, s) = (across(times[k]) + shift, value.difference[axis], value.sigma[axis]);
            let bar = view! { <path class="bar" d=format!("M{x:.1} {:.1}V{:.1}M{:.1} {:.1}h6M{:.1} {:.1}h6", down(d - s), down(d + s), x - 3.0, down(d - s), x - 3.0, down(d + s))></path> };
            spots.push(view! { {bar}{symbol(axis, x, down(d), if small { 2.0 } else { 3.5 })} }.into_any());
        }
        let line = series.velocity.zip(series.line_start).filter(|_| dated).map(|(v, start)| {
            let end = start[axis] + v[axis] * (last - first);
            view! { <path class="trend" d=format!("M{:.1} {:.1}L{:.1} {:.1}", across(first), down(start[axis]), across(last), down(end))></path> }
        });
        view! { <g class=CLASSES[axis]>{line}{spots.collect_view()}</g> }
    });
    let components = components.collect_view();
    let label = words::components(&series.id);
    view! {
        <svg class="time-chart" class:small=small viewBox=format!("0 0 {width} {height}") role="img" aria-label=label>
            {grid}{lines}{dates}{components}
            {(!small).then(|| view! { <text class="axis" x="4" y="12">{unit}</text> })}
        </svg>
    }
}

fn legend(axes: ShownAxes) -> impl IntoView {
    axes.order().into_iter().map(move |axis| view! { <li><svg width="14" height="12" viewBox="0 0 14 12" aria-hidden="true"><g class=CLASSES[axis]>{symbol(axis, 7.0, 6.0, 3.5)}</g></svg><span>"d" {axes.letter(axis)}</span></li> }).collect_view()
}

fn chart_of_chosen(desk: Desk) -> Option<impl IntoView> {
    let (ran, series) = chosen(desk)?;
    let range = range(desk, &[&series]);
    let undated = ran
        .found
        .epochs
        .iter()
        .any(|e| e.date.is_none())
        .then(|| view! { <p class="hint warn">{words::velocity_none}</p> });
    Some(view! {
        <h2 class="section-head"><span>{words::components(&series.id)}</span><ul class="picture-legend time-legend">{legend(ShownAxes::of(ran.found.axes))}<li>{words::bars}</li></ul></h2>
        {chart(desk, &ran.found, &series, range, false)}{undated}
    })
}

/// The other points that moved most, on one scale.
fn others(desk: Desk) -> Option<impl IntoView> {
    let (ran, series) = chosen(desk)?;
    let last = |s: &Series| s.values.last().map_or(0.0, |v| length(v.difference));
    let mut all: Vec<&Series> =
        ran.found.series.iter().filter(|s| s.id != series.id && !ran.found.series_datum.contains(&s.id)).collect();
    all.sort_by(|a, b| last(b).total_cmp(&last(a)));
    all.truncate(OTHERS);
    if all.is_empty() {
        return None;
    }
    let range = range(desk, &all);
    let charts = all.iter().map(|s| {
        let id = s.id.clone();
        view! { <div class="small-chart"><button class="link" on:click=move |_| desk.monitoring.point.set(Some(id.clone()))>{s.id.clone()}</button>{chart(desk, &ran.found, s, range, true)}</div> }
    });
    let charts = charts.collect_view();
    Some(view! { <div class="small-charts">{charts}</div> })
}

fn velocity(desk: Desk) -> Option<impl IntoView> {
    let (ran, series) = chosen(desk)?;
    let (v, s) = series.velocity.zip(series.velocity_sigma)?;
    let unit = unit(&ran);
    let smallest = s.iter().copied().filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    let places = if smallest.is_finite() { format::decimals_for(MONTH * smallest) } else { 3 };
    let axes = ShownAxes::of(ran.found.axes);
    let rows = axes.order().into_iter().map(|axis| view! {
        <tr><td class="left">{axes.letter(axis)}</td><td><b>{format::fixed(MONTH * v[axis], places)}</b></td><td>{format::fixed(MONTH * s[axis], places)}</td>
            <td>{if s[axis] > 0.0 { format::fixed(v[axis].abs() / s[axis], 1) } else { "–".to_owned() }}</td></tr>
    });
    let rows = rows.collect_view();
    let test = series.velocity_test.map(|t| {
        let judged = if t.passed { words::stable() } else { words::moves() };
        format!(
            "T {}, {} {}, p {}: {judged}",
            format::fixed(t.statistic, 1),
            words::limit(),
            format::fixed(t.limit, 2),
            p_words(t.p)
        )
    });
    Some(view! {
        <h2 class="section-head"><span>{words::velocity_of(&series.id)} " " <span class="id">{unit}</span></span><span class="aside">{words::per_month}</span></h2>
        <table class="table"><thead><tr><td class="left"></td><th>"v"</th><th>"σ"</th><th>"|v| / σ"</th></tr></thead><tbody>{rows}</tbody></table>
        <p class="hint">{test}</p>
    })
}

fn since_first(desk: Desk) -> Option<impl IntoView> {
    let (ran, series) = chosen(desk)?;
    let unit = unit(&ran);
    let places = decimals(&ran.found);
    let limits = limits(desk, &series.id);
    let axes = ShownAxes::of(ran.found.axes);
    let rows = ran.found.epochs.iter().enumerate().map(|(k, epoch)| {
        let date = epoch.date.clone().unwrap_or_else(|| words::without_date().to_owned());
        let date = date.chars().take(16).collect::<String>();
        if k == 0 {
            return view! { <tr><td><b>"0"</b></td><td class="left">{date}</td><td>"0"</td><td>"0"</td><td>"0"</td><td>"0"</td><td>"–"</td><td class="left"></td></tr> }.into_any();
        }
        let Some(value) = series.values.iter().find(|v| v.epoch == epoch.name) else {
            return view! { <tr><td><b>{k}</b></td><td class="left">{date}</td><td class="left" colspan="6">{words::not_in_epoch}</td></tr> }.into_any();
        };
        let l = length(value.difference);
        let state = limits.map(|limits| match l {
            l if l >= limits.alarm => view! { <span class="bad"><Glyph icon=Icon::Cross size=12/> " " {words::state_alarm}</span> }.into_any(),
            l if l >= limits.warning => view! { <span class="warn"><Glyph icon=Icon::Warning size=12/> " " {words::state_warning}</span> }.into_any(),
            _ => ().into_any(),
        });
        view! {
            <tr data-epoch=k.to_string()><td><b>{k}</b></td><td class="left">{date}</td>{axes.shown(value.difference).map(|d| view! { <td>{format::fixed(d, places)}</td> }).collect_view()}
                <td><b>{format::fixed(l, places)}</b></td><td>{format::maybe(sigma_along(value), places)}</td><td class="left">{state}</td></tr>
        }.into_any()
    });
    let rows = rows.collect_view();
    Some(view! {
        <h2 class="section-head"><span>{words::since_first} " " <span class="id">{unit}</span></span></h2>
        <table class="table" data-found="since-first">
            <thead><tr><th>{words::number}</th><th class="left">{words::date}</th>{axes.names().map(|axis| view! { <th>"d" {axis}</th> }).collect_view()}<th>{words::length}</th><th>"σ"</th><td class="left"></td></tr></thead>
            <tbody>{rows}</tbody>
        </table>
        {limits.is_some().then(|| view! { <p class="hint">{words::compared_length}</p> })}
    })
}

/// Velocities of all points.
#[component]
fn AllPoints() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let sorting = RwSignal::new(Some(Sorting { column: 1, descending: true }));
    let columns = Signal::derive(move || {
        let unit = monitored.current().map(|ran| unit(&ran)).unwrap_or_default();
        let length = |name: fn() -> &'static str| Column::number(name).unit(unit.clone());
        vec![
            Column::words(text::id),
            length(words::length),
            length(words::velocity),
            length(|| "σ"),
            Column::number(|| "T"),
            Column::number(|| "p"),
            Column::words(words::state),
        ]
    });
    let rows = Memo::new(move |_| {
        let Some(ran) = monitored.current() else { return Vec::new() };
        let places = decimals(&ran.found);
        let all = ran.found.series.iter().map(|series| {
            let speed = speed(series);
            let sigma = speed.and_then(|(_, s)| s);
            let digits = sigma.filter(|s| *s > 0.0).map_or(3, format::decimals_for);
            let mut p = Cell::words(series.velocity_test.map_or("–".to_owned(), |t| p_words(t.p))).class("");
            p.order = series.velocity_test.map(|t| t.p);
            let (state, class) = match series.state {
                Some(ThresholdState::Alarm) => (words::state_alarm(), "left bad"),
                Some(ThresholdState::Warning) => (words::state_warning(), "left warn"),
                _ if moves(series) => (words::moves(), "left warn"),
                _ => ("", "left"),
            };
            let cells = vec![
                Cell::id(&series.id),
                Cell::number(series.values.last().map(|v| length(v.difference)), places),
                Cell::number(speed.map(|(v, _)| v), digits),
                Cell::number(sigma, digits),
                Cell::number(series.velocity_test.map(|t| t.statistic), 1),
                p,
                Cell::words(state).class(class),
            ];
            Row { key: series.id.clone(), cells, off: false }
        });
        all.collect::<Vec<_>>()
    });
    let height = move || format!("calc({} * var(--row))", rows.with(Vec::len).min(24) + 1);
    view! {
        <h2 class="section-head"><span>{words::all_points} " " <span class="id">{move || format::count(rows.with(Vec::len))}</span></span><CopyButton columns rows/></h2>
        <p class="hint">{words::per_month}</p>
        <div class="displaced-table series" style:height=height>
            <NumberTable label=words::all_points columns rows chosen=Signal::derive(move || monitored.point.get())
                on_choose=Callback::new(move |id: String| monitored.point.set(Some(id))) sorting/>
        </div>
    }
}
