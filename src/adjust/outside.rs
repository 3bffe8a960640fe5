//! What took no part: tested again with the full covariance, control against the photos, and the list of all of it.

pub mod control;
pub mod double_points;
pub mod list;
pub mod retest;
