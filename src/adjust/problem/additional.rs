//! Observations of other kinds than image coordinates: control coordinates, observed projection centres, distances and
//! observed parameters of interior orientations, in one list.
//!
//! Each has a residual v (adjusted minus given) and a reciprocal standard error p in the frame of the adjustment; all of
//! them are tested, weighted down and taken out by the same rules as image coordinates.

use crate::adjustment::Given;
use crate::project::Project;

use super::left_out::Key;
use super::network::{Bar, Network};
use super::state::State;

/// An observation that is not an image measurement, by its place in the [`Network`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdditionalObservation {
    /// Point and axis.
    Control(usize, usize),
    /// Photo and axis.
    Position(usize, usize),
    /// Distance.
    Distance(usize),
    /// Interior orientation and place among its estimated parameters.
    Parameter(usize, usize),
}

/// All that take part, in the order of the result.
pub fn all(network: &Network) -> Vec<AdditionalObservation> {
    let mut list = Vec::new();
    for (k, point) in network.points.iter().enumerate() {
        list.extend((0..3).filter(|a| point.prior[*a].1 > 0.0).map(|a| AdditionalObservation::Control(k, a)));
    }
    for (k, photo) in network.photos.iter().enumerate() {
        list.extend((0..3).filter(|a| photo.prior[*a].1 > 0.0).map(|a| AdditionalObservation::Position(k, a)));
    }
    list.extend((0..network.bars.len()).map(AdditionalObservation::Distance));
    for (k, interior) in network.interiors.iter().enumerate() {
        let observed = (0..interior.estimated.len()).filter(|n| interior.estimated[*n].prior.1 > 0.0);
        list.extend(observed.map(|n| AdditionalObservation::Parameter(k, n)));
    }
    list
}

impl AdditionalObservation {
    /// Reciprocal standard error.
    pub fn sqrt_weight(self, network: &Network) -> f64 {
        match self {
            Self::Control(k, a) => network.points[k].prior[a].1,
            Self::Position(k, a) => network.photos[k].prior[a].1,
            Self::Distance(k) => network.bars[k].sqrt_weight,
            Self::Parameter(k, n) => network.interiors[k].estimated[n].prior.1,
        }
    }

    /// Changes the reciprocal standard error.
    pub fn set_sqrt_weight(self, network: &mut Network, sqrt_weight: f64) {
        match self {
            Self::Control(k, a) => network.points[k].prior[a].1 = sqrt_weight,
            Self::Position(k, a) => network.photos[k].prior[a].1 = sqrt_weight,
            Self::Distance(k) => network.bars[k].sqrt_weight = sqrt_weight,
            Self::Parameter(k, n) => network.interiors[k].estimated[n].prior.1 = sqrt_weight,
        }
    }

    /// Adjusted minus given, in the frame of the adjustment.
    pub fn residual(self, network: &Network, state: &State) -> f64 {
        match self {
            Self::Control(k, a) => state.points[k][a] - network.points[k].prior[a].0,
            Self::Position(k, a) => state.poses[k].centre[a] - network.photos[k].prior[a].0,
            Self::Distance(k) => distance_row(network, state, &network.bars[k]).0 / network.bars[k].sqrt_weight,
            Self::Parameter(k, n) => {
                let estimated = &network.interiors[k].estimated[n];
                state.interiors[k].get(estimated.parameter).unwrap_or_default() - estimated.prior.0
            }
        }
    }

    /// Unit of the residual in the observation's own unit.
    pub fn unit(self, network: &Network) -> f64 {
        if matches!(self, Self::Parameter(..)) { 1.0 } else { network.frame.scale }
    }

    /// Place in the document.
    pub fn key(self, network: &Network) -> Key {
        match self {
            Self::Control(k, a) => Key::Control(network.points[k].index, a),
            Self::Position(k, a) => Key::Position(network.photos[k].index, a),
            Self::Distance(k) => Key::Distance(network.bars[k].index),
            Self::Parameter(k, n) => {
                let block = &network.interiors[k];
                let photo = block.photo.map(|p| network.photos[p].index);
                Key::Parameter(block.camera, photo, block.estimated[n].parameter)
            }
        }
    }
}

impl Key {
    /// By name.
    pub fn named(self, project: &Project) -> Given {
        match self {
            Self::Control(k, axis) => Given::Control { point: project.points[k].id.clone(), axis },
            Self::Position(k, axis) => Given::Position { photo: project.photos[k].id.clone(), axis },
            Self::Distance(k) => {
                let distance = &project.distances[k];
                Given::Distance { from: distance.from.clone(), to: distance.to.clone() }
            }
            Self::Parameter(camera, photo, parameter) => Given::Parameter {
                camera: project.cameras[camera].id.clone(),
                photo: photo.map(|p| project.photos[p].id.clone()),
                parameter,
            },
        }
    }
}

/// Weighted residual of a distance and its derivatives by both ends.
pub fn distance_row(network: &Network, state: &State, bar: &Bar) -> (f64, [f64; 6]) {
    let (a, b) = (&state.points[bar.from], &state.points[bar.to]);
    let d: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let length = d[0].hypot(d[1]).hypot(d[2]);
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    let mut rows = [0.0; 6];
    for k in 0..3 {
        let slope = d[k] * inverse * bar.sqrt_weight;
        rows[k] = if network.points[bar.from].fixed[k] { 0.0 } else { -slope };
        rows[3 + k] = if network.points[bar.to].fixed[k] { 0.0 } else { slope };
    }
    ((length - bar.length) * bar.sqrt_weight, rows)
}
