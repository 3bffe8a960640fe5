//! Datum of a free network: the datum defect, and the S-transformation into the chosen datum.

pub mod free;
pub mod s_transformation;
