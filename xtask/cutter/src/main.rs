//! `xtask-cutter MODULE FIRST FOLDER GLUE MAIN` cuts a module whose linker kept its relocations: the part that is needed first goes to the
//! file FIRST, those that come later to FOLDER; both find each other by the names of the glue that loads the parts and of that of the first.

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.as_slice() {
        [module, first, folder, glue, main] => cut(module, first, folder, glue, main),
        _ => Err("xtask-cutter MODULE FIRST FOLDER GLUE MAIN".into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("{fault}");
            ExitCode::FAILURE
        }
    }
}

fn cut(module: &str, first: &str, folder: &str, glue: &str, main: &str) -> Result<(), String> {
    let bytes = std::fs::read(module).map_err(|error| format!("{module}: {error}"))?;
    let mut options = wasm_split_cli_support::Options::new(&bytes);
    options.output_dir = Path::new(folder);
    options.main_out_path = Path::new(first);
    options.link_name = glue;
    options.main_module = main;
    wasm_split_cli_support::transform(options).map_err(|error| format!("wasm_split: {error:#}"))?;
    Ok(())
}
