//! What the code rings of the photos are codes of.

use sightline::ring_code::Family;

/// Code family of all photos.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rings {
    /// Of one family, where there are any.
    Of(Option<Family>),
    /// Of any of these.
    OfSeveral(Vec<Family>),
    /// Of different families.
    Different,
}

impl Default for Rings {
    fn default() -> Self {
        Self::Of(None)
    }
}
