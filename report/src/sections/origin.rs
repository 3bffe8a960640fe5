//! Files of another program, or of an earlier version, that the project was read from: the assumptions, what a converted camera
//! leaves, what was not kept.

use crate::context::{Context, listed};
use crate::html::Html;
use crate::number::{count, fixed};
use sightline::project::{Assumed, Conversion, Ignored, LocalSystem, Origin, RemovedFields};

/// Names of files that are listed.
const LISTED: usize = 12;

/// The program of a format, where it is not called by its own name.
fn program(format: &str) -> &str {
    match format {
        "colmap" | "colmap-binary" => "COLMAP",
        "metashape" => "Agisoft Metashape",
        "bal" => "Bundle Adjustment in the Large",
        "bundler" => "Bundler",
        "meshroom" => "AliceVision Meshroom",
        "nvm" => "VisualSFM",
        "opensfm" => "OpenSfM",
        "pix4d" => "Pix4D",
        "realitycapture" => "RealityCapture",
        "vstars" => "V-STARS",
        other => other,
    }
}

/// A difference in pixels with enough digits to show that it is not 0.
fn pixels(value: f64) -> String {
    if value >= 0.0005 { fixed(value, 3) } else { "< 0.001".to_owned() }
}

/// Nothing where the project was made here.
pub fn write(context: &Context, html: &mut Html) {
    let Some(origin) = &context.project.origin else { return };
    let words = context.words;
    let Origin { format, files, assumed, ignored, conversions, local_system } = &**origin;
    let names = listed(files.iter().map(String::as_str), LISTED);
    if origin.is_foreign() {
        html.h3(words.origin_title()).p(&words.origin_read(&program(format), &names));
    }
    if let Some(LocalSystem { latitude, longitude, height, .. }) = local_system {
        let [latitude, longitude, height] = [latitude, longitude, height].map(f64::to_string);
        html.h3(words.origin_local_title()).p(&words.origin_local(&latitude, &longitude, &height));
    }
    for conversion in conversions {
        let Conversion { camera, from, to, max_px, rms_px, warning, .. } = conversion;
        html.p(&words.origin_conversion(camera, from, to, &pixels(*max_px), &pixels(*rms_px)));
        if *warning {
            html.note(words.origin_warning());
        }
    }
    for one in assumed {
        html.note(match one {
            Assumed::SigmaOnePixel => words.origin_sigma(),
            Assumed::ImageSizeFromPrincipalPoint => words.origin_size_principal_point(),
            Assumed::MeasurementsFromCorner => words.origin_from_corner(),
            Assumed::ImageSizeFromMeasurements => words.origin_size_measurements(),
            Assumed::FourCoefficientsRadialTangential => words.origin_four(),
            Assumed::UnitUnknown => words.origin_unit(),
            Assumed::PixelOriginCorner => words.origin_corner(),
            Assumed::SystemOfChunk => words.origin_chunk(),
        });
    }
    let removed = |one: &&Ignored| RemovedFields::NAMES.contains(&one.name.as_str());
    if ignored.iter().any(|one| removed(&one)) {
        html.note(words.origin_earlier());
    }
    let left: usize = ignored.iter().filter(|one| !removed(one)).map(|ignored| ignored.count).sum();
    if left > 0 {
        html.note(&words.origin_ignored(&count(left)));
    }
}
