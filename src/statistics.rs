//! Statistics: test distributions and the reliability of single observations.

pub mod distribution;
pub mod fisher;
pub mod reliability;
