//! The engine from outside, natively: one binary, one topic a module. That it gives the same as wasm is tested in tests/face.

mod aerial;
mod behaviour;
#[allow(dead_code, reason = "the benchmark uses the rest")]
mod coded_patch;
mod codes;
mod damage;
mod data;
mod dense;
mod doctor;
mod document;
mod exchange;
mod experiments;
mod gross_errors;
mod monte_carlo;
mod naming;
mod networks;
mod oracle;
mod orientation;
mod painter;
mod panel;
mod photos;
mod published;
mod reports;
mod sample;
mod scenes;
mod sharp;
mod targets;
mod tree;
