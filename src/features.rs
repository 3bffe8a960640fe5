//! Measuring on the result: fitted forms, distances, angles, deviations, coordinate systems.
//!
//! Every figure is a function of the adjusted points, so that its variance is that of the points carried along its derivative,
//! f Σ fᵀ with the full covariance Σ. Only the products Σ fᵀ are asked for ([`Carry`]): the adjustment gets each by one solution of
//! its factored normal equations, however many points there are.

mod circle;
mod cylinder;
mod deviation;
mod form;
mod line;
mod linear;
mod measure;
pub mod names;
mod plane;
mod regression;
mod relation;
mod sphere;
mod system;

pub use linear::{Carry, Function};
pub use measure::measure;
