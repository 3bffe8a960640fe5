//! Step 6: the result with its statistics. Of a project that changed since, no number is shown.

use std::collections::HashMap;

use leptos::prelude::*;
use sightline::adjustment::{AdjustedCamera, AdjustedObservation, Adjustment};
use sightline::project::{Camera, Interior, Parameter, Project, Role};

use super::adjust::{parameter_name, parameter_unit};
use super::advice::CRITICAL_W;
use super::changes::change_words;
use super::icon::{Glyph, Icon};
use super::plots::{ResidualPlot, Vector};
use super::shell::export_tables;
use super::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::format;
use crate::i18n::text;
use crate::store::{Desk, Step};

#[component]
pub fn Results() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let state = Memo::new(move |_| desk.document.with(|d| (d.result.is_some(), d.out_of_date())));
    view! {
        {move || match state.get() {
            (false, _) => view! { <NoResult/> }.into_any(),
            (true, true) => view! { <OutOfDate/> }.into_any(),
            (true, false) => view! { <Current/> }.into_any(),
        }}
    }
}

#[component]
fn NoResult() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <main class="out-of-date">
            <h1>{text::no_result}</h1>
            <p>{text::no_result_body}</p>
            <button class="button primary" on:click=move |_| desk.go(Step::Adjust)>{text::adjustment} <Glyph icon=Icon::Arrow/></button>
        </main>
    }
}

#[component]
fn OutOfDate() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let changes = move || {
        let changes = desk.changes_since_result();
        let words = changes.iter().rev().take(4).map(change_words).collect::<Vec<_>>();
        words.join("; ")
    };
    view! {
        <main class="out-of-date">
            <Glyph icon=Icon::Clock size=24/>
            <h1>{text::results_stale}</h1>
            <p>{text::changed_since} " " {changes} ". " {text::no_number_until}</p>
            <div class="row">
                <button class="button primary" on:click=move |_| desk.adjust()>{text::adjust_again}</button>
                <button class="button" on:click=move |_| desk.undo()><Glyph icon=Icon::Undo/> {text::undo}</button>
            </div>
        </main>
    }
}

/// Reads the present adjustment; components below exist only while there is one.
fn read<T: Default>(desk: Desk, read: impl FnOnce(&Adjustment, &Project) -> T) -> T {
    desk.document.with(|d| d.current().map(|r| read(&r.adjustment, &r.input)).unwrap_or_default())
}

/// Rms of all image residuals in pixels: residuals over the pixel size of their camera.
fn rms_px(adjustment: &Adjustment, project: &Project) -> Option<f64> {
    let cameras: HashMap<&str, &Camera> = project.cameras.iter().map(|c| (c.id.as_str(), c)).collect();
    let (mut sum, mut count) = (0.0, 0);
    for photo in &adjustment.photos {
        let camera = project.photos.iter().find(|p| p.id == photo.id).and_then(|p| cameras.get(p.camera.as_str()))?;
        let [px, py] = unit_per_pixel(camera);
        sum += photo.points as f64 * ((photo.rms_x / px).powi(2) + (photo.rms_y / py).powi(2));
        count += 2 * photo.points;
    }
    (count > 0).then(|| (sum / count as f64).sqrt())
}

/// Residual units per pixel: millimetres in the brown model with a pitch, pixels elsewhere.
fn unit_per_pixel(camera: &Camera) -> [f64; 2] {
    if matches!(camera.interior, Interior::Opencv { .. }) { [1.0, 1.0] } else { camera.pitch() }
}

/// How residuals of a camera are shown: micrometres where millimetres are known, else pixels.
fn shown_as(camera: Option<&Camera>) -> (f64, &'static str) {
    match camera {
        Some(c) if c.pixel_pitch.is_some() && matches!(c.interior, Interior::Brown { .. }) => (1000.0, "µm"),
        _ => (1.0, "px"),
    }
}

/// One unit for a whole table: micrometres only when every camera has them.
fn common_unit(project: &Project) -> (f64, &'static str) {
    let units = project.cameras.iter().map(|c| shown_as(Some(c))).collect::<Vec<_>>();
    if units.iter().all(|u| u.1 == "µm") { (1000.0, "µm") } else { (1.0, "px") }
}

/// Factor from a photo's residuals to the table's unit.
fn factors(project: &Project) -> HashMap<String, [f64; 2]> {
    let (factor, unit) = common_unit(project);
    let of = |photo: &sightline::project::Photo| {
        let camera = project.cameras.iter().find(|c| c.id == photo.camera)?;
        let [px, py] = unit_per_pixel(camera);
        Some((photo.id.clone(), if unit == "px" { [1.0 / px, 1.0 / py] } else { [factor, factor] }))
    };
    project.photos.iter().filter_map(of).collect()
}

#[component]
fn Current() -> impl IntoView {
    view! {
        <Hero/>
        <main class="results">
            <section class="a1"><Residuals/></section>
            <section class="a2"><PhotosTable/></section>
            <section class="b scroll"><Cameras/><CheckPoints/></section>
            <section class="c1"><PointsTable/></section>
            <section class="c2"><Worst/></section>
        </main>
    }
}

#[component]
fn Hero() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let sigma0 = move || read(desk, |a, _| a.sigma0);
    let test = move || read(desk, |a, _| a.global_test.clone());
    let redundancy = move || read(desk, |a, _| (a.redundancy, a.observations_count, a.unknowns, a.constraints));
    let rms = move || read(desk, rms_px);
    let precision = move || read(desk, |a, _| a.precision.clone());
    let points = move || read(desk, |a, _| a.points.len());
    let check = move || {
        read(desk, |a, _| {
            let all = a.check_points.iter().filter_map(|c| c.difference).collect::<Vec<_>>();
            let sum: f64 = all.iter().flatten().map(|d| d * d).sum();
            (!all.is_empty()).then(|| ((sum / (3 * all.len()) as f64).sqrt(), all.len()))
        })
    };
    view! {
        <div class="hero">
            <div><span>"σ₀"</span><b class="huge" data-result="sigma0">{move || format::maybe(sigma0(), 3)}</b><small>{text::a_priori_one}</small></div>
            <div class="test">
                {move || test().map(|t| view! {
                    <span class=if t.passed { "pass" } else { "fail" }>
                        <Glyph icon=if t.passed { Icon::Check } else { Icon::Cross } size=14/>
                        " " {if t.passed { text::test_passed() } else { text::test_failed() }}
                    </span>
                    <TestBar statistic=t.statistic lower=t.lower upper=t.upper/>
                    <small><span>{format::fixed(t.lower, 0)}</span><b>"χ² " {format::fixed(t.statistic, 1)}</b><span>{format::fixed(t.upper, 0)}</span></small>
                })}
            </div>
            <div><span>{text::redundancy}</span><b data-result="redundancy">{move || format::count(redundancy().0)}</b>
                <small>{move || {
                    let (_, observations, unknowns, constraints) = redundancy();
                    let plus = if constraints > 0 { format!(" + {}", format::count(constraints)) } else { String::new() };
                    format!("{} − {}{plus}", format::count(observations), format::count(unknowns))
                }}</small>
            </div>
            <div><span>{text::rms_residual} " " <u>"px"</u></span><b data-result="rms-px">{move || format::maybe(rms(), 3)}</b><small>{text::all_image_coordinates}</small></div>
            <div><span>{text::rms_sigma} " X, Y, Z " <u>{unit}</u></span>
                <b>{move || precision().map(|p| {
                    let decimals = p.rms_sigma.iter().copied().fold(f64::INFINITY, f64::min);
                    p.rms_sigma.map(|s| format::fixed(s, format::decimals_for(decimals))).join("\u{2003}")
                })}</b>
                <small>{move || text::points_one_sigma(format::count(points()))}</small>
            </div>
            <div><span>{text::relative_accuracy}</span>
                <b>{move || precision().and_then(|p| p.relative).map(|n| format!("1 : {}", format::count(two_digits(n))))}</b>
                <small>{move || precision().map(|p| text::largest_dimension(format::fixed(p.largest_dimension, 1), unit.get()))}</small>
            </div>
            {move || check().map(|(rms, n)| view! {
                <div><span>{text::check_rms} " " <u>{unit}</u></span><b>{format::fixed(rms, 3)}</b><small>{text::n_points(n)}</small></div>
            })}
            <div class="hero-action"><button class="button primary" on:click=move |_| export_tables(desk)><Glyph icon=Icon::Save/> {text::export_csv}</button></div>
        </div>
    }
}

/// Three significant digits: more would pretend.
fn two_digits(n: f64) -> usize {
    let power = 10f64.powf((n.max(1.0).log10().floor() - 2.0).max(0.0));
    ((n / power).round() * power) as usize
}

/// The statistic between its limits.
#[component]
fn TestBar(statistic: f64, lower: f64, upper: f64) -> impl IntoView {
    let span = (upper - lower).max(f64::MIN_POSITIVE);
    let x = move |value: f64| (36.0 + (value - lower) / span * 138.0).clamp(2.0, 208.0);
    let at = x(statistic);
    view! {
        <svg class="test-bar" width="210" height="14" viewBox="0 0 210 14" aria-hidden="true">
            <path class="grid" d="M0 7H210"></path>
            <path class="within" d=format!("M{0} 2v10M{0} 7H{1}M{1} 2v10", x(lower), x(upper))></path>
            <path class="mark-at" d=format!("M{at} 0v14")></path>
        </svg>
    }
}

/// Value, sigma and unit of a parameter, with a power of ten where the value is small.
fn parameter_cells(camera: &Camera, parameter: Parameter, value: f64, sigma: Option<f64>) -> (String, String, String) {
    let size = value.abs().max(sigma.unwrap_or(0.0));
    let exponent = if size > 0.0 && size < 0.01 { size.log10().floor() as i32 } else { 0 };
    let power = 10f64.powi(exponent);
    let decimals = sigma.map_or(6, |s| format::decimals_for(s / power));
    let unit = parameter_unit(camera, parameter);
    let unit = if exponent == 0 { unit } else { format!("{} {unit}", format::power(exponent)) };
    (format::fixed(value / power, decimals), sigma.map_or("–".into(), |s| format::fixed(s / power, decimals)), unit)
}

#[component]
fn Cameras() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let cameras = Memo::new(move |_| read(desk, |a, _| a.cameras.clone()));
    view! { {move || cameras.get().into_iter().map(|camera| view! { <CameraTable camera/> }).collect_view()} }
}

/// A camera's parameters with their correlations in the same rows.
#[component]
fn CameraTable(camera: AdjustedCamera) -> impl IntoView {
    let names =
        camera.correlation.names.iter().map(|n| n.parse::<Parameter>().map_or("", parameter_name)).collect::<Vec<_>>();
    let id = camera.camera.id.clone();
    let estimated =
        camera.correlation.names.iter().enumerate().filter_map(|(i, n)| Some((i, n.parse::<Parameter>().ok()?)));
    let rows = estimated.map(|(i, p)| {
        let value = camera.camera.interior.get(p).unwrap_or(0.0);
        let sigma = camera.sigma.get(&p).copied();
        let (value, sigma, unit) = parameter_cells(&camera.camera, p, value, sigma);
        let row = camera.correlation.matrix.get(i).cloned().unwrap_or_default();
        let cells = (0..names.len()).map(|j| correlation_cell(i, j, row.get(j).copied().unwrap_or(0.0))).collect_view();
        view! {
            <tr data-camera=camera.camera.id.clone() data-parameter=p.name()>
                <td class="left id">{parameter_name(p)}</td><td><b>{value}</b></td><td>{sigma}</td><td class="left">{unit}</td>{cells}
            </tr>
        }
    }).collect_view();
    let held = camera
        .camera
        .interior
        .parameters()
        .iter()
        .filter(|p| **p != Parameter::F && !camera.camera.estimated().contains(p));
    let held = held.map(|p| parameter_name(*p)).collect::<Vec<_>>().join(", ");
    view! {
        <h2 class="section-head">
            <span>{move || text::camera_and_correlations(&id)}</span>
            <span class="aside"><i class="swatch minus"></i>" −1 " <i class="swatch plus"></i> " +1"</span>
        </h2>
        <table class="table correlations">
            <thead><tr>
                <th class="left"></th><th>{text::value}</th><th>"σ 1σ"</th><th class="left">{text::unit}</th>
                {names.iter().map(|n| view! { <th class="cell">{*n}</th> }).collect_view()}
            </tr></thead>
            <tbody>{rows}</tbody>
        </table>
        {(!held.is_empty()).then(|| view! { <p class="note">{move || text::all_held(&held)}</p> })}
    }
}

fn correlation_cell(i: usize, j: usize, r: f64) -> impl IntoView {
    let shown = if i != j && r.abs() >= 0.4 { format::fixed(r, 2).replacen("0.", ".", 1) } else { String::new() };
    let class = match (j.cmp(&i), r < 0.0) {
        (std::cmp::Ordering::Greater, _) => "cell",
        (std::cmp::Ordering::Equal, _) => "cell own",
        (_, true) => "cell minus",
        _ => "cell plus",
    };
    let strength = if r.abs() > 0.8 { 100.0 } else { 55.0 * r.abs() };
    let shown = if j > i { String::new() } else { shown };
    view! { <td class=class class:full={j < i && r.abs() > 0.8} style:--strength=format!("{strength:.0}%")>{shown}</td> }
}

/// Differences at the check points.
#[component]
fn CheckPoints() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| read(desk, |a, _| a.check_points.clone()));
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    view! {
        <Show when=move || all.with(|a| !a.is_empty())>
            <h2 class="section-head"><span>{text::check_points}</span><span class="aside">{text::adjusted_minus_given}</span></h2>
            <table class="table">
                <thead><tr><th class="left">{text::id}</th>{["X", "Y", "Z"].map(|n| view! { <th>"Δ" {n} " " <u>{unit}</u></th> }).collect_view()}</tr></thead>
                <tbody>
                    {move || all.get().into_iter().map(|c| view! {
                        <tr><td class="left id">{c.id}</td>{(0..3).map(|k| view! { <td>{format::maybe(c.difference.map(|d| d[k]), 4)}</td> }).collect_view()}</tr>
                    }).collect_view()}
                </tbody>
            </table>
        </Show>
    }
}

#[component]
fn PhotosTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(None::<Sorting>);
    let columns = Signal::derive(move || {
        let length = desk.document.with(|d| d.project.unit.clone());
        let unit = read(desk, |_, p| common_unit(p).1.to_owned());
        vec![
            Column::words(text::photo),
            Column::number(text::points_column),
            Column::number(text::rms_x).unit(unit.clone()),
            Column::number(text::rms_y).unit(unit),
            Column::number(|| "X").unit(length.clone()),
            Column::number(|| "Y").unit(length.clone()),
            Column::number(|| "Z").unit(length.clone()),
            Column::number(|| "σ").low("X").unit(length.clone()),
            Column::number(|| "σ").low("Y").unit(length.clone()),
            Column::number(|| "σ").low("Z").unit(length),
        ]
    });
    let rows = Memo::new(move |_| {
        read(desk, |a, project| {
            let factors = factors(project);
            let row = |p: &sightline::adjustment::AdjustedPhoto| {
                let [fx, fy] = factors.get(&p.id).copied().unwrap_or([1.0, 1.0]);
                let sigma = p.sigma_position;
                let decimals = sigma.map_or(3, |s| format::decimals_for(s.into_iter().fold(f64::INFINITY, f64::min)));
                let mut cells = vec![Cell::id(&p.id), Cell::count(p.points)];
                cells.push(Cell::number(Some(p.rms_x * fx), 2 + usize::from(fx < 100.0)));
                cells.push(Cell::number(Some(p.rms_y * fy), 2 + usize::from(fy < 100.0)));
                cells.extend(p.position.map(|x| Cell::number(Some(x), decimals)));
                cells.extend((0..3).map(|k| Cell::number(sigma.map(|s| s[k]), decimals)));
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
        <NumberTable label=text::photos columns rows chosen on_choose=Callback::new(move |id: String| desk.select_photo(&id)) sorting/>
    }
}

#[component]
fn PointsTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 7, descending: true }));
    let columns = Signal::derive(move || {
        let unit = desk.document.with(|d| d.project.unit.clone());
        let number = |name: fn() -> &'static str, low| Column::number(name).low(low).unit(unit.clone());
        vec![
            Column::words(text::id),
            Column::number(text::rays),
            number(|| "X", ""),
            number(|| "Y", ""),
            number(|| "Z", ""),
            number(|| "σ", "X"),
            number(|| "σ", "Y"),
            number(|| "σ", "Z"),
        ]
    });
    let rows = Memo::new(move |_| {
        read(desk, |a, _| {
            let largest = a.points.iter().filter_map(|p| p.sigma).map(|s| s[2]).fold(0.0_f64, f64::max);
            let typical = a.precision.as_ref().map_or(0.001, |p| p.rms_sigma.into_iter().fold(f64::INFINITY, f64::min));
            let decimals = format::decimals_for(typical);
            let row = |p: &sightline::adjustment::AdjustedPoint| {
                let rays = Cell::count(p.rays).class(if p.rays < 3 { "warn" } else { "" });
                let mut cells = vec![Cell::id(&p.id), rays];
                cells.extend(p.xyz.map(|x| Cell::number(Some(x), decimals)));
                cells.extend((0..3).map(|k| Cell::number(p.sigma.map(|s| s[k]), decimals)));
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
        <NumberTable label=text::points columns rows chosen on_choose=Callback::new(move |id: String| desk.select_point(&id)) sorting/>
    }
}

fn largest_w(o: &AdjustedObservation) -> Option<f64> {
    [o.wx, o.wy].into_iter().flatten().max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Observations by the size of their test value.
#[component]
fn Worst() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 5, descending: true }));
    let columns = Signal::derive(move || {
        let unit = read(desk, |_, p| common_unit(p).1.to_owned());
        vec![
            Column::words(text::id),
            Column::words(text::photo),
            Column::number(|| "v").low("x").unit(unit.clone()),
            Column::number(|| "v").low("y").unit(unit),
            Column::number(|| "r"),
            Column::number(|| "w"),
            Column::words(|| ""),
        ]
    });
    let rows = Memo::new(move |_| {
        read(desk, |a, project| {
            let factors = factors(project);
            let row = |o: &AdjustedObservation| {
                let [fx, fy] = factors.get(&o.photo).copied().unwrap_or([1.0, 1.0]);
                let decimals = 2 + usize::from(fx < 100.0);
                let w = largest_w(o);
                let r = [o.rx, o.ry].into_iter().flatten().min_by(f64::total_cmp);
                let over = w.is_some_and(|w| w.abs() > CRITICAL_W);
                let mut size = Cell::number(w, 2).class(if over { "bad" } else { "" });
                size.order = w.map(f64::abs);
                let verdict = if over { format!("✕ {}", text::over(CRITICAL_W)) } else { String::new() };
                Row {
                    key: format!("{}\u{1f}{}", o.photo, o.point),
                    cells: vec![
                        Cell::id(&o.point),
                        Cell::words(&o.photo),
                        Cell::number(Some(o.vx * fx), decimals),
                        Cell::number(Some(o.vy * fy), decimals),
                        Cell::number(r, 2),
                        size,
                        Cell::words(verdict).class("left wide bad"),
                    ],
                    off: !o.enabled,
                }
            };
            a.observations.iter().filter(|o| o.enabled).map(row).collect::<Vec<_>>()
        })
    });
    let chosen = Signal::derive(move || {
        desk.selection.with(|s| Some(format!("{}\u{1f}{}", s.photo.clone()?, s.point.clone()?)))
    });
    let choose = Callback::new(move |key: String| {
        if let Some((photo, point)) = key.split_once('\u{1f}') {
            desk.select_observation(photo, point);
        }
    });
    view! {
        <h2 class="section-head">
            <span>{text::worst_observations}</span>
            <span class="aside">{text::baarda}</span>
            <CopyButton columns rows/>
        </h2>
        <NumberTable label=text::worst_observations columns rows chosen on_choose=choose sorting/>
    }
}

/// Residual vectors of the photo that is chosen.
#[component]
fn Residuals() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let photo = Memo::new(move |_| {
        let chosen = desk.selection.with(|s| s.photo.clone());
        read(desk, |a, _| {
            let known = chosen.filter(|id| a.photos.iter().any(|p| p.id == *id));
            known.or_else(|| a.photos.first().map(|p| p.id.clone()))
        })
    });
    let camera = Memo::new(move |_| {
        let photo = photo.get()?;
        read(desk, |_, p| {
            let camera = &p.photos.iter().find(|x| x.id == photo)?.camera;
            p.cameras.iter().find(|c| c.id == *camera).cloned()
        })
    });
    let frame = move |c: &Camera| {
        let [px, py] = unit_per_pixel(c);
        [f64::from(c.width) * px, f64::from(c.height) * py]
    };
    let size = Signal::derive(move || camera.with(|c| c.as_ref().map_or([0.0; 2], frame)));
    let vectors = Signal::derive(move || {
        let (Some(photo), Some(camera)) = (photo.get(), camera.get()) else { return Vec::new() };
        let chosen = desk.selection.with(|s| s.point.clone());
        read(desk, |a, project| {
            let [px, py] = unit_per_pixel(&camera);
            let (w, h) = (f64::from(camera.width), f64::from(camera.height));
            let places = project.observations.iter().zip(&a.observations);
            let here =
                places.filter(|(o, r)| o.photo == photo && r.enabled && o.point == r.point && o.photo == r.photo);
            here.map(|(o, r)| Vector {
                point: o.point.clone(),
                at: [(o.u - w / 2.0) * px, (h / 2.0 - o.v) * py],
                residual: [r.vx, r.vy],
                chosen: Some(&o.point) == chosen.as_ref(),
                over: largest_w(r).is_some_and(|w| w.abs() > CRITICAL_W),
            })
            .collect()
        })
    });
    let summary = move || {
        let photo = photo.get()?;
        let (factor, unit) = camera.with(|c| shown_as(c.as_ref()));
        read(desk, |a, _| {
            let p = a.photos.iter().find(|p| p.id == photo)?;
            let decimals = if unit == "px" { 3 } else { 2 };
            Some(text::rms_summary(
                format::fixed(p.rms_x * factor, decimals),
                format::fixed(p.rms_y * factor, decimals),
                unit,
                p.points,
            ))
        })
    };
    let shown = Signal::derive(move || camera.with(|c| shown_as(c.as_ref())));
    let choose = Callback::new(move |point: String| {
        if let Some(photo) = photo.get_untracked() {
            desk.select_observation(&photo, &point);
        }
    });
    view! {
        <h2 class="section-head"><span>{move || text::residuals_of(photo.get().unwrap_or_default())}</span><span class="aside">{summary}</span></h2>
        <ResidualPlot size vectors shown on_choose=choose/>
    }
}

/// Control and check points in words, for the step row.
pub fn control_figure(project: &Project) -> String {
    let of = |role| project.points.iter().filter(|p| p.role == role).count();
    format!("{} + {} · {}", of(Role::Control), of(Role::Check), project.distances.len())
}
