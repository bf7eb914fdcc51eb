//! Shortens the shaders, since what is built in is what is downloaded: everywhere by their comments, and in wasm by the names and spaces that only
//! people read. Tests and what `npm run bench -- --shaders` writes keep the names.

use std::collections::{BTreeMap, BTreeSet};
use std::{env, fs, path::Path};

const SHADERS: &str = "src/shading/shaders";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = env::var("OUT_DIR").expect("cargo sets it");
    let mut shaders = BTreeMap::new();
    for entry in fs::read_dir(SHADERS).expect("the shaders") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "wgsl") {
            println!("cargo:rerun-if-changed={}", path.display());
            let source = fs::read_to_string(&path).expect("a shader");
            shaders.insert(path.file_name().expect("a file").to_owned(), bare(&source));
        }
    }
    if env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|target| target == "wasm32") {
        let all: String = shaders.values().map(String::as_str).collect();
        let names = short_names(&tokens(&all));
        for source in shaders.values_mut() {
            *source = shortened(&tokens(source), &names);
        }
    }
    for (name, source) in &shaders {
        fs::write(Path::new(&out).join(name), source).expect("the folder for what is built");
    }
}

/// The shader without comments, indentation and empty lines.
fn bare(source: &str) -> String {
    let code = |line: &'_ str| line.split("//").next().unwrap_or_default().trim().to_string();
    source.lines().map(code).filter(|line| !line.is_empty()).map(|line| line + "\n").collect()
}

fn is_wordy(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Words, numbers, and single other characters; what is in the parentheses of an attribute is one token with it. Without spaces.
pub(crate) fn tokens(source: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = source.trim_start();
    while let Some(first) = rest.chars().next() {
        let up_to = |is_part: &dyn Fn(char) -> bool| rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let length = match first {
            '@' => {
                let name = 1 + rest[1..].find(|c| !is_wordy(c)).unwrap_or(rest.len() - 1);
                if rest[name..].starts_with('(') { rest.find(')').map_or(name, |end| end + 1) } else { name }
            }
            '0'..='9' => up_to(&|c| is_wordy(c) || c == '.'),
            c if is_wordy(c) => up_to(&is_wordy),
            _ if rest.starts_with("--") => 2,
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after.trim_start();
    }
    tokens
}

/// Two letters for each name that the shaders give to a variable, a constant, a function or a member of a struct. Overrides, which are told by
/// their names elsewhere, keep theirs, and so does what is also the name of something built in, as every choice of a vector's parts is.
pub(crate) fn short_names(tokens: &[&str]) -> BTreeMap<String, String> {
    let mut given = BTreeSet::new();
    let mut functions = BTreeSet::new();
    let mut kept = BTreeSet::from(["vs_main", "fs_main"]);
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    for (at, &token) in tokens.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|before| tokens.get(before)).copied().unwrap_or_default();
        let after = tokens.get(at + 1).copied().unwrap_or_default();
        if !token.starts_with(|c: char| c.is_ascii_alphabetic()) {
            continue;
        }
        *uses.entry(token).or_default() += 1;
        match before {
            // After `var<private>` as well.
            "let" | "var" | "const" | ">" if after == ":" || after == "=" => drop(given.insert(token)),
            "fn" => drop((given.insert(token), functions.insert(token))),
            "override" | "struct" => drop(kept.insert(token)),
            _ if after == ":" => drop(given.insert(token)),
            _ => {}
        }
    }
    for pair in tokens.windows(2) {
        if let &[name, "("] = pair
            && !functions.contains(name)
        {
            kept.insert(name);
        }
    }
    let is_choice = |name: &str| name.chars().all(|part| "xyzwrgba".contains(part));
    let mut names: Vec<&str> =
        given.difference(&kept).copied().filter(|name| name.len() > 2 && !is_choice(name)).collect();
    names.sort_by_key(|name| std::cmp::Reverse(uses.get(name).copied().unwrap_or_default()));
    let short = ('a'..='z').flat_map(|first| ('A'..='Z').map(move |second| [first, second].iter().collect::<String>()));
    names.into_iter().map(str::to_string).zip(short).collect()
}

/// The tokens with short names, and spaces only where two words or two signs meet.
pub(crate) fn shortened(tokens: &[&str], names: &BTreeMap<String, String>) -> String {
    let mut out = String::new();
    for &token in tokens {
        let short = names.get(token).map_or_else(|| short_number(token), String::as_str);
        // A number may begin with its point.
        let is_word =
            out.ends_with(is_wordy) && (short.starts_with(is_wordy) || short.len() > 1 && short.starts_with('.'));
        if is_word || out.ends_with('-') && short == "-" {
            out.push(' ');
        }
        out.push_str(short);
    }
    out.push('\n');
    out
}

/// The same number without a zero that says nothing.
fn short_number(token: &str) -> &str {
    match token.strip_suffix('0') {
        Some(whole) if whole.ends_with('.') => whole,
        _ => token.strip_prefix('0').filter(|rest| rest.starts_with('.')).unwrap_or(token),
    }
}
