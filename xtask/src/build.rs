//! pkg/ (the engine with its JavaScript face) and dist/ (the page): cargo in the release profile, then wasm-bindgen.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use serde_json::{Value, json};
use wasm_bindgen_cli_support::Bindgen;

use crate::install::{self, TARGET};
use crate::process::{cargo, output, program, root, run};
use crate::{Outcome, kept, notices, offline, page, parts};

/// How modules are compiled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// While the page is worked on and for daily tests: in minutes, and in seconds after a change.
    Fast,
    /// As it is handed out.
    Release,
}

impl Profile {
    /// Cargo's profile, and its folder below the target directory.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::Fast => ["dev", "debug"],
            Self::Release => ["release", "release"],
        }
    }
}

/// Where the products of a profile lie. Only what may be handed out is left in the root.
pub struct Products {
    profile: Profile,
    /// The engine as an ES module.
    pub pkg: PathBuf,
    /// The page.
    pub dist: PathBuf,
}

impl Products {
    /// The folders of a profile's products: below the root, or below cargo's target directory.
    pub fn of(profile: Profile) -> Outcome<Self> {
        let parent = match profile {
            Profile::Release => root(),
            Profile::Fast => PathBuf::from(target_directory()?).join("fast"),
        };
        Ok(Self { profile, pkg: parent.join("pkg"), dist: parent.join("dist") })
    }

    /// The engine as an ES module.
    pub fn build_pkg(&self) -> Outcome {
        modules(self.profile, &["sightline-face", "sightline-codecs"])?;
        assemble_pkg(self.profile, &self.pkg)
    }

    /// The page as it is served while it is worked on: index.html with Trunk's assets resolved, the page's module and the workers' with
    /// their glue. It gets its [decoders](Self::build_decoders) afterwards.
    pub fn build_page(&self) -> Outcome {
        modules(self.profile, &["sightline-desk", "sightline-worker"])?;
        assemble_dist(self.profile, &self.dist, Decoders::Later)
    }

    /// The decoders of HEIC and RAW photos of a page that stands without them.
    pub fn build_decoders(&self) -> Outcome {
        modules(self.profile, &["sightline-codecs"])?;
        changed(&page::build_folder(&self.dist)?, &[("sightline_codecs", page::CODECS)])
    }

    /// A project of the TypeScript compiler with the program that uses pkg/ as `sightline`; the file's path.
    pub fn declarations_project(&self) -> Outcome<PathBuf> {
        let face = root().join("tests/face");
        let project = json!({
            "extends": face.join("tsconfig.json"),
            "compilerOptions": { "paths": { "sightline": [self.pkg.join("sightline.d.ts")] } },
            "files": [face.join("consumer.ts"), self.pkg.join("sightline.d.ts")],
        });
        let path = PathBuf::from(target_directory()?).join("declarations.json");
        write(&path, project.to_string().as_bytes())?;
        Ok(path)
    }

    /// Everything, compiled together: what the modules have in common is built once.
    pub fn build_all(&self) -> Outcome {
        modules(self.profile, &["sightline-face", "sightline-desk", "sightline-worker", "sightline-codecs"])?;
        // Not one after the other: cargo would compile what they share with the features of each.
        assemble_pkg(self.profile, &self.pkg)?;
        assemble_dist(self.profile, &self.dist, Decoders::Now)
    }
}

/// What stands for the exports of pkg/, and they as a text: of the conditions the first that holds counts, and JSON objects here are sorted.
const EXPORTS: (&str, &str) = (
    "@exports",
    r#"{
    ".": { "types": "./sightline.d.ts", "node": "./node.js", "default": "./sightline.js" },
    "./sightline.js": { "types": "./sightline.d.ts", "default": "./sightline.js" },
    "./codecs.js": { "types": "./codecs.d.ts", "default": "./codecs.js" },
    "./*.wasm": "./*.wasm",
    "./package.json": "./package.json"
  }"#,
);
/// Entry module of the package for Node: it loads and starts the engine.
const NODE: &str = "\
// In Node the module is read from beside this file, at once.
import { readFileSync } from 'node:fs';
import { initSync } from './sightline.js';
initSync({ module: readFileSync(new URL('./sightline_bg.wasm', import.meta.url)) });
export * from './sightline.js';
export { default } from './sightline.js';
";

fn assemble_pkg(profile: Profile, folder: &Path) -> Outcome {
    empty(folder)?;
    bindings(profile, "sightline_face", folder, "sightline", true)?;
    bindings(profile, "sightline_codecs", folder, "codecs", true)?;
    let metadata = metadata()?;
    let engine = metadata["packages"].as_array().into_iter().flatten().find(|package| package["name"] == "sightline");
    let engine = engine.ok_or("cargo metadata does not list sightline")?;
    let package = json!({
        "name": "sightline",
        "description": engine["description"],
        "version": engine["version"],
        "license": engine["license"],
        "type": "module",
        "main": "sightline.js",
        "module": "sightline.js",
        "types": "sightline.d.ts",
        "exports": EXPORTS.0,
        "engines": { "node": ">=20.16" },
        "keywords": ["photogrammetry", "bundle-adjustment", "camera-calibration", "webassembly"],
        "files": [
            "sightline.js", "sightline.d.ts", "sightline_bg.wasm", "sightline_bg.wasm.d.ts", "node.js", "codecs.js", "codecs.d.ts",
            "codecs_bg.wasm", "codecs_bg.wasm.d.ts", "snippets", notices::NAME, "LICENSE-MIT", "LICENSE-APACHE", "README.md",
        ],
        "sideEffects": ["./snippets/*", "./node.js"],
    });
    write(&folder.join("node.js"), NODE.as_bytes())?;
    notices::write_to(folder)?;
    for (from, name) in
        [("LICENSE-MIT", "LICENSE-MIT"), ("LICENSE-APACHE", "LICENSE-APACHE"), ("docs/javascript.md", "README.md")]
    {
        fs::copy(root().join(from), folder.join(name)).map_err(|error| format!("{from}: {error}"))?;
    }
    let text = format!("{package:#}\n").replace(&format!("\"{}\"", EXPORTS.0), EXPORTS.1);
    write(&folder.join("package.json"), text.as_bytes())?;
    report("pkg", &folder.join("sightline_bg.wasm"));
    report("pkg", &folder.join("codecs_bg.wasm"));
    Ok(())
}

/// When the decoders of HEIC and RAW photos are built.
#[derive(PartialEq)]
enum Decoders {
    Now,
    Later,
}

fn assemble_dist(profile: Profile, folder: &Path, decoders: Decoders) -> Outcome {
    empty(folder)?;
    match profile {
        Profile::Release => {
            links_no_engine()?;
            first(&parts::PAGE, "sightline-desk", folder)?;
            first(&parts::WORKER, "sightline-worker", folder)?;
            view3d(folder)?;
            offline::icons(folder)?;
            notices::write_to(folder)?;
        }
        Profile::Fast => {
            let view = files(&root().join("web/view3d"))?;
            kept::product(&shelf()?, "view3d", &view, folder, view3d)?;
            kept::product(&shelf()?, "icons", &[], folder, offline::icons)?;
            kept::product(&shelf()?, "notices", &notices::sources(), folder, notices::write_to)?;
            changed(folder, &[("sightline-desk", page::MODULE), ("sightline-worker", page::WORKER)])?;
        }
    }
    if decoders == Decoders::Now {
        match profile {
            Profile::Fast => changed(folder, &[("sightline_codecs", page::CODECS)])?,
            Profile::Release => bindings(profile, "sightline_codecs", folder, page::CODECS, false)?,
        }
    }
    page::assemble(&root(), folder)?;
    page::seal(folder)?;
    offline::seal(folder)?;
    let folder = &page::build_folder(folder)?;
    for cut in [parts::PAGE, parts::WORKER] {
        report("dist", &folder.join(format!("{}_bg.wasm", cut.module)));
        for part in cut.later(folder)? {
            report("dist", &folder.join(part));
        }
    }
    if decoders == Decoders::Now {
        report("dist", &folder.join(format!("{}_bg.wasm", page::CODECS)));
    }
    Ok(())
}

/// Compiles packages of the workspace as wasm.
fn modules(profile: Profile, packages: &[&str]) -> Outcome {
    install::target()?;
    let [name, _] = profile.names();
    let mut arguments = vec!["build", "--profile", name, "--target", TARGET];
    arguments.extend(packages.iter().flat_map(|package| ["--package", package]));
    // Released files must not contain folder names of the build machine; cargo appends these flags to those of its configuration.
    let short = match profile {
        Profile::Release => Some(format!("target.{TARGET}.rustflags = {:?}", remapped()?)),
        _ => None,
    };
    arguments.extend(short.iter().flat_map(|flags| ["--config", flags.as_str()]));
    run(&mut cargo(&arguments))
}

/// Folders of this machine that a module would name where it can panic, with the name that stands for each: the repository, cargo's, and the
/// sources of the standard library where the toolchain has them (its generic functions are compiled here, with their paths).
pub fn folders() -> Outcome<Vec<(PathBuf, &'static str)>> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".cargo")));
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let library = Path::new(sysroot.trim()).join("lib/rustlib/src/rust");
    Ok(home.map(|home| (home, "cargo")).into_iter().chain([(root(), "."), (library, "/rustc")]).collect())
}

/// Flags of the compiler that name them otherwise.
fn remapped() -> Outcome<Vec<String>> {
    let folders = folders()?;
    Ok(folders.iter().map(|(folder, name)| format!("--remap-path-prefix={}={name}", folder.display())).collect())
}

/// Metadata of the workspace for this machine and for wasm, from the lock file; offline if everything is downloaded.
pub fn metadata() -> Outcome<Value> {
    let text = metadata_of(&[&host()?, TARGET])?;
    serde_json::from_str(&text).map_err(|error| format!("cargo metadata: {error}"))
}

/// The same for some targets, as a text.
pub fn metadata_of(targets: &[&str]) -> Outcome<String> {
    let mut arguments = vec!["metadata", "--format-version", "1", "--locked"];
    arguments.extend(targets.iter().flat_map(|target| ["--filter-platform", target]));
    known_offline(&arguments)
}

/// Packages that are built in several versions on this machine or as wasm, a line each; some with one version are listed too.
pub fn duplicates() -> Outcome<String> {
    let host = host()?;
    let platforms = ["--target", &host, "--target", TARGET];
    let shown =
        ["tree", "--locked", "--workspace", "--duplicates", "--depth", "0", "--prefix", "none", "--format", "{p}"];
    known_offline(&[&shown[..], &platforms].concat())
}

fn host() -> Outcome<String> {
    let version = output(Command::new("rustc").arg("-vV"))?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.ok_or("rustc -vV names no host")?.to_owned())
}

/// Output of cargo, offline if everything is downloaded.
fn known_offline(arguments: &[&str]) -> Outcome<String> {
    let offline = cargo(arguments)
        .arg("--offline")
        .stderr(Stdio::null())
        .output()
        .map_err(|error| format!("cargo {}: {error}", arguments[0]))?;
    if offline.status.success() {
        String::from_utf8(offline.stdout).map_err(|_| format!("cargo {}: its output is not UTF-8", arguments[0]))
    } else {
        output(&mut cargo(arguments))
    }
}

/// Packages of native builds: always the same, since cargo compiles a crate anew for other features, and those
/// follow from the packages that are asked for.
pub const NATIVE: [&str; 16] = [
    "--package",
    "sightline",
    "--package",
    "sightline-exchange",
    "--package",
    "sightline-plan",
    "--package",
    "sightline-report",
    "--package",
    "sightline-lab",
    "--package",
    "sightline-codecs",
    "--package",
    "sightline-desk",
    "--package",
    "sightline-protocol",
];

/// How many of [`NATIVE`], from the first, are the engine and the crates above it: their unit tests run as wasm every day.
pub const ENGINE: usize = 10;

/// The targets of [`NATIVE`] that test the engine from outside.
pub const FROM_OUTSIDE: [&str; 2] = ["--test", "*"];

/// Builds the examples of the engine natively, asked for as the tests are, so that nothing is compiled again for other features,
/// and gives their folder.
pub fn examples() -> Outcome<String> {
    run(cargo(&["build", "--examples"]).args(NATIVE))?;
    Ok(format!("{}/debug/examples", target_directory()?))
}

/// Where cargo builds.
pub fn target_directory() -> Outcome<String> {
    static KNOWN: OnceLock<Outcome<String>> = OnceLock::new();
    let ask =
        || Ok(metadata()?["target_directory"].as_str().ok_or("cargo metadata names no target directory")?.to_owned());
    KNOWN.get_or_init(ask).clone()
}

/// The page's own module has the document, the results and the interface; what computes is in the workers. Told by the
/// names of the functions that were linked.
fn links_no_engine() -> Outcome {
    let module = format!("{}/{TARGET}/release/sightline-desk.wasm", target_directory()?);
    let bytes = fs::read(&module).map_err(|error| format!("{module}: {error}"))?;
    let names = names(&bytes).ok_or_else(|| format!("{module}: it has no names"))?;
    let linked = |name: &str| names.windows(name.len()).any(|window| window == name.as_bytes());
    let engine = [
        "9sightline6detect",
        "9sightline6decode",
        "9sightline6adjust5solve",
        "9sightline6adjust6linear",
        "9sightline6adjust7problem",
        "9sightline6adjust9equations",
        "9sightline6orient5block",
        "9sightline7initial",
        "18sightline_exchange7package",
        "9zune_jpeg",
        "8flashraw",
        "heifer_hevc_dec",
    ];
    match engine.into_iter().find(|name| linked(name)) {
        Some(name) => Err(format!("{module}: the page links {name}, which belongs to the workers")),
        None => Ok(()),
    }
}

/// Section of a module with the names of its functions: relocations, in another, name what was never linked too.
fn names(module: &[u8]) -> Option<&[u8]> {
    // Lengths have seven bits a byte, the lowest first.
    fn length<'a>(bytes: &mut &'a [u8]) -> Option<&'a [u8]> {
        let mut length = 0;
        for shift in (0..32).step_by(7) {
            let (&byte, rest) = bytes.split_first()?;
            *bytes = rest;
            length |= usize::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                break;
            }
        }
        let (content, rest) = bytes.split_at_checked(length)?;
        *bytes = rest;
        Some(content)
    }
    let mut rest = module.get(8..)?;
    while let Some((&kind, after)) = rest.split_first() {
        rest = after;
        let mut content = length(&mut rest)?;
        if kind == 0 && length(&mut content)? == b"name" {
            return Some(content);
        }
    }
    None
}

/// The 3-D view with what it uses of three.js, as one file that the page loads when it is asked for.
fn view3d(dist: &Path) -> Outcome {
    let folder = root().join("web/view3d");
    install::packages_of("web/view3d")?;
    let out = format!("--outfile={}", dist.join(page::VIEW3D).display());
    let arguments = [
        "--no-install",
        "esbuild",
        "view.js",
        "--bundle",
        "--minify",
        "--format=esm",
        "--legal-comments=eof",
        "--log-level=error",
        &out,
    ];
    run(program("npx", &arguments).current_dir(folder).stdout(std::io::stderr()))
}

/// A module as it is handed out: its parts, of which the first is bound.
fn first(parts: &parts::Parts, module: &str, folder: &Path) -> Outcome {
    bind(&parts.cut(&linked(Profile::Release, module)?, folder)?, folder, parts.module, false)
}

/// Where what is served is kept from one time to the next.
fn shelf() -> Outcome<PathBuf> {
    Ok(format!("{}/fast/kept", target_directory()?).into())
}

/// Modules of the page while it is worked on, with their names there: only what has changed is bound anew, side by side. The page's own is
/// whole.
fn changed(folder: &Path, modules: &[(&str, &str)]) -> Outcome {
    let shelf = &shelf()?;
    std::thread::scope(|threads| {
        let bind_one = |(module, name): &(&str, &str)| {
            let module = linked(Profile::Fast, module)?;
            kept::product(shelf, name, std::slice::from_ref(&module), folder, |made| bind(&module, made, name, false))
        };
        let bound: Vec<_> = modules.iter().map(|one| threads.spawn(move || bind_one(one))).collect();
        bound.into_iter().try_for_each(|thread| thread.join().map_err(|_| "wasm-bindgen panicked")?)
    })
}

/// A module as cargo left it.
fn linked(profile: Profile, module: &str) -> Outcome<PathBuf> {
    let [_, folder] = profile.names();
    Ok(format!("{}/{TARGET}/{folder}/{module}.wasm", target_directory()?).into())
}

fn bindings(profile: Profile, module: &str, folder: &Path, name: &str, typescript: bool) -> Outcome {
    bind(&linked(profile, module)?, folder, name, typescript)
}

fn bind(wasm: &Path, folder: &Path, name: &str, typescript: bool) -> Outcome {
    let fault = |error| format!("wasm-bindgen: {error:#}");
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).out_name(name).typescript(typescript).web(true).map_err(fault)?;
    // The parts share the table of functions, which the linker made.
    bindgen.keep_lld_exports([page::MODULE, page::WORKER].contains(&name));
    // Names are not kept, so none needs to be made readable.
    bindgen.demangle(false).remove_name_section(true).remove_producers_section(true);
    bindgen.generate(folder).map_err(fault)
}

/// The files of a folder, without those of the folders in it.
fn files(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    files.sort();
    Ok(files)
}

/// Leaves an empty folder.
pub fn empty(folder: &Path) -> Outcome {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Writes a file, naming it when that fails.
pub fn write(path: &Path, bytes: &[u8]) -> Outcome {
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

fn report(what: &str, wasm: &Path) {
    let size = fs::metadata(wasm).map_or(0, |file| file.len());
    println!("{what}/ is ready ({} of {} kB)", wasm.file_name().unwrap_or_default().to_string_lossy(), size / 1024);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_functions_are_told_from_other_sections() {
        let module = b"\0asm\x01\0\0\0\x01\x02xy\x00\x08\x04linkabc\x00\x87\x00\x04namef1\x0a\x01z";
        assert_eq!(names(module), Some(&b"f1"[..]));
        assert_eq!(names(&module[..12]), None);
    }
}
