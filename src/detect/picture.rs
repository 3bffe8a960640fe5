//! What is true of a picture as a whole: its noise, its range, where it is clipped, how it was
//! sharpened; and the picture made of it in which the sharpening is undone.

pub(crate) mod character;
pub(crate) mod dither;
pub(crate) mod mean;
pub(crate) mod noise;
pub(crate) mod sharpening;
pub(crate) mod softened;
