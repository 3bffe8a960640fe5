//! The report of an adjustment as a self-contained HTML file that a browser prints. The desk shows the same file.
//!
//! There is one source file per section and per language. Numbers are rounded by their standard error ([`number`]), as on the desk.
//!
//! The report loads and runs nothing: it has no script, no inline style, no font, and no picture except the document's logo.

mod context;
pub mod epochs;
pub mod files;
mod html;
pub mod names;
pub mod number;
pub mod plots;
pub mod reason;
mod sections;
pub mod sheets;
mod style;
pub mod texts;

use crate::reason::ReportReason;
use sha2::{Digest, Sha256};

use context::Context;
use sightline::adjustment::Adjustment;
use sightline::error::{Error, Lack, Place, Reason, Result};
use sightline::project::{Project, ReportSettings};

/// The parts from which the HTML file of a report is composed.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Language of its texts, as in HTML.
    pub language: &'static str,
    /// Its title, plain text.
    pub title: String,
    /// Style of the printed page: its size, margins, running headers and numbers.
    pub page_style: String,
    /// Style of the contents.
    pub style: &'static str,
    /// The sections as HTML.
    pub body: String,
}

/// Content security policy: the report runs, loads and sends nothing, even if a name in it contains HTML.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'";

impl Report {
    /// The report as one HTML file.
    pub fn html(&self) -> String {
        let Self { language, title, page_style, style, body } = self;
        let title = html::escaped(title);
        format!(
            "<!doctype html>\n<html lang=\"{language}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
             <style>\n{page_style}{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n"
        )
    }
}

/// Writes the report of an adjusted project.
///
/// # Errors
/// [`Error::Empty`] without an adjustment, [`Error::Invalid`] if it belongs to another state of the project, or if a setting of the report
/// is invalid.
pub fn report(project: &Project, adjustment: Option<&Adjustment>) -> Result<Report> {
    let context = context(project, adjustment)?;
    Ok(Report {
        language: context.language_tag(),
        title: context.title().to_owned(),
        page_style: style::page(&context),
        style: style::STYLE,
        body: sections::all(&context),
    })
}

fn context<'a>(project: &'a Project, adjustment: Option<&'a Adjustment>) -> Result<Context<'a>> {
    let adjustment = adjustment.ok_or(Error::Empty { what: Lack::Adjustment })?;
    belongs(project, adjustment)?;
    check(&project.report)?;
    Ok(Context::new(project, adjustment))
}

/// SHA-256 of the exported document without its report settings, so that it is the same for every report of the document.
///
/// # Errors
/// [`Error::Invalid`] if it cannot be written as JSON.
pub fn digest(project: &Project) -> Result<String> {
    let measured = Project { report: ReportSettings::default(), ..project.clone() };
    let text = serde_json::to_vec(&measured)
        .map_err(|error| invalid(Reason::CannotWriteJson { message: error.to_string() }, Place::default()))?;
    Ok(sha256(&text))
}

/// SHA-256 in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn invalid(reason: Reason, at: Place) -> Error {
    Error::Invalid { reason, at }
}

/// Checks that a result belongs to the project: it lists the same observations in the same order.
fn belongs(project: &Project, adjustment: &Adjustment) -> Result<()> {
    let pairs = || project.observations.iter().zip(&adjustment.observations);
    let same = project.observations.len() == adjustment.observations.len()
        && pairs().all(|(given, found)| given.photo == found.photo && given.point == found.point);
    let knows = |id: &str| project.photos.iter().any(|photo| photo.id == id);
    if same && adjustment.photos.iter().all(|photo| knows(&photo.id)) {
        return Ok(());
    }
    Err(invalid(ReportReason::OtherAdjustment.into(), Place::field("adjustment")))
}

fn check(settings: &ReportSettings) -> Result<()> {
    let positive = |name: &str, value: f64| {
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        let at = Place::field(format!("report.{name}"));
        Err(invalid(Reason::NotPositive { name: name.to_owned(), value: value.into() }, at))
    };
    positive("coverage_factor", settings.coverage_factor)?;
    if let Some(limit) = settings.length_limit {
        positive("length_limit.constant", limit.constant)?;
        limit.per.map_or(Ok(()), |per| positive("length_limit.per", per))?;
    }
    let logo = &settings.logo;
    let data = LOGOS.iter().find_map(|kind| logo.strip_prefix(kind));
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '/' | '=');
    if logo.is_empty() || data.is_some_and(|data| data.chars().all(plain)) {
        return Ok(());
    }
    let text = sightline::error::shortened(&logo.chars().take(60).collect::<String>());
    let reason = Reason::NoneOf { name: "logo".into(), choices: LOGOS.join("…, ") + "…", text };
    Err(invalid(reason, Place::field("report.logo")))
}

/// Permitted kinds of logos.
const LOGOS: [&str; 2] = ["data:image/png;base64,", "data:image/jpeg;base64,"];
