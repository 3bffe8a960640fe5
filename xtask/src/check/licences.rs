//! Licences of the dependency tree against the list in deny.toml, from what cargo and npm have locked.

use std::fs;

use serde_json::Value;
use spdx::{Expression, LicenseReq, ParseMode};

use crate::process::root;
use crate::{Outcome, build};

/// Packages whose licence is not on the list.
pub fn faults() -> Outcome<Vec<String>> {
    let allowed = allowed()?;
    let mut faults = Vec::new();
    for (name, licence) in cargo_packages()?.into_iter().chain(npm_packages()?) {
        match fits(&licence, &allowed) {
            Ok(true) => {}
            Ok(false) => faults.push(format!("{name}: the licence {licence} is not on the list in deny.toml")),
            Err(error) => faults.push(format!("{name}: the licence \"{licence}\" is not understood ({error})")),
        }
    }
    Ok(faults)
}

fn allowed() -> Outcome<Vec<String>> {
    let text = fs::read_to_string(root().join("deny.toml")).map_err(|error| format!("deny.toml: {error}"))?;
    let table: toml::Table = text.parse().map_err(|error| format!("deny.toml: {error}"))?;
    let list = table.get("licenses").and_then(|licences| licences.get("allow")).and_then(|allow| allow.as_array());
    let list = list.ok_or("deny.toml: licenses.allow is missing")?;
    Ok(list.iter().filter_map(|licence| licence.as_str()).map(str::to_owned).collect())
}

/// Whether the allowed licences satisfy an expression; the old "A/B" is read as "A OR B".
fn fits(expression: &str, allowed: &[String]) -> Outcome<bool> {
    let expression = Expression::parse_mode(expression, ParseMode::LAX).map_err(|error| error.reason.to_string())?;
    Ok(expression.evaluate(|required: &LicenseReq| allowed.contains(&required.to_string())))
}

fn cargo_packages() -> Outcome<Vec<(String, String)>> {
    let metadata = build::metadata()?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata lists no packages")?;
    let licence = |package: &Value| {
        let name = format!(
            "{} {}",
            package["name"].as_str().unwrap_or_default(),
            package["version"].as_str().unwrap_or_default()
        );
        (name, package["license"].as_str().unwrap_or("none").to_owned())
    };
    Ok(packages.iter().map(licence).collect())
}

fn npm_packages() -> Outcome<Vec<(String, String)>> {
    let mut all = Vec::new();
    for name in ["e2e/package-lock.json", "web/view3d/package-lock.json"] {
        let text = fs::read_to_string(root().join(name)).map_err(|error| format!("{name}: {error}"))?;
        let lock: Value = serde_json::from_str(&text).map_err(|error| format!("{name}: {error}"))?;
        let packages = lock["packages"].as_object().ok_or_else(|| format!("{name} lists no packages"))?;
        let licence = |(path, package): (&String, &Value)| {
            (path.clone(), package["license"].as_str().unwrap_or("none").to_owned())
        };
        all.extend(packages.iter().filter(|(path, _)| !path.is_empty()).map(licence));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_judged() {
        let allowed = ["MIT".to_owned(), "Apache-2.0 WITH LLVM-exception".to_owned()];
        for (expression, expected) in [
            ("MIT", true),
            ("GPL-3.0-only", false),
            ("GPL-3.0-only OR MIT", true),
            ("Unlicense/MIT", true),
            ("MIT AND GPL-3.0-only", false),
            ("Apache-2.0 WITH LLVM-exception", true),
            ("Apache-2.0", false),
            ("(GPL-2.0-only OR MIT) AND MIT", true),
        ] {
            assert_eq!(fits(expression, &allowed), Ok(expected), "{expression}");
        }
        assert!(fits("none", &allowed).is_err());
    }
}
