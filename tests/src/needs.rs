//! Tests that need what is not everywhere: measurements of others, tools, time. Where it is missing they are reported as
//! ignored, with the reason, never as passed. Of each crate they are one executable, `tests/needs`, which has
//! `harness = false` and [`run`] in `main`.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use libtest_mimic::{Arguments, Completion, Trial};

/// What is missing: the reason why a test is ignored.
pub struct Missing(pub String);

/// A test that may find what it needs missing. It panics where it fails.
pub type Test = fn() -> Result<(), Missing>;

/// The tests of a module, each with its name.
pub type Tests = &'static [(&'static str, Test)];

/// Runs tests by name, those of each module as `module::name`.
#[must_use]
pub fn run(modules: &[(&str, Tests)]) -> ExitCode {
    let trial = |module: &str, (name, test): &'static (&'static str, Test)| {
        Trial::ignorable_test(format!("{module}::{name}"), move || {
            Ok(test().map_or_else(|Missing(what)| Completion::ignored_with(what), |()| Completion::Completed))
        })
    };
    let trials = modules.iter().flat_map(|(module, tests)| tests.iter().map(|test| trial(module, test)));
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit_code()
}

/// Time for all that a test can do: `ABBE_THOROUGH=1`.
///
/// # Errors
///
/// Nobody asked for it.
pub fn thorough() -> Result<(), Missing> {
    if crate::thorough() { Ok(()) } else { Err(Missing("it takes long: ABBE_THOROUGH=1 runs it".to_owned())) }
}

/// A file of the public measurements of UR5 and WAM, which stand beside the repository, if at all.
///
/// # Errors
///
/// The file is not there.
pub fn measured_data(file: &str) -> Result<PathBuf, Missing> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/ur5_wam_jacobi").join(file);
    if path.exists() { Ok(path) } else { Err(Missing(format!("the measured data are not here: {file}"))) }
}

/// A Python that has these modules: `PYTHON`, or `python3`.
///
/// # Errors
///
/// It has not.
pub fn python(modules: &str) -> Result<String, Missing> {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let tried = Command::new(&python).args(["-c", &format!("import {modules}")]).output();
    match tried.is_ok_and(|output| output.status.success()) {
        true => Ok(python),
        false => Err(Missing(format!("{python} has no {modules}"))),
    }
}

/// What `program --version` prints, which must end with that version (an empty one: any).
///
/// # Errors
///
/// The program is not there, fails, or is of another version.
pub fn tool(program: &str, version: &str) -> Result<String, Missing> {
    let output = Command::new(program).arg("--version").output();
    let printed = output.ok().filter(|output| output.status.success());
    let printed = printed.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    printed
        .filter(|printed| printed.ends_with(version))
        .ok_or_else(|| Missing(format!("{program} {version}").trim().to_owned() + " is not installed"))
}
