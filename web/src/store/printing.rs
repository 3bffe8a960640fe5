//! Targets to print: options, drawings by a worker, and saving the files. It is not part of the document: the choice is kept as a preference.

use leptos::prelude::*;
use sightline::Error;
use sightline_protocol::{DrawSheets, Drawn, WriteSheets, from_text, to_text};
use sightline_report::sheets::SheetOptions;

use super::Desk;
use super::background::Stop;
use super::pool::{Failure, TaskOutcome};
use crate::browser::page;
use crate::i18n::{background as words, speech};

const PREFERENCE: &str = "sheets";

/// Signals of the printed sheets.
#[derive(Clone, Copy)]
pub struct Printing {
    pub options: RwSignal<SheetOptions>,
    /// The sheet that is shown, from 0.
    pub sheet: RwSignal<usize>,
    pub drawn: RwSignal<Option<Result<Drawn, Error>>>,
    /// Tells the last order from earlier ones.
    order: StoredValue<u64>,
}

impl Default for Printing {
    fn default() -> Self {
        let kept = page::preference(PREFERENCE).and_then(|text| from_text(&text).ok());
        Self {
            options: RwSignal::new(kept.unwrap_or_default()),
            sheet: RwSignal::new(0),
            drawn: RwSignal::new(None),
            order: StoredValue::new(0),
        }
    }
}

/// Width, height and principal distance in pixels.
pub struct Seeing {
    pub size: [u32; 2],
    pub c_px: f64,
    /// Whether there is no camera in the project.
    pub assumed: bool,
}

impl Desk {
    /// Chooses what is printed.
    pub fn choose_sheets(self, edit: impl FnOnce(&mut SheetOptions)) {
        self.printing.options.update(edit);
        self.printing.options.with_untracked(|options| page::set_preference(PREFERENCE, &to_text(options)));
    }

    /// The printed document, in the language of the desk.
    pub fn sheet_options(self) -> SheetOptions {
        SheetOptions { language: speech().pages(), ..self.printing.options.get() }
    }

    /// Has the sheet drawn that is to be shown.
    pub fn draw_sheets(self, options: SheetOptions, sheet: usize) {
        let order = self.printing.order.try_update_value(|n| {
            *n += 1;
            *n
        });
        let last = move || self.printing.order.try_get_value() == order;
        let on_outcome = move |outcome: TaskOutcome<DrawSheets>| match outcome {
            TaskOutcome::Done(drawn, _) if last() => {
                // Fewer sheets than before: the last is shown.
                let most = drawn.titles.len().saturating_sub(1);
                self.printing.drawn.set(Some(Ok(drawn)));
                if sheet > most {
                    self.printing.sheet.set(most);
                }
            }
            TaskOutcome::Failed(Failure::Refused(error)) if last() => self.printing.drawn.set(Some(Err(error))),
            TaskOutcome::Failed(failure) if last() => self.tell_failure(failure),
            TaskOutcome::Done(..) | TaskOutcome::Failed(_) => {}
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(words::sheets, || ()), DrawSheets { options, sheet }, Vec::new(), on_outcome);
    }

    /// Hands over the PDF, the SVG of the sheet that is shown, or the lists.
    pub fn save_sheets(self, what: Saved) {
        let options = untrack(|| self.sheet_options());
        let sheet = self.printing.sheet.get_untracked();
        let task = match what {
            Saved::Pdf => WriteSheets { options, pdf: true, svg: None },
            Saved::Svg => WriteSheets { options, pdf: false, svg: Some(sheet) },
            Saved::Lists => WriteSheets { options, pdf: false, svg: None },
        };
        let on_outcome = move |outcome: TaskOutcome<WriteSheets>| match outcome {
            TaskOutcome::Done(names, bytes) => {
                for (name, bytes) in names.iter().zip(&bytes) {
                    let kind = match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
                        "pdf" => "application/pdf",
                        "svg" => "image/svg+xml",
                        _ => "text/csv",
                    };
                    self.hand_over(name, kind, bytes);
                }
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(words::sheets, || ()), task, Vec::new(), on_outcome);
    }

    /// The project's camera as diameters are advised for, or a common one.
    pub fn seeing(self) -> Seeing {
        self.document.with(|d| {
            let own =
                d.project.cameras.first().or_else(|| d.project.plan.as_ref()?.cameras.first()).and_then(|camera| {
                    let c_px = camera.principal_distance_px()?;
                    Some(Seeing { size: [camera.width, camera.height], c_px, assumed: false })
                });
            // 28 mm on 36 x 24 mm with 6000 pixels.
            own.unwrap_or(Seeing { size: [6000, 4000], c_px: 28.0 / 0.006, assumed: true })
        })
    }
}

/// The transferred objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saved {
    Pdf,
    Svg,
    Lists,
}
