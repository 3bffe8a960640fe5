//! What is true of a picture as a whole: its noise, its range, where it is clipped.

pub(crate) mod noise;
