//! The page out of index.html: the assets it names in Trunk's form (`<link data-trunk rel=… href=…>`) are copied and linked.

use std::fs;
use std::path::Path;

use crate::Outcome;
use crate::build::write;
use crate::parts;

/// Name of the page's own module in dist/.
pub const MODULE: &str = "desk";
/// Name of the workers' module in dist/.
pub const WORKER: &str = "sightline-worker";
/// The 3-D view in dist/.
pub const VIEW3D: &str = "view3d.js";
/// Name of the decoders' module in dist/, which workers fetch when they need it.
pub const CODECS: &str = "sightline-codecs";

/// Copies what index.html names into `dist` and writes the page there.
pub fn assemble(root: &Path, dist: &Path) -> Outcome {
    let source = read(&root.join("index.html"))?;
    let page = resolve(&source, &mut |asset| place(root, dist, asset))?;
    write(&dist.join("index.html"), page.as_bytes())
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

/// The page with every tag that carries `data-trunk` replaced by what `link` gives for it.
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
                let name = href.rsplit('/').next().unwrap_or_default();
                page.push_str(&tag.replace(" data-trunk", "").replace(&href, name));
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

/// Copies an asset and gives the tag that the page has in its place.
fn place(root: &Path, dist: &Path, asset: &Asset) -> Outcome<String> {
    let source = root.join(&asset.href);
    let name = asset.href.rsplit('/').find(|part| !part.is_empty()).unwrap_or_default();
    let folder = asset.target.as_ref().map_or_else(|| dist.to_path_buf(), |target| dist.join(target));
    match asset.rel.as_str() {
        // Fetched by the page when it stands.
        "rust" if asset.kind.as_deref() == Some("worker") => Ok(String::new()),
        "rust" => Ok(format!(
            "<link rel=\"modulepreload\" href=\"{MODULE}.js\">{}\
             <link rel=\"preload\" href=\"{MODULE}_bg.wasm\" as=\"fetch\" type=\"application/wasm\" crossorigin>",
            if dist.join(parts::PAGE.glue).exists() {
                format!("<link rel=\"modulepreload\" href=\"{}\">", parts::PAGE.glue)
            } else {
                String::new()
            }
        )),
        "css" => {
            copy(&source, &folder.join(name))?;
            Ok(format!("<link rel=\"stylesheet\" href=\"{name}\">"))
        }
        "icon" | "manifest" => {
            copy(&source, &folder.join(name))?;
            Ok(format!("<link rel=\"{}\" href=\"{name}\">", asset.rel))
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
        assert_eq!(page, "<head><link rel=\"a\" href=\"b\">[css]<script src='w.js'></script>[copy-dir]</head>");
        assert_eq!(seen, ["css web/x.css None", "copy-file web/w.js None", "copy-dir web/i/ Some(\"i\")"]);
    }

    #[test]
    fn an_asset_without_a_kind_is_refused() {
        assert!(resolve("<link data-trunk href=\"x\">", &mut |_| Ok(String::new())).is_err());
        assert!(resolve("<link data-trunk rel=\"css\" href=\"x\"", &mut |_| Ok(String::new())).is_err());
    }
}
