//! The ellipse itself: its outline without a singular circle, its conic, and walks along its rim.

pub(crate) mod conic;
pub(crate) mod outline;
pub(crate) mod rays;
