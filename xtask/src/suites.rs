//! `cargo xtask test`: every suite, one after the other, and one line that sums them up.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;
use std::sync::OnceLock;
use std::time::Instant;

use crate::build::{self, Products, Profile};
use crate::install::{self, TARGET};
use crate::process::{cargo, program, root, run, watch};
use crate::{Outcome, serve, single};

/// Tests counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Count {
    passed: usize,
    failed: usize,
    skipped: usize,
}

/// How far the tests go.
#[derive(Clone, Copy, PartialEq)]
enum Extent {
    /// Daily extent for every change, on modules that are compiled fast: a part of the seeded cases, the engine's unit tests as wasm only.
    Daily,
    /// Everything, on the modules that are handed out.
    All,
}

/// A suite: its name on the command line and how it runs, with its output written to what is given.
type Suite = (&'static str, fn(&Run, &mut dyn Write) -> Outcome<Count>);

/// One run of the tests.
struct Run {
    extent: Extent,
    /// Whether the page is among the suites: then it is compiled together with pkg/.
    with_page: bool,
    products: Products,
    built: OnceLock<Outcome>,
}

impl Run {
    /// Builds what several suites test, once, when the first of them needs it.
    fn build(&self) -> Outcome {
        let build = || if self.with_page { self.products.build_all() } else { self.products.build_pkg() };
        self.built.get_or_init(build).clone()
    }

    fn is_all(&self) -> bool {
        self.extent == Extent::All
    }
}

const SUITES: [Suite; 6] =
    [("native", native), ("wasm", wasm), ("face", face), ("types", types), ("page", browser), ("peers", peers)];

/// `test [all] [suite ...]`.
pub fn command(arguments: &[String]) -> Outcome {
    let (extent, names) = match arguments {
        [first, names @ ..] if first == "all" => (Extent::All, names),
        names => (Extent::Daily, names),
    };
    if let Some(name) = names.iter().find(|name| SUITES.iter().all(|(suite, _)| suite != name)) {
        let known = SUITES.map(|(suite, _)| suite).join(", ");
        return Err(format!("there is no suite {name}; the suites are {known}"));
    }
    // Comparisons with other programs belong to the full extent, or are asked for.
    let usual = |name: &str| names.is_empty() && (name != "peers" || extent == Extent::All);
    let wanted = |name: &str| usual(name) || names.iter().any(|wanted| wanted == name);
    let profile = if extent == Extent::All { Profile::Release } else { Profile::Fast };
    let all = Run { extent, with_page: wanted("page"), products: Products::of(profile)?, built: OnceLock::new() };
    let wanted_suites = SUITES.into_iter().filter(|(name, _)| wanted(name));
    let (beside, after): (Vec<_>, Vec<_>) = wanted_suites.partition(|(name, _)| *name == "wasm" && wanted("native"));
    let run = |(name, suite): Suite, out: &mut dyn Write| {
        let _ = writeln!(out, "== {name}");
        let began = Instant::now();
        let (count, note) = match suite(&all, out) {
            Ok(count) => (count, String::new()),
            // A suite that cannot run is a failure, and the others still say what they have to say.
            Err(message) => (Count { failed: 1, ..Count::default() }, format!(": {message}")),
        };
        (count, format!("{name}: {count} in {} s{note}", began.elapsed().as_secs()))
    };
    let (mut total, mut lines) = (Count::default(), Vec::new());
    std::thread::scope(|threads| {
        // While native tests are compiled and run, one core or the other is often free: modules are built beside them, then their tests run.
        let second = wanted("native").then(|| {
            threads.spawn(|| {
                if ["face", "types", "page"].into_iter().any(wanted) {
                    // Tests that need them report a failure.
                    let _ = all.build();
                }
                let mut out = Vec::new();
                let done: Vec<_> = beside.into_iter().map(|suite| run(suite, &mut out)).collect();
                (done, out)
            })
        });
        let mut take = |(count, line): (Count, String)| {
            total = total.plus(count);
            lines.push(line);
        };
        let mut after = after.into_iter();
        if let Some(second) = second {
            after.next().map(|native| run(native, &mut std::io::stdout())).into_iter().for_each(&mut take);
            if let Ok((done, out)) = second.join() {
                let _ = std::io::stdout().write_all(&out);
                done.into_iter().for_each(&mut take);
            }
        }
        after.map(|suite| run(suite, &mut std::io::stdout())).for_each(take);
    });
    println!("==\n{}", lines.join("\n"));
    println!("{total}");
    if total.failed == 0 { Ok(()) } else { Err("the tests failed".into()) }
}

/// The engine from outside, and every other package; in the full extent the engine's unit tests and examples in its documentation too.
fn native(all: &Run, out: &mut dyn Write) -> Outcome<Count> {
    // Sheets of targets are printed and measured.
    install::poppler();
    // Tests whose data is missing pass and write their names here.
    let list = format!("{}/skipped-tests", build::target_directory()?);
    let _ = std::fs::remove_file(&list);
    let mut count = Count::default();
    let mut tests = |targets: &[&str], harness: &[&str]| {
        let mut command = cargo(&["test", "--no-fail-fast"]);
        command.args(targets).arg("--").args(harness).env("SIGHTLINE_SKIPPED", &list);
        if all.is_all() {
            command.env("SIGHTLINE_EXTENT", "all");
        }
        count = count.plus(counted(out, &mut command, rust_count)?);
        Ok::<_, String>(())
    };
    if all.is_all() {
        tests(&build::NATIVE, &["--include-ignored"])?;
    } else {
        tests(&[&build::NATIVE[..], &build::FROM_OUTSIDE].concat(), &[])?;
        // Without the engine's own, which run as wasm.
        tests(&[&build::NATIVE[build::ENGINE..], &["--lib", "--bins"]].concat(), &[])?;
    }
    // By itself, as it was built to run this.
    tests(&["--package", "xtask"], &[])?;
    let skipped: BTreeSet<String> =
        std::fs::read_to_string(&list).unwrap_or_default().lines().map(str::to_owned).collect();
    count.skipped += skipped.len();
    count.passed = count.passed.saturating_sub(skipped.len());
    Ok(count)
}

/// The engine's unit tests as wasm. What it does from outside is compared with the native engine in the face suite.
fn wasm(_: &Run, out: &mut dyn Write) -> Outcome<Count> {
    install::target()?;
    install::node()?;
    // Asked for together with the page's modules, so that dependencies have the features that those have, and are compiled once.
    let others = ["--package", "sightline-desk", "--package", "sightline-worker"];
    let mut command = cargo(&["test", "--target", TARGET, "--lib", "--no-fail-fast"]);
    counted(out, command.args(&build::NATIVE[..build::ENGINE]).args(others), rust_count)
}

fn face(all: &Run, out: &mut dyn Write) -> Outcome<Count> {
    install::packages()?;
    all.build()?;
    // Its numbers are compared with those that the engine gives natively.
    let pkg = text(&all.products.pkg)?;
    node_tests("tests/face", all, out, &[("SIGHTLINE_EXAMPLES", &build::examples()?), ("SIGHTLINE_PKG", &pkg)])
}

/// The declarations of pkg/ with a program that uses them, under the strictest compiler.
fn types(all: &Run, out: &mut dyn Write) -> Outcome<Count> {
    install::packages()?;
    all.build()?;
    let project = all.products.declarations_project()?;
    let compiled = watch(
        out,
        &mut program("node", &["e2e/node_modules/typescript/bin/tsc", "--project", &text(&project)?]),
        |_| (),
    )?;
    Ok(Count { passed: usize::from(compiled), failed: usize::from(!compiled), skipped: 0 })
}

/// Files of other programs against these programs, in the Python that has them: `SIGHTLINE_PYTHON`, or the usual one. What is not installed
/// there is skipped by name.
fn peers(_: &Run, out: &mut dyn Write) -> Outcome<Count> {
    let examples = build::examples()?;
    let python = std::env::var("SIGHTLINE_PYTHON").unwrap_or_else(|_| "python3".into());
    let numpy = std::process::Command::new(&python).args(["-c", "import numpy"]).output();
    if !numpy.is_ok_and(|output| output.status.success()) {
        let _ = writeln!(out, "skipped: {python} has no numpy");
        return Ok(Count { skipped: 1, ..Count::default() });
    }
    let mut all = Count::default();
    for (name, example) in [
        ("interchange", "interchange"),
        ("networks", "interchange"),
        ("equations", "equations"),
        ("calibration", "adjust"),
        ("grids", "grids"),
    ] {
        let (script, example) = (format!("tests/peers/{name}.py"), format!("{examples}/{example}"));
        let count = counted(out, &mut program(&python, &[&script, &example]), peers_count)?;
        all = Count {
            passed: all.passed + count.passed,
            failed: all.failed + count.failed,
            skipped: all.skipped + count.skipped,
        };
    }
    Ok(all)
}

/// "32 passed, 0 failed, 1 skipped", the last line of `tests/peers/interchange.py`.
fn peers_count(line: &str) -> Count {
    let words: Vec<&str> = line.split([' ', ',']).filter(|word| !word.is_empty()).collect();
    let [passed, "passed", failed, "failed", skipped, "skipped"] = words[..] else { return Count::default() };
    let number = |word: &str| word.parse().unwrap_or(0);
    Count { passed: number(passed), failed: number(failed), skipped: number(skipped) }
}

/// The page in a headless browser, against a server of dist/.
fn browser(all: &Run, out: &mut dyn Write) -> Outcome<Count> {
    install::packages()?;
    install::poppler();
    let chromium = install::chromium()?;
    install::korean_font();
    // The page's numbers are compared with those that Node has.
    all.build()?;
    single::write_to(&all.products.dist)?;
    let address = serve::background(all.products.dist.clone())?;
    let variables = [
        ("SIGHTLINE_URL", address),
        ("CHROMIUM", chromium),
        ("SIGHTLINE_PKG", text(&all.products.pkg)?),
        ("SIGHTLINE_DIST", text(&all.products.dist)?),
        // Photos in formats that only a program writes.
        ("SIGHTLINE_EXAMPLES", build::examples()?),
    ];
    let variables: Vec<_> = variables.iter().map(|(name, value)| (*name, value.as_str())).collect();
    node_tests("e2e", all, out, &variables)
}

fn text(path: &Path) -> Outcome<String> {
    path.to_str().map(str::to_owned).ok_or_else(|| format!("{} is not UTF-8", path.display()))
}

/// What lasts, for `cargo xtask bench field`: a hundred large photos in one sitting, a million damaged calls of the face, and the page killed
/// 200 times, of which the tests do a few.
pub fn field() -> Outcome {
    install::packages()?;
    let chromium = install::chromium()?;
    let products = Products::of(Profile::Release)?;
    products.build_all()?;
    let address = serve::background(products.dist)?;
    run(program("node", &["benches/field.mjs", "dist"]).env("CHROMIUM", &chromium))?;
    let calls = ["--test", "--test-reporter=spec", "tests/face/calls.test.mjs"];
    run(program("node", &calls).env("SIGHTLINE_CALLS", "1000000"))?;
    let mut command = program("node", &["--test", "--test-reporter=spec", "e2e/kills.test.mjs"]);
    command.envs([("SIGHTLINE_URL", address.as_str()), ("CHROMIUM", &chromium), ("SIGHTLINE_KILLS", "200")]);
    run(&mut command)
}

/// Tests of the page that only the full extent has: the sizes and parts of what is handed out, and other browsers.
const ONLY_ALL: [&str; 2] = ["browsers.test.mjs", "parts.test.mjs"];
/// Tests that measure how long something takes, or need all of the machine: none runs beside them.
const ALONE: [&str; 4] = ["calls.test.mjs", "experiments.test.mjs", "kills.test.mjs", "stopping.test.mjs"];

/// The `*.test.mjs` of a folder under Node's own test runner, two files at a time where they do not disturb each other.
fn node_tests(folder: &str, all: &Run, out: &mut dyn Write, variables: &[(&str, &str)]) -> Outcome<Count> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(root().join(folder)).map_err(|error| format!("{folder}: {error}"))? {
        let name = entry.map_err(|error| format!("{folder}: {error}"))?.file_name();
        names.extend(name.to_str().filter(|name| name.ends_with(".test.mjs")).map(str::to_owned));
    }
    if names.is_empty() {
        return Err(format!("{folder} holds no *.test.mjs"));
    }
    names.retain(|name| all.is_all() || !ONLY_ALL.contains(&name.as_str()));
    names.sort();
    let (alone, together): (Vec<_>, Vec<_>) = names.into_iter().partition(|name| ALONE.contains(&name.as_str()));
    let mut count = Count::default();
    for (files, at_a_time) in [(together, 2), (alone, 1)] {
        if files.is_empty() {
            continue;
        }
        // Forced to exit: what a failed test leaves open (a browser) must not keep the run from ending.
        let at_a_time = format!("--test-concurrency={at_a_time}");
        let mut command = program("node", &["--test", &at_a_time, "--test-force-exit", "--test-reporter=spec"]);
        command.args(files.iter().map(|name| format!("{folder}/{name}"))).envs(variables.iter().copied());
        if all.is_all() {
            command.env("SIGHTLINE_EXTENT", "all");
        }
        count = count.plus(counted(out, &mut command, node_count)?);
    }
    Ok(count)
}

/// Runs a program that reports tests; one that fails without a failed test counts as one.
fn counted(out: &mut dyn Write, command: &mut std::process::Command, count: fn(&str) -> Count) -> Outcome<Count> {
    let mut total = Count::default();
    let succeeded = watch(out, command, |line| total = total.plus(count(line)))?;
    if !succeeded && total.failed == 0 {
        total.failed = 1;
    }
    Ok(total)
}

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{} passed, {} failed", self.passed, self.failed)?;
        if self.skipped > 0 { write!(f, ", {} skipped", self.skipped) } else { Ok(()) }
    }
}

impl Count {
    fn plus(self, other: Self) -> Self {
        Self {
            passed: self.passed + other.passed,
            failed: self.failed + other.failed,
            skipped: self.skipped + other.skipped,
        }
    }
}

/// "test result: ok. 3 passed; 0 failed; …", of the standard harness and of wasm-bindgen-test.
fn rust_count(line: &str) -> Count {
    let Some((_, result)) = line.split_once("test result: ") else { return Count::default() };
    let number = |word: &str| {
        let words: Vec<&str> = result.split([' ', ';', '.']).filter(|part| !part.is_empty()).collect();
        words.windows(2).find(|pair| pair[1] == word).and_then(|pair| pair[0].parse().ok()).unwrap_or(0)
    };
    Count { passed: number("passed"), failed: number("failed"), skipped: number("ignored") }
}

/// "ℹ pass 3" and "ℹ fail 0" of Node's spec reporter; cancelled tests have failed.
fn node_count(line: &str) -> Count {
    let number =
        |word: &str| line.strip_prefix(&format!("ℹ {word} ")).and_then(|count| count.trim().parse().ok()).unwrap_or(0);
    Count { passed: number("pass"), failed: number("fail") + number("cancelled"), skipped: number("skipped") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_counted() {
        let rust = "test result: FAILED. 12 passed; 3 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.00s";
        assert_eq!(rust_count(rust), Count { passed: 12, failed: 3, skipped: 1 });
        assert_eq!(rust_count("test passed ... ok"), Count::default());
        assert_eq!(node_count("ℹ pass 7"), Count { passed: 7, ..Count::default() });
        assert_eq!(node_count("ℹ fail 2"), Count { failed: 2, ..Count::default() });
        assert_eq!(node_count("ℹ cancelled 1"), Count { failed: 1, ..Count::default() });
        assert_eq!(node_count("ℹ skipped 4"), Count { skipped: 4, ..Count::default() });
        assert_eq!(peers_count("32 passed, 1 failed, 2 skipped"), Count { passed: 32, failed: 1, skipped: 2 });
        assert_eq!(peers_count("ok  32 passed"), Count::default());
        let sum = Count { passed: 12, failed: 0, skipped: 1 };
        assert_eq!(
            (sum.to_string(), Count { skipped: 0, ..sum }.to_string()),
            ("12 passed, 0 failed, 1 skipped".into(), "12 passed, 0 failed".into())
        );
        assert_eq!(node_count("ℹ suites 1"), Count::default());
    }
}
