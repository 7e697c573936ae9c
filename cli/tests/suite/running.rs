//! Runs the binary.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use abbe_tests::processes::{SECOND, processor_time, wait_for};
use serde_json::Value;
use tempfile::NamedTempFile;

/// Output and exit status of a run.
#[derive(Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) status: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// Creates a command whose output does not depend on the environment.
pub(crate) fn command<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_abbe"));
    command.args(arguments).env_remove("NO_COLOR").env_remove("COLUMNS").stdin(Stdio::null());
    command
}

pub(crate) fn abbe<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Run {
    let Output { status, stdout, stderr } = command(arguments).output().expect("the binary starts");
    let text = |bytes| String::from_utf8(bytes).expect("output is text");
    let run =
        Run { status: status.code().expect("no signal ends it"), stdout: text(stdout), stderr: text(stderr) };
    assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
    run
}

/// Limit of the processor time of a run, for an unoptimized build.
const LONGEST: u64 = 60 * SECOND;

/// Runs the command, which must end by itself and within a minute of processor time. Returns also
/// its processor time in hundredths of a second, if the system reports it.
pub(crate) fn ends<S: AsRef<std::ffi::OsStr>>(arguments: &[S], folder: Option<&Path>) -> (Run, u64) {
    let mut command = command(arguments);
    if let Some(folder) = folder {
        command.current_dir(folder);
    }
    let shown = format!("{command:?}");
    let heard = ["stdout", "stderr"].map(|_| NamedTempFile::new().unwrap());
    let [out, err] = heard.each_ref().map(|file| File::create(file.path()).unwrap());
    let mut child = command.stdout(out).stderr(err).spawn().expect("the binary starts");
    let (mut status, mut worked) = (None, 0);
    wait_for(&format!("the end of {shown}"), || {
        worked = processor_time(child.id()).unwrap_or(worked);
        status = child.try_wait().unwrap();
        if status.is_none() && worked > LONGEST {
            child.kill().unwrap();
            panic!("{shown} does not end");
        }
        status.is_some()
    });
    let status = status.and_then(|status| status.code()).unwrap_or_else(|| panic!("a signal ends {shown}"));
    let [stdout, stderr] = heard.map(|file| String::from_utf8(fs::read(file.path()).unwrap()).expect("text"));
    (Run { status, stdout, stderr }, worked)
}

/// Returns the stdout of a successful run.
pub(crate) fn prints<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> String {
    let run = abbe(arguments);
    assert_eq!(run.status, 0, "{}", run.stderr);
    run.stdout
}

/// Returns the stdout of a successful run with `--full`.
pub(crate) fn full(arguments: &[&str]) -> String {
    prints(&[arguments, &["--full"]].concat())
}

/// Returns the printed JSON: one line of finite numbers.
pub(crate) fn json<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Value {
    let text = prints(arguments);
    assert_eq!(text.lines().count(), 1);
    for word in text.split(|letter: char| !letter.is_alphanumeric()) {
        assert!(!["NaN", "nan", "Infinity", "inf"].contains(&word), "{word}");
    }
    assert!(!text.contains("-0.0,"));
    serde_json::from_str(&text).expect("this is JSON")
}

/// Asserts that a text fits a terminal of 100 columns.
pub(crate) fn narrow(text: &str) {
    let widest = text.lines().max_by_key(|line| line.chars().count()).unwrap_or_default();
    assert!(widest.chars().count() <= 100, "{widest}");
    assert!(text.ends_with('\n') && !text.contains(" \n"));
    assert!(!text.contains(['\u{1b}', '\u{a0}']), "no colours, no spaces that are none");
}

/// Writes a file in a folder.
pub(crate) fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("the folder can be written to");
    path
}

/// Returns a map of the shipped UR5 whose columns have the names of its variables.
#[cfg(unix)]
pub(crate) const UR5_MAP: &str = r#"
[data]
uncertainty = "0.02 mm"
[joints]
q1 = { column = "q1", unit = "rad" }
q2 = { column = "q2", unit = "rad" }
q3 = { column = "q3", unit = "rad" }
q4 = { column = "q4", unit = "rad" }
q5 = { column = "q5", unit = "rad" }
q6 = { column = "q6", unit = "rad" }
[point]
columns = ["x", "y", "z"]
unit = "mm"
"#;

/// Returns a shipped spec.
pub(crate) fn shipped(name: &str) -> &'static str {
    let shipped = abbe_manipulators::SHIPPED.iter().find(|shipped| shipped.name == name);
    shipped.expect("this is shipped").spec
}

#[test]
fn alone_it_says_what_it_can_do() {
    let text = prints::<&str>(&[]);
    for word in ["Usage: abbe", "analyze", "check", "generate", "jacobian", "list", "abbe analyze pps"] {
        assert!(text.contains(word), "{word}");
    }
    assert_eq!(prints(&["--version"]), concat!("abbe ", env!("ABBE_VERSION"), "\n"));
}

/// A build in a checkout names its commit; a build of an unpacked archive cannot.
#[test]
fn the_version_has_the_commit_of_the_checkout() {
    let version = prints(&["--version"]);
    let git = |arguments: &[&str]| {
        let output = std::process::Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
        Some(text.trim().to_owned())
    };
    let commit = git(&["ls-files", "--error-unmatch", "build.rs"])
        .and_then(|_| git(&["rev-parse", "--short=12", "HEAD"]))
        .map(|commit| std::env::var("ABBE_COMMIT").unwrap_or(commit));
    let beginning = format!("abbe {}", env!("CARGO_PKG_VERSION"));
    match commit {
        Some(commit) => assert!(version.starts_with(&format!("{beginning} ({commit}")), "{version}"),
        None => assert!(version.starts_with(&beginning), "{version}"),
    }
}

#[test]
fn every_shipped_manipulator_is_listed() {
    let text = prints(&["list"]);
    let listed = json(&["list", "--json"]);
    let shipped = abbe_manipulators::SHIPPED.len() + abbe_manipulators::MECHANISMS.len();
    assert_eq!(listed.as_array().map(Vec::len), Some(shipped));
    for shipped in abbe_manipulators::SHIPPED {
        assert!(text.contains(shipped.name));
    }
    let joints = |name: &str| {
        let mut listed = listed.as_array().unwrap().iter();
        listed.find(|one| one["name"] == name).unwrap()["joints"].clone()
    };
    assert_eq!(joints("pps"), "PPPRRR");
    assert_eq!(joints("hexapod"), "PPPPPP, 6 loops");
}

#[test]
fn a_reader_who_has_seen_enough_is_no_failure() {
    for arguments in
        [&["analyze", "pps"][..], &["generate", "pps"], &["jacobian", "pps", "--json"], &["list"], &[]]
    {
        let mut child = command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    }
}
