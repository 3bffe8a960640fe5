//! The damped iteration, and one network on its way to a solution.

pub mod iteration;
pub mod session;
