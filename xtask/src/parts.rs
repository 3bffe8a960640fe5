//! The page's module cut into parts: what is needed first, and what comes later (`web/src/view/rooms.rs` says what is what). Functions
//! and constants lie in the part that needs them, or in a chunk of those that do.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Outcome;
use crate::build::write;
use crate::process::{cargo, run};

/// Glue of the parts in dist/.
pub const GLUE: &str = "desk-parts.js";

/// A part's bytes: in the page that is one file they have an address. Asked for by bytes, since not every host knows the type of wasm.
const FETCHED: &str = "const fetched = async (name) => {
  const response = await fetch(self.sightlineFiles?.[name] ?? new URL(name, import.meta.url));
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  return response.arrayBuffer();
};
";

/// Cuts a module whose linker kept its relocations: parts that come later go to dist/, the one that is needed first is given, for
/// wasm-bindgen, whose glue for it will be called `main`.
pub fn cut(module: &Path, dist: &Path, main: &str) -> Outcome<PathBuf> {
    let first = module.with_extension("first.wasm");
    let (link_name, main_module) = (format!("./{GLUE}"), format!("./{main}.js"));
    let mut cutter = cargo(&["run", "--quiet", "--package", "xtask-cutter", "--"]);
    run(cutter.args([module, &first, dist]).args([link_name, main_module]))?;
    let glue = dist.join(GLUE);
    let text = fs::read_to_string(&glue).map_err(|error| format!("{GLUE}: {error}"))?;
    let (needed, empty): (Vec<_>, Vec<_>) = later(dist)?.into_iter().partition(|name| text.contains(name));
    for name in empty {
        fs::remove_file(dist.join(&name)).map_err(|error| format!("{name}: {error}"))?;
    }
    for name in &needed {
        rewrite(&dist.join(name))?;
    }
    write(&glue, own_fetch(&text, &needed)?.as_bytes())?;
    Ok(first)
}

/// Writes a part anew without names, and with numbers no longer than they are: the linker leaves room in what it may have to relocate.
fn rewrite(part: &Path) -> Outcome {
    let fault = |error| format!("{}: {error:#}", part.display());
    let mut config = walrus::ModuleConfig::new();
    config.generate_name_section(false).generate_producers_section(false);
    config.parse_file(part).map_err(fault)?.emit_wasm_file(part).map_err(fault)
}

/// Names of the parts that come later.
pub fn later(dist: &Path) -> Outcome<Vec<String>> {
    let entries = fs::read_dir(dist).map_err(|error| format!("{}: {error}", dist.display()))?;
    let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<_> = names
        .filter(|name| (name.starts_with("split_") || name.starts_with("chunk_")) && name.ends_with(".wasm"))
        .collect();
    names.sort();
    Ok(names)
}

/// The glue with our own way to a part's bytes.
fn own_fetch(glue: &str, later: &[String]) -> Outcome<String> {
    const STREAMED: &str = "WebAssembly.instantiateStreaming(src, imports)";
    let mut text = glue.to_owned();
    for name in later {
        let usual = format!("fetch(new URL(\"./{name}\", import.meta.url))");
        if !text.contains(&usual) {
            return Err(format!("{GLUE} does not load {name} by {usual}"));
        }
        text = text.replace(&usual, &format!("fetched(\"{name}\")"));
    }
    if text.matches(STREAMED).count() != later.len() {
        return Err(format!("{GLUE} does not start every part by {STREAMED}"));
    }
    Ok(format!("{FETCHED}{}", text.replace(STREAMED, "WebAssembly.instantiate(await src, imports)")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_fetched_by_their_bytes() {
        let glue = "const src = fetch(new URL(\"./split_a.wasm\", import.meta.url));\n\
                    return async (imports) => (WebAssembly.instantiateStreaming(src, imports));\n";
        let later = ["split_a.wasm".to_owned()];
        let text = own_fetch(glue, &later).expect("glue");
        assert!(text.starts_with(FETCHED) && text.contains("const src = fetched(\"split_a.wasm\");"), "{text}");
        assert!(text.contains("(WebAssembly.instantiate(await src, imports))"), "{text}");
        assert!(own_fetch("", &later).is_err() && own_fetch(glue, &[]).is_err());
    }
}
