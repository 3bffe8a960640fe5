//! The report: made by the engine in a worker, shown and printed here.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::comparison::Comparison;
use sightline::project::{LengthLimit, Project, ReportLanguage, ReportSettings};
use sightline_protocol::{CompareResults, Export, MakePlots, MakeReport, ReportMade};
use sightline_report::plots::Plot;

use super::background::Stop;
use super::pool::TaskOutcome;
use super::saving::file_stem;
use super::{Desk, JobKind, Until};
use crate::browser::file::{self, NamedFile};
use crate::browser::page;
use crate::document::Change;
use crate::edit::report::{self, LogoFault};
use crate::format;
use crate::i18n::background as words;
use crate::i18n::{errors, speech, text};

/// The report as it is shown.
#[derive(Clone, Copy, Default)]
pub struct Reports {
    /// The last result.
    pub made: RwSignal<Option<ReportMade>>,
    /// The plots of the present result.
    pub plots: RwSignal<Vec<Plot>>,
    /// The present result beside the one before.
    pub compared: RwSignal<Option<Arc<Comparison>>>,
    /// Why nothing was.
    pub failure: RwSignal<Option<String>>,
    /// Whether another one is being made: what is shown is the one before.
    pub being_made: RwSignal<bool>,
    /// Tells the answer to the last question from earlier ones.
    asked: RwSignal<u64>,
    asked_plots: RwSignal<u64>,
    asked_comparison: RwSignal<u64>,
}

/// The language that a report is written in: its own, or the desk's.
pub fn report_language(settings: &ReportSettings) -> ReportLanguage {
    settings.language.unwrap_or_else(|| speech().pages())
}

impl Desk {
    /// The project as its report is made of it: with language and date, where it has none of its own.
    fn to_report(self, project: &Project) -> Project {
        let mut project = project.clone();
        project.report.language = Some(report_language(&project.report));
        if project.report.date.trim().is_empty() {
            project.report.date = page::today();
        }
        project
    }

    /// Has the report of the present result made; the one that is shown stays until then.
    pub fn make_report(self) {
        let task = self.document.with(|d| {
            let result = d.current()?;
            Some(MakeReport { project: self.to_report(&d.project), adjustment: result.adjustment.clone() })
        });
        let serial = self.reports.asked.get_untracked() + 1;
        self.reports.asked.set(serial);
        self.reports.being_made.set(task.is_some());
        let Some(task) = task else { return self.reports.made.set(None) };
        let on_outcome = move |outcome: TaskOutcome<MakeReport>| {
            if self.reports.asked.get_untracked() != serial {
                return;
            }
            self.reports.being_made.set(false);
            match outcome {
                TaskOutcome::Done(made, _) => {
                    self.reports.failure.set(None);
                    self.reports.made.set(Some(made));
                }
                TaskOutcome::Failed(failure) => {
                    self.reports.made.set(None);
                    self.reports.failure.set(Some(match &failure {
                        super::pool::Failure::Refused(error) => errors::sentence(error),
                        super::pool::Failure::Unreadable(detail) | super::pool::Failure::Lost(detail) => {
                            text::worker_lost(detail)
                        }
                    }));
                }
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        let stopped = move || {
            self.reports.being_made.set(false);
            self.reports.made.set(None);
            self.reports.failure.set(Some(words::report_stopped().to_owned()));
        };
        self.ask(Stop(words::report, stopped), task, Vec::new(), on_outcome);
    }

    /// Has the plots of the present result drawn, in the desk's language.
    pub fn make_plots(self) {
        let task = self.document.with(|d| {
            let result = d.current()?;
            let mut project = (*d.project).clone();
            project.report = ReportSettings::default();
            project.report.language = Some(report_language(&project.report));
            let before = self.history.with(|history| {
                history.result_before(result).map(|before| ((*before.input).clone(), before.adjustment.clone()))
            });
            Some(MakePlots { project, adjustment: result.adjustment.clone(), before })
        });
        let serial = self.reports.asked_plots.get_untracked() + 1;
        self.reports.asked_plots.set(serial);
        let Some(task) = task else { return self.reports.plots.set(Vec::new()) };
        let on_outcome = move |outcome: TaskOutcome<MakePlots>| {
            if self.reports.asked_plots.get_untracked() != serial {
                return;
            }
            match outcome {
                TaskOutcome::Done(plots, _) => self.reports.plots.set(plots),
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        self.ask(Stop(words::plots, || ()), task, Vec::new(), on_outcome);
    }

    /// Has the present result set beside the one before, where there is one.
    pub fn compare_results(self) {
        let before = untrack(|| self.result_before());
        let present = self.document.with_untracked(|d| d.current().cloned());
        let serial = self.reports.asked_comparison.get_untracked() + 1;
        self.reports.asked_comparison.set(serial);
        let Some((before, present)) = before.zip(present) else { return self.reports.compared.set(None) };
        let task = CompareResults {
            before: (*before.input).clone(),
            earlier: before.adjustment.clone(),
            after: (*present.input).clone(),
            later: present.adjustment.clone(),
        };
        let on_outcome = move |outcome: TaskOutcome<CompareResults>| {
            if self.reports.asked_comparison.get_untracked() != serial {
                return;
            }
            match outcome {
                TaskOutcome::Done(found, _) => self.reports.compared.set(Some(Arc::new(found))),
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        self.ask(Stop(words::comparison, || ()), task, Vec::new(), on_outcome);
    }

    /// Hands a plot over as a file.
    pub fn save_plot(self, plot: &Plot) {
        if let Err(detail) = file::download(&format!("{}.svg", plot.name), "image/svg+xml", plot.file().as_bytes()) {
            self.say(true, Until::NextWork, move || text::cannot_save(&detail));
        }
    }

    /// Hands the report over as one file.
    pub fn save_report(self) {
        let task = self.document.with_untracked(|d| Export {
            format: "report".to_owned(),
            project: untrack(|| self.to_report(&d.project)),
            adjustment: d.current().map(|result| result.adjustment.clone()),
        });
        let name = format!("{}-report.html", file_stem(&task.project.name));
        let batch = self.start_job(JobKind::Reporting, 1, || {});
        let on_outcome = move |outcome: TaskOutcome<Export>| {
            self.end_job();
            match outcome {
                TaskOutcome::Done(_, bytes) => {
                    if let Some(bytes) = bytes.first() {
                        self.hand_over(&name, "text/html", bytes);
                    }
                }
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }

    /// Changes the settings of the report.
    pub fn edit_report(self, edit: impl FnOnce(&mut ReportSettings)) {
        self.change(Change::ReportEdited, |document| report::change(document, edit));
    }

    /// Takes a coverage factor as typed.
    pub fn set_coverage(self, typed: &str) {
        match format::parse(typed).filter(|k| *k > 0.0) {
            Some(k) => self.edit_report(|settings| settings.coverage_factor = k),
            None => self.refuse(typed, text::not_a_length),
        }
    }

    /// Takes a part of the limit of length measurement errors as typed; nothing takes it away.
    pub fn set_length_limit(self, constant: &str, per: &str) {
        let number = |typed: &str| format::parse(typed).filter(|x| *x > 0.0);
        for typed in [constant, per] {
            if number(typed).is_none() && !typed.trim().is_empty() {
                return self.refuse(typed, text::not_a_length);
            }
        }
        let limit = number(constant).map(|constant| LengthLimit { constant, per: number(per) });
        self.edit_report(|settings| settings.length_limit = limit);
    }

    /// Takes a picture for the first page.
    pub fn take_logo(self, file: NamedFile) {
        spawn_local(async move {
            match file.content.read().await {
                Ok(bytes) => match report::logo(&bytes) {
                    Ok(logo) => self.edit_report(|settings| settings.logo = logo),
                    Err(LogoFault::Kind) => self.say(true, Until::NextWork, || text::logo_kind().to_owned()),
                    Err(LogoFault::Size) => self.say(true, Until::NextWork, || text::logo_size().to_owned()),
                },
                Err(detail) => self.say(true, Until::NextWork, move || text::unreadable(&detail)),
            }
        });
    }
}
