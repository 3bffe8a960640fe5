//! Report settings. They are not an input of the adjustment: the result stays current.

use std::sync::Arc;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sightline::project::{ReportSettings, Section};

use crate::document::{AdjustmentResult, Document};

/// Largest picture that is kept in the document, bytes.
pub const LARGEST_LOGO: usize = 1 << 20;

/// Changes the report's settings; a result that is current stays so.
pub fn change(document: &mut Document, edit: impl FnOnce(&mut ReportSettings)) {
    let current = document.current().cloned();
    edit(&mut document.project_mut().report);
    if let Some(result) = current {
        let input = document.project.clone();
        document.result = Some(Arc::new(AdjustmentResult { input, ..(*result).clone() }));
    }
}

/// Puts a section in or leaves it out.
pub fn switch(settings: &mut ReportSettings, section: Section, on: bool) {
    settings.left_out.retain(|other| *other != section);
    if !on {
        settings.left_out.push(section);
        settings.left_out.sort_unstable();
    }
}

/// Why a picture is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogoFault {
    /// Neither PNG nor JPEG.
    Kind,
    /// Larger than [`LARGEST_LOGO`].
    Size,
}

/// A picture file as a data URL, as the document stores it.
///
/// # Errors
/// Why the file cannot be used.
pub fn logo(file: &[u8]) -> Result<String, LogoFault> {
    let kind = match file {
        [0x89, b'P', b'N', b'G', ..] => "png",
        [0xff, 0xd8, 0xff, ..] => "jpeg",
        _ => return Err(LogoFault::Kind),
    };
    if file.len() > LARGEST_LOGO {
        return Err(LogoFault::Size);
    }
    Ok(format!("data:image/{kind};base64,{}", BASE64_STANDARD.encode(file)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adjusted() -> Document {
        let adjustment = serde_json::from_str(
            r#"{"termination":"converged","iterations":[],"observations_count":0,"unknowns":0,"constraints":0,
                "redundancy":0,"sigma0":null,"global_test":null,"cameras":[],"photos":[],"points":[],"observations":[],
                "check_points":[],"precision":null}"#,
        )
        .unwrap();
        let mut document = Document::default();
        let input = document.project.clone();
        document.result = Some(Arc::new(AdjustmentResult { oriented: input.clone(), input, adjustment }));
        document
    }

    #[test]
    fn words_of_the_report_leave_the_result_current_and_do_not_make_an_old_one_so() {
        let mut document = adjusted();
        change(&mut document, |settings| settings.operator = "Crew".into());
        assert!(document.current().is_some() && document.project.report.operator == "Crew");
        document.project_mut().unit = "m".into();
        change(&mut document, |settings| settings.date = "today".into());
        assert!(document.out_of_date());
    }

    #[test]
    fn sections_are_switched() {
        let mut settings = ReportSettings::default();
        switch(&mut settings, Section::Points, false);
        switch(&mut settings, Section::Points, false);
        assert_eq!(settings.left_out, [Section::Points, Section::AllObservations]);
        switch(&mut settings, Section::AllObservations, true);
        switch(&mut settings, Section::Points, true);
        assert!(settings.left_out.is_empty());
    }

    #[test]
    fn a_logo_is_a_small_png_or_jpeg() {
        assert_eq!(logo(&[0xff, 0xd8, 0xff]).unwrap(), "data:image/jpeg;base64,/9j/");
        assert!(logo(b"\x89PNG\r\n").unwrap().starts_with("data:image/png;base64,iVBOR"));
        assert_eq!(logo(b"<svg/>"), Err(LogoFault::Kind));
        let mut large = vec![0; LARGEST_LOGO + 1];
        large[..3].copy_from_slice(&[0xff, 0xd8, 0xff]);
        assert_eq!(logo(&large), Err(LogoFault::Size));
    }
}
