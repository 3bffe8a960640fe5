//! Interior orientation: the camera models and the names of their parameters.
//!
//! A new model is a variant of [`Interior`], a row of [`CameraModel`] and its equations in `src/camera/`.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Name of a parameter of the interior orientation. `F` is fx = fy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's own
pub enum Parameter {
    C,
    F,
    Fx,
    Fy,
    X0,
    Y0,
    Cx,
    Cy,
    K1,
    K2,
    K3,
    P1,
    P2,
    B1,
    B2,
    K4,
    K5,
    K6,
}

impl Parameter {
    /// Every parameter of the brown model, in its order.
    pub const BROWN: [Self; 10] =
        [Self::C, Self::X0, Self::Y0, Self::K1, Self::K2, Self::K3, Self::P1, Self::P2, Self::B1, Self::B2];
    /// Every parameter of the opencv model, in its order.
    pub const OPENCV: [Self; 10] =
        [Self::F, Self::Fx, Self::Fy, Self::Cx, Self::Cy, Self::K1, Self::K2, Self::P1, Self::P2, Self::K3];
    /// Every parameter of the rational model, in OpenCV's order.
    #[rustfmt::skip]
    pub const OPENCV_RATIONAL: [Self; 13] = [
        Self::F, Self::Fx, Self::Fy, Self::Cx, Self::Cy,
        Self::K1, Self::K2, Self::P1, Self::P2, Self::K3, Self::K4, Self::K5, Self::K6,
    ];
    /// Every parameter of the fisheye model, in OpenCV's order.
    pub const OPENCV_FISHEYE: [Self; 9] =
        [Self::F, Self::Fx, Self::Fy, Self::Cx, Self::Cy, Self::K1, Self::K2, Self::K3, Self::K4];

    /// Name in the project format.
    pub fn name(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::F => "f",
            Self::Fx => "fx",
            Self::Fy => "fy",
            Self::X0 => "x0",
            Self::Y0 => "y0",
            Self::Cx => "cx",
            Self::Cy => "cy",
            Self::K1 => "k1",
            Self::K2 => "k2",
            Self::K3 => "k3",
            Self::P1 => "p1",
            Self::P2 => "p2",
            Self::B1 => "b1",
            Self::B2 => "b2",
            Self::K4 => "k4",
            Self::K5 => "k5",
            Self::K6 => "k6",
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Parameter {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        let all = CameraModel::ALL.iter().flat_map(|model| model.parameters);
        all.copied().find(|p| p.name() == name).ok_or(())
    }
}

/// Properties of a camera model besides its equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraModel {
    /// Name in the project format.
    pub name: &'static str,
    /// Parameters in the model's order.
    pub parameters: &'static [Parameter],
    /// Parameter that is the principal distance.
    pub distance: Parameter,
    /// Parameters of the principal point.
    pub centre: [Parameter; 2],
    /// Coefficients of the radial distortion, each with the power of the radius that it multiplies.
    pub radial: &'static [(Parameter, i32)],
    /// Whether measurements and residuals are photo coordinates (y up, the camera's unit) and not pixels (v down).
    pub in_photo_units: bool,
    /// Whether directions of 90 degrees and more off the axis have an image.
    pub is_wide: bool,
}

impl CameraModel {
    /// Brown: correction of the measurement.
    pub const BROWN: Self = Self {
        name: "brown",
        parameters: &Parameter::BROWN,
        distance: Parameter::C,
        centre: [Parameter::X0, Parameter::Y0],
        radial: &[(Parameter::K1, 3), (Parameter::K2, 5), (Parameter::K3, 7)],
        in_photo_units: true,
        is_wide: false,
    };
    /// OpenCV with five coefficients.
    pub const OPENCV: Self = Self {
        name: "opencv",
        parameters: &Parameter::OPENCV,
        distance: Parameter::F,
        centre: [Parameter::Cx, Parameter::Cy],
        radial: &[(Parameter::K1, 3), (Parameter::K2, 5), (Parameter::K3, 7)],
        in_photo_units: false,
        is_wide: false,
    };
    /// OpenCV with eight coefficients.
    pub const OPENCV_RATIONAL: Self = Self {
        name: "opencv_rational",
        parameters: &Parameter::OPENCV_RATIONAL,
        radial: &[
            (Parameter::K1, 3),
            (Parameter::K2, 5),
            (Parameter::K3, 7),
            (Parameter::K4, 3),
            (Parameter::K5, 5),
            (Parameter::K6, 7),
        ],
        ..Self::OPENCV
    };
    /// OpenCV's fisheye.
    pub const OPENCV_FISHEYE: Self = Self {
        name: "opencv_fisheye",
        parameters: &Parameter::OPENCV_FISHEYE,
        radial: &[(Parameter::K1, 3), (Parameter::K2, 5), (Parameter::K3, 7), (Parameter::K4, 9)],
        is_wide: true,
        ..Self::OPENCV
    };
    /// Every model.
    pub const ALL: [Self; 4] = [Self::BROWN, Self::OPENCV, Self::OPENCV_RATIONAL, Self::OPENCV_FISHEYE];

    /// Power of the radius that a coefficient of the radial distortion multiplies.
    pub fn radial_power(&self, parameter: Parameter) -> Option<i32> {
        self.radial.iter().find(|(p, _)| *p == parameter).map(|(_, power)| *power)
    }
}

/// Model and parameters of an interior orientation.
///
/// Brown: a correction added to the measured photo coordinates x̄ = x - x0, ȳ = y - y0 (photo units).
/// The others: ideal to image; fx, fy, cx, cy in the pixel frame (OpenCV's cx is ours - 0.5), distortion of normalised coordinates,
/// or of the angle off the axis (fisheye).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's own
pub enum Interior {
    Brown {
        /// Principal distance; null: not known yet.
        #[serde(default)]
        c: Option<f64>,
        #[serde(default)]
        x0: f64,
        #[serde(default)]
        y0: f64,
        #[serde(default)]
        k1: f64,
        #[serde(default)]
        k2: f64,
        #[serde(default)]
        k3: f64,
        #[serde(default)]
        p1: f64,
        #[serde(default)]
        p2: f64,
        #[serde(default)]
        b1: f64,
        #[serde(default)]
        b2: f64,
    },
    Opencv {
        /// Focal length in pixels along u; null: not known yet.
        #[serde(default)]
        fx: Option<f64>,
        /// Focal length in pixels along v; null: not known yet.
        #[serde(default)]
        fy: Option<f64>,
        cx: f64,
        cy: f64,
        #[serde(default)]
        k1: f64,
        #[serde(default)]
        k2: f64,
        #[serde(default)]
        p1: f64,
        #[serde(default)]
        p2: f64,
        #[serde(default)]
        k3: f64,
    },
    OpencvRational {
        /// Focal length in pixels along u; null: not known yet.
        #[serde(default)]
        fx: Option<f64>,
        /// Focal length in pixels along v; null: not known yet.
        #[serde(default)]
        fy: Option<f64>,
        cx: f64,
        cy: f64,
        #[serde(default)]
        k1: f64,
        #[serde(default)]
        k2: f64,
        #[serde(default)]
        p1: f64,
        #[serde(default)]
        p2: f64,
        #[serde(default)]
        k3: f64,
        #[serde(default)]
        k4: f64,
        #[serde(default)]
        k5: f64,
        #[serde(default)]
        k6: f64,
    },
    OpencvFisheye {
        /// Focal length in pixels along u; null: not known yet.
        #[serde(default)]
        fx: Option<f64>,
        /// Focal length in pixels along v; null: not known yet.
        #[serde(default)]
        fy: Option<f64>,
        cx: f64,
        cy: f64,
        #[serde(default)]
        k1: f64,
        #[serde(default)]
        k2: f64,
        #[serde(default)]
        k3: f64,
        #[serde(default)]
        k4: f64,
    },
}

/// Where a model keeps a parameter.
enum Slot<'a> {
    Value(&'a mut f64),
    /// A principal distance, which may be unknown.
    Distance(&'a mut Option<f64>),
}

impl Interior {
    /// A brown model without distortion.
    pub fn brown(c: f64) -> Self {
        Self::Brown { c: Some(c), x0: 0.0, y0: 0.0, k1: 0.0, k2: 0.0, k3: 0.0, p1: 0.0, p2: 0.0, b1: 0.0, b2: 0.0 }
    }

    /// Properties of its model.
    pub fn model(&self) -> &'static CameraModel {
        match self {
            Self::Brown { .. } => &CameraModel::BROWN,
            Self::Opencv { .. } => &CameraModel::OPENCV,
            Self::OpencvRational { .. } => &CameraModel::OPENCV_RATIONAL,
            Self::OpencvFisheye { .. } => &CameraModel::OPENCV_FISHEYE,
        }
    }

    /// Parameters of the model, in its order.
    pub fn parameters(&self) -> &'static [Parameter] {
        self.model().parameters
    }

    /// Where a parameter stands; `None` if the model lacks it, and for `F`, which is two.
    fn slot(&mut self, parameter: Parameter) -> Option<Slot<'_>> {
        use Parameter as P;
        let value = match self {
            Self::Brown { c, x0, y0, k1, k2, k3, p1, p2, b1, b2 } => match parameter {
                P::C => return Some(Slot::Distance(c)),
                P::X0 => x0,
                P::Y0 => y0,
                P::K1 => k1,
                P::K2 => k2,
                P::K3 => k3,
                P::P1 => p1,
                P::P2 => p2,
                P::B1 => b1,
                P::B2 => b2,
                _ => return None,
            },
            Self::Opencv { fx, fy, cx, cy, k1, k2, p1, p2, k3 } => match parameter {
                P::Fx => return Some(Slot::Distance(fx)),
                P::Fy => return Some(Slot::Distance(fy)),
                P::Cx => cx,
                P::Cy => cy,
                P::K1 => k1,
                P::K2 => k2,
                P::P1 => p1,
                P::P2 => p2,
                P::K3 => k3,
                _ => return None,
            },
            Self::OpencvRational { fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 } => match parameter {
                P::Fx => return Some(Slot::Distance(fx)),
                P::Fy => return Some(Slot::Distance(fy)),
                P::Cx => cx,
                P::Cy => cy,
                P::K1 => k1,
                P::K2 => k2,
                P::P1 => p1,
                P::P2 => p2,
                P::K3 => k3,
                P::K4 => k4,
                P::K5 => k5,
                P::K6 => k6,
                _ => return None,
            },
            Self::OpencvFisheye { fx, fy, cx, cy, k1, k2, k3, k4 } => match parameter {
                P::Fx => return Some(Slot::Distance(fx)),
                P::Fy => return Some(Slot::Distance(fy)),
                P::Cx => cx,
                P::Cy => cy,
                P::K1 => k1,
                P::K2 => k2,
                P::K3 => k3,
                P::K4 => k4,
                _ => return None,
            },
        };
        Some(Slot::Value(value))
    }

    /// Value of a parameter; `None` if the model lacks it or it is not known. `F` is fx.
    pub fn get(&self, parameter: Parameter) -> Option<f64> {
        let mut own = *self;
        match own.slot(if parameter == Parameter::F { Parameter::Fx } else { parameter })? {
            Slot::Value(value) => Some(*value),
            Slot::Distance(value) => *value,
        }
    }

    /// Sets a parameter, if the model has it. `F` moves fx to `value` and keeps the ratio fy : fx.
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        if parameter == Parameter::F {
            let ratio = self.get(Parameter::Fx).map_or(1.0, |fx| value / fx);
            let fy = self.get(Parameter::Fy).map_or(value, |fy| fy * ratio);
            self.set(Parameter::Fy, fy);
            return self.set(Parameter::Fx, value);
        }
        match self.slot(parameter) {
            Some(Slot::Value(place)) => *place = value,
            Some(Slot::Distance(place)) => *place = Some(value),
            None => {}
        }
    }

    /// Makes the principal distance unknown.
    pub fn forget_principal_distance(&mut self) {
        for parameter in [Parameter::C, Parameter::Fx, Parameter::Fy] {
            if let Some(Slot::Distance(place)) = self.slot(parameter) {
                *place = None;
            }
        }
    }
}
