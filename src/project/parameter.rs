//! Interior orientation: the two camera models and the names of their parameters.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Name of a parameter of the interior orientation. `F` stands for fx and fy as one.
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
}

impl Parameter {
    /// Every parameter of the brown model, in its order.
    pub const BROWN: [Self; 10] =
        [Self::C, Self::X0, Self::Y0, Self::K1, Self::K2, Self::K3, Self::P1, Self::P2, Self::B1, Self::B2];
    /// Every parameter of the opencv model, in its order.
    pub const OPENCV: [Self; 10] =
        [Self::F, Self::Fx, Self::Fy, Self::Cx, Self::Cy, Self::K1, Self::K2, Self::P1, Self::P2, Self::K3];

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
        [Self::BROWN, Self::OPENCV].concat().into_iter().find(|p| p.name() == name).ok_or(())
    }
}

/// Model and parameters of an interior orientation.
///
/// Brown: a correction added to the measured photo coordinates x̄ = x - x0, ȳ = y - y0 (photo units).
/// Opencv: ideal to image on normalised coordinates; fx, fy, cx, cy in the pixel frame (OpenCV's cx is ours - 0.5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "lowercase")]
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
}

impl Interior {
    /// A brown model without distortion.
    pub fn brown(c: f64) -> Self {
        Self::Brown { c: Some(c), x0: 0.0, y0: 0.0, k1: 0.0, k2: 0.0, k3: 0.0, p1: 0.0, p2: 0.0, b1: 0.0, b2: 0.0 }
    }

    /// Parameters of the model, in its order.
    pub fn parameters(&self) -> &'static [Parameter] {
        match self {
            Self::Brown { .. } => &Parameter::BROWN,
            Self::Opencv { .. } => &Parameter::OPENCV,
        }
    }

    /// Value of a parameter; none where the model lacks it or it is not known. `F` is fx.
    pub fn get(&self, parameter: Parameter) -> Option<f64> {
        use Parameter as P;
        match (*self, parameter) {
            (Self::Brown { c, .. }, P::C) => c,
            (Self::Brown { x0: value, .. }, P::X0)
            | (Self::Brown { y0: value, .. }, P::Y0)
            | (Self::Brown { k1: value, .. } | Self::Opencv { k1: value, .. }, P::K1)
            | (Self::Brown { k2: value, .. } | Self::Opencv { k2: value, .. }, P::K2)
            | (Self::Brown { k3: value, .. } | Self::Opencv { k3: value, .. }, P::K3)
            | (Self::Brown { p1: value, .. } | Self::Opencv { p1: value, .. }, P::P1)
            | (Self::Brown { p2: value, .. } | Self::Opencv { p2: value, .. }, P::P2)
            | (Self::Brown { b1: value, .. }, P::B1)
            | (Self::Brown { b2: value, .. }, P::B2)
            | (Self::Opencv { cx: value, .. }, P::Cx)
            | (Self::Opencv { cy: value, .. }, P::Cy) => Some(value),
            (Self::Opencv { fx, .. }, P::F | P::Fx) => fx,
            (Self::Opencv { fy, .. }, P::Fy) => fy,
            _ => None,
        }
    }

    /// Sets a parameter, if the model has it. `F` moves fx to `value` and keeps the ratio fy : fx.
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        use Parameter as P;
        let place = match (self, parameter) {
            (Self::Brown { c, .. }, P::C) => c.insert(value),
            (Self::Opencv { fx, fy, .. }, P::F) => {
                let ratio = fx.map_or(1.0, |fx| value / fx);
                *fy = Some(fy.map_or(value, |fy| fy * ratio));
                fx.insert(value)
            }
            (Self::Opencv { fx, .. }, P::Fx) => fx.insert(value),
            (Self::Opencv { fy, .. }, P::Fy) => fy.insert(value),
            (Self::Brown { x0: place, .. }, P::X0)
            | (Self::Brown { y0: place, .. }, P::Y0)
            | (Self::Brown { k1: place, .. } | Self::Opencv { k1: place, .. }, P::K1)
            | (Self::Brown { k2: place, .. } | Self::Opencv { k2: place, .. }, P::K2)
            | (Self::Brown { k3: place, .. } | Self::Opencv { k3: place, .. }, P::K3)
            | (Self::Brown { p1: place, .. } | Self::Opencv { p1: place, .. }, P::P1)
            | (Self::Brown { p2: place, .. } | Self::Opencv { p2: place, .. }, P::P2)
            | (Self::Brown { b1: place, .. }, P::B1)
            | (Self::Brown { b2: place, .. }, P::B2)
            | (Self::Opencv { cx: place, .. }, P::Cx)
            | (Self::Opencv { cy: place, .. }, P::Cy) => place,
            _ => return,
        };
        *place = value;
    }
}
