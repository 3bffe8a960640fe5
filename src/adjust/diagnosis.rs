//! Diagnosis: causes of a rank defect, and weaknesses of a solvable network.

pub mod advice;
pub mod judgement;
mod null_space;
pub mod questions;
pub mod rank_defect;
pub mod slips;
pub mod structure;
