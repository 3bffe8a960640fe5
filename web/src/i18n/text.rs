//! The texts that most of the desk uses, under one name; those of a part by itself (experiments, plan, monitoring) go by the part's name.

pub use super::en::adjusting::*;
pub use super::en::changes::*;
pub use super::en::control::*;
pub use super::en::general::*;
pub use super::en::names::*;
pub use super::en::photos::*;
pub use super::en::projects::*;
pub use super::en::reports::*;
pub use super::en::results::*;
pub use super::en::targets::*;

/// A point's role.
pub fn role_word(role: sightline::project::Role) -> &'static str {
    match role {
        sightline::project::Role::Tie => role_tie(),
        sightline::project::Role::Control => role_control(),
        sightline::project::Role::Check => role_check(),
    }
}

/// A camera model's name, as people read it.
pub fn model_name(interior: &sightline::project::Interior) -> &'static str {
    use sightline::project::Interior;
    match interior {
        Interior::Brown { .. } => model_brown(),
        Interior::Opencv { .. } => model_opencv(),
        Interior::OpencvRational { .. } => model_opencv_rational(),
        Interior::OpencvFisheye { .. } => model_opencv_fisheye(),
    }
}
