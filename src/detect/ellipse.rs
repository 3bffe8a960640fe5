//! Ellipse representations: outline without a singular circle, conic, and walks along the rim.

pub(crate) mod conic;
pub(crate) mod outline;
pub(crate) mod rays;
