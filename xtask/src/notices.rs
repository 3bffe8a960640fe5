//! THIRD-PARTY.txt: the licences of everything of others that is handed out, as their terms ask for: crates that are linked into a module,
//! npm packages that are bundled, and Rust's own library.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use spdx::Expression;

use crate::build::write;
use crate::install::TARGET;
use crate::process::root;
use crate::{Outcome, build, install};

/// Name of the file, beside the page and in pkg/.
pub const NAME: &str = "THIRD-PARTY.txt";
/// Packages of the workspace that become modules.
pub const SHIPPED: [&str; 4] = ["sightline-face", "sightline-desk", "sightline-worker", "sightline-codecs"];
/// Folder of the only scripts that packages of npm are bundled into.
const BUNDLED: &str = "web/view3d";

/// A package with its licence.
#[derive(Clone, Debug, Eq, Ord, PartialEq, PartialOrd)]
struct Package {
    name: String,
    version: String,
    /// SPDX expression.
    licence: String,
    authors: String,
    source: String,
    folder: PathBuf,
}

/// Writes the file into a folder.
pub fn write_to(folder: &Path) -> Outcome {
    write(&folder.join(NAME), text()?.as_bytes())
}

/// Inputs of the file.
pub fn sources() -> Vec<PathBuf> {
    let mut all = vec![root().join("Cargo.lock"), root().join(BUNDLED).join("package-lock.json")];
    all.extend(scripts().unwrap_or_default());
    all
}

fn text() -> Outcome<String> {
    let metadata: Value = serde_json::from_str(&build::metadata_of(&[TARGET])?).map_err(|error| error.to_string())?;
    let mut packages = crates(&metadata)?;
    packages.extend(npm()?);
    packages.push(Package {
        name: "Rust standard library".into(),
        version: "of the compiler".into(),
        licence: "MIT OR Apache-2.0".into(),
        authors: "The Rust Project contributors".into(),
        source: "https://github.com/rust-lang/rust".into(),
        folder: PathBuf::new(),
    });
    packages.sort();
    let mut by_text: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut list = String::new();
    for package in &packages {
        list += &format!("{} {}: {} ({})\n", package.name, package.version, package.licence, package.source);
        for text in texts(package)? {
            by_text.entry(text).or_default().push(format!("{} {}", package.name, package.version));
        }
    }
    let rule = "=".repeat(78);
    let mut all = format!(
        "Sightline contains the following software of others, each under its own licence.\n\n{list}\nThe texts of the licences follow.\n"
    );
    for (text, names) in by_text {
        all += &format!("\n{rule}\n{}\n{rule}\n\n{}\n", names.join(", "), text.trim_end());
    }
    Ok(all)
}

/// The crates that are linked into what is handed out: whatever the shipped packages need at run time, as wasm.
fn crates(metadata: &Value) -> Outcome<Vec<Package>> {
    let packages = metadata["packages"].as_array().ok_or("cargo metadata lists no packages")?;
    let nodes = metadata["resolve"]["nodes"].as_array().ok_or("cargo metadata resolves nothing")?;
    let by_id: BTreeMap<&str, &Value> =
        packages.iter().filter_map(|package| Some((package["id"].as_str()?, package))).collect();
    let needs: BTreeMap<&str, &Value> = nodes.iter().filter_map(|node| Some((node["id"].as_str()?, node))).collect();
    let is_shipped = |package: &Value| SHIPPED.iter().any(|name| package["name"] == *name);
    let mut open: Vec<&str> = by_id.iter().filter(|(_, package)| is_shipped(package)).map(|(id, _)| *id).collect();
    if open.len() != SHIPPED.len() {
        return Err(format!("cargo metadata lists {} of {SHIPPED:?}", open.len()));
    }
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        for needed in needs.get(id).and_then(|node| node["deps"].as_array()).into_iter().flatten() {
            let at_run_time =
                needed["dep_kinds"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"].is_null()));
            open.extend(needed["pkg"].as_str().filter(|_| at_run_time));
        }
    }
    let of_others = seen.into_iter().filter_map(|id| by_id.get(id)).filter(|package| !package["source"].is_null());
    of_others.map(|package| of_crate(package)).collect()
}

fn of_crate(package: &Value) -> Outcome<Package> {
    let text = |key: &str| package[key].as_str().unwrap_or_default().to_owned();
    let authors = package["authors"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let authors = authors.collect::<Vec<_>>().join(", ");
    let name = text("name");
    let licence = text("license");
    if licence.is_empty() {
        return Err(format!("{name} states no licence"));
    }
    let folder = PathBuf::from(text("manifest_path")).parent().map(Path::to_path_buf).unwrap_or_default();
    let source = Some(text("repository")).filter(|url| !url.is_empty());
    let source = source.unwrap_or_else(|| format!("https://crates.io/crates/{name}"));
    let authors = if authors.is_empty() { format!("the authors of {name}") } else { authors };
    Ok(Package { version: text("version"), licence, authors, source, folder, name })
}

fn scripts() -> Outcome<Vec<PathBuf>> {
    let folder = root().join(BUNDLED);
    let entries = fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut all: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|end| end == "js")).collect();
    all.sort();
    Ok(all)
}

/// Packages of npm that the scripts import, directly: those that these need themselves are refused, until there is one.
fn npm() -> Outcome<Vec<Package>> {
    install::packages_of(BUNDLED)?;
    let mut names = BTreeSet::new();
    for script in scripts()? {
        let text = fs::read_to_string(&script).map_err(|error| format!("{}: {error}", script.display()))?;
        names.extend(imported(&text));
    }
    let package = |name: String| {
        let folder = root().join(BUNDLED).join("node_modules").join(&name);
        let path = folder.join("package.json");
        let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let about: Value = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        if about["dependencies"].as_object().is_some_and(|needed| !needed.is_empty()) {
            return Err(format!("{name} needs other packages of npm: {NAME} does not list them yet"));
        }
        let field = |key: &str| about[key].as_str().unwrap_or_default().to_owned();
        Ok(Package {
            version: field("version"),
            licence: field("license"),
            authors: format!("the authors of {name}"),
            source: format!("https://www.npmjs.com/package/{name}"),
            folder,
            name,
        })
    };
    names.into_iter().map(package).collect()
}

/// Names of the packages that a script imports.
fn imported(script: &str) -> BTreeSet<String> {
    let parts = script.split(" from '").skip(1).filter_map(|rest| rest.split_once('\'')).map(|(path, _)| path);
    let outside = parts.filter(|path| !path.starts_with('.'));
    outside
        .map(|path| path.split('/').take(if path.starts_with('@') { 2 } else { 1 }).collect::<Vec<_>>().join("/"))
        .collect()
}

/// The licence files of a package, or the standard texts of its licences where it brings none.
fn texts(package: &Package) -> Outcome<Vec<String>> {
    let mut own = Vec::new();
    if !package.folder.as_os_str().is_empty() {
        collect(&package.folder, &mut own)?;
    }
    if !own.is_empty() {
        own.sort();
        return Ok(own);
    }
    let expression = package.licence.replace('/', " OR ");
    let parsed = Expression::parse(&expression)
        .map_err(|error| format!("{}: the licence {expression} is not understood ({})", package.name, error.reason))?;
    // Of licences to choose from the first; MIT and the like name who has the copyright.
    let id = parsed.requirements().find_map(|required| required.req.license.id());
    let id = id.ok_or_else(|| format!("{}: the licence {expression} has no text", package.name))?;
    let text = id.text().replace("<year> <copyright holders>", &package.authors);
    Ok(vec![format!("Copyright (c) {}\n\n{text}", package.authors)])
}

/// Texts of the licence files of a folder.
fn collect(folder: &Path, into: &mut Vec<String>) -> Outcome {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        if !["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE"]
            .iter()
            .any(|start| name.starts_with(start))
        {
            continue;
        }
        if path.is_dir() {
            let files = fs::read_dir(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            let files: Vec<PathBuf> =
                files.filter_map(|entry| Some(entry.ok()?.path())).filter(|p| p.is_file()).collect();
            for file in files {
                into.push(read(&file)?);
            }
        } else {
            into.push(read(&path)?);
        }
    }
    Ok(())
}

fn read(path: &Path) -> Outcome<String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_crate_is_listed_with_a_text() {
        let text = text().expect("a file");
        let metadata: Value = serde_json::from_str(&build::metadata_of(&[TARGET]).expect("metadata")).expect("JSON");
        let linked = crates(&metadata).expect("crates");
        assert!(linked.len() > 100, "{}", linked.len());
        let (list, texts) = text.split_once("The texts of the licences follow.").expect("two parts");
        for package in &linked {
            let entry = format!("{} {}", package.name, package.version);
            assert!(list.contains(&format!("{entry}: ")) && texts.contains(&entry), "{entry}");
        }
        for name in ["nalgebra ", "leptos ", "three ", "Rust standard library"] {
            assert!(list.contains(name), "{name}");
        }
        // What only builds is not handed out.
        for name in ["walrus ", "esbuild ", "wasm-bindgen-test "] {
            assert!(!list.contains(&format!("\n{name}")), "{name}");
        }
        let home = std::env::var("HOME").unwrap_or_else(|_| "/home".into());
        assert!(!text.contains(&home));
    }

    #[test]
    fn imported_packages_are_named_once() {
        let script = "import { a } from 'three';\nimport { b } from 'three/addons/b.js';\nimport c from './c.js';\nimport d from '@x/y/z.js';\n";
        assert_eq!(imported(script).into_iter().collect::<Vec<_>>(), ["@x/y", "three"]);
    }
}
