//! `cargo xtask bench`: what is measured of the engine, as wasm in Node on one thread, and how often the page may be killed.

use crate::build::{Products, Profile};
use crate::install;
use crate::process::{cargo, program, run};
use crate::{Outcome, build, suites};

/// A part: its name on the command line and how it runs.
type Part = (&'static str, fn() -> Outcome);

const PARTS: [Part; 8] = [
    ("detect", detect),
    ("codes", codes),
    ("border", || script("border")),
    ("growth", || script("growth")),
    ("field", suites::field),
    ("estimation", estimation),
    ("epochs", epochs),
    ("orient", orient),
];

/// `bench [part ...]`.
pub fn command(names: &[String]) -> Outcome {
    if let Some(name) = names.iter().find(|name| PARTS.iter().all(|(part, _)| part != name)) {
        let known = PARTS.map(|(part, _)| part).join(", ");
        return Err(format!("there is no part {name}; the parts are {known}"));
    }
    if names.is_empty() || names.iter().any(|name| !["estimation", "epochs"].contains(&name.as_str())) {
        install::node()?;
        Products::of(Profile::Release)?.build_pkg()?;
    }
    for (name, part) in PARTS {
        if names.is_empty() || names.iter().any(|wanted| wanted == name) {
            println!("== {name}");
            part()?;
        }
    }
    Ok(())
}

/// Targets whose truth is known are painted natively and detected in Node.
fn detect() -> Outcome {
    let folder = format!("{}/bench", build::target_directory()?);
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "detect", "--", &folder]))?;
    run(&mut program("node", &["benches/detect.mjs", &folder]))?;
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "photos"]))
}

/// Seeded networks adjusted natively against their truth.
fn estimation() -> Outcome {
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "estimation"]))
}

/// Time of comparing epochs, natively.
fn epochs() -> Outcome {
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "epochs"]))
}

/// Seeded networks and bare dots, natively.
fn orient() -> Outcome {
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "orient"]))?;
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "orient", "--", "dots"]))
}

/// Ring codes are drawn and read natively, then printed sheets of them.
fn codes() -> Outcome {
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "codes"]))?;
    run(&mut cargo(&["bench", "--package", "sightline", "--bench", "prints"]))
}

fn script(name: &str) -> Outcome {
    run(&mut program("node", &[&format!("benches/{name}.mjs")]))
}
