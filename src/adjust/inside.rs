//! The adjustment for inspection: its linearised observation equations, its normal equations and its iterations one by one, for
//! teaching and for checking with other software.

pub mod cholesky;
pub(crate) mod influence;
pub mod linear_system;
pub mod normal_equations;
pub mod s_transformation;
pub mod sparse;
pub mod stepping;
