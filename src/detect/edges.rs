//! What the rim of a target shows: edges on rays across it, the ellipse through them, how steep they are and what lies
//! around them. Knows grey levels and outlines, nothing of how an outline was come by.

pub(crate) mod blur;
pub(crate) mod edge;
pub(crate) mod lit;
pub(crate) mod look;
pub(crate) mod propagation;
pub(crate) mod quality;
pub(crate) mod sectors;
pub(crate) mod surround;
pub(crate) mod through;
