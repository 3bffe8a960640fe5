//! Cargo's runner of wasm tests: a test module is bound by wasm-bindgen's library and run in Node. What wasm-bindgen's own runner does beside
//! that (browsers, their drivers, a server) needs crates that are no longer maintained.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use wasm_bindgen_cli_support::Bindgen;

/// Exports of tests begin with this; then come the test's marks, '_' and its path, whose first part is the crate.
const TEST: &str = "__wbgt_";
/// The mark of a test that is ignored.
const IGNORED: char = '$';

/// Arguments passed on by cargo, as for the standard harness.
#[derive(Debug, Default, PartialEq)]
struct Arguments {
    module: PathBuf,
    filters: Vec<String>,
    skip: Vec<String>,
    exact: bool,
    ignored: bool,
    include_ignored: bool,
    nocapture: bool,
    list: bool,
}

fn arguments(all: impl Iterator<Item = String>) -> Result<Arguments, String> {
    let mut arguments = Arguments::default();
    let mut all = all.peekable();
    arguments.module = all.next().ok_or("no module is given")?.into();
    while let Some(argument) = all.next() {
        match argument.as_str() {
            "--exact" => arguments.exact = true,
            "--ignored" => arguments.ignored = true,
            "--include-ignored" => arguments.include_ignored = true,
            "--nocapture" | "--no-capture" => arguments.nocapture = true,
            "--list" => arguments.list = true,
            // What is printed is short in any case.
            "--quiet" | "-q" => {}
            "--skip" => arguments.skip.push(all.next().ok_or("--skip needs a name")?),
            flag if flag.starts_with('-') => return Err(format!("{flag} is not known to the runner of wasm tests")),
            _ => arguments.filters.push(argument),
        }
    }
    Ok(arguments)
}

/// A test: its name and its export.
#[derive(Debug, PartialEq)]
struct Test {
    name: String,
    export: String,
}

/// The tests that are wanted of a module's exports, and how many others there are.
fn wanted<'a>(arguments: &Arguments, exports: impl Iterator<Item = &'a str>) -> (Vec<Test>, usize) {
    let matches = |name: &str, filter: &String| if arguments.exact { name == filter } else { name.contains(filter) };
    let (mut tests, mut others) = (Vec::new(), 0);
    for export in exports {
        let Some((marks, _)) = export.strip_prefix(TEST).and_then(|rest| rest.split_once('_')) else { continue };
        let Some((_, name)) = export.split_once("::") else { continue };
        let any = |filters: &[String]| filters.iter().any(|filter| matches(name, filter));
        let asked = arguments.filters.is_empty() || any(&arguments.filters);
        if asked && !any(&arguments.skip) && (marks.contains(IGNORED) || !arguments.ignored) {
            tests.push(Test { name: name.to_owned(), export: export.to_owned() });
        } else {
            others += 1;
        }
    }
    (tests, others)
}

/// The script that runs tests: what they write to the console goes to the harness, which shows it where a test fails.
fn script(arguments: &Arguments, tests: &[Test], others: usize) -> String {
    let exports = tests.iter().map(|test| format!("  {:?},\n", test.export)).collect::<String>();
    let (nocapture, ignored) = (arguments.nocapture, arguments.include_ignored || arguments.ignored);
    format!(
        "const {{ exit }} = require('node:process');
const handlers = {{}};
global.__wbgtest_og_console_log = console.log;
global.__wbgtest_og_console_error = console.error;
for (const method of ['debug', 'log', 'info', 'warn', 'error']) {{
  const own = console[method];
  console[method] = (...words) => {{
    if ({nocapture}) own.apply(console, words);
    handlers[method]?.(words);
  }};
}}
// After that, so that the module takes this console.
const wasm = require('./{NAME}.js');
for (const method of ['debug', 'log', 'info', 'warn', 'error']) handlers[method] = wasm[`__wbgtest_console_${{method}}`];
global.__wbg_test_invoke = (work) => work();
const context = new wasm.WasmBindgenTestContext(false);
context.include_ignored({ignored});
context.filtered_count({others});
const tests = [
{exports}];
context.run(tests.map((name) => wasm.__wasm[name])).then(
  (passed) => exit(passed ? 0 : 1),
  (error) => {{
    global.__wbgtest_og_console_error(error);
    exit(1);
  }},
);
"
    )
}

/// Name of the bound module.
const NAME: &str = "wasm-tests";

fn run(arguments: &Arguments) -> Result<bool, String> {
    let bytes = fs::read(&arguments.module).map_err(|error| format!("{}: {error}", arguments.module.display()))?;
    let fault = |error: &dyn std::fmt::Display| format!("{}: {error:#}", arguments.module.display());
    let mut module = walrus::ModuleConfig::new().generate_dwarf(true).parse(&bytes).map_err(|error| fault(&error))?;
    // It would say in which browser: Node runs all of them.
    module.customs.remove_raw("__wasm_bindgen_test_unstable");
    let exports = module.exports.iter().map(|export| export.name.clone()).collect::<Vec<_>>();
    let (tests, others) = wanted(arguments, exports.iter().map(String::as_str));
    if arguments.list {
        tests.iter().for_each(|test| println!("{}: test", test.name));
        return Ok(true);
    }
    if tests.is_empty() {
        // What runs tests is linked only where there are some.
        println!("no tests to run!");
        return Ok(true);
    }
    let folder = std::env::temp_dir().join(format!("sightline-wasm-tests-{}", std::process::id()));
    let outcome = bound(module, &folder)
        .and_then(|()| in_node(&folder, &script(arguments, &tests, others)))
        .map_err(|error| fault(&error));
    let _ = fs::remove_dir_all(&folder);
    outcome
}

fn bound(module: walrus::Module, folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    let fault = |error| format!("wasm-bindgen: {error:#}");
    let mut bindgen = Bindgen::new();
    bindgen.nodejs(true).map_err(fault)?;
    // Tests are exports of the module itself, which the glue gives away as `__wasm`.
    bindgen.debug(true).export_wasm(true).input_module(NAME, module).emit_start(false).generate(folder).map_err(fault)
}

fn in_node(folder: &Path, script: &str) -> Result<bool, String> {
    let file = folder.join("run.cjs");
    fs::write(&file, script).map_err(|error| error.to_string())?;
    let ended = Command::new("node").arg("--expose-gc").arg(file).status().map_err(|error| format!("node: {error}"))?;
    Ok(ended.success())
}

fn main() -> ExitCode {
    match arguments(std::env::args().skip(1)).and_then(|arguments| run(&arguments)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(words: &str) -> Arguments {
        arguments(words.split(' ').map(str::to_owned)).expect("arguments")
    }

    #[test]
    fn tests_are_chosen_as_the_standard_harness_chooses_them() {
        let exports = ["memory", "__wbgt__a_0::one::works", "__wbgt_$_b_1::one::slow", "__wbgt__c_2::two::works"];
        let names = |words: &str| {
            let (tests, others) = wanted(&given(words), exports.into_iter());
            (tests.into_iter().map(|test| test.name).collect::<Vec<_>>().join(" "), others)
        };
        assert_eq!(names("m.wasm"), ("one::works one::slow two::works".into(), 0));
        assert_eq!(names("m.wasm one:: --quiet"), ("one::works one::slow".into(), 1));
        assert_eq!(names("m.wasm --exact works"), (String::new(), 3));
        assert_eq!(names("m.wasm --skip two --ignored"), ("one::slow".into(), 2));
        assert_eq!(names("m.wasm one::works two"), ("one::works two::works".into(), 1));
        assert!(arguments(["m.wasm", "--shuffle"].map(str::to_owned).into_iter()).is_err());
        assert!(arguments(std::iter::empty()).is_err());
    }
}
