//! The order of modules: each uses only those named before it, through whatever re-export, and those of one folder form no circle. A
//! module of an ordered folder that is in no list is a fault.

use std::collections::{BTreeMap, BTreeSet};

use crate::Outcome;
use crate::process::root;

use super::modules::{Module, Modules, Use};

/// Files of one folder that may use each other: more cannot be read one after the other.
const MOST: usize = 3;

/// All children that an order does not name; they may use each other.
const OTHERS: &str = "*";

/// Modules of one folder in their order.
struct Order {
    /// Folder of the crate.
    folder: &'static str,
    /// Path of the module whose children are ordered; empty for the crate.
    parent: &'static [&'static str],
    /// Children, first those that use no other; [`OTHERS`] means all that are not named.
    children: &'static [&'static str],
}

const ORDERS: [Order; 5] = [
    Order {
        folder: "web/src",
        parent: &[],
        children: &["format", "browser", "i18n", "document", "edit", "parts", "store", "view"],
    },
    // What views share uses no view; the rest is held free of circles.
    Order { folder: "web/src", parent: &["view"], children: &["components", OTHERS, "rooms", "shell"] },
    Order {
        folder: "src",
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
        ],
    },
    Order {
        folder: "src",
        parent: &["detect"],
        children: &[
            "acceptance",
            "median",
            "normal",
            "window",
            "ellipse",
            "picture",
            "edges",
            "search",
            "rendered",
            "centroid",
            "measure",
            "code",
            "occlusion",
            "adaptive_moments",
            "small_targets",
            "pass",
            "second_look",
            "rims",
            "click",
            "damaged_rows",
            "sites",
            "shot",
            "colours",
        ],
    },
    Order {
        folder: "src",
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

/// Crates whose modules are examined: their folders.
const CRATES: [&str; 7] = ["src", "exchange/src", "plan/src", "report/src", "lab/src", "web/src", "web/worker/src"];

/// Uses of a later module by an earlier one, and circles.
pub fn faults(sources: &[String]) -> Outcome<Vec<String>> {
    let mut faults = Vec::new();
    for folder in CRATES {
        let modules = Modules::of(&root(), folder, sources)?;
        let uses = modules.uses();
        for order in ORDERS.iter().filter(|order| order.folder == folder) {
            faults.extend(order.unknown(&modules));
            faults.extend(uses.iter().filter_map(|one| order.broken_by(one)));
        }
        faults.extend(
            circles(&uses)
                .into_iter()
                .filter(|circle| circle.size > MOST)
                .map(|circle| format!("{folder}: these use each other: {}\n{}", circle.names, circle.lines.join("\n"))),
        );
    }
    Ok(faults)
}

impl Order {
    /// Modules that the order does not name.
    fn unknown(&self, modules: &Modules) -> Vec<String> {
        let unknown = |(module, file): (&Module, &str)| {
            let own = self.place(module)?.err()?;
            Some(format!("{file}: the order of modules in xtask/src/check/order.rs does not name {own}"))
        };
        modules.all().filter_map(unknown).collect()
    }

    /// Place in the order of a module below the parent; its name if it is in no list.
    fn place(&self, module: &Module) -> Option<Result<usize, String>> {
        let own = child(module, self.parent)?;
        let place = |name: &str| self.children.iter().position(|known| *known == name);
        Some(place(own).or_else(|| place(OTHERS)).ok_or_else(|| own.to_owned()))
    }

    fn broken_by(&self, one: &Use) -> Option<String> {
        let (from, to) = (self.place(&one.from)?.ok()?, self.place(&one.to)?.ok()?);
        let [before, after] = [from, to].map(|place| self.children[place]);
        (to > from).then(|| format!("{}: {before} comes before {after} and must not use it", one.place))
    }
}

/// The child of `parent` that a module is or lies in.
fn child<'a>(module: &'a Module, parent: &[&str]) -> Option<&'a str> {
    let inside = module.len() > parent.len() && module.iter().zip(parent).all(|(a, b)| a == b);
    inside.then(|| module[parent.len()].as_str())
}

/// Modules that use each other.
struct Circle {
    /// Their names.
    names: String,
    /// How many they are.
    size: usize,
    /// One place of every use among them.
    lines: Vec<String>,
}

/// Modules of one folder, each with all below it, that use each other; a folder's own file and its children are one.
fn circles(uses: &BTreeSet<Use>) -> Vec<Circle> {
    let parents: BTreeSet<&[String]> =
        uses.iter().flat_map(|one| (0..one.from.len()).map(|n| &one.from[..n])).collect();
    let mut found = Vec::new();
    for parent in parents {
        let names: Vec<&str> = parent.iter().map(String::as_str).collect();
        let mut edges: BTreeMap<&str, BTreeMap<&str, &str>> = BTreeMap::new();
        for one in uses {
            if let (Some(from), Some(to)) = (child(&one.from, &names), child(&one.to, &names))
                && from != to
            {
                edges.entry(from).or_default().entry(to).or_insert(&one.place);
            }
        }
        let reach = |start: &str| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![start]);
            while let Some(at) = open.pop() {
                for next in edges.get(at).into_iter().flat_map(BTreeMap::keys) {
                    if seen.insert(*next) {
                        open.push(*next);
                    }
                }
            }
            seen
        };
        let reached: BTreeMap<&str, BTreeSet<&str>> = edges.keys().map(|name| (*name, reach(name))).collect();
        let mut told: BTreeSet<&str> = BTreeSet::new();
        for (name, all) in &reached {
            if told.contains(name) || !all.contains(name) {
                continue;
            }
            let circle: Vec<&str> = all
                .iter()
                .copied()
                .filter(|other| reached.get(other).is_some_and(|back| back.contains(name)))
                .collect();
            told.extend(&circle);
            let prefix = if names.is_empty() { String::new() } else { format!("{}::", names.join("::")) };
            let inside = circle.iter().flat_map(|from| edges[from].iter().map(move |(to, place)| (from, to, place)));
            let inside = inside.filter(|(_, to, _)| circle.contains(to));
            let lines: Vec<String> =
                inside.map(|(from, to, place)| format!("    {from} uses {to} at {place}")).collect();
            found.push(Circle { names: format!("{prefix}{{{}}}", circle.join(", ")), size: circle.len(), lines });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(path: &str) -> Module {
        path.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect()
    }

    fn used(from: &str, to: &str) -> Use {
        Use { from: module(from), to: module(to), place: "a.rs:1".into() }
    }

    #[test]
    fn later_modules_are_not_used() {
        let order = Order { folder: "src", parent: &["adjust"], children: &["linear", "problem", "solve"] };
        assert!(order.broken_by(&used("adjust::problem::state", "adjust::solve::session")).is_some());
        assert!(order.broken_by(&used("adjust::solve::session", "adjust::problem::state")).is_none());
        assert!(order.broken_by(&used("adjust", "adjust::solve")).is_none(), "the folder's own file");
        assert!(order.broken_by(&used("detect::scan", "adjust::solve")).is_none());
        assert_eq!(order.place(&module("adjust::attic")), Some(Err("attic".to_owned())));
        let order = Order { folder: "web/src", parent: &["view"], children: &["components", OTHERS, "shell"] };
        assert!(order.broken_by(&used("view::components::table", "view::photos")).is_some());
        assert!(order.broken_by(&used("view::photos", "view::shell")).is_some());
        assert!(order.broken_by(&used("view::photos", "view::targets")).is_none());
    }

    #[test]
    fn circles_are_told_once_and_at_the_folder_where_they_close() {
        let uses = [
            used("a::x", "b"),
            used("b", "c"),
            used("c::y", "a"),
            used("d", "a"),
            used("a::x", "a::z"),
            used("a::z", "a::x"),
        ];
        let found = circles(&uses.into());
        assert_eq!(found.iter().map(|circle| circle.names.as_str()).collect::<Vec<_>>(), ["{a, b, c}", "a::{x, z}"]);
        assert_eq!(found[0].size, 3);
        assert_eq!(found[0].lines[0], "    a uses b at a.rs:1");
        assert!(circles(&[used("a", "a::x"), used("a::x", "a")].into()).is_empty());
    }
}
