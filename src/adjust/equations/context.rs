//! Context of the observation and normal equations, shared by the code that builds, solves and inverts them.

use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::adjustment::ResidualPlace;

use super::ordering::Layout;

/// Weights of the image coordinates, and where their residuals are taken.
#[derive(Clone, Copy, Debug)]
pub struct Weighting<'a> {
    /// Where residuals are taken.
    pub place: ResidualPlace,
    /// Factors on the reciprocal standard errors (robust weighting), per ray; empty for none.
    pub robust: &'a [[f64; 2]],
    /// Shifts of the measurements in the units of the residuals (eccentricity), per ray; empty for none.
    pub shift: &'a [[f64; 2]],
}

/// A network at certain values.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The numbered network.
    pub network: &'a Network,
    /// Places of its unknowns in the normal equations.
    pub layout: &'a Layout,
    /// Values of the unknowns.
    pub state: &'a State,
    /// Weights of the image coordinates.
    pub weighting: Weighting<'a>,
}

impl<'a> Context<'a> {
    /// The same at other values.
    pub fn at(self, state: &'a State) -> Self {
        Self { state, ..self }
    }
}
