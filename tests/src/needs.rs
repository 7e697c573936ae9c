//! Tests with requirements: public measurements, tools, or time. If a requirement is missing, the
//! test is reported as ignored, with the reason, never as passed. Each crate has one executable for
//! them, `tests/needs`, which has `harness = false` and [`run`] in `main`.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::thread;
use std::time::{Duration, Instant};

use libtest_mimic::{Arguments, Completion, Trial};

use crate::processes::{SECOND, WATCHDOG, processor_time};

/// Missing requirement: the reason why a test is ignored.
pub struct Missing(pub String);

/// Test that returns [`Missing`] if a requirement is missing, and panics if it fails.
pub type Test = fn() -> Result<(), Missing>;

/// Tests of a module, with their names.
pub type Tests = &'static [(&'static str, Test)];

/// Runs tests, named `module::name`.
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

/// Requires a thorough run: `ABBE_THOROUGH=1`.
///
/// # Errors
///
/// Returns [`Missing`] in an ordinary run.
pub fn thorough() -> Result<(), Missing> {
    if crate::thorough() { Ok(()) } else { Err(Missing("it takes long: ABBE_THOROUGH=1 runs it".to_owned())) }
}

/// Returns the path of a file of the public measurements of UR5 and WAM, in a folder beside the
/// repository.
///
/// # Errors
///
/// Returns [`Missing`] if there is no such file.
pub fn measured_data(file: &str) -> Result<PathBuf, Missing> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/ur5_wam_jacobi").join(file);
    if path.exists() { Ok(path) } else { Err(Missing(format!("the measured data are not here: {file}"))) }
}

/// Returns a Python with these modules: `PYTHON`, or `python3`.
///
/// # Errors
///
/// Returns [`Missing`] if it lacks one of them.
pub fn python(modules: &str) -> Result<String, Missing> {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let tried = Command::new(&python).args(["-c", &format!("import {modules}")]).output();
    match tried.is_ok_and(|output| output.status.success()) {
        true => Ok(python),
        false => Err(Missing(format!("{python} has no {modules}"))),
    }
}

/// Returns the output of `program --version`, which must end with `version` (any if empty).
///
/// # Errors
///
/// Returns [`Missing`] if the program is not installed, fails, or has another version.
pub fn tool(program: &str, version: &str) -> Result<String, Missing> {
    let output = Command::new(program).arg("--version").output();
    let printed = output.ok().filter(|output| output.status.success());
    let printed = printed.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    printed
        .filter(|printed| printed.ends_with(version))
        .ok_or_else(|| Missing(format!("{program} {version}").trim().to_owned() + " is not installed"))
}

/// Runs a command and returns whether it succeeds. A command that does not end within two minutes
/// of processor time, or within [`WATCHDOG`], is killed: it is in a loop without end.
///
/// # Panics
///
/// If the command cannot be started.
pub fn succeeds_in_time(command: &mut Command) -> bool {
    let mut run = command.spawn().expect("the command is there");
    let begun = Instant::now();
    while begun.elapsed() < WATCHDOG && processor_time(run.id()).is_none_or(|time| time < 120 * SECOND) {
        if let Some(status) = run.try_wait().expect("it was started") {
            return status.success();
        }
        thread::sleep(Duration::from_millis(10));
    }
    run.kill().and_then(|()| run.wait()).expect("it was started");
    false
}
