//! Why initial values cannot be computed: the reason in errors of closed-form solutions.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Why an initial value cannot be computed from what was given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum Degeneracy {
    /// Fewer points or rays than the method needs.
    TooFew {
        /// How many the method needs.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// The object points lie on a line, or coincide.
    Collinear,
    /// The object points lie in a plane, or so nearly that noise dominates.
    Coplanar,
    /// The rays intersect at too small an angle.
    NearParallel {
        /// Largest angle between two of the rays, in radians.
        angle: f64,
    },
    /// The point lies behind a camera.
    BehindCamera {
        /// Position of that ray in the list given.
        ray: usize,
    },
    /// No solution puts the points in front of the camera with small residuals.
    NoSolution,
}

impl fmt::Display for Degeneracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { needed, given } => write!(f, "{given} points or rays, but {needed} are needed"),
            Self::Collinear => f.write_str("the points lie on a line"),
            Self::Coplanar => f.write_str("the points lie in a plane"),
            Self::NearParallel { angle } => {
                write!(f, "the rays are nearly parallel: they meet at {:.3}°", angle.to_degrees())
            }
            Self::BehindCamera { ray } => write!(f, "the point lies behind the camera of ray {}", ray + 1),
            Self::NoSolution => f.write_str("no solution fits"),
        }
    }
}

impl std::error::Error for Degeneracy {}
