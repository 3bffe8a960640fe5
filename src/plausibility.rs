//! Compares given values with those that the photos determine.
//!
//! Photos alone determine the form of an object: up to position, attitude and size, and never mirrored. Coordinates, distances and
//! cameras that contradict this form are typed, exported or named wrongly, and least squares would hide it: a mirrored plane fits
//! without a residual. Each module answers one question and returns its values; [`crate::orient`] reports them as notes,
//! [`crate::adjust`] as advice. Nothing is corrected here but by [`exchange::exchange_axes`], which is asked for.

pub mod axes;
pub mod cameras;
pub mod exchange;
pub mod framing;
mod least_squares;
pub mod one_station;
pub mod scale;
mod seen;
pub mod units;

pub use exchange::exchange_axes;
