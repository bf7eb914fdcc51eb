//! Takes the comments out of the shaders, which make a third of their text: what is built in is what is downloaded.

use std::{env, fs, path::Path};

const SHADERS: &str = "src/shading/shaders";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = env::var("OUT_DIR").expect("cargo sets it");
    for entry in fs::read_dir(SHADERS).expect("the shaders") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "wgsl") {
            println!("cargo:rerun-if-changed={}", path.display());
            let source = fs::read_to_string(&path).expect("a shader");
            let name = path.file_name().expect("a file");
            fs::write(Path::new(&out).join(name), bare(&source)).expect("the folder for what is built");
        }
    }
}

/// The shader without comments, indentation and empty lines.
fn bare(source: &str) -> String {
    let code = |line: &'_ str| line.split("//").next().unwrap_or_default().trim().to_string();
    source.lines().map(code).filter(|line| !line.is_empty()).map(|line| line + "\n").collect()
}
