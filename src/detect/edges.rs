//! The rim of a target: edge points on rays across it, the ellipse through them, edge widths, and the annulus around
//! it. Independent of how an outline was found.

pub(crate) mod blur;
pub(crate) mod edge;
pub(crate) mod ellipse_fit;
pub(crate) mod lit;
pub(crate) mod propagation;
pub(crate) mod quality;
pub(crate) mod quick_test;
pub(crate) mod sectors;
pub(crate) mod surround;
