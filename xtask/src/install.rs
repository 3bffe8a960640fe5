//! What the commands need beyond cargo: installed where that is safe, else one line that says what to install.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::Outcome;
use crate::process::{exists, output, program, root, run};

/// The target of the page and of pkg/.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// The wasm target's standard library.
pub fn target() -> Outcome {
    let libraries = output(Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]))?;
    if PathBuf::from(libraries.trim()).is_dir() {
        return Ok(());
    }
    if !exists("rustup") {
        return Err(format!(
            "install the standard library of the Rust target {TARGET} (with rustup: rustup target add {TARGET})"
        ));
    }
    run(program("rustup", &["target", "add", TARGET]).stdout(std::io::stderr()))
}

/// Node and npm.
pub fn node() -> Outcome {
    for name in ["node", "npm"] {
        if !exists(name) {
            return Err(format!("install Node.js 20.16 or later ({name} is not on the path): https://nodejs.org"));
        }
    }
    Ok(())
}

/// The npm packages of the tests, as the lock file has them.
pub fn packages() -> Outcome {
    packages_of("e2e")
}

/// The npm packages of a folder, as its lock file has them.
pub fn packages_of(name: &str) -> Outcome {
    node()?;
    let folder = root().join(name);
    let lock = fs::read_to_string(folder.join("package-lock.json"))
        .map_err(|error| format!("{name}/package-lock.json: {error}"))?;
    let stamp = folder.join("node_modules/.installed-from");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == lock) {
        return Ok(());
    }
    run(program("npm", &["ci", "--no-audit", "--no-fund", "--loglevel=error"])
        .current_dir(&folder)
        .stdout(std::io::stderr()))?;
    fs::write(&stamp, lock).map_err(|error| format!("{}: {error}", stamp.display()))
}

/// The browser of the page's tests: the variable CHROMIUM, or one that is installed, or Debian's.
pub fn chromium() -> Outcome<String> {
    if let Ok(path) = std::env::var("CHROMIUM") {
        return if exists(&path) { Ok(path) } else { Err(format!("CHROMIUM names {path}, which does not start")) };
    }
    const NAMES: [&str; 5] = [
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    ];
    let installed = || NAMES.iter().find(|name| exists(name)).map(|name| (*name).to_owned());
    if let Some(name) = installed() {
        return Ok(name);
    }
    let advice = "install Chromium (Debian: apt-get install chromium) or set CHROMIUM to a browser of its family";
    if !exists("apt-get") {
        return Err(advice.into());
    }
    // The package list of a fresh machine is empty or old; installing may work without a new one, so its failure decides nothing.
    let _ = apt(&["update", "-qq"]);
    apt(&["install", "-y", "-qq", "--no-install-recommends", "chromium"])
        .map_err(|error| format!("{advice} ({error})"))?;
    installed().ok_or_else(|| advice.into())
}

/// Programs that read printed pages (pdftotext, pdftoppm), if Debian's can be installed; the tests of sheets and of the printed report
/// are skipped by name without it.
pub fn poppler() {
    if !exists("pdftotext") && exists("apt-get") {
        let _ = apt(&["update", "-qq"]);
        let _ = apt(&["install", "-y", "-qq", "--no-install-recommends", "poppler-utils"]);
    }
}

/// A font that has Korean, where Debian's can be installed: a page is printed with empty boxes without one, and widths are not the true ones.
pub fn korean_font() {
    let missing = output(Command::new("fc-list").arg(":lang=ko")).is_ok_and(|fonts| fonts.trim().is_empty());
    if missing && exists("apt-get") {
        let _ = apt(&["update", "-qq"]);
        let _ = apt(&["install", "-y", "-qq", "--no-install-recommends", "fonts-nanum"]);
    }
}

fn apt(arguments: &[&str]) -> Outcome {
    let administrator = output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
    let mut command = if administrator { program("apt-get", &[]) } else { program("sudo", &["-n", "apt-get"]) };
    run(command.args(arguments).env("DEBIAN_FRONTEND", "noninteractive").stdout(std::io::stderr()))
}
