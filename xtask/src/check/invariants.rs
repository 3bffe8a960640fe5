//! The invariants of CONTRIBUTING.md that text alone can show, its code map, and that no large file is kept.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::process::root;

use super::{names, order};

/// Lines from which a file should be split; said, not enforced.
const LONG: usize = 450;

/// Maximum size of a source file in bytes: pictures of the documents have to be smaller, and data and packages do not belong here.
const LARGE: u64 = 300_000;

/// The engine and the crates above it.
const ENGINE: &[&str] = &["src/", "exchange/", "plan/", "report/", "lab/"];

/// Words that a folder must not contain.
struct Ban {
    /// Where; everywhere if empty.
    folders: &'static [&'static str],
    /// Paths below which the words are at home.
    except: &'static [&'static str],
    words: &'static [&'static str],
    why: &'static str,
}

const BANS: [Ban; 6] = [
    Ban {
        folders: ENGINE,
        except: &[],
        words: &["web_sys", "js_sys", "wasm_bindgen::", "serde_wasm_bindgen"],
        why: "the engine knows no JavaScript: that is face/",
    },
    Ban {
        folders: ENGINE,
        except: &[],
        words: &["leptos", "sightline_desk"],
        why: "the engine does not know the desk",
    },
    Ban {
        folders: &["web/"],
        except: &["web/src/browser/", "web/worker/src/scope.rs"],
        words: &["web_sys", "js_sys"],
        why: "the desk touches the browser in web/src/browser and web/worker/src/scope.rs only",
    },
    Ban {
        folders: &["web/src/"],
        except: &[],
        words: &[
            "sightline::detect::",
            "sightline::decode",
            "sightline::orient::orient",
            "sightline::adjust::adjust",
            "sightline_exchange::package",
        ],
        why: "the page computes nothing and reads no files of its own: that is web/worker",
    },
    Ban {
        folders: ENGINE,
        except: &[],
        words: &["println!", "eprintln!", "dbg!"],
        why: "the engine reports in results, not on a terminal",
    },
    Ban {
        folders: &[],
        except: &["xtask/src/check/invariants.rs"],
        words: &["TODO", "FIXME", "XXX", "todo!(", "unimplemented!("],
        why: "nothing is left for later",
    },
];

/// Faults; long files are only mentioned.
pub fn faults() -> Outcome<Vec<String>> {
    let root = root();
    let mut faults = Vec::new();
    let sources = sources(&root)?;
    faults.extend(order::faults(&sources)?);
    faults.extend(names::faults(&sources)?);
    for path in sources {
        let text = fs::read_to_string(root.join(&path)).map_err(|error| format!("{path}: {error}"))?;
        faults.extend(BANS.iter().flat_map(|ban| ban.broken_in(&path, &text)));
        let lines = text.lines().count();
        if lines > LONG {
            println!("note: {path} has {lines} lines; one algorithm a file is about 250");
        }
    }
    faults.extend(large(&root)?);
    let map = fs::read_to_string(root.join("CONTRIBUTING.md")).map_err(|error| format!("CONTRIBUTING.md: {error}"))?;
    let map = map.split("## Code map").nth(1).ok_or("CONTRIBUTING.md has no code map")?;
    let map = map.split("\n## ").next().unwrap_or(map);
    for name in paths(map) {
        if !root.join(name).exists() {
            faults.push(format!("CONTRIBUTING.md: the code map names {name}, which does not exist"));
        }
    }
    for entry in fs::read_dir(root.join("src")).map_err(|error| format!("src: {error}"))? {
        let path = entry.map_err(|error| format!("src: {error}"))?.path();
        let name = format!("src/{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_file() && !paths(map).any(|known| known == name) {
            faults.push(format!("CONTRIBUTING.md: the code map does not name {name}"));
        }
    }
    Ok(faults)
}

impl Ban {
    fn broken_in(&self, path: &str, text: &str) -> Vec<String> {
        let here = self.folders.is_empty() || self.folders.iter().any(|folder| path.starts_with(folder));
        if !here || self.except.iter().any(|home| path.starts_with(home)) {
            return Vec::new();
        }
        let code = |line: &str| !line.trim_start().starts_with("//");
        let lines = text.lines().enumerate().filter(|(_, line)| code(line) || self.folders.is_empty());
        let broken = lines.filter_map(|(number, line)| {
            let word = self.words.iter().find(|word| line.contains(**word))?;
            // The tests of a module run in Node too.
            (!line.contains("wasm_bindgen_test")).then(|| format!("{path}:{}: {word}: {}", number + 1, self.why))
        });
        broken.collect()
    }
}

/// Files that Git keeps, or would with the next `git add`, and that are too large.
fn large(root: &Path) -> Outcome<Vec<String>> {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root)
        .output()
        .map_err(|error| format!("git ls-files: {error}"))?;
    if !listed.status.success() {
        return Err(format!("git ls-files: {}", String::from_utf8_lossy(&listed.stderr)));
    }
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    let size = |name: &str| fs::metadata(root.join(name)).map_or(0, |about| about.len());
    let large = names.split('\0').filter(|name| !name.is_empty() && size(name) > LARGE);
    Ok(large
        .map(|name| format!("{name}: {} kB; files above {} kB are not kept", size(name) / 1000, LARGE / 1000))
        .collect())
}

/// Repository paths in backquotes.
fn paths(text: &str) -> impl Iterator<Item = &str> {
    text.split('`')
        .skip(1)
        .step_by(2)
        .filter(|word| word.contains(['/', '.']) && !word.contains([' ', '{', ':', '(', '<']))
}

/// Rust and JavaScript sources that are ours, relative to the root.
fn sources(root: &Path) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    let mut folders: Vec<PathBuf> = [
        "src", "codecs", "exchange", "face", "lab", "plan", "report", "web", "xtask", "tests", "benches", "examples",
        "e2e",
    ]
    .map(|name| root.join(name))
    .into();
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for entry in entries {
            let path = entry.map_err(|error| format!("{}: {error}", folder.display()))?.path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if path.is_dir() {
                if !matches!(name, "node_modules" | "vendor" | "out" | "target") {
                    folders.push(path);
                }
            } else if [".rs", ".js", ".mjs", ".ts"].iter().any(|end| name.ends_with(end)) {
                found.extend(path.strip_prefix(root).ok().and_then(Path::to_str).map(str::to_owned));
            }
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bans_see_code_and_spare_homes_and_comments() {
        let engine = &BANS[0];
        assert_eq!(engine.broken_in("src/detect.rs", "// web_sys\nuse web_sys::Window;\n").len(), 1);
        assert!(engine.broken_in("src/a.rs", "use wasm_bindgen_test::wasm_bindgen_test as test;").is_empty());
        assert!(engine.broken_in("web/src/browser/file.rs", "use js_sys::Array;").is_empty());
        let later = &BANS[5];
        assert_eq!(later.broken_in("e2e/a.test.mjs", "// TODO more").len(), 1);
    }

    #[test]
    fn paths_are_found_in_backquotes() {
        let text = "| `src/detect.rs` | one of `a b` and `src/detect/` | `lib` |";
        assert_eq!(paths(text).collect::<Vec<_>>(), ["src/detect.rs", "src/detect/"]);
    }
}
