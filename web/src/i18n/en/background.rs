//! Names of background tasks.

use super::English;
use crate::i18n::declare;

declare! { background {
    photo: "Reading a photo";
    pixels: "Reading the samples of a photo";
    target: "Measuring a target";
    colours: "Measuring the colours of a photo";
    situation: "Orienting photos to predict point positions";
    features: "Measuring features and coordinate systems";
    report: "Writing the report";
    report_stopped: "The report was stopped. It is written again after the next change.";
    plots: "Drawing plots";
    comparison: "Comparing the results";
    displaced: "Displacements are being computed for the photos";
    sheets: "Drawing targets";
    file: "Writing a file";
    plan: "Computing the plan";
} }
