//! Figures of live pages, compared with those of the commands: of the modules in Node, and of pages
//! in headless Chromium, which are used with mouse and keyboard.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_manipulators::SHIPPED;
use abbe_spec::number;
use abbe_tests::needs::{Missing, Tests, tool};
use abbe_tests::{is_tested, thorough};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub(crate) const TESTS: Tests = &[
    ("modules_agree_with_the_commands", modules_agree_with_the_commands),
    ("pages_show_the_figures_of_the_commands", pages_show_the_figures_of_the_commands),
];

fn modules_agree_with_the_commands() -> Result<(), Missing> {
    node()?;
    let folder = tempfile::tempdir().expect("a folder");
    let numbers = folder.path().join("numbers.json");
    fs::write(&numbers, formatted_numbers()).expect("a file");
    let files = fs::read_dir(tests()).expect("a folder").map(|file| file.expect("a file").path());
    let files = files.filter(|file| file.to_string_lossy().ends_with(".test.js"));
    run(files, if thorough() { 5 } else { 2 }, &[("ABBE_NUMBERS", numbers.as_os_str())]);
    Ok(())
}

fn pages_show_the_figures_of_the_commands() -> Result<(), Missing> {
    node()?;
    tool("chromium", "")?;
    run([tests().join("pages.js")], if thorough() { 10 } else { 3 }, &[]);
    Ok(())
}

/// Requires Node 20, which has all that the tests call.
fn node() -> Result<(), Missing> {
    let version = tool("node", "")?;
    let major = version.trim_start_matches('v').split('.').next().and_then(|major| major.parse().ok());
    if major.is_some_and(|major: u32| major >= 20) {
        return Ok(());
    }
    Err(Missing(format!("node is {version}, older than 20")))
}

/// Returns the folder of the tests in JavaScript.
fn tests() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../report/src/explore/tests")
}

/// Runs tests in JavaScript on the machines to be tested, at so many states of each.
fn run(files: impl IntoIterator<Item = PathBuf>, states: usize, variables: &[(&str, &OsStr)]) {
    let machines = SHIPPED.iter().map(|shipped| shipped.name).filter(|name| is_tested(name));
    let output = Command::new("node")
        .arg("--test")
        .args(files)
        .env("ABBE", env!("CARGO_BIN_EXE_abbe"))
        .env("ABBE_MACHINES", machines.collect::<Vec<_>>().join(" "))
        .env("ABBE_STATES", states.to_string())
        .envs(variables.iter().copied())
        .output()
        .expect("node runs");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{printed}");
    assert!(printed.contains("# fail 0") && printed.contains("# skipped 0"), "{printed}");
}

/// Returns numbers with their texts for people, as JSON: halves, powers of ten and others.
fn formatted_numbers() -> String {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut values = vec![0.0, -0.0, 1e7, 9_999_999.5, 1e-5, 9.9e-6, 1e18, 1e-300, 0.1, 1000.0];
    for _ in 0..20_000 {
        let decade = random.random_range(-9..12);
        let mut value = random.random_range(-10.0..10.0) * 10_f64.powi(decade);
        if random.random_bool(0.5) {
            // Halves of a digit, which are exact.
            value = (value * 64.0).round() / 64.0;
        }
        values.push(value);
    }
    let row = |value: &f64| {
        let value = *value;
        let size = value.abs();
        let decimals = number::decimals(size, 4);
        let texts = [
            number::fixed(value, decimals),
            number::fixed(value, 1),
            number::trimmed(value, 4),
            number::short(value),
            number::digits(value, 4),
            number::rounded_down(size, number::decimals(size, 2)),
            number::percent(size, 3.0),
        ];
        serde_json::json!([value, decimals, texts])
    };
    serde_json::Value::from_iter(values.iter().map(row)).to_string()
}
