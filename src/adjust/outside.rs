//! Data that were not used: retested with the full covariance, control compared with the photos, and the list of all of them.

pub mod control;
pub mod double_points;
pub mod list;
pub mod retest;
