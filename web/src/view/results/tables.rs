//! Check points, photos, points and the worst observations of a result.

use std::collections::HashMap;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::adjustment::{AdjustedObservation, Adjustment};

use super::read;
use crate::browser::page;
use crate::document::AdjustmentResult;
use crate::format;
use crate::i18n::{language, text};
use crate::store::{Desk, Kind, Step};
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::view::components::units::common_unit;
use crate::view::components::units::factors;
use crate::view::components::units::length_unit;

/// Differences at the check points.
#[component]
pub(super) fn CheckPoints() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| read(desk, |a, _| a.check_points.clone()));
    let axes = Memo::new(move |_| desk.axes());
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    view! {
        <Show when=move || all.with(|a| !a.is_empty())>
            <h2 class="section-head"><span>{text::check_points}</span><span class="aside">{text::adjusted_minus_given}</span></h2>
            <table class="table">
                <thead><tr><th class="left">{text::id}</th>{move || axes.get().names().map(|n| view! { <th>"Δ" {n} " " <u>{unit}</u></th> }).collect_view()}</tr></thead>
                <tbody>
                    {move || all.get().into_iter().map(|c| view! {
                        <tr><td class="left id">{c.id}</td>{axes.get().order().map(|k| view! { <td>{format::maybe(c.difference.map(|d| d[k]), 4)}</td> }).collect_view()}</tr>
                    }).collect_view()}
                </tbody>
            </table>
        </Show>
    }
}

#[component]
pub(super) fn PhotosTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(None::<Sorting>);
    let columns = Signal::derive(move || {
        let length = desk.document.with(length_unit);
        let unit = read(desk, |a, _| common_unit(a).1.to_owned());
        let mut columns = vec![
            Column::words(text::photo),
            Column::number(text::points_column),
            Column::number(text::rms_x).unit(unit.clone()),
            Column::number(text::rms_y).unit(unit),
        ];
        columns.extend(Column::coordinates(desk.axes(), &length));
        columns
    });
    let rows = Memo::new(move |_| {
        let axes = desk.axes();
        read(desk, |a, _| {
            let factors = factors(a);
            // As the best of them is known: a column has one number of decimals.
            let known = a.photos.iter().filter_map(|p| p.sigma_position).flatten().filter(|sigma| *sigma > 0.0);
            let decimals = format::decimals_for(known.fold(f64::INFINITY, f64::min));
            let row = |p: &sightline::adjustment::AdjustedPhoto| {
                let [fx, fy] = factors.get(&p.id).copied().unwrap_or([1.0, 1.0]);
                let sigma = p.sigma_position;
                let mut cells = vec![Cell::id(&p.id), Cell::count(p.points)];
                cells.push(Cell::number(Some(p.rms_x * fx), 2 + usize::from(fx < 100.0)));
                cells.push(Cell::number(Some(p.rms_y * fy), 2 + usize::from(fy < 100.0)));
                cells.extend(axes.shown(p.position).map(|x| Cell::number(Some(x), decimals)));
                cells.extend(axes.order().map(|k| Cell::number(sigma.map(|s| s[k]), decimals)));
                Row { key: p.id.clone(), cells, off: false }
            };
            a.photos.iter().map(row).collect::<Vec<_>>()
        })
    });
    let chosen = Signal::derive(move || desk.selection.with(|s| s.photo.clone()));
    view! {
        <h2 class="section-head">
            <span>{text::photos} " " <span class="id">{move || rows.with(Vec::len)}</span></span>
            <CopyButton columns rows/>
        </h2>
        <NumberTable label=text::photos columns rows chosen on_choose=Callback::new(move |id: String| desk.select_photo(&id)) sorting kind=Kind::Photos/>
    }
}

#[component]
pub(super) fn PointsTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 7, descending: true }));
    let columns = Signal::derive(move || {
        let unit = desk.document.with(length_unit);
        let mut columns = vec![Column::words(text::id), Column::number(text::rays)];
        columns.extend(Column::coordinates(desk.axes(), &unit));
        columns
    });
    let rows = Memo::new(move |_| {
        let axes = desk.axes();
        read(desk, |a, _| {
            let largest = a.points.iter().filter_map(|p| p.sigma).map(|s| s[2]).fold(0.0_f64, f64::max);
            let typical = a.precision.as_ref().map_or(0.001, |p| p.rms_sigma.into_iter().fold(f64::INFINITY, f64::min));
            let decimals = format::decimals_for(typical);
            let row = |p: &sightline::adjustment::AdjustedPoint| {
                let rays = Cell::count(p.rays).class(if p.rays < 3 { "warn" } else { "" });
                let mut cells = vec![Cell::id(&p.id), rays];
                cells.extend(axes.shown(p.xyz).map(|x| Cell::number(Some(x), decimals)));
                cells.extend(axes.order().map(|k| Cell::number(p.sigma.map(|s| s[k]), decimals)));
                if let (Some(s), Some(last)) = (p.sigma, cells.last_mut()) {
                    last.bar = (largest > 0.0).then(|| s[2] / largest);
                }
                Row { key: p.id.clone(), cells, off: false }
            };
            a.points.iter().map(row).collect::<Vec<_>>()
        })
    });
    let chosen = Signal::derive(move || desk.selection.with(|s| s.point.clone()));
    view! {
        <h2 class="section-head">
            <span>{text::points} " " <span class="id">{move || format::count(rows.with(Vec::len))}</span></span>
            <CopyButton columns rows/>
        </h2>
        <NumberTable label=text::points columns rows chosen on_choose=Callback::new(move |id: String| desk.select_point(&id)) sorting kind=Kind::Points/>
    }
}

pub(super) fn largest_w(o: &AdjustedObservation) -> Option<f64> {
    [o.wx, o.wy].into_iter().flatten().max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// A result: the same where it is the same object.
#[derive(Clone)]
struct Same(Arc<AdjustmentResult>);

impl PartialEq for Same {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Observations whose rows are made in one task of the page.
const AT_ONCE: usize = 2000;

fn worst_row(a: &Adjustment, factors: &HashMap<String, [f64; 2]>, o: &AdjustedObservation) -> Row {
    let [fx, fy] = factors.get(&o.photo).copied().unwrap_or([1.0, 1.0]);
    let decimals = 2 + usize::from(fx < 100.0);
    let w = largest_w(o);
    let r = [o.rx, o.ry].into_iter().flatten().min_by(f64::total_cmp);
    let over = w.is_some_and(|w| w.abs() > a.criteria.w);
    let mut size = Cell::number(w, 2).class(if over { "bad" } else { "" });
    size.order = w.map(f64::abs);
    let verdict = if over { format!("✕ {}", text::over(format::fixed(a.criteria.w, 2))) } else { String::new() };
    Row {
        key: format!("{}\u{1f}{}", o.photo, o.point),
        cells: vec![
            Cell::id(&o.point),
            Cell::words(&o.photo),
            Cell::number(o.vx.map(|v| v * fx), decimals),
            Cell::number(o.vy.map(|v| v * fy), decimals),
            Cell::number(r, 2),
            size,
            Cell::words(verdict).class("left wide bad"),
        ],
        off: !o.enabled,
    }
}

/// Observations by the size of their test value: their rows are made piece by piece, for there may be many.
#[component]
pub(super) fn Worst() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 5, descending: true }));
    let columns = Signal::derive(move || {
        let unit = read(desk, |a, _| common_unit(a).1.to_owned());
        vec![
            Column::words(text::id),
            Column::words(text::photo),
            Column::number(|| "v").low("x").unit(unit.clone()),
            Column::number(|| "v").low("y").unit(unit),
            Column::number(|| "r"),
            Column::number(|| "w"),
            Column::words(text::verdict),
        ]
    });
    let current = Memo::new(move |_| desk.document.with(|d| d.current().cloned().map(Same)));
    let rows = RwSignal::new(Vec::<Row>::new());
    Effect::new(move |_| {
        // Its words are of a language.
        language();
        let Some(Same(result)) = current.get() else { return rows.set(Vec::new()) };
        spawn_local(async move {
            let a = &result.adjustment;
            let factors = factors(a);
            let mut all = Vec::new();
            for some in a.observations.chunks(AT_ONCE) {
                page::breathe().await;
                all.extend(some.iter().filter(|o| o.enabled).map(|o| worst_row(a, &factors, o)));
            }
            let is_meant = || current.try_get_untracked().flatten().is_some_and(|now| now == Same(result.clone()));
            if is_meant() {
                rows.try_set(all);
            }
        });
    });
    let chosen = Signal::derive(move || {
        desk.selection.with(|s| Some(format!("{}\u{1f}{}", s.photo.clone()?, s.point.clone()?)))
    });
    let choose = Callback::new(move |key: String| {
        if let Some((photo, point)) = key.split_once('\u{1f}') {
            desk.select_observation(photo, point);
        }
    });
    // Its photo, at its place.
    let open = Callback::new(move |key: String| {
        choose.run(key);
        desk.go(Step::Identities);
    });
    view! {
        <h2 class="section-head">
            <span>{text::worst_observations}</span>
            <span class="aside">{text::baarda}</span>
            <CopyButton columns rows/>
        </h2>
        <NumberTable label=text::worst_observations columns rows chosen on_choose=choose on_open=open sorting kind=Kind::Observations/>
    }
}
