//! What a free network leaves open, and the S-transformation into the datum asked for.

pub mod free;
pub mod s_transformation;
