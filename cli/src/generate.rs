//! `abbe generate`: the closed form as source code.

use std::{ffi::OsString, path::PathBuf};

use abbe_study::Machine;
use abbe_study::generate::{self, Fmi, Language, Real, archive};
use clap::{Args, ValueHint};

use crate::arguments::{Writing, named};
use crate::output::{Outcome, Outputs, note};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe generate arm.toml --out arm.rs
  abbe generate arm.toml --lang c --out controller
  abbe generate arm.toml --lang c --real float --out controller
  abbe generate arm.toml --lang c --only compensated,pose --name left_arm --out controller
  abbe generate arm.toml --lang js --out arm.js
  abbe generate arm.toml --lang python --out arm.py
  abbe generate arm.toml --lang matlab --out arm.m
  abbe generate arm.toml --lang st --out arm.st         for CODESYS, TwinCAT and other PLCs
  abbe generate arm.toml --lang plcopen --out arm.xml   the same, to import in one step
  abbe generate arm.toml --lang fmu --out arm.fmu       for simulators
"))]
pub(crate) struct Generate {
    /// Path of a spec file (TOML), or name of a shipped manipulator
    #[arg(value_hint = ValueHint::FilePath)]
    spec: OsString,
    /// Language of the generated code
    #[arg(long, ignore_case = true, value_parser = named(generate::Generate::LANGUAGES), default_value = Language::Rust.name())]
    lang: Language,
    /// Floating-point type of the generated C: `float` for processors with single precision only.
    /// [default: double]
    #[arg(long, value_parser = named(generate::Generate::REALS))]
    real: Option<Real>,
    /// Write only these functions, separated by commas, and what they need; not in Rust and
    /// functional mock-up units. [default: all]
    #[arg(long, value_name = "FUNCTIONS")]
    only: Option<String>,
    /// Name in the code, such that several machines can be linked. [default: the spec's]
    #[arg(long)]
    name: Option<String>,
    /// FMI version of the unit that --lang fmu writes. [default: 3]
    #[arg(long, value_name = "VERSION", value_parser = named(generate::Generate::VERSIONS))]
    fmi: Option<Fmi>,
    /// Write to this file instead of stdout; C, which has a header and a source, writes into this
    /// folder
    #[arg(long, short, value_name = "PATH")]
    out: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
}

pub(crate) fn run(arguments: &Generate) -> Result<Outcome> {
    let language = language(arguments)?;
    let job = generate::Generate {
        machine: Machine::find(&arguments.spec)?,
        language,
        only: arguments.only.clone(),
        name: arguments.name.clone(),
    };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    if let Language::Fmu(_) = language {
        return unit(arguments, &job, outputs);
    }
    let files = job.run(&mut Console::default())?;
    let paths: Vec<PathBuf> = match (&arguments.out, &files[..]) {
        (None, [file]) => return Ok(Outcome::passed(file.text.clone())),
        (None, _) => {
            let message = format!("{} consists of {} files", language.name(), files.len());
            return Err(Failure::new("--lang", message).help("give a folder: `--out DIR`"));
        }
        (Some(file), [_]) => vec![file.clone()],
        (Some(folder), _) => {
            outputs.folder(folder)?;
            files.iter().map(|file| folder.join(&file.name)).collect()
        }
    };
    let texts = files.iter().map(|file| &file.text);
    outputs.write(paths.iter().cloned().zip(texts.clone()))?;
    for (path, text) in paths.iter().zip(texts) {
        note(&format!("wrote {}: {} lines, {} bytes", path.display(), text.lines().count(), text.len()));
    }
    Ok(Outcome::passed(String::new()))
}

/// Returns the language with its options: the number type of C, the FMI version of an FMU.
fn language(arguments: &Generate) -> Result<Language> {
    let language = match (arguments.lang, arguments.real) {
        (language, None) => language,
        (Language::C(_), Some(real)) => Language::C(real),
        (language, Some(real)) => {
            let message = format!("`--real` has no effect on {}", language.name());
            let help = format!("use `--lang c --real {}`, or leave `--real` out", real.name());
            return Err(Failure::new("--real", message).help(help));
        }
    };
    match (language, arguments.fmi) {
        (Language::Fmu(_), Some(fmi)) => Ok(Language::Fmu(fmi)),
        (_, Some(_)) => Err(Failure::new("--fmi", "`--fmi` has an effect on functional mock-up units only")
            .help("add `--lang fmu`, or leave `--fmi` out")),
        (language, None) => Ok(language),
    }
}

/// Writes a functional mock-up unit, an archive of all files.
fn unit(arguments: &Generate, job: &generate::Generate, outputs: Outputs) -> Result<Outcome> {
    let Some(path) = &arguments.out else {
        return Err(Failure::new("--lang", "a functional mock-up unit is an archive and cannot be printed")
            .help(format!("give a file: `--out {}.fmu`", job.machine.spec.name)));
    };
    let files = job.run(&mut Console::default())?;
    let archive = archive(&files);
    outputs.write([(path.clone(), &archive)])?;
    note(&format!("wrote {}: {} files, {} bytes", path.display(), files.len(), archive.len()));
    Ok(Outcome::passed(String::new()))
}
