//! Why a network cannot be solved, and what a solvable one is weak in.

pub mod advice;
pub mod judgement;
mod null_space;
pub mod questions;
pub mod rank_defect;
pub mod slips;
pub mod structure;
