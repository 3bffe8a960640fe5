//! Reference to the project of epoch 0.

use serde::{Deserialize, Serialize};

/// The first epoch of a series of projects of one object.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EpochOf {
    /// Name of its project.
    pub name: String,
    /// Identifier in the project storage; empty if it was not stored.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub key: String,
    /// This project's number in the series, the first epoch being 0.
    pub number: usize,
    /// Names of coded points that are not those of their codes, by the code's: the same names are given again.
    #[serde(skip_serializing_if = "std::collections::BTreeMap::is_empty")]
    pub names: std::collections::BTreeMap<String, String>,
}
