//! The engine from outside, natively: one binary, one topic a module, in folders like those of `src`. That it gives the same as wasm is
//! tested in tests/face.

/// Adjustment, statistics and what goes wrong in networks.
mod adjust {
    mod aerial;
    mod behaviour;
    mod components;
    mod curved;
    mod damage;
    mod doctor;
    mod estimation;
    mod features;
    mod forms;
    mod gross_errors;
    mod inside;
    pub mod models;
    mod monte_carlo;
    mod oracle;
    mod order;
    mod published;
    mod reports;
    mod rig;
    mod slips;
    mod unmodelled;
}

/// Whether a calibration is good.
mod calibration {
    mod coverage;
    mod cross;
    mod distance;
    mod models;
    mod patterns;
    mod uncertainty;
}

/// Two results of one object beside each other.
mod comparison;

/// Pictures: what is found, how well, and what is not.
mod detect {
    mod cases;
    mod coarse;
    mod codes;
    mod codes_among;
    mod compression;
    mod developed;
    mod donuts;
    mod formats;
    mod honest;
    mod light;
    mod ordinary;
    mod panel;
    mod photos;
    mod scenes;
    mod sharp;
    mod targets;
}

/// Files of other programs, read and written.
mod exchange {
    mod axes;
    mod foreign;
    mod interchange;
    mod lists;
    mod round_trips;
    mod spatial;
    mod tables;
}

/// Values of the papers.
mod experiments {
    mod published;
}

/// Epochs of one object: what moved, and how often the tests are right.
mod monitoring {
    mod damage;
    mod projects;
    mod properties;
    mod published;
    mod shared;
    mod simulated;
}

/// Names of targets.
mod matching {
    mod grids;
}

/// From names to initial values.
mod orient {
    mod doubles;
    mod left_out;
    mod naming;
    mod orientation;
    mod questions;
    mod seeded;
}

/// Predictions of plans, and recommended plans.
mod plan {
    mod planning;
    mod search;
}

/// The document as other programs write it.
mod project {
    mod document;
    mod units;
}

/// The report's pages.
mod report {
    mod pages;
}

/// The sample project.
mod sample;

/// Targets to print.
mod sheets {
    mod calibrated;
    mod printed;
}

/// The adjustment for those who learn.
mod teaching;

/// Shared by several tests; benches and fuzz targets use some of it.
mod support {
    pub mod boards;
    pub mod camera_model;
    #[allow(dead_code, reason = "the benchmark uses the rest")]
    pub mod coded_patch;
    pub mod coded_photo;
    pub mod compression;
    pub mod conditions;
    pub mod data;
    pub mod dense;
    pub mod donuts;
    pub mod epochs;
    pub mod extent;
    pub mod grid_fit;
    pub mod lenses;
    pub mod light;
    pub mod networks;
    pub mod painter;
    pub mod print_shot;
    pub mod seed_document;
    pub mod textures;
    pub mod tree;
    pub mod trials;
    pub mod wavy;
}
