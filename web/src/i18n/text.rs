//! The texts of the desk, apart from those of the experiments and of errors.

pub use super::en::desk::*;

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
