//! The result, read from a solved network.

pub mod additional;
pub mod result;
