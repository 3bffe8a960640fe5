//! What is handed out, in one folder: the site, the page as one file, the engine as an ES module, licences, digests of everything.

use std::collections::BTreeMap;
use std::fs;

use crate::build::{self, Products, Profile, write};
use crate::page::copy_folder;
use crate::process::root;
use crate::{Outcome, notices, offline, single};

/// The list of digests, as `sha256sum --check` reads it.
const SUMS: &str = "SHA256SUMS";
/// Maximum number of bytes of the page as one file.
const SINGLE_MB: usize = 8;

/// Builds everything and leaves it in `release/sightline-VERSION`.
pub fn command() -> Outcome {
    let products = Products::of(Profile::Release)?;
    products.build_all()?;
    single::write_to(&products.dist)?;
    let version = version()?;
    let folder = root().join("release").join(format!("sightline-{version}"));
    build::empty(&folder)?;
    let site = folder.join("site");
    copy_folder(&products.dist, &site)?;
    let file = folder.join(single::NAME);
    fs::rename(site.join(single::NAME), &file).map_err(|error| format!("{}: {error}", file.display()))?;
    copy_folder(&products.pkg, &folder.join("pkg"))?;
    notices::write_to(&folder)?;
    for name in ["LICENSE-MIT", "LICENSE-APACHE", "README.md", "CHANGELOG.md"] {
        let from = root().join(name);
        fs::copy(&from, folder.join(name)).map_err(|error| format!("{}: {error}", from.display()))?;
    }
    let mut files = BTreeMap::new();
    offline::list(&folder, "", &mut files)?;
    let named = builders_paths(&files)?;
    if !named.is_empty() {
        return Err(format!("paths of this machine are in what would be handed out: {}", named.join(", ")));
    }
    write(&folder.join(SUMS), sums(&files).as_bytes())?;
    let size = files.get(single::NAME).map_or(0, Vec::len);
    if size > SINGLE_MB << 20 {
        println!("{} has {:.1} MB, more than {SINGLE_MB}", single::NAME, size as f64 / f64::from(1 << 20));
    }
    println!("release/sightline-{version} is ready ({} files)", files.len() + 1);
    Ok(())
}

fn version() -> Outcome<String> {
    let metadata = build::metadata()?;
    let engine = metadata["packages"].as_array().into_iter().flatten().find(|package| package["name"] == "sightline");
    let version = engine.and_then(|package| package["version"].as_str());
    Ok(version.ok_or("cargo metadata does not list sightline")?.to_owned())
}

/// Lines of digests, by name.
fn sums(files: &BTreeMap<String, Vec<u8>>) -> String {
    files.iter().map(|(name, bytes)| format!("{}  {name}\n", offline::hex(bytes))).collect()
}

/// Files that name a folder of the machine that built them: where the repository lies, cargo's own folder, or that of the standard library.
fn builders_paths(files: &BTreeMap<String, Vec<u8>>) -> Outcome<Vec<String>> {
    let folders: Vec<String> = build::folders()?.iter().map(|(path, _)| path.display().to_string()).collect();
    let names = |bytes: &[u8]| folders.iter().any(|folder| contains(bytes, folder.as_bytes()));
    Ok(files.iter().filter(|(_, bytes)| names(bytes)).map(|(name, _)| name.clone()).collect())
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    // A root of one or two characters would be found anywhere.
    part.len() > 4 && bytes.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Whether the digests in a folder are those of its files.
    fn holds(folder: &Path) -> Outcome<bool> {
        let text = fs::read_to_string(folder.join(SUMS)).map_err(|error| error.to_string())?;
        let mut files = BTreeMap::new();
        offline::list(folder, "", &mut files)?;
        files.remove(SUMS);
        Ok(text == sums(&files))
    }

    #[test]
    fn digests_are_those_of_the_files() {
        let folder = std::env::temp_dir().join(format!("sightline-release-{}", std::process::id()));
        fs::create_dir_all(folder.join("deep")).expect("a folder");
        write(&folder.join("deep/a"), b"1").expect("a file");
        write(&folder.join("b"), b"2").expect("a file");
        let mut files = BTreeMap::new();
        offline::list(&folder, "", &mut files).expect("a list");
        write(&folder.join(SUMS), sums(&files).as_bytes()).expect("a file");
        let before = holds(&folder);
        write(&folder.join("b"), b"3").expect("a file");
        let after = holds(&folder);
        fs::remove_dir_all(&folder).expect("removed");
        assert_eq!((before, after), (Ok(true), Ok(false)));
    }

    #[test]
    fn a_path_of_this_machine_is_found() {
        let own = format!("x{}/src/a.rs", root().display());
        let library = build::folders()
            .expect("rustc")
            .iter()
            .map(|(path, _)| format!("{}/library/core", path.display()))
            .next_back();
        let files = BTreeMap::from([
            ("a".to_owned(), own.into_bytes()),
            ("b".to_owned(), b"/rustc/abc/library".to_vec()),
            ("c".to_owned(), library.expect("three folders").into_bytes()),
        ]);
        assert_eq!(builders_paths(&files), Ok(vec!["a".to_owned(), "c".to_owned()]));
    }
}
