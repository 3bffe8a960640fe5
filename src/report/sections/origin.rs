//! Files of another program that the project was read from: what was taken for granted, what a converted camera leaves.

use crate::project::{Assumed, Conversion, Origin};
use crate::report::context::{Context, listed};
use crate::report::html::Html;
use crate::report::number::{count, fixed};

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
        "vstars" => "V-STARS",
        other => other,
    }
}

/// A difference in pixels with the digits that tell it from none.
fn pixels(value: f64) -> String {
    if value >= 0.0005 { fixed(value, 3) } else { "< 0.001".to_owned() }
}

/// Nothing where the project was made here.
pub fn write(context: &Context, html: &mut Html) {
    let Some(origin) = &context.project.origin else { return };
    let words = context.words;
    let Origin { format, files, assumed, ignored, conversions } = &**origin;
    let names = listed(files.iter().map(String::as_str), LISTED);
    html.h3(words.origin_title()).p(&words.origin_read(&program(format), &names));
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
            Assumed::ImageSizeFromMeasurements => words.origin_size_measurements(),
            Assumed::FourCoefficientsRadialTangential => words.origin_four(),
            Assumed::UnitUnknown => words.origin_unit(),
            Assumed::PixelOriginCorner => words.origin_corner(),
            Assumed::SystemOfChunk => words.origin_chunk(),
        });
    }
    let left: usize = ignored.iter().map(|ignored| ignored.count).sum();
    if left > 0 {
        html.note(&words.origin_ignored(&count(left)));
    }
}
