//! Finds the commit that the command is built from, so that a page which somebody signs can be
//! traced to its source: `ABBE_COMMIT` of the environment, the one that `cargo package` notes, or
//! that of git.

use std::{path::Path, process::Command};

/// Sources that the command is compiled from, relative to this package.
const SOURCES: [&str; 16] = [
    "../Cargo.toml",
    "../Cargo.lock",
    "../spec",
    "../codegen",
    "../runtime",
    "../kinematics",
    "../analysis",
    "../bound",
    "../calibration",
    "../interpreter",
    "../manipulators",
    "../exchange",
    "../study",
    "../metrology",
    "../report",
    "../cli",
];

fn main() {
    println!("cargo::rerun-if-env-changed=ABBE_COMMIT");
    println!("cargo::rerun-if-changed=build.rs");
    let given = std::env::var("ABBE_COMMIT").ok().filter(|commit| !commit.is_empty());
    let commit = given.or_else(packaged).or_else(checked_out);
    let commit = commit.map(|commit| format!(" ({commit})")).unwrap_or_default();
    println!("cargo::rustc-env=ABBE_VERSION={}{commit}", env!("CARGO_PKG_VERSION"));
}

/// Returns the commit of a package from a registry.
fn packaged() -> Option<String> {
    let note = std::fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let (_, after) = note.split_once("\"sha1\"")?;
    let commit = after.split('"').nth(1)?.get(..12)?;
    let mark = if note.contains("\"dirty\": true") { " modified" } else { "" };
    Some(format!("{commit}{mark}"))
}

/// Returns the commit of the checkout around this package, marked if a source differs from it.
/// Cargo runs this again after another checkout or a change of a source, not otherwise.
fn checked_out() -> Option<String> {
    // The commit of another repository around an unpacked package says nothing.
    let own = git(&["ls-files", "--error-unmatch", "build.rs"]).is_some();
    let commit = git(&["rev-parse", "--short=12", "HEAD"]).filter(|_| own)?;
    let branch = git(&["rev-parse", "--symbolic-full-name", "HEAD"])?;
    // The log changes with every commit, also where the branch has no file of its own yet.
    for name in ["HEAD", "logs/HEAD", branch.as_str(), "packed-refs"] {
        let path = git(&["rev-parse", "--git-path", name])?;
        if Path::new(&path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    for source in SOURCES {
        if Path::new(source).is_file() {
            println!("cargo::rerun-if-changed={source}");
        }
        let entries = Path::new(source).read_dir().into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|path| !path.ends_with("tests")) {
            println!("cargo::rerun-if-changed={}", path.display());
        }
    }
    let status = ["status", "--porcelain", "--untracked-files=no", "--", ":(exclude)../*/tests"];
    let changed = git(&[&status[..], &SOURCES].concat())?;
    Some(if changed.is_empty() { commit } else { format!("{commit} modified") })
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("--no-optional-locks").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
    Some(text.trim().to_owned())
}
