//! Predicted accuracy of a plan, what is missing, the best next photo, comparison of plans.

use leptos::prelude::*;
use sightline::Error;
use sightline::adjustment::Advice;
use sightline::project::{Parameter, Wanted};
use sightline_plan::{Criterion, Lacking, Prediction};

use super::predicted;
use crate::browser::event;
use crate::document::Change;
use crate::edit::plan;
use crate::format;
use crate::i18n::{errors, name_list, planning as words};
use crate::store::Desk;
use crate::view::components::icon::{Glyph, Icon};
use crate::view::components::parameters::parameter_name;
use crate::view::components::parameters::parameter_unit;

fn unit(desk: Desk) -> String {
    desk.document.with(|d| d.project.unit.clone())
}

/// A length with digits according to its size.
fn length(value: f64) -> String {
    format::fixed(value, format::decimals_for(value))
}

fn lack_words(lack: &Lacking) -> String {
    match lack {
        Lacking::NoPhotos => words::lack_no_photos().to_owned(),
        Lacking::NoPoints => words::lack_no_points().to_owned(),
        Lacking::Undetermined { points } => words::lack_undetermined(name_list(points)),
        Lacking::Beyond { points } => words::lack_beyond(name_list(points)),
        Lacking::Forbidden { stations } => words::lack_forbidden(name_list(stations)),
        Lacking::Defect { defect } => errors::sentence(&Error::RankDefect { defects: vec![defect.clone()] }),
    }
}

/// Weaknesses of the network that apply to a plan.
fn advice_words(advice: &Advice) -> Option<String> {
    Some(match advice {
        Advice::TwoRays { points } => words::two_rays(name_list(points)),
        Advice::NarrowIntersection { points } => words::narrow(name_list(points.iter().map(|(id, _)| id))),
        Advice::HighCorrelation { first, second, correlation, .. } => {
            words::correlated(first, second, format::fixed(*correlation, 2))
        }
        Advice::WeakPrincipalDistance { parameter, sigma, .. } => {
            words::weak_distance(parameter, format::compact(*sigma))
        }
        _ => return None,
    })
}

#[component]
pub fn Verdict() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let told = move || {
        // What is wanted does not change while a station is dragged.
        let (wanted, points) = desk.document.with(|d| d.project.plan.as_deref().map(|p| (p.wanted, p.points.len())))?;
        let failure = desk.planning.predicted.with(|p| p.as_ref().and_then(|p| p.as_ref().err()).map(errors::sentence));
        if let Some(sentence) = failure {
            return Some(
                view! { <p class="note bad" role="alert"><Glyph icon=Icon::Warning/> " " {sentence}</p> }.into_any(),
            );
        }
        let Some(prediction) = predicted(desk) else {
            return Some(view! { <p class="note">{words::predicting}</p> }.into_any());
        };
        Some(verdict(desk, wanted, points, &prediction).into_any())
    };
    view! { <div class="verdict" aria-live="polite">{told}</div> }
}

fn verdict(desk: Desk, wanted: Wanted, points: usize, prediction: &Prediction) -> impl IntoView + use<> {
    let unit = unit(desk);
    let k = prediction.factor;
    let level = format::editable((1e5 * wanted.probability).round() / 1e3);
    let beyond = prediction
        .lacks
        .iter()
        .find_map(|l| if let Lacking::Beyond { points } = l { Some(points.len()) } else { None });
    let largest = prediction.largest.map(|axis| length(axis * k));
    let reached = prediction.reached;
    let head = match (&largest, beyond) {
        (Some(largest), _) if reached => words::reached(largest, &unit, &level),
        (Some(_), Some(count)) => {
            words::missed(format::count(count), format::count(points), format::compact(wanted.precision), &unit)
        }
        _ => words::not_yet().to_owned(),
    };
    let worst = prediction.worst.as_ref().and_then(|id| {
        let point = prediction.points.iter().find(|p| p.id == *id)?;
        Some(words::worst_point(id, point.rays))
    });
    let rms = prediction.rms.map(|rms| words::rms_of_all(length(rms * k), &unit));
    let lacks = prediction.lacks.iter().map(|lack| view! { <li class="bad">{lack_words(lack)}</li> }).collect_view();
    let advice =
        prediction.advice.iter().filter_map(advice_words).map(|words| view! { <li>{words}</li> }).collect_view();
    let parameters = prediction.cameras.iter().flat_map(|camera| {
        camera.sigma.iter().map(|(parameter, sigma)| {
            let name = parameter_name(*parameter);
            view! { <dt>"σ " {name}</dt><dd>{format::compact(*sigma)}</dd> }
        })
    });
    let parameters = parameters.collect_view();
    let calibrated = prediction.cameras.iter().any(|c| !c.sigma.is_empty());
    view! {
        <p class="verdict-head" class:reached=reached class:missed=!reached data-reached=reached.to_string()>
            <Glyph icon=if reached { Icon::Check } else { Icon::Cross }/> <b>{head}</b>
        </p>
        {largest.map(|largest| view! {
            <div class="figure">
                <strong>{largest}</strong>
                <span><span>{unit.clone()} ", " {level.clone()} " %, " {worst}</span><span>{rms}</span></span>
            </div>
        })}
        <ul class="lacks">{lacks}{advice}</ul>
        {calibrated.then(|| view! {
            <h2 class="section-head"><span>{words::parameters}</span><span class="aside">"1σ"</span></h2>
            <dl class="pairs">{parameters}</dl>
        })}
    }
}

/// Where the next photo should be.
#[component]
pub fn Next() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let planning = desk.planning;
    let parameters = move || {
        let plan = desk.plan()?;
        let camera = plan.cameras.first()?;
        Some(camera.free.iter().copied().filter(|p| *p != Parameter::F).collect::<Vec<_>>())
    };
    let chosen_point = move || desk.selection.with(|s| s.point.clone());
    let options = move || {
        let now = planning.criterion.get();
        let mut all =
            vec![(Criterion::Worst, words::by_worst().to_owned()), (Criterion::Mean, words::by_mean().to_owned())];
        if let Some(worst) = predicted(desk).and_then(|p| p.worst.clone()).or_else(chosen_point) {
            let words = words::by_chosen(&worst);
            all.push((Criterion::Points { points: vec![worst] }, words));
        }
        let features =
            desk.document.with(|d| d.project.plan.as_deref().map_or(Vec::new(), |p| plan::features(&d.project, p)));
        for (name, points) in features {
            all.push((Criterion::Points { points }, words::by_feature(name)));
        }
        for parameter in parameters().unwrap_or_default() {
            all.push((Criterion::Parameter { parameter }, words::by_parameter(parameter_name(parameter))));
        }
        let known = StoredValue::new(all.iter().map(|(c, _)| c.clone()).collect::<Vec<_>>());
        view! {
            <select name="criterion" aria-label=words::criterion on:change=move |e| {
                let place = event::value(&e).parse::<usize>().ok();
                if let Some(criterion) = place.and_then(|k| known.with_value(|all| all.get(k).cloned())) {
                    planning.criterion.set(criterion);
                    planning.suggested.set(Vec::new());
                }
            }>
                {all.into_iter().enumerate().map(|(k, (criterion, words))| view! {
                    <option value=k selected=criterion == now>{words}</option>
                }).collect_view()}
            </select>
        }
    };
    let found = move || {
        let unit = unit(desk);
        let factor = predicted(desk).map_or(1.0, |p| p.factor);
        let of_camera = matches!(planning.criterion.get(), Criterion::Parameter { .. });
        let all = planning.suggested.get();
        let compared = all.first().map(|s| words::compared(format::count(s.compared)));
        let rows = all.into_iter().enumerate().map(|(k, s)| {
            let told = match s.value {
                Some(value) if of_camera => words::suggestion(format::compact(value), "1σ", s.sees),
                Some(value) => words::suggestion(length(value * factor), &unit, s.sees),
                None => words::suggestion_open(s.sees),
            };
            let station = s.station.clone();
            view! {
                <li>
                    <b>{k + 1}</b><span>{told}</span>
                    <button class="button small" data-take=k.to_string() on:click=move |_| desk.take_suggested(station.clone())>{words::take}</button>
                </li>
            }
        });
        view! { <ol class="suggestions">{rows.collect_view()}</ol><p class="hint">{compared}</p> }
    };
    let no_photos = move || desk.document.with(|d| d.project.plan.as_ref().is_none_or(|p| p.stations.is_empty()));
    view! {
        <section class="next">
            <h2>{words::next_photo}</h2>
            <div class="row">
                {options}
                <button class="button" data-action="next" disabled=move || no_photos() || desk.tasks.job.with(Option::is_some)
                    on:click=move |_| desk.suggest_photo()>{words::search}</button>
            </div>
            {found}
        </section>
    }
}

/// The present plan and the others.
#[component]
pub fn Compared() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let table = move || {
        let plan = desk.plan()?;
        let predictions = desk.planning.predicted.with(|p| p.as_ref()?.as_ref().ok().cloned())?;
        if predictions.len() != plan.variants.len() + 1 {
            return None;
        }
        let names: Vec<String> = std::iter::once(words::this_plan().to_owned())
            .chain(plan.variants.iter().map(|v| v.name.clone()))
            .collect();
        let row = |label: &'static str, cell: &dyn Fn(&Prediction) -> String| {
            let cells = predictions.iter().map(|p| view! { <td class:reached=p.reached>{cell(p)}</td> }).collect_view();
            view! { <tr><td class="left">{label}</td>{cells}</tr> }
        };
        let number = |value: Option<f64>| value.map_or("–".to_owned(), length);
        let rows = vec![
            row(words::photos(), &|p| format::count(p.stations.len())),
            row(words::largest(), &|p| {
                format!("{} {}", if p.reached { "✓" } else { "×" }, number(p.largest.map(|a| a * p.factor)))
            }),
            row(words::rms(), &|p| number(p.rms.map(|a| a * p.factor))),
            row(words::fewest_rays(), &|p| p.points.iter().map(|p| p.rays).min().map_or("–".into(), format::count)),
            row(words::sigma_c(), &|p| {
                let found = p.cameras.first().and_then(|c| {
                    let (parameter, sigma) =
                        [Parameter::C, Parameter::F].into_iter().find_map(|p| Some((p, c.sigma.get(&p)?)))?;
                    Some(format!("{} {}", format::compact(*sigma), parameter_unit(&c.camera, parameter)))
                });
                found.unwrap_or_else(|| "–".to_owned())
            }),
        ];
        let heads = names.iter().map(|name| view! { <th>{name.clone()}</th> }).collect_view();
        let actions = plan.variants.iter().enumerate().map(|(k, variant)| {
            view! {
                <button class="button small" on:click=move |_| desk.edit_plan(Change::PlanEdited, |p| plan::switch_variant(p, k))>
                    {words::switch_to(&variant.name)}
                </button>
                <button class="icon-button small" aria-label=words::remove on:click=move |_| {
                    desk.edit_plan(Change::PlanEdited, |p| if k < p.variants.len() { p.variants.remove(k); });
                }><Glyph icon=Icon::Cross size=12/></button>
            }
        });
        Some(view! {
            <table class="table variants"><thead><tr><td></td>{heads}</tr></thead><tbody>{rows}</tbody></table>
            <div class="row actions">{actions.collect_view()}</div>
        })
    };
    view! {
        <h2 class="section-head">
            <span>{words::compare}</span>
            <button class="link" data-action="keep" on:click=move |_| desk.edit_plan(Change::PlanEdited, |p| { plan::keep_variant(p); })>{words::keep}</button>
        </h2>
        {table}
    }
}

/// Prediction compared with the result of the adjustment.
#[component]
pub fn Reached() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let table = move || {
        let prediction = predicted(desk)?;
        let result = desk.document.with(|d| d.current().cloned())?;
        let largest = |sigma: [f64; 3]| sigma.into_iter().fold(0.0, f64::max);
        let mut rows: Vec<(String, f64, f64)> = (result.adjustment.points.iter())
            .filter_map(|point| {
                let planned = prediction.points.iter().find(|p| p.id == point.id)?;
                Some((point.id.clone(), largest(planned.sigma?), largest(point.sigma?)))
            })
            .collect();
        if rows.is_empty() {
            return None;
        }
        rows.sort_by(|a, b| b.2.total_cmp(&a.2));
        let rows = rows.into_iter().take(12).map(|(id, planned, reached)| {
            view! { <tr><td class="left id">{id}</td><td>{length(planned)}</td><td>{length(reached)}</td></tr> }
        });
        Some(view! {
            <h2 class="section-head"><span>{words::reached_adjusted}</span></h2>
            <p class="note">{words::reached_words}</p>
            <table class="table"><thead><tr><td></td><th>{words::predicted}</th><th>{words::adjusted}</th></tr></thead>
                <tbody>{rows.collect_view()}</tbody></table>
        })
    };
    view! { <div>{table}</div> }
}
