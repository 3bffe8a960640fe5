//! The modules of a crate and which of them each file uses, read from the syntax: paths from `crate`, `super`, `self`, children and imported
//! names, through re-exports and globs to the file that declares the item. What is compiled for tests alone is skipped.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

use crate::Outcome;

/// Re-exports that one path is followed through.
const STEPS: usize = 16;

/// Names of a module's path from the crate's root, which has none.
pub type Module = Vec<String>;

/// One crate's modules.
pub struct Modules {
    files: BTreeMap<Module, Source>,
}

/// Content of one file.
struct Source {
    /// Path of the file from the root of the repository.
    file: String,
    /// Names that it declares itself.
    items: BTreeSet<String>,
    /// Names that it imports or exports again, with their paths.
    imports: BTreeMap<String, Vec<String>>,
    /// Modules all of whose names it imports.
    globs: Vec<Vec<String>>,
    /// Paths in its code, with the line.
    paths: Vec<(Vec<String>, usize)>,
}

/// A use of one module by another.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Use {
    /// Who uses.
    pub from: Module,
    /// The used module: the one that declares the item.
    pub to: Module,
    /// File and line.
    pub place: String,
}

impl Modules {
    /// The crate whose sources lie in a folder, with `lib.rs` or `main.rs` as its root; `files` are paths from the root of the repository.
    ///
    /// # Errors
    /// A file that cannot be read or parsed.
    pub fn of(root: &Path, folder: &str, files: &[String]) -> Outcome<Self> {
        let read = |path: &String| {
            let text = fs::read_to_string(root.join(path)).map_err(|error| format!("{path}: {error}"))?;
            Ok::<_, String>((path.clone(), text))
        };
        let own = files.iter().filter(|path| path.starts_with(&format!("{folder}/")) && path.ends_with(".rs"));
        Self::parsed(folder, own.map(read).collect::<Outcome<Vec<_>>>()?)
    }

    fn parsed(folder: &str, texts: Vec<(String, String)>) -> Outcome<Self> {
        let (mut files, mut for_tests) = (BTreeMap::new(), BTreeSet::new());
        for (path, text) in texts {
            let module = module(&path[folder.len() + 1..]);
            let parsed = syn::parse_file(&text).map_err(|error| format!("{path}: {error}"))?;
            let mut source = Source {
                file: path,
                items: BTreeSet::new(),
                imports: BTreeMap::new(),
                globs: Vec::new(),
                paths: Vec::new(),
            };
            let mut reader = Reader { source: &mut source, tests: Vec::new() };
            reader.visit_file(&parsed);
            let tests = std::mem::take(&mut reader.tests);
            for_tests.extend(tests.into_iter().map(|name| below(&module, name)));
            files.insert(module, source);
        }
        files.retain(|module, _| !(1..=module.len()).any(|n| for_tests.contains(&module[..n])));
        Ok(Self { files })
    }

    /// Every module with its file.
    pub fn all(&self) -> impl Iterator<Item = (&Module, &str)> {
        self.files.iter().map(|(module, source)| (module, source.file.as_str()))
    }

    /// Every use of one file's module by another file.
    pub fn uses(&self) -> BTreeSet<Use> {
        let mut found = BTreeSet::new();
        for (module, source) in &self.files {
            for (path, line) in &source.paths {
                if let Some(to) = self.resolved(module, path, STEPS).filter(|to| to != module) {
                    found.insert(Use { from: module.clone(), to, place: format!("{}:{line}", source.file) });
                }
            }
        }
        found
    }

    /// The module that declares what a path in `module` names; `None` if it is another crate's.
    fn resolved(&self, module: &Module, path: &[String], steps: usize) -> Option<Module> {
        let steps = steps.checked_sub(1)?;
        let (first, rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Module::new(),
            "self" => module.clone(),
            "super" => module[..module.len().checked_sub(1)?].to_vec(),
            name => return self.named(module, name, rest, false, steps),
        };
        let mut rest = rest;
        while let Some((_, further)) = rest.split_first().filter(|(name, _)| *name == "super") {
            at.pop()?;
            rest = further;
        }
        match rest.split_first() {
            None => Some(at),
            Some((name, further)) => self.named(&at, name, further, true, steps).or(Some(at)),
        }
    }

    /// The same from a name of `module`, with what follows it. Names that `inside` code are no other crate's may be local ones.
    fn named(&self, module: &Module, name: &str, rest: &[String], inside: bool, steps: usize) -> Option<Module> {
        let child = below(module, name.to_owned());
        if self.files.contains_key(&child) {
            return match rest.split_first() {
                None => Some(child),
                Some((next, further)) => self.named(&child, next, further, true, steps).or(Some(child)),
            };
        }
        let source = self.files.get(module)?;
        if source.items.contains(name) {
            return Some(module.clone());
        }
        if let Some(path) = source.imports.get(name).filter(|path| path.first().is_some_and(|first| first != name)) {
            let path: Vec<String> = path.iter().chain(rest).cloned().collect();
            return self.resolved(module, &path, steps);
        }
        let steps = steps.checked_sub(1)?;
        let within = |glob: &Vec<String>| {
            let to = self.resolved(module, glob, steps).filter(|to| to != module)?;
            self.named(&to, name, rest, false, steps)
        };
        source.globs.iter().find_map(within).or_else(|| inside.then(|| module.clone()))
    }
}

/// The module of a file below the crate's folder.
fn module(path: &str) -> Module {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    let path = path.strip_suffix("/mod").unwrap_or(path);
    if matches!(path, "lib" | "main") { Module::new() } else { path.split('/').map(str::to_owned).collect() }
}

fn below(module: &[String], name: String) -> Module {
    module.iter().cloned().chain([name]).collect()
}

/// Reads one file.
struct Reader<'a> {
    source: &'a mut Source,
    /// Children that are compiled for tests alone.
    tests: Vec<String>,
}

/// Whether an item is compiled for tests alone.
pub fn of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let cfg = attribute.path().is_ident("cfg");
        cfg && attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    })
}

/// Attributes of an item.
pub fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    use syn::Item::*;
    match item {
        Const(i) => &i.attrs,
        Enum(i) => &i.attrs,
        Fn(i) => &i.attrs,
        Impl(i) => &i.attrs,
        Macro(i) => &i.attrs,
        Mod(i) => &i.attrs,
        Static(i) => &i.attrs,
        Struct(i) => &i.attrs,
        Trait(i) => &i.attrs,
        Type(i) => &i.attrs,
        Union(i) => &i.attrs,
        Use(i) => &i.attrs,
        _ => &[],
    }
}

fn declared(item: &syn::Item) -> Option<String> {
    use syn::Item::*;
    let name = match item {
        Const(i) => &i.ident,
        Enum(i) => &i.ident,
        Fn(i) => &i.sig.ident,
        Macro(i) => i.ident.as_ref()?,
        Mod(i) => i.content.as_ref().map(|_| &i.ident)?,
        Static(i) => &i.ident,
        Struct(i) => &i.ident,
        Trait(i) => &i.ident,
        Type(i) => &i.ident,
        Union(i) => &i.ident,
        _ => return None,
    };
    Some(name.to_string())
}

impl Reader<'_> {
    fn import(&mut self, tree: &syn::UseTree, before: &[String]) {
        match tree {
            syn::UseTree::Path(path) => self.import(&path.tree, &below(before, path.ident.to_string())),
            syn::UseTree::Group(group) => group.items.iter().for_each(|one| self.import(one, before)),
            syn::UseTree::Glob(glob) => {
                self.source.paths.push((before.to_vec(), glob.star_token.spans[0].start().line));
                self.source.globs.push(before.to_vec());
            }
            syn::UseTree::Name(name) => self.imported(&name.ident, name.ident.to_string(), before),
            syn::UseTree::Rename(name) => self.imported(&name.ident, name.rename.to_string(), before),
        }
    }

    fn imported(&mut self, name: &syn::Ident, known_as: String, before: &[String]) {
        let itself = name == "self";
        let path = if itself { before.to_vec() } else { below(before, name.to_string()) };
        let last = before.last().cloned().unwrap_or_default();
        let known_as = if itself && known_as == "self" { last } else { known_as };
        self.source.paths.push((path.clone(), name.span().start().line));
        self.source.imports.insert(known_as, path);
    }

    /// Paths among the words of a macro, which are of no grammar: those with `::` between two words.
    fn words(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let (mut colons, mut line) = (0, 0);
        for token in tokens {
            match token {
                TokenTree::Ident(word) => {
                    if colons != 2 {
                        self.end(&mut path, line);
                        line = word.span().start().line;
                    }
                    path.push(word.to_string());
                    colons = 0;
                }
                TokenTree::Punct(point) if point.as_char() == ':' => colons += 1,
                TokenTree::Group(group) => {
                    self.end(&mut path, line);
                    self.words(group.stream());
                    colons = 0;
                }
                _ => {
                    self.end(&mut path, line);
                    colons = 0;
                }
            }
        }
        self.end(&mut path, line);
    }

    fn end(&mut self, path: &mut Vec<String>, line: usize) {
        let path = std::mem::take(path);
        if path.len() > 1 {
            self.source.paths.push((path, line));
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_file(&mut self, file: &'ast syn::File) {
        self.source.items.extend(file.items.iter().filter_map(declared));
        visit::visit_file(self, file);
    }

    fn visit_item(&mut self, item: &'ast syn::Item) {
        match item {
            syn::Item::Mod(child) if of_tests(&child.attrs) => {
                if child.content.is_none() {
                    self.tests.push(child.ident.to_string());
                }
            }
            other if of_tests(attributes(other)) => {}
            syn::Item::Use(used) => self.import(&used.tree, &[]),
            other => visit::visit_item(self, other),
        }
    }

    fn visit_impl_item(&mut self, item: &'ast syn::ImplItem) {
        match item {
            syn::ImplItem::Fn(function) if of_tests(&function.attrs) => {}
            other => visit::visit_impl_item(self, other),
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|segment| segment.ident.to_string()).collect::<Vec<_>>();
        let line = path.segments.first().map_or(0, |segment| segment.ident.span().start().line);
        if path.leading_colon.is_none() && names.len() > 1 {
            self.source.paths.push((names, line));
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, used: &'ast syn::Macro) {
        self.words(used.tokens.clone());
        visit::visit_macro(self, used);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uses(texts: &[(&str, &str)]) -> Vec<(String, String)> {
        let texts = texts.iter().map(|(path, text)| (format!("src/{path}"), (*text).to_owned())).collect();
        let modules = Modules::parsed("src", texts).expect("they parse");
        modules.uses().into_iter().map(|one| (one.from.join("::"), one.to.join("::"))).collect()
    }

    fn pair(from: &str, to: &str) -> (String, String) {
        (from.to_owned(), to.to_owned())
    }

    #[test]
    fn items_are_followed_to_the_file_that_declares_them() {
        let tree = [
            ("lib.rs", "mod a; mod b; mod c;"),
            ("a.rs", "mod inner; pub use inner::*;\npub use self::inner::{Thing as Known};"),
            ("a/inner.rs", "pub struct Thing; pub fn go() {}"),
            ("b.rs", "use crate::{\n    a::{\n        Known,\n    },\n};\nfn f() { crate::a::go(); }"),
            ("c.rs", "use super::b as other;\nfn f() { vec![other::f()]; }"),
        ];
        let found = uses(&tree);
        assert!(found.contains(&pair("b", "a::inner")), "{found:?}");
        assert!(found.contains(&pair("c", "b")), "{found:?}");
        assert!(!found.contains(&pair("b", "a")), "{found:?}");
        assert_eq!(
            found.iter().filter(|(from, _)| from == "b").count(),
            2,
            "a renamed item and one by a glob: {found:?}"
        );
    }

    #[test]
    fn tests_and_other_crates_are_passed_over() {
        let tree = [
            ("main.rs", "mod a; mod b; #[cfg(test)] mod tests;"),
            ("a.rs", "use std::fmt;\nuse other::b;\n#[cfg(test)]\nmod tests { use crate::b::x; }"),
            ("b.rs", "pub fn x() {}\n#[cfg(test)]\nfn y() { crate::a::z(); }"),
            ("tests.rs", "use crate::a;"),
        ];
        assert_eq!(uses(&tree), []);
    }

    #[test]
    fn paths_in_macros_are_seen() {
        let tree = [
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "fn f() { view! { <p>{crate::b::text()}</p> }; }"),
            ("b.rs", "pub fn text() {}"),
        ];
        assert_eq!(uses(&tree), [pair("a", "b")]);
    }
}
