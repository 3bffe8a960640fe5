//! `cargo xtask test`: every suite, one after the other, and one line that sums them up.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::time::Instant;

use crate::install::{self, TARGET};
use crate::process::{cargo, program, root, run, watch};
use crate::{Outcome, build, serve, single};

/// Tests counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Count {
    passed: usize,
    failed: usize,
    skipped: usize,
}

/// A suite: its name on the command line and how it runs.
type Suite = (&'static str, fn(&Products) -> Outcome<Count>);

/// What several suites are run on, built once, when the first of them needs it.
struct Products {
    /// Whether the page is among what is wanted: then it is compiled together with pkg/.
    with_page: bool,
    built: OnceCell<Outcome>,
}

impl Products {
    fn build(&self) -> Outcome {
        let build = || if self.with_page { build::all() } else { build::pkg() };
        self.built.get_or_init(build).clone()
    }
}

const SUITES: [Suite; 5] = [("native", native), ("wasm", wasm), ("face", face), ("types", types), ("page", browser)];

/// `test [suite ...]`.
pub fn command(names: &[String]) -> Outcome {
    if let Some(name) = names.iter().find(|name| SUITES.iter().all(|(suite, _)| suite != name)) {
        let known = SUITES.map(|(suite, _)| suite).join(", ");
        return Err(format!("there is no suite {name}; the suites are {known}"));
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| wanted == name);
    let products = Products { with_page: wanted("page"), built: OnceCell::new() };
    let (mut total, mut lines) = (Count::default(), Vec::new());
    for (name, suite) in SUITES {
        if !wanted(name) {
            continue;
        }
        println!("== {name}");
        let began = Instant::now();
        let (count, note) = match suite(&products) {
            Ok(count) => (count, String::new()),
            // A suite that cannot run is a failure, and the others still say what they have to say.
            Err(message) => (Count { failed: 1, ..Count::default() }, format!(": {message}")),
        };
        total = total.plus(count);
        let seconds = began.elapsed().as_secs();
        lines.push(format!("{name}: {count} in {seconds} s{note}"));
    }
    println!("==\n{}", lines.join("\n"));
    println!("{total}");
    if total.failed == 0 { Ok(()) } else { Err("the tests failed".into()) }
}

fn native(_: &Products) -> Outcome<Count> {
    // Sheets of targets are printed and measured.
    install::poppler();
    // Tests whose data is missing pass and write their names here.
    let list = format!("{}/skipped-tests", build::target_directory()?);
    let _ = std::fs::remove_file(&list);
    let mut command = cargo(&["test", "--no-fail-fast"]);
    let mut count = counted(command.args(build::NATIVE).env("SIGHTLINE_SKIPPED", &list), rust_count)?;
    let skipped: BTreeSet<String> =
        std::fs::read_to_string(&list).unwrap_or_default().lines().map(str::to_owned).collect();
    count.skipped += skipped.len();
    count.passed = count.passed.saturating_sub(skipped.len());
    // By itself, as it was built to run this.
    Ok(count.plus(counted(&mut cargo(&["test", "--package", "xtask"]), rust_count)?))
}

/// The engine's unit tests as wasm. What it does from outside is compared with the native engine in the face suite.
fn wasm(_: &Products) -> Outcome<Count> {
    install::target()?;
    install::node()?;
    counted(&mut cargo(&["test", "--target", TARGET, "--package", "sightline", "--lib", "--no-fail-fast"]), rust_count)
}

fn face(products: &Products) -> Outcome<Count> {
    install::packages()?;
    products.build()?;
    // Its numbers are compared with those that the engine gives natively.
    node_tests("tests/face", &[("SIGHTLINE_EXAMPLES", &build::examples()?)])
}

/// The declarations of pkg/ with a program that uses them, under the strictest compiler.
fn types(products: &Products) -> Outcome<Count> {
    install::packages()?;
    products.build()?;
    let compiled = watch(
        &mut program("node", &["e2e/node_modules/typescript/bin/tsc", "--project", "tests/face/tsconfig.json"]),
        |_| (),
    )?;
    Ok(Count { passed: usize::from(compiled), failed: usize::from(!compiled), skipped: 0 })
}

/// The page in a headless browser, against a server of dist/.
fn browser(products: &Products) -> Outcome<Count> {
    install::packages()?;
    install::poppler();
    let chromium = install::chromium()?;
    install::korean_font();
    // The page's numbers are compared with those that Node has.
    products.build()?;
    single::write_to(&root().join("dist"))?;
    let address = serve::background(root().join("dist"))?;
    // Photos in formats that only a program writes.
    let examples = build::examples()?;
    node_tests("e2e", &[("SIGHTLINE_URL", &address), ("CHROMIUM", &chromium), ("SIGHTLINE_EXAMPLES", &examples)])
}

/// What lasts, for `cargo xtask bench field`: a hundred large photos in one sitting, a million damaged calls of the face, and the page killed
/// 200 times, of which the tests do a few.
pub fn field() -> Outcome {
    install::packages()?;
    let chromium = install::chromium()?;
    build::all()?;
    let address = serve::background(root().join("dist"))?;
    run(program("node", &["benches/field.mjs", "dist"]).env("CHROMIUM", &chromium))?;
    let calls = ["--test", "--test-reporter=spec", "tests/face/calls.test.mjs"];
    run(program("node", &calls).env("SIGHTLINE_CALLS", "1000000"))?;
    let mut command = program("node", &["--test", "--test-reporter=spec", "e2e/kills.test.mjs"]);
    command.envs([("SIGHTLINE_URL", address.as_str()), ("CHROMIUM", &chromium), ("SIGHTLINE_KILLS", "200")]);
    run(&mut command)
}

/// The `*.test.mjs` of a folder under Node's own test runner.
fn node_tests(folder: &str, variables: &[(&str, &str)]) -> Outcome<Count> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(root().join(folder)).map_err(|error| format!("{folder}: {error}"))? {
        let name = entry.map_err(|error| format!("{folder}: {error}"))?.file_name();
        files.extend(name.to_str().filter(|name| name.ends_with(".test.mjs")).map(|name| format!("{folder}/{name}")));
    }
    if files.is_empty() {
        return Err(format!("{folder} holds no *.test.mjs"));
    }
    files.sort();
    // Forced to exit: what a failed test leaves open (a browser) must not keep the run from ending.
    let flags = ["--test", "--test-concurrency=1", "--test-force-exit", "--test-reporter=spec"];
    let mut command = program("node", &flags);
    command.args(&files).envs(variables.iter().copied());
    counted(&mut command, node_count)
}

/// Runs a program that reports tests; one that fails without a failed test counts as one.
fn counted(command: &mut std::process::Command, count: fn(&str) -> Count) -> Outcome<Count> {
    let mut total = Count::default();
    let succeeded = watch(command, |line| total = total.plus(count(line)))?;
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
        let sum = Count { passed: 12, failed: 0, skipped: 1 };
        assert_eq!(
            (sum.to_string(), Count { skipped: 0, ..sum }.to_string()),
            ("12 passed, 0 failed, 1 skipped".into(), "12 passed, 0 failed".into())
        );
        assert_eq!(node_count("ℹ suites 1"), Count::default());
    }
}
