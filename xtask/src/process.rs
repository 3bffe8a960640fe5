//! Running other programs from the repository's root.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::Outcome;

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the repository").to_path_buf()
}

/// A program started in the root.
pub fn program(name: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(name);
    command.args(arguments).current_dir(root()).stdin(Stdio::null());
    command
}

/// Cargo, the same one that runs this.
pub fn cargo(arguments: &[&str]) -> Command {
    let mut command = program(&std::env::var("CARGO").unwrap_or_else(|_| "cargo".into()), arguments);
    // Set by the outer `cargo run` for this package alone; cargo would rebuild what looks at them.
    for (name, _) in std::env::vars_os() {
        if name.to_str().is_some_and(|name| name.starts_with("CARGO_PKG_") || name.starts_with("CARGO_MANIFEST_")) {
            command.env_remove(name);
        }
    }
    command
}

/// Runs it and checks for success.
pub fn run(command: &mut Command) -> Outcome {
    let name = describe(command);
    let status = command.status().map_err(|error| format!("{name}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name}: failed ({status})")) }
}

/// Standard output of a program that succeeds.
pub fn output(command: &mut Command) -> Outcome<String> {
    let name = describe(command);
    let output = command.stderr(Stdio::inherit()).output().map_err(|error| format!("{name}: {error}"))?;
    if !output.status.success() {
        return Err(format!("{name}: failed ({})", output.status));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("{name}: its output is not UTF-8"))
}

/// Runs it, passes its output on to `out` line by line and shows each line to `look`; whether it succeeded.
pub fn watch(out: &mut dyn Write, command: &mut Command, mut look: impl FnMut(&str)) -> Outcome<bool> {
    let name = describe(command);
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(|error| format!("{name}: {error}"))?;
    let reader = BufReader::new(child.stdout.take().expect("piped above"));
    for line in reader.split(b'\n') {
        let line = line.map_err(|error| format!("{name}: {error}"))?;
        let text = String::from_utf8_lossy(&line);
        // A closed standard output (head, a dropped terminal) must not end the tests.
        let _ = writeln!(out, "{text}").and_then(|()| out.flush());
        look(&text);
    }
    Ok(child.wait().map_err(|error| format!("{name}: {error}"))?.success())
}

/// Whether a program can be started at all.
pub fn exists(name: &str) -> bool {
    Command::new(name)
        .arg("--version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok()
}

fn describe(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).take(6).collect::<Vec<_>>().join(" ")
}
