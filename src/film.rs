//! Film and plates, measured on a comparator or in a scan: from machine coordinates to photo coordinates.
//!
//! The way is that of Kang and Yeu (1985): machine coordinates are transformed to the calibrated fiducial marks by a plane
//! transformation ([`transformation`]), a calibrated distortion table is fitted by an odd polynomial ([`distortion`]),
//! and what results are observations like those of any camera ([`comparator`]).

pub mod comparator;
pub mod distortion;
pub mod transformation;
