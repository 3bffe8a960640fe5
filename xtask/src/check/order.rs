//! The order of the engine's modules and of the rooms inside them: each uses only those named before it.
//!
//! Read from the text: `crate::` and `super::` paths of every source file outside its tests. A module that is in no list is a fault.

use std::fs;

use crate::Outcome;
use crate::process::root;

/// Modules of one folder in their order.
struct Order {
    /// Path of the module whose children are ordered; empty for the crate.
    parent: &'static [&'static str],
    /// Children, first those that use no other.
    children: &'static [&'static str],
}

const ORDERS: [Order; 3] = [
    Order {
        parent: &[],
        children: &[
            "error",
            "limits",
            "units",
            "axes",
            "project",
            "statistics",
            "ring_code",
            "detection",
            "adjustment",
            "rotation",
            "depiction",
            "camera",
            "film",
            "image",
            "decode",
            "exif",
            "sensor",
            "tiles",
            "detect",
            "initial",
            "equipment",
            "eccentricity",
            "features",
            "plausibility",
            "adjust",
            "noise",
            "calibration",
            "monitoring",
            "comparison",
            "matching",
            "orient",
            "scene",
            "render",
            "network",
            "sample",
            "report",
            "exchange",
            "sheets",
            "plan",
            "experiments",
            "teaching",
        ],
    },
    Order {
        parent: &["detect"],
        children: &[
            "acceptance",
            "median",
            "normal",
            "part",
            "ellipse",
            "picture",
            "edges",
            "search",
            "rendered",
            "centroid",
            "measure",
            "code",
            "covered",
            "lump",
            "alike",
            "pass",
            "rims",
            "click",
            "whole",
            "sites",
            "shot",
            "colours",
        ],
    },
    Order {
        parent: &["adjust"],
        children: &[
            "linear",
            "problem",
            "equations",
            "datum",
            "statistics",
            "diagnosis",
            "solve",
            "gross_errors",
            "variance_components",
            "patterns",
            "report",
            "outside",
            "inside",
        ],
    },
];

/// Uses of a later module by an earlier one.
pub fn faults(sources: &[String]) -> Outcome<Vec<String>> {
    let mut faults = Vec::new();
    for path in sources.iter().filter(|path| path.starts_with("src/") && path.ends_with(".rs")) {
        let text = fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}"))?;
        faults.extend(ORDERS.iter().flat_map(|order| order.broken_in(path, &text)));
    }
    Ok(faults)
}

/// The module a file holds, from the crate down; none for the crate's root and for files of tests alone.
fn module(path: &str) -> Option<Vec<&str>> {
    let path: Vec<&str> = path.strip_prefix("src/")?.strip_suffix(".rs")?.split('/').collect();
    (path != ["lib"] && path.last() != Some(&"tests")).then_some(path)
}

impl Order {
    fn broken_in(&self, path: &str, text: &str) -> Vec<String> {
        let Some(module) = module(path) else { return Vec::new() };
        let Some(own) = below(&module, self.parent) else { return Vec::new() };
        let place = |name: &str| self.children.iter().position(|child| *child == name);
        let Some(at) = place(own) else {
            return vec![format!("{path}: the order of modules in xtask/src/check/order.rs does not name {own}")];
        };
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines = code.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"));
        let broken = lines.flat_map(|(number, line)| {
            let used = named(line, &module).into_iter().filter_map(|path| {
                let child = (*below(&path.iter().map(String::as_str).collect::<Vec<_>>(), self.parent)?).to_owned();
                place(&child).filter(|other| *other > at).map(|_| child)
            });
            used.map(|child| format!("{path}:{}: {own} comes before {child} and must not use it", number + 1))
                .collect::<Vec<_>>()
        });
        broken.collect()
    }
}

/// The name that follows the parent's in a path.
fn below<'a>(path: &[&'a str], parent: &[&str]) -> Option<&'a str> {
    path.starts_with(parent).then(|| path.get(parent.len()).copied()).flatten()
}

/// Paths that a line names, from the crate down, the first of a group in braces only where it is one line's.
fn named(line: &str, module: &[&str]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let starts = ["crate::", "super::"];
    let mut rest = line;
    while let Some((at, start)) = starts.iter().filter_map(|start| Some((rest.find(start)?, *start))).min() {
        let bounded = !rest[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
        rest = &rest[at + start.len()..];
        if !bounded {
            continue;
        }
        let mut base: Vec<String> = match start {
            "super::" => module[..module.len() - 1].iter().map(|name| (*name).to_owned()).collect(),
            _ => Vec::new(),
        };
        while let Some(further) = rest.strip_prefix("super::") {
            base.pop();
            rest = further;
        }
        for path in tails(rest) {
            found.push(base.iter().cloned().chain(path).collect());
        }
    }
    found
}

/// `a::b::c` as its parts, `{a::b, c}` as several.
fn tails(text: &str) -> Vec<Vec<String>> {
    let parts = |text: &str| -> Vec<String> {
        let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(text.len());
        text[..end].split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()
    };
    match text.strip_prefix('{') {
        Some(group) => {
            group.split('}').next().unwrap_or_default().split(',').map(|one| parts(one.trim_start())).collect()
        }
        None => vec![parts(text)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_modules_are_seen_through_every_kind_of_path() {
        let order = Order { parent: &["adjust"], children: &["linear", "problem", "solve"] };
        let broken = |path: &str, text: &str| order.broken_in(path, text).len();
        assert_eq!(broken("src/adjust/problem/state.rs", "use crate::adjust::solve::session::Log;\n"), 1);
        assert_eq!(broken("src/adjust/problem/state.rs", "    super::super::solve::go();\n"), 1);
        assert_eq!(broken("src/adjust/problem.rs", "use super::{linear, solve};\n"), 1);
        assert_eq!(broken("src/adjust/solve/session.rs", "use crate::adjust::problem::state::State;\n"), 0);
        assert_eq!(broken("src/adjust/problem/state.rs", "// use crate::adjust::solve\nuse super::solve;\n"), 0);
        assert_eq!(broken("src/adjust/problem/state.rs", "#[cfg(test)]\nuse crate::adjust::solve::x;\n"), 0);
        assert_eq!(broken("src/adjust/attic.rs", ""), 1, "a room that no list names");
        assert_eq!(broken("src/detect/scan.rs", "use crate::adjust::solve::x;\n"), 0);
    }
}
