//! Dense linear algebra of the reduced normal equations: tiles, their kernel, blocks of three.

pub mod blocks;
pub mod cholesky3;
pub mod kernel;
pub mod tiles;
