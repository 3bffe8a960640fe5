//! Cofactors and external reliability of additional observations.

use crate::adjust::problem::additional::AdditionalObservation;
use crate::adjust::problem::network::Network;

use super::cofactors::Cofactors;

impl AdditionalObservation {
    /// Cofactor of the weighted adjusted observation, 1 - r.
    pub fn cofactor(self, network: &Network, cofactors: &Cofactors) -> f64 {
        let squared = self.sqrt_weight(network).powi(2);
        match self {
            Self::Control(k, a) => cofactors.additional_points[k][a] * squared,
            Self::Position(k, a) => cofactors.photos[k][(3 + a, 3 + a)] * squared,
            Self::Distance(k) => cofactors.bars[k],
            Self::Parameter(k, n) => {
                cofactors.interiors[k][(n, n)] * network.interiors[k].estimated[n].scale.powi(2) * squared
            }
        }
    }

    /// Shift, by a unit of weighted observation error, of the point that it moves most, and that point. `None` if it
    /// acts on no point.
    pub fn influence(self, network: &Network, cofactors: &Cofactors) -> Option<(f64, usize)> {
        let sqrt_weight = self.sqrt_weight(network);
        let influence = &cofactors.additional_influence;
        let (shift, point) = match self {
            Self::Control(k, a) => {
                let (shift, point) = influence.points[k][a];
                (shift * sqrt_weight, point)
            }
            Self::Position(k, a) => {
                let (shift, point) = influence.photos[k][a];
                (shift * sqrt_weight, point)
            }
            Self::Distance(k) => influence.bars[k],
            Self::Parameter(k, n) => {
                let (shift, point) = influence.interiors[k][n];
                (shift * sqrt_weight * network.interiors[k].estimated[n].scale, point)
            }
        };
        (point < network.points.len()).then_some((shift, point))
    }
}
