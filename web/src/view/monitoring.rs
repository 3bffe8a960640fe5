//! Monitoring: epochs beside each other. The engine compares; here epochs and options are chosen, and what was found is shown.

mod options;
mod picture;
mod points;
mod report;
mod setup;
mod tests;
mod time;
mod words;

use leptos::prelude::*;
use sightline_report::epochs::decimals;

use super::components::icon::{Glyph, Icon};
use crate::format;
use crate::i18n::{Text, monitoring as said, text};
use crate::store::monitoring::{ComparisonRun, MonitoringPage};
use crate::store::{Desk, Step};
use crate::view::components::title::TitleBar;

use picture::Picture;
use points::{Groups, LeftOutPoints, ObjectPoints, ReferencePoints};
use report::EpochsReport;
use setup::Setup;
use tests::{Epochs, Notes, Tests};
use time::OverTime;
use words::verdict;

#[component]
pub fn Monitoring() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let has_result = Memo::new(move |_| desk.document.with(|d| d.result.is_some()));
    let enough = Memo::new(move |_| monitored.epochs.with(Vec::len) > 1);
    let ran = Memo::new(move |_| monitored.ran.with(Option::is_some));
    let current = Memo::new(move |_| monitored.current().is_some());
    let views: [(MonitoringPage, &str, Text); 4] = [
        (MonitoringPage::Setup, "setup", said::setup),
        (MonitoringPage::Displacements, "displacements", said::displacements),
        (MonitoringPage::Time, "time", said::over_time),
        (MonitoringPage::Report, "report", text::report),
    ];
    view! {
        <TitleBar title=said::monitoring sentence=Signal::derive(|| said::sentence().to_owned())>
            <Show when=move || has_result.get()>
                <button class="button" data-action="to-results" on:click=move |_| desk.go(Step::Results)>{text::results}</button>
            </Show>
            <button class="button" class:primary=move || !current.get() data-action="compare" disabled=move || !enough.get()
                on:click=move |_| desk.compare_epochs()>{said::compare} " " <Glyph icon=Icon::Arrow/></button>
        </TitleBar>
        <div class="result-views" role="navigation" aria-label=said::monitoring>
            {views.map(|(one, key, name)| view! {
                <button class="text-button" data-shown=key aria-pressed=move || (monitored.view.get() == one).to_string()
                    disabled=move || one != MonitoringPage::Setup && !ran.get()
                    on:click=move |_| monitored.view.set(one)>{name}</button>
            }).collect_view()}
        </div>
        {move || match (monitored.view.get(), current.get()) {
            (MonitoringPage::Setup, _) => view! { <Setup/> }.into_any(),
            (_, false) => view! { <OutOfDate/> }.into_any(),
            (MonitoringPage::Displacements, true) => view! { <Displacements/> }.into_any(),
            (MonitoringPage::Time, true) => view! { <OverTime/> }.into_any(),
            (MonitoringPage::Report, true) => view! { <EpochsReport/> }.into_any(),
        }}
    }
}

/// Text shown while the last comparison is of other epochs or options.
#[component]
fn OutOfDate() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <main class="out-of-date">
            <Glyph icon=Icon::Clock size=24/>
            <h1>{said::out_of_date}</h1>
            <p>{said::out_of_date_words}</p>
            <button class="button primary" disabled=move || desk.monitoring.epochs.with(Vec::len) < 2
                on:click=move |_| desk.compare_epochs()>{said::compare}</button>
        </main>
    }
}

fn unit(ran: &ComparisonRun) -> String {
    ran.found.unit.clone().unwrap_or_default()
}

/// Movements between two epochs.
#[component]
fn Displacements() -> impl IntoView {
    view! {
        <Verdict/>
        <main class="epochs-view">
            <aside class="scroll" tabindex="0" aria-label=said::tests><Epochs/><Tests/><Notes/></aside>
            <Picture/>
            <section class="scroll displaced" tabindex="0" aria-label=said::object_points>
                <ObjectPoints/><ReferencePoints/><Groups/><LeftOutPoints/>
            </section>
        </main>
    }
}

/// The verdict in one sentence, with its two figures.
#[component]
fn Verdict() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    move || {
        let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
        let (calm, sentence, detail) = verdict(&ran.found, &pair);
        let unit = unit(&ran);
        let decimals = decimals(&pair);
        let largest =
            pair.points.iter().filter(|p| !pair.stable.contains(&p.id)).max_by(|a, b| a.length.total_cmp(&b.length));
        let largest = largest.map(|p| {
            let value = format::fixed(p.length, decimals);
            let sigma = p.length_sigma.map(|s| format!(" ± {}", format::fixed(s, decimals))).unwrap_or_default();
            view! {
                <div><span>{said::largest} " " <u>{unit.clone()}</u></span><b data-found="largest">{value}<small>{sigma}</small></b>
                    <small>{said::of_point(&p.id)}</small></div>
            }
        });
        let mut detectable: Vec<f64> = pair
            .points
            .iter()
            .filter(|p| !pair.stable.contains(&p.id))
            .filter_map(|p| Some(p.detectable?.worst))
            .collect();
        detectable.sort_by(f64::total_cmp);
        let detectable = detectable.get(detectable.len() / 2).map(|median| {
            let options = monitored.options.get();
            let percent = |share: f64| format::editable((1e6 * share).round() / 1e4);
            view! {
                <div><span>{said::detectable_median} " " <u>{unit.clone()}</u></span><b>{format::fixed(*median, decimals)}</b>
                    <small>{said::at_power(percent(options.power), format!("{} %", percent(options.significance)))}</small></div>
            }
        });
        Some(view! {
            <div class="moved-verdict" class:calm=calm aria-live="polite">
                <div class="words">
                    <p class="said"><Glyph icon=if calm { Icon::Check } else { Icon::Warning } size=18/> <b data-found="verdict">{sentence}</b></p>
                    <p>{detail}</p>
                </div>
                {largest}{detectable}
            </div>
        })
    }
}
