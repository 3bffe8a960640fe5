//! What the search for gross errors leaves out of a document.

use crate::project::{Parameter, Project};

/// An observation by its place in the document, which stays when the network is numbered anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// Point and axis.
    Control(usize, usize),
    /// Photo and axis.
    Position(usize, usize),
    /// Distance.
    Distance(usize),
    /// Camera, photo for an interior orientation per photo, parameter.
    Parameter(usize, Option<usize>, Parameter),
}

/// Observations of a document that the search for gross errors rejected.
#[derive(Clone, Debug, Default)]
pub struct RejectedObservations {
    /// Per image observation.
    pub observations: Vec<bool>,
    /// Observations of other kinds.
    pub given: Vec<Key>,
}

impl RejectedObservations {
    /// Nothing.
    pub fn nothing(project: &Project) -> Self {
        Self { observations: vec![false; project.observations.len()], given: Vec::new() }
    }

    /// Whether nothing is left out.
    pub fn is_empty(&self) -> bool {
        self.given.is_empty() && !self.observations.contains(&true)
    }
}
