//! Entry points for build scripts: every spec of a folder becomes a module.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use abbe_spec::{Diagnostic, Diagnostics, Spec};

use crate::print;

/// Generates a module for every spec (`*.toml`) in a folder, for `abbe::include_manipulators!()` to
/// include. Studies, maps and plans (`*.study.toml`, …) are skipped.
///
/// Call it from a build script. If a spec has mistakes, it prints all of them and exits with status
/// 1.
pub fn compile(specs: impl AsRef<Path>) {
    let specs = specs.as_ref();
    println!("cargo:rerun-if-changed={}", specs.display());
    let out = std::env::var_os("OUT_DIR").map(PathBuf::from);
    match out.map_or(Err(CompileError::NotABuildScript), |out| compile_into(specs, &out)) {
        Ok(files) => {
            for file in files {
                println!("cargo:rerun-if-changed={}", file.display());
            }
        }
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(1);
        }
    }
}

/// Generates a module for every `*.toml` in `specs`, and `abbe_manipulators.rs` that includes them,
/// in `out`.
///
/// Returns the paths of the specs, sorted by name, followed by the paths of their table files. A
/// file whose contents would not change is left untouched. If any spec has a mistake, nothing is
/// written.
pub fn compile_into(specs: &Path, out: &Path) -> Result<Vec<PathBuf>, CompileError> {
    let mut files = spec_files(specs)?;
    let mut read: Vec<Spec> = Vec::new();
    let mut mistaken = Vec::new();
    for file in &files {
        match Spec::read(file) {
            Ok(spec) => match read.iter().find(|other| other.name == spec.name) {
                Some(other) => {
                    let message =
                        format!("duplicate manipulator name `{}`: also in `{}`", spec.name, other.file);
                    let mistake = Diagnostic::whole_file(message).help("rename one of them");
                    let path = file.display().to_string();
                    mistaken.push(Diagnostics { path, text: "".into(), list: vec![mistake] });
                }
                None => read.push(spec),
            },
            Err(diagnostics) => mistaken.push(diagnostics),
        }
    }
    if !mistaken.is_empty() {
        return Err(CompileError::Specs(mistaken));
    }
    let mut index = String::new();
    files.extend(read.iter().flat_map(|spec| spec.beside.iter().cloned()));
    for spec in &read {
        let file = format!("abbe_{}.rs", spec.name);
        write_if_changed(&out.join(&file), &print::rust(spec))?;
        index.push_str(&format!("include!(concat!(env!(\"OUT_DIR\"), \"/{file}\"));\n"));
    }
    write_if_changed(&out.join("abbe_manipulators.rs"), &index)?;
    Ok(files)
}

fn spec_files(specs: &Path) -> Result<Vec<PathBuf>, CompileError> {
    let failed = |error| CompileError::Io(specs.to_owned(), error);
    let mut files = Vec::new();
    for entry in fs::read_dir(specs).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") && !is_companion(&path) {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(CompileError::NoSpecs(specs.to_owned()));
    }
    files.sort();
    Ok(files)
}

/// Returns `true` for a file that accompanies a spec: `arm.study.toml`, `arm.map.toml`,
/// `arm.plan.toml`.
fn is_companion(path: &Path) -> bool {
    let kind = path.file_stem().map(Path::new).and_then(Path::extension);
    kind.is_some_and(|kind| ["study", "map", "plan"].iter().any(|companion| kind == *companion))
}

/// Writes `text` atomically (a temporary file is renamed), and only if the file differs.
fn write_if_changed(path: &Path, text: &str) -> Result<(), CompileError> {
    let failed = |error| CompileError::Io(path.to_owned(), error);
    if fs::read_to_string(path).is_ok_and(|found| found == text) {
        return Ok(());
    }
    let partial = path.with_extension("partial");
    fs::write(&partial, text).map_err(failed)?;
    fs::rename(&partial, path).map_err(failed)
}

/// Reason why a folder of specs could not be compiled.
#[derive(Debug)]
pub enum CompileError {
    /// A folder or file could not be read or written.
    Io(PathBuf, io::Error),
    /// The folder contains no `*.toml`.
    NoSpecs(PathBuf),
    /// `OUT_DIR` is not set, so the caller is not a build script.
    NotABuildScript,
    /// One or more specs have mistakes.
    Specs(Vec<Diagnostics>),
}

impl std::error::Error for CompileError {}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(path, error) => write!(f, "error: {}: {error}", path.display()),
            Self::NoSpecs(path) => write!(f, "error: there is no spec (*.toml) in {}", path.display()),
            Self::NotABuildScript => {
                write!(f, "error: OUT_DIR is not set: call `compile` from a build script")
            }
            Self::Specs(all) => {
                let shown: Vec<String> = all.iter().map(Diagnostics::to_string).collect();
                write!(f, "{}", shown.join("\n\n"))
            }
        }
    }
}
