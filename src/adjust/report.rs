//! The result, read from a solved network.

pub mod additional;
mod extent;
pub mod result;
mod rig;
