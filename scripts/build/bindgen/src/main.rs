//! `wasm-bindgen` with the options that scripts/build/wasm.mjs passes, spelled as the official command spells them, which may stand in for it.

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(mut args: impl Iterator<Item = String>) -> Result<(), String> {
    let mut bindgen = Bindgen::new();
    let mut folder = None;
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("{arg} needs a value"));
        match arg.as_str() {
            "--version" => {
                println!("wasm-bindgen {}", env!("CARGO_PKG_VERSION"));
                return Ok(());
            }
            "--target" => match value()?.as_str() {
                "web" => bindgen.web(true).map_err(|error| format!("{error:#}"))?,
                other => return Err(format!("--target must be web, not {other}")),
            },
            "--out-dir" => {
                folder = Some(value()?);
                continue;
            }
            "--out-name" => bindgen.out_name(&value()?),
            "--experimental-reset-state-function" => bindgen.reset_state_function(true),
            option if option.starts_with('-') => return Err(format!("there is no option {option}")),
            file => bindgen.input_path(file),
        };
    }
    let folder = folder.ok_or("--out-dir is missing")?;
    // As the official command has it.
    bindgen.typescript(true).omit_default_module_path(false);
    bindgen.generate(folder).map_err(|error| format!("{error:#}"))
}
