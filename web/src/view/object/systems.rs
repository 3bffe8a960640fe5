//! Coordinate systems in the features panel.

use leptos::prelude::*;
use sightline::adjustment::{MeasuredSystem, SystemPoint};
use sightline::project::{CoordinateSystem, SystemKind};

use crate::browser::event;
use crate::format;
use crate::i18n::{errors, object as words, text};
use crate::store::Desk;
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::view::components::units::length_unit;

/// The list of coordinate systems, and the coordinates in the one that is opened.
#[component]
pub fn Systems() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| {
        desk.document.with(|d| {
            let measured = |id: &str| d.current()?.adjustment.systems.iter().find(|s| s.id == id).cloned();
            let fresh = !d.features_out_of_date();
            let one = |s: &CoordinateSystem| {
                (s.id.clone(), system_word(&s.kind), has_weights(&s.kind), measured(&s.id).filter(|_| fresh))
            };
            d.project.systems.iter().map(one).collect::<Vec<_>>()
        })
    });
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    let open = RwSignal::new(None::<String>);
    let sorting = RwSignal::new(None::<Sorting>);
    let columns = Signal::derive(move || coordinate_columns(&unit.get()));
    let rows = Memo::new(move |_| {
        let Some(id) = open.get() else { return Vec::new() };
        all.with(|all| {
            let system = all.iter().find(|(name, ..)| *name == id).and_then(|(.., measured)| measured.as_ref());
            system.map(coordinate_rows).unwrap_or_default()
        })
    });
    let point = Signal::derive(move || desk.selection.with(|s| s.point.clone()));
    let on_choose = Callback::new(move |id: String| desk.select_point(&id));
    // The opened one, and whether its scale is estimated, if that can be chosen.
    let opened = Memo::new(move |_| {
        let id = open.get()?;
        desk.document.with(|d| {
            let system = d.project.systems.iter().find(|s| s.id == id)?;
            Some((id, if let SystemKind::BestFit { scale, .. } = system.kind { Some(scale) } else { None }))
        })
    });
    view! {
        <Show when=move || !all.with(Vec::is_empty)>
            <h2 class="section-head"><span>{words::systems}</span></h2>
            <ul class="feature-list">
                {move || all.get().into_iter().map(|(id, word, weighted, measured)| {
                    let (key, gone, shown) = (id.clone(), id.clone(), id.clone());
                    let unit = unit.get();
                    let (note, fault) = note_and_fault(measured.as_ref(), if weighted { "" } else { &unit });
                    view! {
                        <li>
                            <button class="feature" data-system=key aria-expanded=move || open.with(|o| o.as_ref() == Some(&shown)).to_string()
                                on:click=move |_| open.update(|o| *o = if o.as_ref() == Some(&id) { None } else { Some(id.clone()) })>
                                <b class="letter">{gone.clone()}</b><span class="what">{word}<small>{note}</small></span>
                                <span class="fault">{fault}</span>
                            </button>
                            <button class="link" on:click=move |_| desk.remove_feature(&gone)>{words::remove}</button>
                        </li>
                    }
                }).collect_view()}
            </ul>
            {move || opened.get().map(|(id, scale)| view! { <OpenedSystem id scale open columns rows/> })}
            <Show when=move || !rows.with(Vec::is_empty)>
                <NumberTable label=words::systems columns rows chosen=point on_choose sorting/>
            </Show>
        </Show>
    }
}

/// Name of the opened system, whether its scale is estimated, and copying of its coordinates.
#[component]
fn OpenedSystem(
    id: String,
    scale: Option<bool>,
    open: RwSignal<Option<String>>,
    columns: Signal<Vec<Column>>,
    rows: Memo<Vec<Row>>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let (from, scaled) = (id.clone(), id.clone());
    view! {
        <h2 class="section-head">
            <span>
                <input class="feature-name" name="system-name" type="text" aria-label=words::system_name prop:value=id
                    on:change=move |e| {
                        let to = event::value(&e);
                        if desk.rename_feature(&from, &to) {
                            open.set(Some(to.trim().to_owned()));
                        }
                    }/>
            </span>
            <span class="aside">
                {scale.map(|on| view! {
                    <label class="tick"><input type="checkbox" name="system-scale" prop:checked=on
                        on:change=move |e| desk.scale_system(&scaled, event::checked(&e))/> <span>{words::with_scale}</span></label>
                })}
                <CopyButton columns rows/>
            </span>
        </h2>
    }
}

/// Coordinates with their standard errors. The axes are those of the system, and not in the order of the user.
fn coordinate_columns(unit: &str) -> Vec<Column> {
    let number = |name: fn() -> &'static str, low| Column::number(name).low(low).unit(unit);
    vec![
        Column::words(text::id),
        number(|| "X", ""),
        number(|| "Y", ""),
        number(|| "Z", ""),
        number(|| "σ", "X"),
        number(|| "σ", "Y"),
        number(|| "σ", "Z"),
    ]
}

fn coordinate_rows(system: &MeasuredSystem) -> Vec<Row> {
    let sigmas = system.points.iter().filter_map(|p| p.sigma).flatten().filter(|s| *s > 0.0);
    let decimals = format::decimals_for(sigmas.fold(f64::INFINITY, f64::min));
    let row = |p: &SystemPoint| {
        let mut cells = vec![Cell::id(&p.id)];
        cells.extend(p.xyz.map(|x| Cell::number(Some(x), decimals)));
        cells.extend((0..3).map(|k| Cell::number(p.sigma.map(|s| s[k]), decimals)));
        Row { key: p.id.clone(), cells, off: false }
    };
    system.points.iter().map(row).collect()
}

fn system_word(kind: &SystemKind) -> &'static str {
    match kind {
        SystemKind::Automatic { .. } => words::system_automatic(),
        SystemKind::PlaneLinePoint { .. } => words::system_plane_line_point(),
        SystemKind::BestFit { .. } => words::system_best_fit(),
    }
}

/// Whether the fit is weighted by standard errors: σ₀ is then a ratio, else a length.
fn has_weights(kind: &SystemKind) -> bool {
    matches!(kind, SystemKind::BestFit { given, .. } if given.iter().any(|g| g.sigma.is_some()))
}

/// σ₀ or the number of points of a system, and why it could not be computed.
fn note_and_fault(system: Option<&MeasuredSystem>, unit: &str) -> (String, String) {
    let Some(system) = system else { return (text::out_of_date().to_owned(), String::new()) };
    if let Some(error) = &system.error {
        return (String::new(), errors::sentence(error));
    }
    let sigma0 = system.sigma0.map(|s| words::fit_sigma(format::fixed(s, format::decimals_for(s)), unit));
    (sigma0.unwrap_or_else(|| words::n_points(system.points.len())), String::new())
}
