//! No type name has two meanings in one crate: a search for a name finds one declaration. Structs, enums, traits, unions
//! and aliases of modules count, private ones too; those inside functions, macros and implementations do not, nor what is compiled for tests
//! alone.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::Outcome;
use crate::process::root;

use super::modules::{Modules, attributes, of_tests};

/// Crates that are checked: their folders.
const CRATES: [&str; 13] = [
    "src",
    "codecs/src",
    "exchange/src",
    "plan/src",
    "report/src",
    "lab/src",
    "face/src",
    "web/src",
    "web/worker/src",
    "web/protocol/src",
    "xtask/src",
    "xtask/cutter/src",
    "xtask/runner/src",
];

/// Names that are declared more than once, each with its places.
pub fn faults(sources: &[String]) -> Outcome<Vec<String>> {
    let root = root();
    let mut faults = Vec::new();
    for folder in CRATES {
        let modules = Modules::of(&root, folder, sources)?;
        let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (_, file) in modules.all() {
            for (name, line) in types_of(&root, file)? {
                places.entry(name).or_default().push(format!("{file}:{line}"));
            }
        }
        faults.extend(repeated(folder, places));
    }
    Ok(faults)
}

/// A fault for each name of a crate with more than one place.
fn repeated(folder: &str, places: BTreeMap<String, Vec<String>>) -> Vec<String> {
    let repeated = places.into_iter().filter(|(_, places)| places.len() > 1);
    repeated.map(|(name, places)| format!("{folder}: {name} names more than one type: {}", places.join(", "))).collect()
}

fn types_of(root: &Path, file: &str) -> Outcome<Vec<(String, usize)>> {
    let text = fs::read_to_string(root.join(file)).map_err(|error| format!("{file}: {error}"))?;
    let parsed = syn::parse_file(&text).map_err(|error| format!("{file}: {error}"))?;
    let mut found = Vec::new();
    declared(&parsed.items, &mut found);
    Ok(found)
}

/// Names and lines of the types among the items of a module and of the modules written inside it.
fn declared(items: &[syn::Item], found: &mut Vec<(String, usize)>) {
    use syn::Item::*;
    for item in items.iter().filter(|item| !of_tests(attributes(item))) {
        let name = match item {
            Enum(i) => &i.ident,
            Struct(i) => &i.ident,
            Trait(i) => &i.ident,
            Type(i) => &i.ident,
            Union(i) => &i.ident,
            Mod(i) => {
                declared(i.content.as_ref().map_or(&[], |(_, items)| items), found);
                continue;
            }
            _ => continue,
        };
        found.push((name.to_string(), name.span().start().line));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<(String, usize)> {
        let mut found = Vec::new();
        declared(&syn::parse_file(text).expect("it parses").items, &mut found);
        found
    }

    #[test]
    fn types_of_modules_count_and_nothing_else() {
        let text = "pub struct A;\nenum B {}\nmod inner { trait C {} type D = u8; }\nunion E { x: u8 }
fn f() { struct Local; }
impl Iterator for A { type Item = u8; }
macro_rules! m { () => { struct InMacro; } }
#[cfg(test)] struct T;
#[cfg(test)] mod tests { struct U; }";
        let expected = [("A", 1), ("B", 2), ("C", 3), ("D", 3), ("E", 4)];
        assert_eq!(names(text), expected.map(|(name, line)| (name.to_owned(), line)));
    }

    #[test]
    fn a_name_with_two_places_is_a_fault() {
        let places = [("Pose", vec!["src/a.rs:1"]), ("State", vec!["src/a.rs:2", "src/b.rs:3"])];
        let places = places.map(|(name, places)| (name.to_owned(), places.into_iter().map(str::to_owned).collect()));
        let expected = "src: State names more than one type: src/a.rs:2, src/b.rs:3";
        assert_eq!(repeated("src", places.into()), [expected]);
    }
}
