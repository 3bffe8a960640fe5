//! `cargo xtask check`: what a compiler does not see. Works offline.

mod dependencies;
mod invariants;
mod licences;
mod modules;
mod names;
mod order;

use crate::Outcome;

/// Licences of everything that is linked or run, where it comes from and in how many versions, then the repository's own rules.
pub fn command() -> Outcome {
    let mut faults = licences::faults()?;
    faults.extend(dependencies::faults()?);
    faults.extend(invariants::faults()?);
    if faults.is_empty() {
        println!("licences, sources, versions and invariants hold");
        return Ok(());
    }
    Err(format!("{}\n{} faults", faults.join("\n"), faults.len()))
}
