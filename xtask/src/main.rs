//! Builds, serves and tests Sightline: `cargo xtask <command>` is the whole interface, and installs nothing globally.

mod bench;
mod build;
mod check;
mod install;
mod kept;
mod notices;
mod offline;
mod page;
mod parts;
mod process;
mod release;
mod serve;
mod single;
mod suites;

use std::process::ExitCode;

use build::{Products, Profile};

/// Outcome of a command; the text is one line for the user.
type Outcome<T = ()> = Result<T, String>;

const USAGE: &str = "\
cargo xtask <command>
  serve [--port N]     build, serve the page on loopback and print the address (port 8080, or the next free one)
  build [--single-file]
                       leave the page in dist/ and the engine with its JavaScript face in pkg/; with --single-file also
                       dist/sightline.html, the whole page in one file that opens from a disk
  release              build everything into release/: the site, the page as one file, pkg, licences, digests
  test [all] [suite ...]
                       run every suite, or only those named: native wasm face types page; the daily extent, on modules that are
                       compiled fast. With `all` the full extent, on the modules that are handed out: see CONTRIBUTING.md
  bench [part ...]     measure the engine, or only the parts named: detect codes border growth estimation epochs orient field;
                       field takes in 100 large photos, makes a million damaged calls of the face and kills the page 200 times
  check                licences of the dependency tree, invariants of the code, the code map; works offline";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Outcome {
    let Some((command, rest)) = arguments.split_first() else { return Err(USAGE.into()) };
    match command.as_str() {
        "serve" => serve::command(rest),
        "build" => match rest {
            [flag] if flag == "--single-file" => {
                let products = Products::of(Profile::Release)?;
                products.build_all()?;
                single::write_to(&products.dist)
            }
            _ => {
                none_of(rest)?;
                Products::of(Profile::Release)?.build_all()
            }
        },
        "release" => {
            none_of(rest)?;
            release::command()
        }
        "test" => suites::command(rest),
        "bench" => bench::command(rest),
        "check" => {
            none_of(rest)?;
            check::command()
        }
        "help" | "--help" | "-h" => {
            println!("{USAGE}");
            Ok(())
        }
        other => Err(format!("there is no command {other}\n{USAGE}")),
    }
}

fn none_of(rest: &[String]) -> Outcome {
    rest.first().map_or(Ok(()), |extra| Err(format!("not understood: {extra}\n{USAGE}")))
}
