//! The damped iteration, and the session that solves one network.

pub mod iteration;
pub mod session;
pub mod values;
