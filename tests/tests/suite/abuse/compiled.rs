//! Accepted specs compile without a warning: specs with hostile names, titles and expressions, each
//! a module of one crate.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe_codegen::print::rust;
use abbe_spec::Spec;
use abbe_tests::abuse::{Choices, spec};
use abbe_tests::chains::revolute_chain;

use super::watch::many;

/// Names of manipulators: modules and types of generated code.
const MANIPULATORS: [&str; 28] = [
    "default",
    "default_",
    "result",
    "option",
    "vec",
    "string",
    "some",
    "ok_",
    "none",
    "text",
    "list",
    "raw",
    "abbe",
    "std",
    "core",
    "clone",
    "debug",
    "copy",
    "send",
    "a__b",
    "_x",
    "x_",
    "frame",
    "parameters",
    "inputs",
    "description",
    "drop",
    "d1",
];

/// Checks a crate with these modules by the compiler. Returns its messages if it fails.
fn check(folder: &Path, modules: &[String]) -> Option<String> {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime").canonicalize().unwrap();
    let manifest = format!(
        "[package]\nname = \"hostile\"\nversion = \"0.0.0\"\nedition = \"2024\"\n[dependencies]\n\
         abbe = {{ path = {runtime:?} }}\n[workspace]\n"
    );
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    // The versions of the workspace, which are downloaded.
    fs::copy(runtime.join("../Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let mut root = "//! Hostile.\n#![deny(warnings)]\n".to_owned();
    for (i, module) in modules.iter().enumerate() {
        fs::write(folder.join(format!("src/m{i}.rs")), module).unwrap();
        root += &format!("pub mod m{i};\n");
    }
    fs::write(folder.join("src/lib.rs"), root).unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["check", "--quiet", "--offline"]).current_dir(folder);
    cargo.env("CARGO_TARGET_DIR", folder.join("target")).env_remove("RUSTFLAGS");
    let output = cargo.output().unwrap();
    (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Returns chains long enough for loops over almost nothing: no parameters, no moving joints, no
/// joints.
fn bare_chains() -> [String; 3] {
    let revolute = revolute_chain(40);
    let euler = |text: &str| text.replace("length = \"m\"", "length = \"m\"\norientation = \"euler-yzx\"");
    let rigid = "[manipulator]\nname = \"rigid\"\nlength = \"m\"\n".to_owned();
    let bar = |i| format!("[[frame]]\nname = \"bar {i}\"\ntransform = \"Tx(0.1) Rz(0.2)\"\n");
    [
        euler(&revolute),
        format!("{revolute}[parameters]\nidle = \"1 m\"\n"),
        euler(&(rigid + &(0..40).map(bar).collect::<String>())),
    ]
}

#[test]
fn accepted_specs_compile() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile");
    let _ = fs::remove_dir_all(folder.join("src"));
    let wanted = many(40) as usize;
    let bare = bare_chains().map(|text| rust(&Spec::parse("bare.toml", &text).unwrap()));
    let wanted = wanted + bare.len();
    let (mut modules, mut refused, mut first) = (Vec::from(bare), 0, String::new());
    for seed in 0.. {
        if modules.len() == wanted {
            break;
        }
        let name = MANIPULATORS[seed as usize % MANIPULATORS.len()];
        match Spec::parse("hostile \u{202e} */ `.toml", &spec(&mut Choices::seeded(seed), name)) {
            Ok(spec) => modules.push(format!("//! {seed}\n{}", rust(&spec))),
            Err(mistakes) => {
                refused += 1;
                first = if first.is_empty() { mistakes.to_string() } else { first };
            }
        }
    }
    println!("{wanted} modules, {refused} specs refused");
    assert!(refused < wanted / 2, "{refused} of {wanted} are refused: {first}");
    for (i, batch) in modules.chunks(200).enumerate() {
        if let Some(said) = check(&folder, batch) {
            let said: String = said.lines().take(120).map(|line| line.to_owned() + "\n").collect();
            panic!("batch {i}:\n{said}");
        }
    }
}
