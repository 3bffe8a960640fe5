//! A simulated gross error: the response of the tests and of four estimators.

use leptos::prelude::*;
use sightline_lab::teaching::{Estimate, Planted, Planting, Show, Tested};
use sightline_protocol::Inquiry;

use super::number;
use crate::browser::event;
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;

/// Bars are drawn of at most so many coordinates; of more, the largest.
const BARS: usize = 400;
const LISTED: usize = 12;

#[component]
pub fn Errors() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    // Observations that take part, as places in the document: found by the first answer.
    let chosen = RwSignal::new(None::<(usize, usize)>);
    let second = RwSignal::new(None::<(usize, usize)>);
    let size = RwSignal::new(8.0_f64);
    // What of a lesson is shown already.
    let followed = RwSignal::new(Show::default());
    let plant = move || {
        let one = |(observation, axis): (usize, usize)| Planting { observation, axis, size: size.get_untracked() };
        let errors: Vec<Planting> =
            [chosen.get_untracked(), second.get_untracked()].into_iter().flatten().map(one).collect();
        desk.inquire(Inquiry::Plant(errors));
    };
    Effect::new(move || {
        let ready = inside.steps.with(|steps| !steps.is_empty());
        if ready && inside.planted.with_untracked(Option::is_none) {
            chosen.set(None);
            second.set(None);
            followed.set(Show::default());
            plant();
        }
    });
    // The observation with the median redundancy number: neither the hardest nor the easiest to check.
    Effect::new(move || {
        let none = chosen.get_untracked().is_none();
        let middle = inside.planted.with(|found| {
            let mut all = found.as_ref()?.tested.clone();
            all.sort_by(|a, b| a.r.total_cmp(&b.r));
            all.get(all.len() / 2).map(|one| (one.observation, one.axis))
        });
        if none && middle.is_some() {
            chosen.set(middle);
            plant();
        }
    });
    // The error that a lesson refers to.
    Effect::new(move || {
        let wanted = inside.wanted.get();
        let place = inside.planted.with(|found| {
            let (found, row) = (found.as_ref()?, wanted.observation.as_ref()?);
            let of = |one: &Tested| {
                let [photo, point] = &found.names[one.observation];
                format!("{photo} {point} {}", ["x", "y"][one.axis.min(1)]) == *row
            };
            found.tested.iter().find(|one| of(one)).map(|one| (one.observation, one.axis))
        });
        if place.is_some() && followed.get_untracked() != wanted {
            chosen.set(place);
            second.set(None);
            size.set(wanted.size.unwrap_or(size.get_untracked()));
            followed.set(wanted);
            plant();
        }
    });
    let name = move |(observation, axis): (usize, usize)| {
        inside.planted.with(|found| {
            let names = found.as_ref().and_then(|found| found.names.get(observation));
            names.map_or_else(String::new, |[photo, point]| format!("{photo} {point} {}", ["x", "y"][axis.min(1)]))
        })
    };
    let options = move || {
        let all = inside.planted.with(|found| found.as_ref().map(|found| found.tested.clone()).unwrap_or_default());
        all.into_iter().map(|one| (one.observation, one.axis)).collect::<Vec<_>>()
    };
    let known = Memo::new(move |_| options());
    let key = |place: (usize, usize)| format!("{}/{}", place.0, place.1);
    let parse = |text: &str| {
        let (observation, axis) = text.split_once('/')?;
        Some((observation.parse().ok()?, axis.parse().ok()?))
    };
    view! {
        <main class="inside-page scroll">
            <div class="inside-options">
                <label class="option"><span>{words::error_in}</span>
                    <select name="planted" prop:value=move || chosen.get().map(key) on:change=move |e| {
                        chosen.set(parse(&event::value(&e)));
                        plant();
                    }>{move || known.get().into_iter().map(|place| view! { <option value=key(place)>{name(place)}</option> }).collect_view()}</select></label>
                <label class="option"><span>{words::second_error}</span>
                    <select name="planted-second" prop:value=move || second.get().map(key).unwrap_or_default() on:change=move |e| {
                        second.set(parse(&event::value(&e)));
                        plant();
                    }><option value="">{words::no_second}</option>
                    {move || known.get().into_iter().map(|place| view! { <option value=key(place)>{name(place)}</option> }).collect_view()}</select></label>
                <label class="option wide"><span>{move || words::size_of_error(format::fixed(size.get(), 1))}</span>
                    <input type="range" name="error-size" min="0" max="20" step="0.5" prop:value=move || size.get().to_string()
                        on:input=move |e| size.set(event::value(&e).parse().unwrap_or(0.0)) on:change=move |_| plant()/></label>
            </div>
            {move || inside.planted.get().filter(|found| found.before.is_some() || found.tested.is_empty()).map_or_else(
                || view! { <p class="note">{words::computing}</p> }.into_any(),
                |found| shown(&found, chosen.get(), name),
            )}
        </main>
    }
}

fn shown(
    found: &Planted,
    chosen: Option<(usize, usize)>,
    name: impl Fn((usize, usize)) -> String + Copy + 'static,
) -> AnyView {
    let is_chosen = |one: &Tested| chosen == Some((one.observation, one.axis));
    let over = found.tested.iter().filter(|one| one.w.abs() > found.critical).count();
    let own = found.tested.iter().find(|one| is_chosen(one)).copied();
    let mut largest = found.tested.clone();
    largest.sort_by(|a, b| b.w.abs().total_cmp(&a.w.abs()));
    let mut hardest = found.tested.clone();
    hardest.sort_by(|a, b| a.r.total_cmp(&b.r));
    let table = |all: &[Tested]| {
        let rows = all.iter().take(LISTED).map(|one| {
            let bad = one.w.abs() > found.critical;
            view! {
                <tr class:chosen=is_chosen(one)>
                    <td class="left">{name((one.observation, one.axis))}</td><td>{format::fixed(one.r, 2)}</td>
                    <td>{format::fixed(one.detectable, 1)}</td><td class:bad=bad><b>{format::fixed(one.w, 2)}</b></td>
                </tr>
            }
        });
        let rows = rows.collect_view();
        view! {
            <table class="table"><thead><tr><th class="left">{words::observation}</th><th>"r"</th><th>{words::detectable} " " <u>"σ"</u></th><th>"w"</th></tr></thead>
            <tbody>{rows}</tbody></table>
        }
    };
    let unit = expect_context::<Desk>().inside.unit();
    let sentence = match own {
        Some(own) if own.w.abs() > found.critical => {
            words::found_it(format::fixed(own.w, 2), over, format::fixed(found.critical, 2))
        }
        Some(own) => words::missed_it(format::fixed(own.w, 2), over, format::fixed(found.critical, 2)),
        None => String::new(),
    };
    let percent =
        |share: Option<f64>| share.map_or("–".to_owned(), |share| format!("{} %", format::fixed(100.0 * share, 1)));
    view! {
        <p class="inside-said" data-said="planted">{sentence}</p>
        <div class="errors">
            <section>
                <h2 class="section-head"><span>"|w|"</span><span class="aside">{words::least_squares}</span></h2>
                <p class="hint">{words::w_is}</p>
                {bars(found, is_chosen)}
                {estimates(&found.estimates, &unit)}
            </section>
            <section>
                <h2 class="section-head"><span>{words::observation}</span></h2>
                <table class="table words"><tbody>
                    <tr><td class="left">{words::redundancy_number}</td><td>{found.before.map(|one| format::fixed(one.r, 3))}</td></tr>
                    <tr><td class="left">{words::detectable}</td><td>{found.before.map(|one| format!("{} σ", format::fixed(one.detectable, 1)))}</td></tr>
                    <tr><td class="left">{words::without_error}</td><td>{found.before.map(|one| format::fixed(one.w, 2))}</td></tr>
                    <tr><td class="left">{words::power}</td><td data-power="">{percent(found.power)}</td></tr>
                    <tr><td class="left">{words::detected_in(format::count(found.draws))}</td><td data-detected="">{percent(found.detected)}</td></tr>
                    <tr><td class="left">{words::largest_in}</td><td>{percent(found.largest)}</td></tr>
                </tbody></table>
                <h2 class="section-head"><span>{words::largest_w}</span></h2>{table(&largest)}
                <h2 class="section-head"><span>{words::hardest}</span></h2>{table(&hardest)}
            </section>
        </div>
    }
    .into_any()
}

fn bars(found: &Planted, is_chosen: impl Fn(&Tested) -> bool) -> AnyView {
    let (width, height) = (800.0, 180.0);
    let mut all = found.tested.clone();
    if all.len() > BARS {
        all.sort_by(|a, b| b.w.abs().total_cmp(&a.w.abs()));
        all.truncate(BARS);
        all.sort_by_key(|one| (one.observation, one.axis));
    }
    let top = all.iter().map(|one| one.w.abs()).fold(found.noncentrality, f64::max) * 1.08;
    let wide = width / all.len().max(1) as f64;
    let bars = all.iter().enumerate().map(|(k, one)| {
        let tall = one.w.abs() / top * height;
        let class = if is_chosen(one) {
            "chosen"
        } else if one.w.abs() > found.critical {
            "bad"
        } else {
            ""
        };
        view! { <rect class=class x=k as f64 * wide y=height - tall width=(0.8 * wide).max(0.8) height=tall></rect> }
    });
    let bars = bars.collect_view();
    let line = |w: f64, class: &'static str, said: String| {
        let y = height * (1.0 - w / top);
        view! { <line class=class x1="0" x2=width y1=y y2=y></line><text x="4" y=y - 4.0>{said}</text> }
    };
    view! {
        <svg class="w-bars" viewBox=format!("0 0 {width} {height}") role="img" aria-label="|w|">
            {bars}
            {line(found.critical, "limit", words::critical(format::fixed(found.critical, 2)))}
            {line(found.noncentrality, "dashed", words::at_detectable(format::fixed(found.noncentrality, 2)))}
        </svg>
    }
    .into_any()
}

fn estimates(all: &[Estimate], unit: &str) -> impl IntoView + use<> {
    let name = |one: &Estimate| match one.name.as_str() {
        "huber" => "Huber",
        "tukey" => "Tukey",
        "snooping" => words::snooping(),
        _ => words::least_squares(),
    };
    let heads = all.iter().map(|one| view! { <th>{name(one)}</th> }).collect_view();
    let row = |label: &'static str, unit: &str, key: &'static str, of: fn(&Estimate) -> String| {
        let cells = all.iter().map(|one| view! { <td>{of(one)}</td> }).collect_view();
        view! { <tr data-row=key><td class="left">{label} " " <u>{unit.to_owned()}</u></td>{cells}</tr> }
    };
    view! {
        <table class="table words estimates"><thead><tr><th class="left"></th>{heads}</tr></thead><tbody>
            {row("σ₀", "", "sigma0", |one| one.sigma0.map_or("–".to_owned(), |sigma0| format::fixed(sigma0, 3)))}
            {row(words::point_moves(), unit, "moved", |one| one.moved.map_or("–".to_owned(), number))}
            {row(words::in_own_sigma(), "", "in-sigma", |one| one.moved_in_sigma.map_or("–".to_owned(), |moved| format::fixed(moved, 2)))}
            {row(words::others_move(), unit, "others", |one| number(one.others))}
            {row(words::weight_factor(), "", "weight", |one| format::fixed(one.weight, 2))}
            {row(words::weakened(), "", "weakened", |one| format::count(one.weakened))}
        </tbody></table>
    }
}
