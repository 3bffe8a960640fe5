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
//!
//! The pipeline, from the bytes of photos to coordinates with standard errors; the photos here are those of the sample:
//!
//! ```
//! use sightline::adjust::adjust;
//! use sightline::adjustment::AdjustOptions;
//! use sightline::detection::{Codes, DetectOptions};
//! use sightline::matching::{PhotoTargets, name_coded};
//! use sightline::orient::orient;
//! use sightline::{decode, detect};
//! use sightline_lab::sample;
//!
//! // Cameras, photos and control points: given before anything is measured.
//! let mut project = sample::project()?;
//!
//! // Targets, photo by photo.
//! let options = DetectOptions { codes: Codes::Auto, ..DetectOptions::default() };
//! let mut photos = Vec::new();
//! for photo in &project.photos {
//!     let grey = decode::grey(&sample::file(&photo.file)?, options.channel)?;
//!     let targets = detect::detect(&grey.view()?, &options)?.targets;
//!     photos.push(PhotoTargets { photo: photo.id.clone(), targets });
//! }
//!
//! // Point names: the number of a code is the name of its point.
//! let coded = name_coded(&photos, None);
//! let known: Vec<_> = project.points.iter().map(|point| point.id.clone()).collect();
//! project.points.extend(coded.points.into_iter().filter(|point| !known.contains(&point.id)));
//! project.observations.extend(coded.observations);
//!
//! // Initial values, then the bundle adjustment.
//! let oriented = orient(&project)?;
//! let adjustment = adjust(&oriented.project, &AdjustOptions::default(), &mut |_| true)?;
//!
//! for point in &adjustment.points {
//!     let [x, y, z] = point.sigma.expect("full statistics");
//!     assert!(x.max(y).max(z) < 0.1, "{}: {x} {y} {z} mm", point.id);
//! }
//! assert!(adjustment.global_test.expect("a redundancy").passed);
//! # Ok::<(), sightline::Error>(())
//! ```

pub mod adjust;
pub mod adjustment;
pub mod axes;
pub mod calibration;
pub mod camera;
pub mod comparison;
pub mod decode;
pub mod depiction;
pub mod detect;
pub mod detection;
pub mod eccentricity;
pub mod equipment;
pub mod error;
pub mod exif;
pub mod features;
pub mod film;
pub mod image;
pub mod initial;
pub mod limits;
pub mod matching;
pub mod monitoring;
pub mod noise;
pub mod orient;
pub mod plausibility;
pub mod project;
pub mod ring_code;
pub mod rotation;
pub mod sensor;
pub mod statistics;
pub mod tiles;
pub mod units;

pub use error::{Error, Result};
