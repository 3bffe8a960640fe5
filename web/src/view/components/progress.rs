//! What is being computed, how far it is, and the way to stop it.

use leptos::prelude::*;

use crate::format;
use crate::i18n::{self, experiments as words, monitoring, planning as plan_words, text};
use crate::store::{Desk, Job, JobKind};

#[component]
pub fn Progress() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let now = move || desk.tasks.job.get();
    let percent = move || now().map_or(0.0, |job| 100.0 * job.done as f64 / job.total.max(1) as f64);
    let words = move || now().map_or("", |job| job_label(&job));
    let counted = move || now().filter(|job| job.total > 1).map(|job| job_count(desk, &job));
    view! {
        <Show when=move || desk.tasks.job.with(Option::is_some)>
            <div
                class="progress"
                role="progressbar"
                aria-label=words
                aria-valuemin="0"
                aria-valuemax="100"
                aria-valuenow=move || format!("{:.0}", percent())
            >
                <span>{words}</span>
                <span class="count">{counted}</span>
                <i style:--done=move || format!("{}%", percent())></i>
            </div>
            <button class="button" on:click=move |_| desk.cancel()>{text::cancel}</button>
        </Show>
    }
}

fn job_label(job: &Job) -> &'static str {
    match job.kind {
        JobKind::Opening => text::opening_photos(),
        JobKind::Detecting => text::detecting(),
        JobKind::Adjusting => text::adjusting(),
        JobKind::Matching => text::matching(),
        JobKind::Saving => text::saving(),
        JobKind::OpeningProject => text::opening_project(),
        JobKind::Reading => i18n::interchange::reading(),
        JobKind::Sample => text::opening_sample(),
        JobKind::Experiment => words::running(),
        JobKind::Reporting => text::writing_report(),
        JobKind::Planning => plan_words::making(),
        JobKind::Comparing => monitoring::comparing(),
    }
}

/// How far the work is, in its own words.
fn job_count(desk: Desk, job: &Job) -> String {
    let (done, total) = (format::count(job.done), format::count(job.total));
    match job.kind {
        JobKind::Detecting => {
            let targets = desk.document.with(|d| d.detections.values().map(|d| d.targets.len()).sum());
            text::photos_and_targets(done, total, format::count(targets))
        }
        JobKind::Adjusting => text::iteration_of(done, total),
        _ => text::done_of(done, total),
    }
}
