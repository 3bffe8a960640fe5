//! How a step changes the values of the unknowns, and how one network's values pass to another.

use std::collections::HashMap;

use super::network::Network;
use super::state::{ExteriorOrientation, State};

/// A step: per photo turn (camera axes) and shift, per interior orientation its scaled unknowns, per point its shift.
#[derive(Clone, Debug, Default)]
pub struct Step {
    /// Photos.
    pub photos: Vec<[f64; 6]>,
    /// Interior orientations.
    pub interiors: Vec<Vec<f64>>,
    /// Points.
    pub points: Vec<[f64; 3]>,
}

impl Step {
    /// Largest change of an object or projection-centre coordinate.
    pub fn largest(&self) -> f64 {
        let photos = self.photos.iter().flat_map(|p| &p[3..]);
        photos.chain(self.points.iter().flatten()).fold(0.0, |most, x| x.abs().max(most))
    }
}

impl State {
    /// The state after a step.
    pub fn stepped(&self, network: &Network, step: &Step) -> Self {
        let interiors = self.interiors.iter().zip(&step.interiors).zip(&network.interiors);
        Self {
            poses: self.poses.iter().zip(&step.photos).map(|(pose, step)| pose.turned(step)).collect(),
            interiors: interiors
                .map(|((interior, step), block)| {
                    let mut interior = *interior;
                    for (estimated, step) in block.estimated.iter().zip(step) {
                        let value = interior.get(estimated.parameter).unwrap_or_default();
                        interior.set(estimated.parameter, value + step * estimated.scale);
                    }
                    interior
                })
                .collect(),
            points: self
                .points
                .iter()
                .zip(&step.points)
                .map(|(x, step)| std::array::from_fn(|a| x[a] + step[a]))
                .collect(),
        }
    }

    /// Takes over the values of another network's state for the same document, where it has them.
    pub fn adopt(&mut self, network: &Network, other: &Self, other_network: &Network) {
        let moved = |x: [f64; 3]| network.frame.inside(other_network.frame.outside(x));
        let photos: HashMap<usize, usize> =
            other_network.photos.iter().enumerate().map(|(k, photo)| (photo.index, k)).collect();
        for (block, pose) in network.photos.iter().zip(&mut self.poses) {
            let Some(&k) = photos.get(&block.index) else { continue };
            *pose = ExteriorOrientation { m: other.poses[k].m, centre: moved(other.poses[k].centre) };
            self.interiors[block.interior] = other.interiors[other_network.photos[k].interior];
        }
        let points: HashMap<usize, usize> =
            other_network.points.iter().enumerate().map(|(k, point)| (point.index, k)).collect();
        for (block, x) in network.points.iter().zip(&mut self.points) {
            let Some(&k) = points.get(&block.index) else { continue };
            let adopted = moved(other.points[k]);
            (0..3).filter(|a| !block.fixed[*a]).for_each(|a| x[a] = adopted[a]);
        }
    }
}
