//! Texts of storage that the browser may clear.

use super::English;
use crate::i18n::declare;

declare! { lasting {
    photo: "A photo is being read";
    pixels: "The samples of a photo are being read";
    target: "A target is being measured";
    colours: "The colours of a photo are being measured";
    lens_colours: "What a lens changes for red and blue is being computed";
    situation: "Photos are being oriented, to show where points should be";
    features: "Forms and systems are being measured";
    report: "The report is being made";
    report_stopped: "The report was stopped. It is made again after the next change.";
    plots: "Plots are being drawn";
    comparison: "The results are being compared";
    sheets: "Targets are being drawn";
    file: "A file is being written";
    plan: "The plan is being computed";
} }
