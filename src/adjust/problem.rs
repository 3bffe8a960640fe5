//! The document as the adjustment sees it: numbering, values, additional observations, preparation.

pub mod additional;
pub mod eccentric;
pub mod far_points;
pub mod left_out;
pub mod network;
pub mod numbering;
pub mod rig;
pub mod state;
pub mod step;
mod surface;
pub mod unmodelled;
