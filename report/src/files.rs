//! Every file that a project is written as: the report and its plots, and the formats of [`sightline_exchange`].

use sightline::adjustment::Adjustment;
use sightline::error::Result;
use sightline::project::Project;
use sightline_exchange::{self as exchange, Files};

/// The formats written here, beside those of [`exchange::FORMATS`].
pub const FORMATS: [&str; 2] = ["report", "plots"];

/// Writes a project: `report` as `report.html`, `plots` as an SVG a plot, and what [`exchange::export_with`] writes.
///
/// # Errors
/// Those of [`crate::report`], [`crate::plots::plots`] and [`exchange::export_with`]; [`sightline::Error::Unknown`] for any other format.
pub fn export(format: &str, project: &Project, adjustment: Option<&Adjustment>, convert: bool) -> Result<Files> {
    match format {
        "report" => {
            let html = crate::report(project, adjustment)?.html();
            Ok(Files::from([("report.html".to_owned(), html.into_bytes())]))
        }
        "plots" => {
            let plots = crate::plots::plots(project, adjustment)?;
            Ok(plots.into_iter().map(|plot| (format!("{}.svg", plot.name), plot.file().into_bytes())).collect())
        }
        written if exchange::FORMATS.iter().any(|known| known.export && known.name == written) => {
            exchange::export_with(format, project, adjustment, convert)
        }
        _ => Err(exchange::unknown_export(format, &FORMATS)),
    }
}
