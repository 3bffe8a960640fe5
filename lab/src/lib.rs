//! Sightline for teaching and experiments: the sample project, the papers' experiments run again, the adjustment for those who learn.
//!
//! Nothing here is needed to measure: users of the engine do not link it, and it is not published.

pub mod experiments;
pub mod reason;
pub mod sample;
pub mod teaching;
