//! The page out of index.html: the assets it names in Trunk's form (`<link data-trunk rel=… href=…>`) are copied and linked.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::build::write;
use crate::{Outcome, notices, offline, parts};

/// Name of the page's own module in dist/.
pub const MODULE: &str = "desk";
/// Name of the workers' module in dist/.
pub const WORKER: &str = "sightline-worker";
/// The 3-D view in dist/.
pub const VIEW3D: &str = "view3d.js";
/// Name of the decoders' module in dist/, which workers fetch when they need it.
pub const CODECS: &str = "sightline-codecs";

/// The page's own HTML in dist/.
const PAGE: &str = "index.html";
/// Placeholder in the page for the folder of its build.
const BUILD: &str = "@build/";
/// What lies beside the page and not in the folder of its build: browsers and systems know it by its name, or it has to come where the rest of
/// the build does not.
const OUTSIDE: [&str; 5] = [PAGE, "service.js", "check.js", "manifest.webmanifest", notices::NAME];

/// Copies what index.html names into `dist` and writes the page there.
pub fn assemble(root: &Path, dist: &Path) -> Outcome {
    let source = read(&root.join(PAGE))?;
    let page = resolve(&source, &mut |asset| place(root, dist, asset))?;
    write(&dist.join(PAGE), page.as_bytes())
}

fn is_outside(name: &str) -> bool {
    OUTSIDE.contains(&name) || name.starts_with("icon")
}

/// Puts the files of a build into a folder that is named by what is in all of them. They refer to each other by names beside their own, so that a
/// page never takes a part of another build for one of its own: that lies elsewhere.
pub fn seal(dist: &Path) -> Outcome {
    let mut files = BTreeMap::new();
    offline::list(dist, "", &mut files)?;
    files.retain(|name, _| !is_outside(name.split('/').next().unwrap_or_default()));
    let mut all = Sha256::new();
    for (name, bytes) in &files {
        all.update(format!("{name} {}\n", offline::hex(bytes)));
    }
    let digest = all.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect::<String>();
    let folder = dist.join(&digest);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in fs::read_dir(dist).map_err(|error| format!("{}: {error}", dist.display()))? {
        let path = entry.map_err(|error| format!("{}: {error}", dist.display()))?.path();
        let name = path.file_name().unwrap_or_default();
        if path != folder && !is_outside(&name.to_string_lossy()) {
            fs::rename(&path, folder.join(name)).map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    let page = read(&dist.join(PAGE))?;
    write(&dist.join(PAGE), page.replace(BUILD, &format!("{digest}/")).as_bytes())
}

/// The folder of the build that a page in `dist` is of.
pub fn build_folder(dist: &Path) -> Outcome<PathBuf> {
    let page = read(&dist.join(PAGE))?;
    let name = page.split_once(&format!("/{MODULE}_bg.wasm")).and_then(|(before, _)| before.rsplit('"').next());
    Ok(dist.join(name.ok_or_else(|| format!("{PAGE} does not name the page's module"))?))
}

/// An asset of the page: a tag with `data-trunk`.
#[derive(Debug, PartialEq)]
struct Asset {
    rel: String,
    href: String,
    target: Option<String>,
    /// Of a module: "main" or "worker".
    kind: Option<String>,
}

/// The page with every tag that has `data-trunk` replaced by what `link` gives for it.
fn resolve(source: &str, link: &mut dyn FnMut(&Asset) -> Outcome<String>) -> Outcome<String> {
    let mut page = String::new();
    let mut rest = source;
    while let Some(start) = rest.find("<link ").into_iter().chain(rest.find("<script ")).min() {
        let end = start + rest[start..].find('>').ok_or("index.html: a tag does not end")? + 1;
        let tag = &rest[start..end];
        page.push_str(&rest[..start]);
        if tag.contains(" data-trunk") {
            let script = tag.starts_with("<script");
            let rel = if script {
                "copy-file".into()
            } else {
                attribute(tag, "rel").ok_or_else(|| format!("index.html: {tag} lacks rel"))?
            };
            let href = attribute(tag, if script { "src" } else { "href" }).unwrap_or_else(|| "web/Cargo.toml".into());
            let replacement = link(&Asset {
                rel,
                href: href.clone(),
                target: attribute(tag, "data-target-path"),
                kind: attribute(tag, "data-type"),
            })?;
            if script {
                let name = placed(href.rsplit('/').next().unwrap_or_default());
                page.push_str(&tag.replace(" data-trunk", "").replace(&href, &name));
            } else {
                page.push_str(&replacement);
            }
        } else {
            page.push_str(tag);
        }
        rest = &rest[end..];
    }
    page.push_str(rest);
    Ok(page)
}

/// The address of a file from the page.
fn placed(name: &str) -> String {
    if is_outside(name) { name.to_owned() } else { format!("{BUILD}{name}") }
}

/// Copies an asset and gives the tag that the page has in its place.
fn place(root: &Path, dist: &Path, asset: &Asset) -> Outcome<String> {
    let source = root.join(&asset.href);
    let name = asset.href.rsplit('/').find(|part| !part.is_empty()).unwrap_or_default();
    let folder = asset.target.as_ref().map_or_else(|| dist.to_path_buf(), |target| dist.join(target));
    match asset.rel.as_str() {
        // Fetched by the page when it stands.
        "rust" if asset.kind.as_deref() == Some("worker") => Ok(String::new()),
        "rust" => Ok(format!(
            "<link rel=\"modulepreload\" href=\"{BUILD}{MODULE}.js\">{}\
             <link rel=\"preload\" href=\"{BUILD}{MODULE}_bg.wasm\" as=\"fetch\" type=\"application/wasm\" crossorigin>",
            if dist.join(parts::PAGE.glue).exists() {
                format!("<link rel=\"modulepreload\" href=\"{}\">", placed(parts::PAGE.glue))
            } else {
                String::new()
            }
        )),
        "css" => {
            copy(&source, &folder.join(name))?;
            Ok(format!("<link rel=\"stylesheet\" href=\"{}\">", placed(name)))
        }
        "icon" | "manifest" => {
            copy(&source, &folder.join(name))?;
            Ok(format!("<link rel=\"{}\" href=\"{}\">", asset.rel, placed(name)))
        }
        "inline" => {
            let text = read(&source)?;
            Ok(if name.ends_with(".css") {
                format!("<style>{text}</style>")
            } else {
                format!("<script type=\"module\">{text}</script>")
            })
        }
        "copy-file" => copy(&source, &folder.join(name)).map(|()| String::new()),
        "copy-dir" => {
            copy_folder(&source, &folder.join(if asset.target.is_some() { "" } else { name })).map(|()| String::new())
        }
        other => Err(format!("index.html: an asset of the kind {other} ({}) is not known here", asset.href)),
    }
}

/// Value of an attribute, quoted in either way.
fn attribute(tag: &str, name: &str) -> Option<String> {
    let at = tag.find(&format!(" {name}="))? + name.len() + 2;
    let quote = tag[at..].chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
    let value = &tag[at + 1..];
    Some(value[..value.find(quote)?].to_owned())
}

fn read(path: &Path) -> Outcome<String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn copy(from: &Path, to: &Path) -> Outcome {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    fs::copy(from, to).map(drop).map_err(|error| format!("{}: {error}", from.display()))
}

/// Copies all that is in a folder.
pub fn copy_folder(from: &Path, to: &Path) -> Outcome {
    for entry in fs::read_dir(from).map_err(|error| format!("{}: {error}", from.display()))? {
        let path = entry.map_err(|error| format!("{}: {error}", from.display()))?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() { copy_folder(&path, &target)? } else { copy(&path, &target)? }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assets_are_resolved_and_the_rest_is_left_alone() {
        let source = "<head><link rel=\"a\" href=\"b\"><link data-trunk rel=\"css\" href=\"web/x.css\" />\
                      <script data-trunk src='web/w.js'></script><link data-trunk rel=\"copy-dir\" href=\"web/i/\" data-target-path=\"i\"></head>";
        let mut seen = Vec::new();
        let page = resolve(source, &mut |asset| {
            seen.push(format!("{} {} {:?}", asset.rel, asset.href, asset.target));
            Ok(format!("[{}]", asset.rel))
        })
        .expect("a page");
        assert_eq!(page, "<head><link rel=\"a\" href=\"b\">[css]<script src='@build/w.js'></script>[copy-dir]</head>");
        assert_eq!(seen, ["css web/x.css None", "copy-file web/w.js None", "copy-dir web/i/ Some(\"i\")"]);
    }

    #[test]
    fn files_of_different_builds_lie_in_different_folders() {
        let dist = std::env::temp_dir().join(format!("sightline-build-{}", std::process::id()));
        let folder = |content: &str| {
            crate::build::empty(&dist).expect("a folder");
            fs::create_dir_all(dist.join("storage")).expect("a folder");
            for (name, content) in [
                ("index.html", "<link href=\"@build/desk_bg.wasm\"><script src=\"check.js\"></script>"),
                ("check.js", "0"),
                ("service.js", "1"),
                ("icon-180.png", "2"),
                ("desk_bg.wasm", content),
                ("storage/life.js", "3"),
            ] {
                write(&dist.join(name), content.as_bytes()).expect("a file");
            }
            seal(&dist).expect("sealed");
            let folder = build_folder(&dist).expect("a folder");
            assert_eq!(fs::read_to_string(folder.join("desk_bg.wasm")).as_deref().ok(), Some(content));
            assert!(folder.join("storage/life.js").exists() && dist.join("check.js").exists());
            assert!(!dist.join("desk_bg.wasm").exists() && !folder.join("service.js").exists());
            folder.file_name().expect("a name").to_owned()
        };
        let (first, second, again) = (folder("a"), folder("b"), folder("a"));
        fs::remove_dir_all(&dist).expect("removed");
        assert!(first != second && first == again);
    }

    #[test]
    fn an_asset_without_a_kind_is_refused() {
        assert!(resolve("<link data-trunk href=\"x\">", &mut |_| Ok(String::new())).is_err());
        assert!(resolve("<link data-trunk rel=\"css\" href=\"x\"", &mut |_| Ok(String::new())).is_err());
    }
}
