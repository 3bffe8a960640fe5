//! Cargo's runner of wasm tests: wasm-bindgen's, in Node.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Without the `--quiet` that `cargo test -q` hands on, which wasm-bindgen's runner does not know.
    let arguments = std::env::args().filter(|argument| argument != "--quiet");
    match wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}
