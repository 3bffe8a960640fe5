//! The engine from outside, natively: one binary, one topic a module, in folders like those of `src`. That it gives the same as wasm is
//! tested in tests/face.

/// Adjustment, statistics and what goes wrong in networks.
mod adjust {
    mod aerial;
    mod behaviour;
    mod colours;
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
}

/// Whether a calibration is good.
mod calibration {
    mod cross;
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

/// What the papers state.
mod experiments {
    mod published;
}

/// Epochs of one object: what moved, and how often the tests are right.
mod monitoring {
    mod damage;
    mod projects;
    mod properties;
    mod published;
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

/// What plans promise and which are recommended.
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

/// What several tests share; benches and fuzz targets use some of it.
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
