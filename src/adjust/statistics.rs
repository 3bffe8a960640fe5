//! Cofactors of unknowns and observations, external reliability.

pub mod additional;
pub mod cofactors;
pub mod external_reliability;
pub mod ray_cofactors;
