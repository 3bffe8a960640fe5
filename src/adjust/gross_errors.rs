//! The search for gross errors: data snooping and robust weights.

pub mod robust;
pub mod search;
pub mod snooping;
