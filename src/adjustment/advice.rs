//! What a solvable network is weak in, and what of the input contradicts its photos.

use serde::{Deserialize, Serialize};

use super::{Given, ImplausibleCamera, MirroredControl, OneStation, PatternKind, Remedy, UndecidedAxes, UnitRatio};
use crate::project::Parameter;

/// Weaknesses of a solvable network, as data; the desk writes them in the user's language.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Advice {
    /// Two parameters are strongly correlated: correlation beyond 0.95.
    HighCorrelation {
        /// Camera identifier.
        camera: String,
        /// Photo identifier, where one parameter is the photo's.
        photo: Option<String>,
        /// Name of one parameter.
        first: String,
        /// Name of the other.
        second: String,
        /// Their correlation.
        correlation: f64,
    },
    /// Observations that are hardly checked by others: redundancy numbers below 0.1.
    LowRedundancy {
        /// Photo and point of each image observation.
        observations: Vec<(String, String)>,
        /// Observations of other kinds.
        #[serde(default)]
        given: Vec<Given>,
    },
    /// Points with two rays: a gross error along the epipolar line stays unseen.
    TwoRays {
        /// The points.
        points: Vec<String>,
    },
    /// Points whose rays meet under less than 5°, or as much short of 180°.
    NarrowIntersection {
        /// Point and largest acute angle between its rays in radians.
        points: Vec<(String, f64)>,
    },
    /// Points behind a camera in which they were measured.
    BehindCamera {
        /// Photo and point of each.
        observations: Vec<(String, String)>,
    },
    /// Distances left out because an end is not measured.
    DistanceUnused {
        /// Ends of each.
        distances: Vec<(String, String)>,
    },
    /// A principal distance that the photos hardly determine: its standard error is more than a twentieth of it.
    WeakPrincipalDistance {
        /// Camera identifier.
        camera: String,
        /// Photo identifier, for cameras with an interior orientation per photo.
        photo: Option<String>,
        /// Name of the parameter.
        parameter: String,
        /// Its adjusted value.
        value: f64,
        /// Its standard error.
        sigma: f64,
        /// Largest angle between the viewing directions of its photos, radians.
        convergence: f64,
    },
    /// The robust weighting or the search for gross errors came to no end.
    GrossErrorsUnsettled,
    /// The estimation of variance components came to no end.
    VarianceComponentsUnsettled,
    /// The residuals of a camera are systematic: they follow a pattern that a cause explains. Told before anything that takes them as noise.
    ResidualPattern {
        /// Camera identifier.
        camera: String,
        /// Quantities on which they depend.
        pattern: PatternKind,
        /// Photos that it is about; empty: all.
        photos: Vec<String>,
        /// Probability of such residuals without a cause.
        p_value: f64,
        /// Root mean square length of the pattern, pixels.
        rms_px: f64,
        /// Its largest length.
        max_px: f64,
        /// σ0 without the pattern.
        sigma0: f64,
        /// Remedy.
        remedy: Remedy,
    },
    /// The residuals are larger than the standard errors of the image coordinates: σ0 is beyond [`Criteria::sigma0`](super::Criteria::sigma0) and
    /// its test failed.
    SigmasTooSmall {
        /// Standard deviation of unit weight.
        sigma0: f64,
        /// Standard deviation of what is not modelled with which they would agree, pixels; null if it cannot be determined.
        unmodelled: Option<f64>,
    },
    /// σ0 fails its test although `unmodelled` was given: it was estimated with other weights.
    UnmodelledAgain {
        /// Standard deviation of unit weight.
        sigma0: f64,
        /// The value to take instead, pixels.
        unmodelled: f64,
    },
    /// A parameter of distortion that is not significantly different from 0 ([`Criteria::significance`](super::Criteria::significance)).
    Insignificant {
        /// Camera identifier.
        camera: String,
        /// Photo identifier, for cameras with an interior orientation per photo.
        #[serde(default)]
        photo: Option<String>,
        /// Which parameter.
        parameter: Parameter,
        /// Its size in standard errors.
        ratio: f64,
        /// The parameter it is most correlated with; null if it is estimated alone.
        #[serde(default)]
        with: Option<Parameter>,
        /// Their correlation.
        #[serde(default)]
        correlation: Option<f64>,
    },
    /// Observations whose |w| exceeds the critical value ([`Criteria::w`](super::Criteria::w)), told where the largest is too large for the largest of so
    /// many: of a thousand tests one exceeds the critical value by chance.
    Suspected {
        /// How many there are.
        count: usize,
        /// Photo, point and w of the image observations with the largest, at most [`Self::SUSPECTS`] of them.
        observations: Vec<(String, String, f64)>,
        /// Observations of other kinds, with w.
        given: Vec<(Given, f64)>,
    },
    /// A control point's given coordinates are not where the photos see it.
    ControlMisfit {
        /// The point.
        point: String,
        /// Given minus seen, in the project's unit; seen: from everything else, without the point's own coordinates.
        difference: [f64; 3],
        /// Size of the difference in its standard errors, from the full covariance of both.
        sigma_ratio: f64,
    },
    /// Two control points whose given coordinates fit when they are exchanged.
    ExchangedPoints {
        /// The points.
        points: [String; 2],
    },
    /// Points nearer to each other than their standard errors can separate: one target under two names, most often.
    DoublePoints {
        /// The pairs.
        pairs: Vec<(String, String)>,
    },
    /// Given coordinates are a mirror image of what the photos show.
    MirroredControl(MirroredControl),
    /// Given points lie in a plane, and nothing shows whether their axes are mirrored.
    UndecidedAxes(UndecidedAxes),
    /// Something seems to be given in another unit than the rest.
    UnitRatio(UnitRatio),
    /// Photos were taken from one place.
    OneStation(OneStation),
    /// A given camera is implausible.
    ImplausibleCamera(ImplausibleCamera),
    /// Nothing gives a scale: lengths are right relative to each other only and have no unit.
    NoScale,
}

impl Advice {
    /// Maximum number of image observations that a suspicion names.
    pub const SUSPECTS: usize = 20;

    /// Whether it means that a given value contradicts the photos. sigma0 and the global test may not show that, so it is shown beside them
    /// wherever they are stated.
    pub fn contradicts(&self) -> bool {
        match self {
            Self::ControlMisfit { .. }
            | Self::ExchangedPoints { .. }
            | Self::Suspected { .. }
            | Self::MirroredControl(_)
            | Self::UndecidedAxes(_)
            | Self::UnitRatio(_)
            | Self::ImplausibleCamera(_) => true,
            Self::OneStation(station) => station.all,
            _ => false,
        }
    }
}
