//! pkg/ (the engine with its JavaScript face) and dist/ (the page): cargo in the release profile, then wasm-bindgen.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::install::{self, TARGET};
use crate::process::{cargo, output, root, run};
use crate::{Outcome, page};

/// Leaves the engine as an ES module in pkg/.
pub fn pkg() -> Outcome {
    install::target()?;
    // The module is asked for here and not in Cargo.toml, where every test and the desk would link it too.
    run(&mut cargo(&[
        "rustc",
        "--release",
        "--target",
        TARGET,
        "--package",
        "sightline",
        "--lib",
        "--crate-type",
        "cdylib",
        "--features",
        "javascript",
    ]))?;
    let folder = root().join("pkg");
    empty(&folder)?;
    bindings("sightline.wasm", &folder, "sightline", "web")?;
    let metadata = metadata()?;
    let engine = metadata["packages"].as_array().into_iter().flatten().find(|package| package["name"] == "sightline");
    let engine = engine.ok_or("cargo metadata does not list sightline")?;
    let package = json!({
        "name": "sightline",
        "description": engine["description"],
        "version": engine["version"],
        "license": engine["license"],
        "type": "module",
        "main": "sightline.js",
        "module": "sightline.js",
        "types": "sightline.d.ts",
        "files": ["sightline.js", "sightline.d.ts", "sightline_bg.wasm", "sightline_bg.wasm.d.ts", "snippets"],
        "sideEffects": ["./snippets/*"],
    });
    write(&folder.join("package.json"), format!("{package:#}\n").as_bytes())?;
    report("pkg", &folder.join("sightline_bg.wasm"));
    Ok(())
}

/// Leaves the page in dist/: index.html with Trunk's assets resolved, the desk's module and its glue.
pub fn dist() -> Outcome {
    install::target()?;
    run(&mut cargo(&["build", "--release", "--target", TARGET, "--package", "sightline-desk"]))?;
    let folder = root().join("dist");
    empty(&folder)?;
    bindings("sightline-desk.wasm", &folder, page::MODULE, "web")?;
    page::assemble(&root(), &folder)?;
    report("dist", &folder.join(format!("{}_bg.wasm", page::MODULE)));
    Ok(())
}

/// What cargo knows of the workspace on this machine and as wasm, from the lock file; offline where all is downloaded.
pub fn metadata() -> Outcome<Value> {
    let version = output(Command::new("rustc").arg("-vV"))?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).ok_or("rustc -vV names no host")?;
    let arguments =
        ["metadata", "--format-version", "1", "--locked", "--filter-platform", host, "--filter-platform", TARGET];
    let offline = cargo(&arguments)
        .arg("--offline")
        .stderr(Stdio::null())
        .output()
        .map_err(|error| format!("cargo metadata: {error}"))?;
    let text = if offline.status.success() {
        String::from_utf8(offline.stdout).map_err(|_| "cargo metadata: its output is not UTF-8")?
    } else {
        output(&mut cargo(&arguments))?
    };
    serde_json::from_str(&text).map_err(|error| format!("cargo metadata: {error}"))
}

/// Builds an example of the engine natively, with what the tests are built with, and gives its path.
pub fn example(name: &str) -> Outcome<String> {
    run(&mut cargo(&["build", "--profile", "test", "--package", "sightline", "--example", name]))?;
    Ok(format!("{}/debug/examples/{name}{}", target_directory()?, std::env::consts::EXE_SUFFIX))
}

/// Where cargo builds.
pub fn target_directory() -> Outcome<String> {
    Ok(metadata()?["target_directory"].as_str().ok_or("cargo metadata names no target directory")?.to_owned())
}

fn bindings(wasm: &str, folder: &Path, name: &str, target: &str) -> Outcome {
    let wasm = format!("{}/{TARGET}/release/{wasm}", target_directory()?);
    let folder = folder.to_str().ok_or("the repository's path is not UTF-8")?;
    let mut arguments = vec!["wasm-bindgen", "--target", target, "--out-dir", folder, "--out-name", name];
    arguments.extend(["--remove-name-section", "--remove-producers-section", &wasm]);
    if target == "web" && name == page::MODULE {
        arguments.push("--no-typescript");
    }
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(arguments).map_err(|error| format!("wasm-bindgen: {error:#}"))
}

fn empty(folder: &Path) -> Outcome {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Writes a file, naming it when that fails.
pub fn write(path: &Path, bytes: &[u8]) -> Outcome {
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

fn report(what: &str, wasm: &Path) {
    let size = fs::metadata(wasm).map_or(0, |file| file.len());
    println!("{what}/ is ready ({} of {} kB)", wasm.file_name().unwrap_or_default().to_string_lossy(), size / 1024);
}
