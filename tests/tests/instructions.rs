//! Instruction counts by valgrind, within 2 % of the checked-in ones.
//!
//! Requires valgrind, gungraun-runner and the compiler of the checked-in counts, and is otherwise
//! ignored. `.ci/run` installs the first two and runs it; `cargo test` does not. `UPDATE_EXPECT=1
//! cargo test -p abbe-tests --test instructions` updates the counts.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

use abbe_tests::needs::{Missing, Tests, run, tool};
use serde_json::Value;

fn main() -> ExitCode {
    run(&[("instructions", TESTS)])
}

const TESTS: Tests = &[("as_many_as_are_checked_in", as_many_as_are_checked_in)];

/// Returns the required version of the runner: that of the crate.
fn version() -> &'static str {
    let lock = include_str!("../../Cargo.lock");
    let (_, entry) = lock.split_once("name = \"gungraun\"\nversion = \"").expect("the crate is locked");
    entry.split('"').next().expect("a version")
}

/// Returns the counts by the name of the benchmark.
fn counted() -> BTreeMap<String, u64> {
    let arguments = [
        "bench",
        "--profile",
        "counts",
        "--quiet",
        "-p",
        "abbe-instructions",
        "--bench",
        "instructions",
        "--features",
        "instructions",
        "--",
    ];
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .arg("--output-format=json")
        .env_remove("RUSTFLAGS")
        .output()
        .expect("cargo runs this test");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    let summaries = serde_json::Deserializer::from_slice(&output.stdout).into_iter::<Value>();
    summaries
        .map(|summary| {
            let summary = summary.expect("a summary for each benchmark");
            let name = |key: &str| summary[key].as_str().expect("a name").to_owned();
            let count = &summary["profiles"][0]["data"]["total"]["metrics"]["Ir"]["values"]["new"];
            let count = count.as_u64().unwrap_or_else(|| panic!("no count in {summary}"));
            (format!("{} {}", name("function_name"), name("id")), count)
        })
        .collect()
}

fn as_many_as_are_checked_in() -> Result<(), Missing> {
    let valgrind = tool("valgrind", "")?;
    tool("gungraun-runner", version())?;
    let rustc = tool("rustc", "")?;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/instructions.txt");
    let counts = counted();
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        let mut table = format!("{rustc}\n");
        counts.iter().for_each(|(name, count)| writeln!(table, "{name} {count}").expect("a string"));
        fs::write(&path, table).expect("the table");
    }
    let table = fs::read_to_string(&path).expect("the table");
    let (compiler, rows) = table.split_once('\n').expect("the compiler first");
    if compiler != rustc {
        return Err(Missing(format!("counted with {compiler}, and this is {rustc}")));
    }
    let expected: BTreeMap<String, u64> = rows
        .lines()
        .map(|row| row.rsplit_once(' ').expect("a name and a count"))
        .map(|(name, count)| (name.to_owned(), count.parse().expect("a count")))
        .collect();
    assert!(expected.keys().eq(counts.keys()), "{:?} are counted", counts.keys());
    let off: Vec<String> = expected
        .iter()
        .map(|(name, expected)| (name, *expected, counts[name]))
        .filter(|(_, expected, count)| 50 * expected.abs_diff(*count) > *expected)
        .map(|(name, expected, count)| format!("{name}: {count} instead of {expected}"))
        .collect();
    assert!(off.is_empty(), "off by more than 2 % with {valgrind}:\n{}", off.join("\n"));
    Ok(())
}
