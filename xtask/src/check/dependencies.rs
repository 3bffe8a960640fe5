//! Checks the sources of dependencies and duplicate versions against deny.toml, as `cargo deny` does, but offline.

use std::collections::BTreeMap;
use std::fs;

use toml::{Table, Value};

use crate::process::root;
use crate::{Outcome, build};

/// The lock files of the workspace and of the fuzz targets, which are a separate workspace.
const LOCKS: [&str; 2] = ["Cargo.lock", "fuzz/Cargo.lock"];

/// Packages from sources that deny.toml does not allow, duplicate versions that it does not list, and listed versions that are no longer
/// in use.
pub fn faults() -> Outcome<Vec<String>> {
    let deny = read("deny.toml")?;
    let registries = strings(&deny, "sources", "allow-registry")?;
    let mut faults = Vec::new();
    for lock in LOCKS {
        faults.extend(foreign(&read(lock)?, &registries).into_iter().map(|package| format!("{lock}: {package}")));
    }
    faults.extend(versions(&duplicates(&build::duplicates()?), &skipped(&deny)?));
    Ok(faults)
}

fn read(name: &str) -> Outcome<Table> {
    let text = fs::read_to_string(root().join(name)).map_err(|error| format!("{name}: {error}"))?;
    text.parse().map_err(|error| format!("{name}: {error}"))
}

fn strings(deny: &Table, section: &str, key: &str) -> Outcome<Vec<String>> {
    let list = deny.get(section).and_then(|section| section.get(key)).and_then(Value::as_array);
    let list = list.ok_or_else(|| format!("deny.toml: {section}.{key} is missing"))?;
    Ok(list.iter().filter_map(Value::as_str).map(str::to_owned).collect())
}

/// The duplicate versions that deny.toml allows.
fn skipped(deny: &Table) -> Outcome<Vec<String>> {
    let list = deny.get("bans").and_then(|bans| bans.get("skip")).and_then(Value::as_array);
    let list = list.ok_or("deny.toml: bans.skip is missing")?;
    Ok(list.iter().filter_map(|entry| entry.get("crate")).filter_map(Value::as_str).map(str::to_owned).collect())
}

/// Packages of a lock file that come from none of the registries. Packages of this repository have no source.
fn foreign(lock: &Table, registries: &[String]) -> Vec<String> {
    let packages = lock.get("package").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let text = |package: &Value, key: &str| package.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
    let known =
        |source: &str| source.strip_prefix("registry+").is_some_and(|from| registries.iter().any(|r| r == from));
    packages
        .iter()
        .filter(|package| package.get("source").is_some() && !known(&text(package, "source")))
        .map(|package| format!("{} comes from {}", text(package, "name"), text(package, "source")))
        .collect()
}

/// Names with several versions, from lines like "name v1.2.3".
fn duplicates(tree: &str) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for line in tree.lines() {
        let mut words = line.split_whitespace();
        let (Some(name), Some(version)) = (words.next(), words.next().and_then(|v| v.strip_prefix('v'))) else {
            continue;
        };
        let versions = all.entry(name.to_owned()).or_default();
        // A package that is also built with other features for build scripts is listed twice.
        if !versions.iter().any(|known| known == version) {
            versions.push(version.to_owned());
        }
    }
    all.retain(|_, versions| versions.len() > 1);
    all
}

/// Faults if more than one version of a package is not listed in deny.toml, or if a listed version is not a duplicate.
fn versions(duplicates: &BTreeMap<String, Vec<String>>, skipped: &[String]) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, versions) in duplicates {
        let new = versions.iter().filter(|version| !skipped.contains(&format!("{name}@{version}"))).collect::<Vec<_>>();
        if new.len() > 1 {
            faults.push(format!(
                "{name} is used in versions {versions:?}: list the older ones in deny.toml, with the packages that need them"
            ));
        }
    }
    for entry in skipped {
        let here = entry.split_once('@').is_some_and(|(name, version)| {
            duplicates.get(name).is_some_and(|versions| versions.iter().any(|known| known == version))
        });
        if !here {
            faults.push(format!("{entry} is listed in deny.toml but is not a duplicate version"));
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_versions_are_named_once_each() {
        let found = duplicates("a v1.0.0\na v2.0.0 (proc-macro)\nb v1.0.0\nb v1.0.0\n\n[build-dependencies]\n");
        assert_eq!(found, BTreeMap::from([("a".to_owned(), vec!["1.0.0".to_owned(), "2.0.0".to_owned()])]));
        assert!(versions(&found, &["a@1.0.0".to_owned()]).is_empty());
        assert_eq!(versions(&found, &[]).len(), 1);
        assert_eq!(versions(&found, &["a@1.0.0".to_owned(), "b@1.0.0".to_owned()]).len(), 1);
    }

    #[test]
    fn a_package_from_elsewhere_is_named() {
        let lock: Table = "[[package]]\nname = \"own\"\n[[package]]\nname = \"a\"\nsource = \"registry+https://x\"\n\
            [[package]]\nname = \"b\"\nsource = \"git+https://y\"\n"
            .parse()
            .expect("a lock file");
        assert_eq!(foreign(&lock, &["https://x".to_owned()]), ["b comes from git+https://y"]);
    }
}
