//! Lens corrections according to a photo's file, and their consequences for a calibration.

use sightline::exif::{Aberration, LensCorrection, PhotoInfo, Setting};

use crate::edit::pairs;
use crate::i18n::text;

/// One or two sentences; `None` if the file has no such data.
pub fn sentence(file: &str, info: &PhotoInfo) -> Option<String> {
    let named = |made: bool| {
        let of = info.corrections.iter().filter(|correction| (correction.setting != Setting::Off) == made);
        let names = of.map(|LensCorrection { aberration, setting, tag }| {
            let name = aberration_name(*aberration);
            if *setting == Setting::Auto { text::correction_auto(name, tag) } else { text::correction_of(name, tag) }
        });
        Some(names.collect::<Vec<_>>().join(", ")).filter(|names| !names.is_empty())
    };
    let moves = |correction: &LensCorrection| {
        correction.setting != Setting::Off && correction.aberration == Aberration::Distortion
    };
    let made = named(true).map(|names| match (pairs::is_raw(file), info.corrections.iter().any(moves)) {
        (true, _) => text::corrections_of_developed(names),
        (false, true) => text::corrections_made(names),
        (false, false) => text::corrections_without_distortion(names),
    });
    let not_made = named(false).filter(|_| !pairs::is_raw(file)).map(text::corrections_off);
    let all = made.into_iter().chain(not_made).collect::<Vec<_>>().join(" ");
    Some(all).filter(|all| !all.is_empty())
}

fn aberration_name(aberration: Aberration) -> &'static str {
    match aberration {
        Aberration::Distortion => text::aberration_distortion(),
        Aberration::LateralColour => text::aberration_lateral_colour(),
        Aberration::Vignetting => text::aberration_vignetting(),
        Aberration::Diffraction => text::aberration_diffraction(),
    }
}
