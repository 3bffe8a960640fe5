//! The search for gross errors: a robust start, data snooping and robust weights.

mod reweighting;
pub mod robust;
pub mod search;
pub mod snooping;
pub mod start;
