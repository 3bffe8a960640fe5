//! The page as one file that opens from a disk or a USB stick: everything of dist/ inside one HTML, nothing fetched.

use std::fs;
use std::io::Write;
use std::path::Path;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use sha2::{Digest, Sha256};

use crate::build::write;
use crate::page::{self, CODECS, MODULE, VIEW3D, WORKER};
use crate::parts::{self, Parts};
use crate::{Outcome, notices};

/// Name of the file in dist/.
pub const NAME: &str = "sightline.html";

/// Bytes of a text that [`packed`] made.
const UNPACKED: &str = "
const unpacked = async (text) => {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Uint8Array(await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
};
";

/// Gives the parts, which are in scripts that are data, addresses, and starts the page.
const OPENING: &str = "
if (!self.DecompressionStream) {
  document.body.append('This browser is too old for Sightline: use Chrome, Edge, Firefox or Safari of 2023 or later.');
  throw new Error('DecompressionStream is missing');
}
const bytes = (id) => unpacked(document.getElementById(id).textContent);
const address = async (id, type) => URL.createObjectURL(new Blob([await bytes(id)], { type }));
self.sightlineTold = [];
self.sightlineFiles = {};
const named = [['worker.js', 'worker', 'text/javascript'], ['storage.js', 'storage', 'text/javascript'], ['sightline-worker_bg.wasm', 'engine', 'application/wasm']];
// Parts of the page's module, by the names that its glue has for them.
for (const part of document.querySelectorAll('script[data-part]')) named.push([part.id, part.id, 'application/wasm']);
await Promise.all(named.map(async ([name, id, type]) => (sightlineFiles[name] = await address(id, type))));
// A page from a disk has no file beside it: the licences are inside, and are saved.
addEventListener('click', async (event) => {
  const link = event.target.closest?.('a[href=\"THIRD-PARTY.txt\"]');
  if (!link) return;
  event.preventDefault();
  link.href = await address('licences', 'text/plain;charset=utf-8');
  link.download = 'THIRD-PARTY.txt';
  link.click();
});
const parts = { 'view3d.js': 'view3d' };
const loading = {};
// The same address every time: one at another address would be loaded again.
self.sightlineLoad = async (name) => import(await (loading[name] ??= address(parts[name], 'text/javascript')));
";

/// Writes the file out of an assembled dist/.
pub fn write_to(dist: &Path) -> Outcome {
    let build = &page::build_folder(dist)?;
    let text = |name: &str| fs::read_to_string(build.join(name)).map_err(|error| format!("{name}: {error}"));
    let coded = |name: &str| {
        let bytes = fs::read(build.join(name)).map_err(|error| format!("{name}: {error}"))?;
        packed(&bytes)
    };
    // While the page is worked on, its modules are whole.
    let glue_of = |module: &Parts| {
        let glue = text(&format!("{}.js", module.module))?;
        if build.join(module.glue).exists() { with_parts(module, &glue, &text(module.glue)?) } else { inlined(&glue) }
    };
    let page = fs::read_to_string(dist.join("index.html")).map_err(|error| format!("index.html: {error}"))?;
    let worker = {
        let start = bundled(build, "worker.js", &mut Vec::new())?;
        let import = format!("(await import(\"./{WORKER}.js\")).default");
        if !start.contains(&import) {
            return Err(format!("worker.js does not start by {import}"));
        }
        let codecs = format!("await import(\"./{CODECS}.js\")");
        if !start.contains(&codecs) {
            return Err(format!("worker.js does not load the decoders by {codecs}"));
        }
        // In a function of their own, as both glues have the same names; their module beside them, as a worker of a page from a disk
        // may fetch nothing of it.
        let (decoders, module) = (inlined(&text(&format!("{CODECS}.js"))?)?, coded(&format!("{CODECS}_bg.wasm"))?);
        let decoders = format!(
            "const decoders = () => {{\n{decoders}\n\
             const module = () => unpacked('{module}');\n\
             return {{ default: () => __wbg_init({{ module_or_path: module() }}), unpack, trapped }};\n}};"
        );
        let start = start.replace(&import, "__wbg_init").replace(&codecs, "decoders()");
        let own = |name: String| Ok(format!("'{name}': () => unpacked('{}'),\n", coded(&name)?));
        let own = parts::WORKER.later(build)?.into_iter().map(own).collect::<Outcome<Vec<String>>>()?.concat();
        format!("{UNPACKED}self.sightlineBytes = {{\n{own}}};\n{decoders}\n{}\n{start}", glue_of(&parts::WORKER)?)
    };
    let style = styles(&page)?.into_iter().map(|name| text(name.rsplit('/').next().unwrap_or_default()));
    let style = style.collect::<Outcome<Vec<_>>>()?.concat();
    let desk = glue_of(&parts::PAGE)?;
    let script = format!("{UNPACKED}{OPENING}{desk}\nawait __wbg_init({{ module_or_path: await bytes('desk') }});\n");
    if script.contains("</script") || style.contains("</style") {
        return Err("a part of the page ends the element that it would be in".into());
    }
    let policy = format!(
        "default-src 'none'; script-src '{}' 'wasm-unsafe-eval' blob:; style-src '{}'; worker-src blob:; connect-src blob:; \
         img-src blob: data:; base-uri 'none'; form-action 'none'",
        digest(&script),
        digest(&style)
    );
    let data = |id: &str, content: String| format!("<script type=\"text/plain\" id=\"{id}\">{content}</script>\n");
    let part = |name: String| {
        let bytes = coded(&name)?;
        Ok(format!("<script type=\"text/plain\" data-part id=\"{name}\">{bytes}</script>\n"))
    };
    let later = parts::PAGE.later(build)?.into_iter().map(part).collect::<Outcome<Vec<String>>>()?.concat();
    let html = [
        "<!doctype html>\n<html lang=\"en\" data-theme=\"light\">\n<head>\n<meta charset=\"utf-8\">\n".into(),
        format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n"),
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Sightline</title>\n".into(),
        format!(
            "<link rel=\"icon\" href=\"data:image/svg+xml;base64,{}\">\n",
            BASE64_STANDARD.encode(text("../icon.svg")?)
        ),
        format!("<style>{style}</style>\n</head>\n<body>\n"),
        "<noscript>Sightline needs JavaScript and WebAssembly.</noscript>\n".into(),
        data("worker", packed(worker.as_bytes())?),
        data("storage", packed(bundled(build, "storage.js", &mut Vec::new())?.as_bytes())?),
        data("view3d", coded(VIEW3D)?),
        data("engine", coded(&format!("{WORKER}_bg.wasm"))?),
        data("desk", coded(&format!("{MODULE}_bg.wasm"))?),
        later,
        data("licences", coded(&format!("../{}", notices::NAME))?),
        format!("<script type=\"module\">{script}</script>\n</body>\n</html>\n"),
    ]
    .concat();
    write(&dist.join(NAME), html.as_bytes())?;
    println!("dist/{NAME} is ready ({} kB)", html.len() / 1024);
    Ok(())
}

/// Bytes compressed, as a text.
fn packed(bytes: &[u8]) -> Outcome<String> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    let packed = encoder.write_all(bytes).and_then(|()| encoder.finish());
    Ok(BASE64_STANDARD.encode(packed.map_err(|error| error.to_string())?))
}

fn digest(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text.as_bytes())))
}

/// Names of the page's style sheets, in their order.
fn styles(page: &str) -> Outcome<Vec<String>> {
    let names: Vec<String> = page
        .split("<link rel=\"stylesheet\" href=\"")
        .skip(1)
        .filter_map(|rest| rest.split_once('"').map(|(name, _)| name.to_owned()))
        .collect();
    if names.is_empty() { Err("index.html names no style sheet".into()) } else { Ok(names) }
}

/// The glue of a module's first part with that of the others, which refer to each other.
fn with_parts(module: &Parts, glue: &str, parts: &str) -> Outcome<String> {
    let from = format!(" from \"./{}\"", module.glue);
    let names =
        |line: &str| Some(line.strip_prefix("import * as ")?.trim_end_matches(';').strip_suffix(&from)?.to_owned());
    let names: Vec<String> = glue.lines().filter_map(names).collect();
    if names.is_empty() {
        return Err(format!("the glue of {} does not import that of its parts{from}", module.module));
    }
    let own = |line: &&str| !line.starts_with("import ") || !line.trim_end_matches(';').ends_with(&from);
    let desk = inlined(&glue.lines().filter(own).map(|line| format!("{line}\n")).collect::<String>())?;
    // It is part of the same script as what it imports.
    let import = format!("import {{ initSync }} from \"./{}.js\";", module.module);
    if !parts.contains(&import) {
        return Err(format!("the glue of the parts does not import what starts the module by {import}"));
    }
    let exported = parts.lines().filter_map(|line| line.strip_prefix("export const ")?.split_once(" = "));
    let exported = exported.map(|(name, _)| name).collect::<Vec<_>>().join(", ");
    let parts = inlined(&parts.replace(&import, ""))?;
    let named: String = names.iter().map(|name| format!("const {name} = sightlineParts;\n")).collect();
    Ok(format!("const sightlineParts = (() => {{\n{parts}\nreturn {{ {exported} }};\n}})();\n{named}{desk}"))
}

/// A script of ours with what it imports before it, each file once.
fn bundled(dist: &Path, name: &str, seen: &mut Vec<String>) -> Outcome<String> {
    let script = fs::read_to_string(dist.join(name)).map_err(|error| format!("{name}: {error}"))?;
    let folder = name.rsplit_once('/').map(|(folder, _)| format!("{folder}/")).unwrap_or_default();
    let (mut before, mut own) = (String::new(), String::new());
    for line in script.lines() {
        let imported = line.strip_prefix("import {").and_then(|rest| rest.split_once(" from ")).map(|(_, file)| file);
        match imported {
            Some(file) => {
                let file = file.trim_end_matches(';').trim_matches(['"', '\'']);
                let file = format!("{folder}{}", file.strip_prefix("./").ok_or_else(|| format!("{name}: {line}"))?);
                if !seen.contains(&file) {
                    before += &bundled(dist, &file, seen)?;
                    seen.push(file);
                }
            }
            None => own += &format!("{}\n", line.strip_prefix("export ").unwrap_or(line)),
        }
    }
    Ok(before + &own)
}

/// The glue of a module as plain statements: what it exports stays under its own name.
fn inlined(glue: &str) -> Outcome<String> {
    if glue.lines().any(|line| line.starts_with("import ")) {
        return Err("the glue of a module imports other files".into());
    }
    let lines = glue.lines().filter(|line| !line.starts_with("export {"));
    let plain = lines.map(|line| line.strip_prefix("export ").unwrap_or(line)).collect::<Vec<_>>().join("\n");
    // Only available in modules; used if the caller does not give the location of the wasm.
    Ok(plain.replace("import.meta.url", "location.href"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glue_becomes_plain_statements() {
        let glue =
            "export function work() {}\nconst a = import.meta.url;\nexport { initSync, __wbg_init as default };\n";
        assert_eq!(inlined(glue).as_deref(), Ok("function work() {}\nconst a = location.href;"));
        assert!(inlined("import x from './x.js';").is_err());
    }

    #[test]
    fn what_a_script_imports_stands_before_it_once() {
        let folder = std::env::temp_dir().join(format!("sightline-bundled-{}", std::process::id()));
        fs::create_dir_all(folder.join("deep")).expect("a folder");
        for (name, content) in [
            ("a.js", "import { b } from './deep/b.js';\nimport { c } from './deep/c.js';\nwork(b, c);\n"),
            ("deep/b.js", "import { c } from './c.js';\nexport const b = c;\n"),
            ("deep/c.js", "export const c = 1;\n"),
        ] {
            write(&folder.join(name), content.as_bytes()).expect("a file");
        }
        let all = bundled(&folder, "a.js", &mut Vec::new());
        fs::remove_dir_all(&folder).expect("removed");
        assert_eq!(all.as_deref(), Ok("const c = 1;\nconst b = c;\nwork(b, c);\n"));
    }

    #[test]
    fn glue_of_parts_is_there_before_that_of_the_module() {
        let glue = "import * as import1 from \"./desk-parts.js\"\nexport function initSync() {}\n";
        let parts = "import { initSync } from \"./desk.js\";\nexport const a = initSync();\nconst b = 1;\nexport const c = b;\n";
        let all = with_parts(&parts::PAGE, glue, parts).expect("glue");
        assert!(!all.contains("import ") && !all.contains("export "), "{all}");
        assert!(all.contains("return { a, c };") && all.contains("const import1 = sightlineParts;"), "{all}");
        assert!(with_parts(&parts::PAGE, "", parts).is_err() && with_parts(&parts::PAGE, glue, "").is_err());
    }

    #[test]
    fn style_sheets_are_found_in_their_order() {
        let page = "<link rel=\"stylesheet\" href=\"a.css\">\n<link rel=\"stylesheet\" href=\"b.css\">";
        assert_eq!(styles(page).expect("names"), ["a.css", "b.css"]);
        assert!(styles("<p>").is_err());
    }
}
