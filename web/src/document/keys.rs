//! Keys that identify the rows of the document, and the names of its tables.

use serde::{Deserialize, Serialize};

/// Kinds of rows that can be selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    Photos,
    Cameras,
    Points,
    Observations,
    Distances,
    /// Identified by photo and number.
    Targets,
}

/// Separates photo and point in the key of an observation (ASCII unit separator).
const SEPARATOR: char = '\u{1f}';

/// Key of an observation.
pub fn observation_key(photo: &str, point: &str) -> String {
    format!("{photo}{SEPARATOR}{point}")
}

/// Photo and point of an observation's key.
pub fn observation_of_key(key: &str) -> Option<(&str, &str)> {
    key.split_once(SEPARATOR)
}

/// The tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Table {
    Photos,
    Cameras,
    #[default]
    Points,
    Observations,
    Distances,
    /// Points with given coordinates.
    Control,
    /// Targets with their names.
    Identities,
}
