//! Modules cut into parts: what is needed first, and what comes later. Of the page's `web/src/view/rooms.rs` says what is what, of the
//! workers' `web/protocol/src/lib.rs`. Functions and constants lie in the part that needs them, or in a chunk of those that do.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::{empty, write};
use crate::process::{cargo, run};
use crate::{Outcome, page};

/// A module that comes in parts.
pub struct Parts {
    /// Name of the module in dist/, and of the glue that wasm-bindgen will make for its first part.
    pub module: &'static str,
    /// Glue of the parts that come later, in dist/.
    pub glue: &'static str,
    /// Prefix of their names.
    prefix: &'static str,
}

/// Those of the page.
pub const PAGE: Parts = Parts { module: page::MODULE, glue: "desk-parts.js", prefix: "desk_" };
/// Those of its workers.
pub const WORKER: Parts = Parts { module: page::WORKER, glue: "worker-parts.js", prefix: "worker_" };

/// A part's bytes: in the page that is one file they have an address, and its workers, which may fetch nothing, have them. Asked for by
/// bytes, since not every host knows the type of wasm.
const FETCHED: &str = "const fetched = async (name) => {
  const own = self.sightlineBytes?.[name];
  if (own) return own();
  const response = await fetch(self.sightlineFiles?.[name] ?? new URL(name, import.meta.url));
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  return response.arrayBuffer();
};
";

impl Parts {
    /// Cuts a module whose linker kept its relocations: parts that come later go to dist/, the one that is needed first is given, for
    /// wasm-bindgen.
    pub fn cut(&self, module: &Path, dist: &Path) -> Outcome<PathBuf> {
        let first = module.with_extension("first.wasm");
        let folder = module.with_extension("parts");
        empty(&folder)?;
        let (link_name, main_module) = (format!("./{}", self.glue), format!("./{}.js", self.module));
        let mut cutter = cargo(&["run", "--quiet", "--package", "xtask-cutter", "--"]);
        run(cutter.args([module, &first, &folder]).args([link_name, main_module]))?;
        let glue = folder.join(self.glue);
        let text = fs::read_to_string(&glue).map_err(|error| format!("{}: {error}", self.glue))?;
        // one that is empty is named nowhere
        let needed: Vec<_> = modules(&folder)?.into_iter().filter(|name| text.contains(name.as_str())).collect();
        for name in &needed {
            rewrite(&folder.join(name), &dist.join(format!("{}{name}", self.prefix)))?;
        }
        write(&dist.join(self.glue), self.own_fetch(&text, &needed)?.as_bytes())?;
        Ok(first)
    }

    /// Names of the parts in dist/ that come later.
    pub fn later(&self, dist: &Path) -> Outcome<Vec<String>> {
        Ok(modules(dist)?
            .into_iter()
            .filter(|name| name.starts_with(self.prefix) && !name.ends_with("_bg.wasm"))
            .collect())
    }

    /// The glue with our own way to a part's bytes.
    fn own_fetch(&self, glue: &str, later: &[String]) -> Outcome<String> {
        const STREAMED: &str = "WebAssembly.instantiateStreaming(src, imports)";
        let mut text = glue.to_owned();
        for name in later {
            let usual = format!("fetch(new URL(\"./{name}\", import.meta.url))");
            if !text.contains(&usual) {
                return Err(format!("{} does not load {name} by {usual}", self.glue));
            }
            text = text.replace(&usual, &format!("fetched(\"{}{name}\")", self.prefix));
        }
        if text.matches(STREAMED).count() != later.len() {
            return Err(format!("{} does not start every part by {STREAMED}", self.glue));
        }
        Ok(format!("{FETCHED}{}", text.replace(STREAMED, "WebAssembly.instantiate(await src, imports)")))
    }
}

/// Modules in a folder.
fn modules(folder: &Path) -> Outcome<Vec<String>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<_> = names.filter(|name| name.ends_with(".wasm")).collect();
    names.sort();
    Ok(names)
}

/// Writes a part anew without names, and with numbers no longer than they are: the linker leaves room in what it may have to relocate.
fn rewrite(part: &Path, to: &Path) -> Outcome {
    let fault = |error| format!("{}: {error:#}", part.display());
    let mut config = walrus::ModuleConfig::new();
    config.generate_name_section(false).generate_producers_section(false);
    config.parse_file(part).map_err(fault)?.emit_wasm_file(to).map_err(fault)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_fetched_by_their_bytes() {
        let glue = "const src = fetch(new URL(\"./split_a.wasm\", import.meta.url));\n\
                    return async (imports) => (WebAssembly.instantiateStreaming(src, imports));\n";
        let later = ["split_a.wasm".to_owned()];
        let text = WORKER.own_fetch(glue, &later).expect("glue");
        assert!(text.starts_with(FETCHED) && text.contains("const src = fetched(\"worker_split_a.wasm\");"), "{text}");
        assert!(text.contains("(WebAssembly.instantiate(await src, imports))"), "{text}");
        assert!(WORKER.own_fetch("", &later).is_err() && WORKER.own_fetch(glue, &[]).is_err());
    }
}
