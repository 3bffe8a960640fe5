//! Sightline's engine: from photographs of circular targets to coordinates with standard errors.
//!
//! Conventions, everywhere in this crate:
//!
//! | frame | definition |
//! | --- | --- |
//! | pixel (u, v) | origin at the outer corner of the top-left pixel of the stored sensor grid, u right, v down; the first pixel's centre is (0.5, 0.5) |
//! | photo (x, y) | origin at the image centre, x right, y up; millimetres when the pixel pitch is known, else pixels |
//! | camera | x right, y up, z towards the viewer: the object lies at negative z |
//! | object (X, Y, Z) | right-handed, one length unit for the whole project |
//!
//! Angles are radians. M = Mκ·Mφ·Mω takes object differences into the camera frame ([`rotation`]).
//! There is one document, the [`project::Project`], and one result, the [`adjustment::Adjustment`].

pub mod adjust;
pub mod adjustment;
pub mod camera;
pub mod decode;
pub mod detect;
pub mod detection;
pub mod eccentricity;
pub mod error;
pub mod exchange;
pub mod exif;
pub mod experiments;
pub mod film;
pub mod image;
pub mod initial;
pub mod matching;
pub mod network;
pub mod noise;
pub mod orient;
pub mod project;
pub mod render;
pub mod ring_code;
pub mod rotation;
pub mod sample;
pub mod scene;
pub mod statistics;

pub use error::{Error, Result};
