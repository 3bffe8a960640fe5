//! The result beside the one before: what moved, by how many standard errors. The engine compares; here it is shown.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::comparison::{Alignment, CovarianceOf, Moved, ParameterChange};

use crate::format;
use crate::i18n::{comparing as words, name_list, text};
use crate::store::{Desk, Kind};
use crate::view::components::parameters::parameter_cells;
use crate::view::components::parameters::parameter_name;
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::view::components::units::length_unit;

/// In which system the two were compared.
fn alignment_words(alignment: &Alignment) -> String {
    match alignment {
        Alignment::Same => words::same_system().to_owned(),
        Alignment::Fitted { points, scale: None } => words::fitted_rigidly(points),
        Alignment::Fitted { points, scale: Some(scale) } => words::fitted(points, format::fixed(*scale, 6)),
        Alignment::Apart { common } => words::apart(common),
        Alignment::Unlike { common, agreeing, mirrored: true, .. } => words::unlike_mirrored(common, agreeing),
        Alignment::Unlike { common, agreeing, scale: Some(scale), .. } => {
            words::unlike_scale(common, agreeing, format::fixed(*scale, 6))
        }
        Alignment::Unlike { common, agreeing, .. } => words::unlike(common, agreeing),
        Alignment::Units { before, after } => words::other_units(before, after),
    }
}

/// Where the standard errors come from.
fn ratio_words(covariance: CovarianceOf) -> &'static str {
    match covariance {
        CovarianceOf::Union => words::ratios_union(),
        CovarianceOf::Sum => words::ratios_independent(),
        _ => words::ratios_mean(),
    }
}

#[component]
pub(super) fn Compared() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = desk.reports.compared;
    // Which two results are compared, distinguished by their positions.
    let pair = Memo::new(move |_| {
        let present = desk.document.with(|d| d.current().map(Arc::as_ptr));
        let before = desk.result_before();
        [present.map(|p| p as usize), before.as_ref().map(|b| Arc::as_ptr(b) as usize)]
    });
    Effect::new(move |_| {
        pair.track();
        desk.compare_results();
    });
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    let says = move || {
        all.with(|found| {
            let found = found.as_ref()?;
            let unit = unit.get();
            let sigma0 = found.sigma0.map(|s| format::maybe(s, 3));
            let redundancy = found.redundancy.map(format::count);
            let rms = found.rms.map(|rms| {
                let rms = format::fixed(rms, format::decimals_for(rms));
                let limit = format::fixed(found.limit, 2);
                words::moved_by(format::count(found.points.len()), rms, unit, format::count(found.beyond), limit)
            });
            let gone = (!found.gone.is_empty()).then(|| words::gone(found.gone.len(), name_list(&found.gone)));
            let new = (!found.new.is_empty()).then(|| words::only_now(found.new.len(), name_list(&found.new)));
            let unlike =
                (!found.unlike_cameras.is_empty()).then(|| words::unlike_cameras(name_list(&found.unlike_cameras)));
            Some(view! {
                <p data-compared="figures">{words::figures(&sigma0[0], &sigma0[1], &redundancy[0], &redundancy[1])} " " {rms}</p>
                <p class="note" data-compared="alignment">{alignment_words(&found.alignment)} " " {ratio_words(found.covariance)}</p>
                {[gone, new, unlike].into_iter().flatten().map(|line| view! { <p class="note">{line}</p> }).collect_view()}
            })
        })
    };
    let points = Signal::derive(move || all.with(|found| found.as_ref().map(|f| f.points.clone()).unwrap_or_default()));
    let photos = Signal::derive(move || all.with(|found| found.as_ref().map(|f| f.photos.clone()).unwrap_or_default()));
    let limit = Signal::derive(move || all.with(|found| found.as_ref().map_or(f64::INFINITY, |f| f.limit)));
    let parameters = move || all.with(|found| found.as_ref().map(|f| f.parameters.clone()).unwrap_or_default());
    let point = Signal::derive(move || desk.selection.with(|s| s.point.clone()));
    let photo = Signal::derive(move || desk.selection.with(|s| s.photo.clone()));
    view! {
        <main class="compared" data-compared="page">
            <section class="compared-points">
                <Movements title=text::points moved=points limit chosen=point on_choose=Callback::new(move |id: String| desk.select_point(&id)) kind=Kind::Points/>
            </section>
            <section class="scroll compared-rest" tabindex="0" aria-label=words::beside_before>
                <div class="compared-words">{says}</div>
                <Show when=move || all.with(|found| found.as_ref().is_some_and(|f| !f.parameters.is_empty()))>
                    <Parameters all=Signal::derive(parameters) limit/>
                </Show>
                <div class="compared-photos">
                    <Movements title=words::projection_centres moved=photos limit chosen=photo on_choose=Callback::new(move |id: String| desk.select_photo(&id)) kind=Kind::Photos/>
                </div>
            </section>
        </main>
    }
}

/// How far points or projection centres moved, those first that moved by most standard errors.
#[component]
fn Movements(
    title: fn() -> &'static str,
    moved: Signal<Vec<Moved>>,
    limit: Signal<f64>,
    chosen: Signal<Option<String>>,
    on_choose: Callback<String>,
    kind: Kind,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 6, descending: true }));
    let columns = Signal::derive(move || {
        let unit = desk.document.with(length_unit);
        let length = |name: fn() -> &'static str| Column::number(name).unit(unit.clone());
        let difference = |axis| Column::axis(|| "Δ", axis).unit(unit.clone());
        let [a, b, c] = desk.axes().names();
        vec![
            Column::words(if matches!(kind, Kind::Photos) { text::photo } else { text::id }),
            difference(a),
            difference(b),
            difference(c),
            length(|| "|Δ|"),
            length(words::largest_sigma),
            Column::number(words::times_sigma),
        ]
    });
    let rows = Memo::new(move |_| {
        let (limit, axes) = (limit.get(), desk.axes());
        moved.with(|all| {
            let smallest =
                all.iter().filter_map(|m| m.sigma).flatten().filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
            let decimals = format::decimals_for(smallest);
            let row = |m: &Moved| {
                let mut cells = vec![Cell::id(&m.id)];
                cells.extend(axes.shown(m.difference).map(|d| Cell::number(Some(d), decimals)));
                cells.push(Cell::number(Some(m.length()), decimals));
                cells.push(Cell::number(m.sigma.map(|s| s.into_iter().fold(0.0, f64::max)), decimals));
                let over = m.ratio.is_some_and(|ratio| ratio > limit);
                cells.push(Cell::number(m.ratio, 1).class(if over { "bad" } else { "" }));
                Row { key: m.id.clone(), cells, off: false }
            };
            all.iter().map(row).collect::<Vec<_>>()
        })
    });
    view! {
        <h2 class="section-head">
            <span>{title} " " <span class="id">{move || format::count(rows.with(Vec::len))}</span></span>
            <CopyButton columns rows/>
        </h2>
        <NumberTable label=title columns rows chosen on_choose sorting kind/>
    }
}

/// Previous and present interior orientations.
#[component]
fn Parameters(#[prop(into)] all: Signal<Vec<ParameterChange>>, limit: Signal<f64>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let row = move |change: ParameterChange| {
        let camera = desk.document.with(|d| {
            let all = d.current().map(|r| r.input.cameras.clone()).unwrap_or_default();
            all.into_iter().find(|camera| camera.id == change.camera)
        })?;
        let shown = |value: f64| parameter_cells(&camera, change.parameter, value, change.sigma);
        let ((before, ..), (after, sigma, unit)) = (shown(change.before), shown(change.after));
        let whose = change.photo.as_ref().map_or(change.camera.clone(), |photo| format!("{} · {photo}", change.camera));
        let over = change.ratio.is_some_and(|ratio| ratio > limit.get());
        Some(view! {
            <tr data-parameter=change.parameter.name()>
                <td class="left id">{whose}</td><td class="left">{parameter_name(change.parameter)}</td>
                <td>{before}</td><td><b>{after}</b></td><td>{sigma}</td><td class="left">{unit}</td>
                <td class:bad=over>{format::maybe(change.ratio, 1)}</td>
            </tr>
        })
    };
    view! {
        <h2 class="section-head"><span>{text::cameras}</span></h2>
        <div class="compared-cameras">
            <table class="table">
                <thead><tr>
                    <th class="left">{text::camera}</th><td class="left"></td><th>{words::before}</th><th>{words::after}</th>
                    <th>{words::largest_sigma}</th><th class="left">{text::unit}</th><th>{words::times_sigma}</th>
                </tr></thead>
                <tbody>{move || all.get().into_iter().map(row).collect_view()}</tbody>
            </table>
        </div>
    }
}
