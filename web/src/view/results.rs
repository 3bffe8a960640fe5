//! Step 6: the result with its statistics. No number is shown if the project has changed since.

mod cameras;
mod compared;
mod drawings;
mod given;
mod meanings;
mod tables;

use crate::view::components::no_result::{NoResult, OutOfDate};
use crate::view::components::units::{length_unit, pixel_of, shown_as};
use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::adjustment::Adjustment;
use sightline::project::{Camera, Project, Role};

use super::advice::{Contradictions, VerdictLine};
use super::components::icon::{Glyph, Icon};
use super::estimated::estimated;
use super::left_out::NotUsed;
use super::object::Overview;
use super::plots::{ResidualPlot, Vector};

use crate::browser::page;
use crate::format;
use crate::i18n::{comparing, first, inside, interchange, monitoring, object, text};
use crate::store::inside::Network;
use crate::store::{Desk, Step};

use cameras::Cameras;
use compared::Compared;
use drawings::Drawings;
use given::GivenTable;
use meanings::{Meanings, Statistic};
use tables::{CheckPoints, PhotosTable, PointsTable, Worst, largest_w};

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

/// Reads the present adjustment; components below exist only while there is one.
fn read<T: Default>(desk: Desk, read: impl FnOnce(&Adjustment, &Project) -> T) -> T {
    desk.document.with(|d| d.current().map(|r| read(&r.adjustment, &r.input)).unwrap_or_default())
}

/// Tabs of the results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ResultsTab {
    Tables,
    Plots,
    Compared,
    Meanings,
}

/// Parts of the results that are drawn one after the other.
const PARTS: usize = 6;

#[component]
fn Current() -> impl IntoView {
    let shown = RwSignal::new(ResultsTab::Tables);
    let explained = RwSignal::new(None::<Statistic>);
    let desk = expect_context::<Desk>();
    let compared = Memo::new(move |_| desk.result_before().is_some());
    // Every part has a task of the page of its own: each is laid out as it comes.
    let parts = RwSignal::new(0);
    spawn_local(async move {
        for there in 1..=PARTS {
            page::breathe().await;
            parts.try_set(there);
        }
    });
    let there = move |part: usize| move || parts.get() >= part;
    let views: [(ResultsTab, crate::i18n::Text); 4] = [
        (ResultsTab::Tables, text::tables),
        (ResultsTab::Plots, text::plots),
        (ResultsTab::Compared, comparing::beside_before),
        (ResultsTab::Meanings, text::meanings),
    ];
    view! {
        <VerdictLine/>
        <Hero explain=Callback::new(move |statistic| {
            explained.set(Some(statistic));
            shown.set(ResultsTab::Meanings);
        })/>
        <Contradictions/>
        <NotUsed/>
        <nav class="result-views" aria-label=text::results>
            {views.map(|(one, name)| view! {
                <Show when=move || one != ResultsTab::Compared || compared.get()>
                    <button class="text-button" data-shown=format!("{one:?}").to_lowercase() aria-pressed=move || (shown.get() == one).to_string()
                        on:click=move |_| shown.set(one)>{name}</button>
                </Show>
            }).collect_view()}
        </nav>
        {move || match shown.get() {
            ResultsTab::Tables => view! {
                <main class="results" data-whole=move || there(PARTS)().then_some("")>
                    <section class="o"><Show when=there(2)><ObjectSeen/></Show></section>
                    <section class="a1"><Show when=there(1)><Residuals/></Show></section>
                    <section class="a2"><Show when=there(5)><PhotosTable/></Show></section>
                    <section class="b scroll" tabindex="0" aria-label=text::cameras><Show when=there(3)><Cameras/><CheckPoints/><GivenTable/></Show></section>
                    <section class="c1"><Show when=there(4)><PointsTable/></Show></section>
                    <section class="c2"><Show when=there(PARTS)><Worst/></Show></section>
                </main>
            }.into_any(),
            ResultsTab::Plots => view! { <Drawings/> }.into_any(),
            ResultsTab::Compared => view! { <Compared/> }.into_any(),
            ResultsTab::Meanings => view! { <Meanings chosen=explained/> }.into_any(),
        }}
    }
}

/// The name of a figure; it opens what the figure means.
#[component]
fn Explained(explain: Callback<Statistic>, of: Statistic, name: crate::i18n::Text) -> impl IntoView {
    view! {
        <button class="explained" title=text::what_it_means on:click=move |_| explain.run(of)>{name}</button>
    }
}

#[component]
fn Hero(explain: Callback<Statistic>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    let sigma0 = move || read(desk, |a, _| a.sigma0);
    let test = move || read(desk, |a, _| a.global_test.clone());
    let redundancy = move || read(desk, |a, _| (a.redundancy, a.observations_count, a.unknowns, a.constraints));
    let rms = move || read(desk, |a, _| a.rms_px);
    let precision = move || read(desk, |a, _| a.precision.clone());
    let points = move || read(desk, |a, _| a.points.len());
    let check = move || read(desk, |a, _| a.check_statistics.as_ref().map(|all| (all.rms_all, all.count)));
    view! {
        <div class="hero" role="region" aria-label=first::figures>
            <h1 class="visually-hidden">{text::results}</h1>
            <div><span><Explained explain of=Statistic::Sigma0 name=|| "σ₀"/></span><b class="huge" data-result="sigma0">{move || format::maybe(sigma0(), 3)}</b><small>{text::a_priori_one}</small></div>
            <div class="test">
                {move || read(desk, |a, _| estimated(a)).map(|said| view! { <span data-result="estimated">{said}</span> })}
                {move || test().map(|t| view! {
                    <span class=if t.passed { "pass" } else { "fail" }>
                        <Glyph icon=if t.passed { Icon::Check } else { Icon::Cross } size=14/>
                        " " {if t.passed { text::test_passed() } else { text::test_failed() }}
                    </span>
                    <button class="explained bar-button" aria-label=text::what_it_means title=text::what_it_means on:click=move |_| explain.run(Statistic::GlobalTest)>
                    <TestBar statistic=t.statistic lower=t.lower upper=t.upper/>
                    </button>
                    <small><span>{format::fixed(t.lower, 0)}</span><b>"χ² " {format::fixed(t.statistic, 1)}</b><span>{format::fixed(t.upper, 0)}</span></small>
                })}
            </div>
            <div><span><Explained explain of=Statistic::Redundancy name=text::redundancy/></span><b data-result="redundancy">{move || format::count(redundancy().0)}</b>
                <small>{move || {
                    let (_, observations, unknowns, constraints) = redundancy();
                    let plus = if constraints > 0 { format!(" + {}", format::count(constraints)) } else { String::new() };
                    format!("{} − {}{plus}", format::count(observations), format::count(unknowns))
                }}</small>
            </div>
            <div><span><Explained explain of=Statistic::RmsResidual name=text::rms_residual/> " " <u>"px"</u></span><b data-result="rms-px">{move || format::maybe(rms(), 3)}</b><small>{text::all_image_coordinates}</small></div>
            <div><span><Explained explain of=Statistic::RmsSigma name=text::rms_sigma/> " " {move || desk.axes().list()} " " <u>{unit}</u></span>
                <b>{move || precision().map(|p| {
                    let decimals = p.rms_sigma.iter().copied().fold(f64::INFINITY, f64::min);
                    desk.axes().shown(p.rms_sigma).map(|s| format::fixed(s, format::decimals_for(decimals))).join("\u{2003}")
                })}</b>
                <small>{move || text::points_one_sigma(format::count(points()))}</small>
            </div>
            <div><span><Explained explain of=Statistic::RelativeAccuracy name=text::relative_accuracy/></span>
                <b>{move || precision().and_then(|p| p.relative).map(|n| format!("1 : {}", format::count(format::three_digits(n))))}</b>
                <small>{move || precision().map(|p| text::largest_dimension(format::fixed(p.largest_dimension, 1), unit.get()))}</small>
            </div>
            {move || check().map(|(rms, n)| view! {
                <div><span><Explained explain of=Statistic::CheckRms name=text::check_rms/> " " <u>{unit}</u></span><b>{format::fixed(rms, 3)}</b><small>{text::n_points(n)}</small></div>
            })}
            <div class="hero-action"><EpochActions/>
                <button class="button" data-action="inside" on:click=move |_| desk.open_inside(Network::Document)>{inside::inside}</button>
                <button class="button" on:click=move |_| desk.export("csv")><Glyph icon=Icon::Save/> {text::export_csv}</button>
                <button class="button" data-open="files" title=interchange::files_for_others
                    on:click=move |_| desk.go(Step::Files)>{interchange::files}</button>
                <button class="button primary" on:click=move |_| desk.go(Step::Report)>{text::write_report} <Glyph icon=Icon::Arrow/></button>
            </div>
        </div>
    }
}

/// The next epoch of this project; of a later epoch, what moved since the first.
#[component]
fn EpochActions() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let first = Memo::new(move |_| desk.document.with(|d| d.project.epoch.as_ref().map(|epoch| epoch.name.clone())));
    view! {
        {move || match first.get() {
            Some(name) => view! {
                <button class="button primary" data-action="compare-epochs" on:click=move |_| desk.compare_with_first()>{move || monitoring::compare_with(&name)}</button>
            }.into_any(),
            None => view! {
                <button class="button" data-action="monitoring" on:click=move |_| desk.show_monitoring()>{monitoring::monitoring}</button>
            }.into_any(),
        }}
        <button class="button" data-action="new-epoch" title=monitoring::new_epoch_words on:click=move |_| desk.begin_next_epoch()>{monitoring::new_epoch}</button>
    }
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

/// The object beside the numbers; in space it is a click away.
#[component]
fn ObjectSeen() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <h2 class="section-head"><span>{object::object}</span>
            <button class="link" data-action="object" on:click=move |_| desk.go(Step::Object)>{object::open_object} " →"</button>
        </h2>
        <div class="plot-box"><Overview/></div>
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
        let [px, py] = pixel_of(c);
        [f64::from(c.width) * px, f64::from(c.height) * py]
    };
    let size = Signal::derive(move || camera.with(|c| c.as_ref().map_or([0.0; 2], frame)));
    let vectors = Signal::derive(move || {
        let (Some(photo), Some(camera)) = (photo.get(), camera.get()) else { return Vec::new() };
        let chosen = desk.selection.with(|s| s.point.clone());
        read(desk, |a, project| {
            let [px, py] = pixel_of(&camera);
            let (w, h) = (f64::from(camera.width), f64::from(camera.height));
            // pixels count downwards
            let up = if camera.interior.model().in_photo_units { 1.0 } else { -1.0 };
            let places = project.observations.iter().zip(&a.observations);
            let here =
                places.filter(|(o, r)| o.photo == photo && r.enabled && o.point == r.point && o.photo == r.photo);
            here.filter_map(|(o, r)| {
                Some(Vector {
                    point: o.point.clone(),
                    at: [(o.u - w / 2.0) * px, (h / 2.0 - o.v) * py],
                    residual: [r.vx?, up * r.vy?],
                    chosen: Some(&o.point) == chosen.as_ref(),
                    over: largest_w(r).is_some_and(|w| w.abs() > a.criteria.w),
                })
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

/// Source of scale and position of the object, for the step row: its control points, or else check points, or else distances.
pub fn control_figure(project: &Project) -> String {
    let of = |role| project.points.iter().filter(|p| p.role == role).count();
    let kinds = [
        (of(Role::Control), text::n_control as fn(usize) -> String),
        (of(Role::Check), text::n_check),
        (project.distances.len(), text::n_distances),
    ];
    kinds.into_iter().find(|(n, _)| *n > 0).map_or_else(|| "–".to_owned(), |(n, words)| words(n))
}
