//! Compile time, code size and speed of generated modules, in crates created below the target
//! folder.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use abbe_codegen::print;
use abbe_spec::Spec;
use abbe_tests::chains::general_chain;

/// Compiles the modules of chains of these lengths, and compares their speed with a loop on
/// nalgebra matrices.
pub(crate) fn report(lengths: &[usize]) -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let place = target.join("growth");
    let package = |name: &str, dependencies: &str| {
        format!(
            "[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[dependencies]\n\
             abbe = {{ path = {:?} }}\n{dependencies}",
            root.join("runtime")
        )
    };
    let write = |name: &str, file: &str, text: &str| -> std::io::Result<()> {
        let folder = place.join(name);
        fs::create_dir_all(folder.join("src"))?;
        fs::write(folder.join(file), text)
    };
    let names: Vec<String> = lengths.iter().map(|frames| format!("chain{frames}")).collect();
    let mut dependencies = "nalgebra = \"0.35\"\n".to_owned();
    let mut runs = String::new();
    for (name, &frames) in names.iter().zip(lengths) {
        let spec =
            Spec::parse("chain.toml", &general_chain(frames)).map_err(|mistakes| mistakes.to_string())?;
        write(name, "Cargo.toml", &package(name, ""))?;
        write(name, "src/lib.rs", &print::rust(&spec))?;
        dependencies.push_str(&format!("{name} = {{ path = \"../{name}\" }}\n"));
        runs.push_str(&format!("    run!({name});\n"));
    }
    let main = include_str!("run.rs.txt").replace("    // runs\n", &runs);
    let frame_loop = root.join("tests/src/frame_loop.rs");
    write("run", "Cargo.toml", &package("run", &dependencies))?;
    write("run", "src/main.rs", &main.replace("frame_loop.rs", &frame_loop.display().to_string()))?;
    let members = names.iter().map(|name| format!("{name:?}, ")).collect::<String>();
    fs::write(
        place.join("Cargo.toml"),
        format!("[workspace]\nresolver = \"3\"\nmembers = [{members}\"run\"]\n"),
    )?;
    fs::copy(root.join("Cargo.lock"), place.join("Cargo.lock"))?;

    let cargo = |arguments: &[&str]| -> Result<f64, Box<dyn Error>> {
        let start = Instant::now();
        let status = Command::new(env!("CARGO"))
            .args(arguments)
            .args(["--release", "--quiet", "--offline"])
            .env("CARGO_TARGET_DIR", place.join("target"))
            .current_dir(&place)
            .status()?;
        let seconds = start.elapsed().as_secs_f64();
        if status.success() { Ok(seconds) } else { Err(format!("cargo {arguments:?}: {status}").into()) }
    };
    cargo(&["build", "-p", "abbe"])?;
    println!("\n{:<12} {:>10} {:>10}", "", "compile s", "code kB");
    for name in &names {
        let source = place.join(name).join("src/lib.rs");
        fs::write(&source, fs::read_to_string(&source)?)?;
        let seconds = cargo(&["build", "-p", name])?;
        let library = place.join(format!("target/release/lib{name}.rlib"));
        println!("{name:<12} {seconds:>10.2} {:>10.1}", text_bytes(&library)? as f64 / 1e3);
    }
    println!();
    cargo(&["run", "-p", "run"])?;
    Ok(())
}

/// Returns the bytes of machine code in a library, as reported by `size`.
fn text_bytes(library: &Path) -> Result<u64, Box<dyn Error>> {
    let output = Command::new("size").arg(library).output()?;
    let lines = String::from_utf8(output.stdout)?;
    Ok(lines.lines().filter_map(|line| line.split_whitespace().next()?.parse::<u64>().ok()).sum())
}
