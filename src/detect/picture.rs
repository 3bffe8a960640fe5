//! Properties of a whole picture: noise, grey level range, saturation, sharpening; and a copy in which the
//! sharpening is reversed.

pub(crate) mod character;
pub(crate) mod dither;
pub(crate) mod mean;
pub(crate) mod noise;
pub(crate) mod sharpening;
pub(crate) mod softened;
