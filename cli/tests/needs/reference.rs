//! Comparison of the command with an independent implementation in plain Python
//! (`tests/reference/`), on random specs that together use every form of the spec language; 30
//! specs in a thorough run.

use std::path::Path;
use std::process::Command;

use abbe_tests::needs::{Missing, Tests};
use abbe_tests::thorough;

pub(crate) const TESTS: Tests = &[
    ("random_specs_are_as_plain_python_has_them", (|| compared("first"))),
    ("further_ones_and_the_paper_are_as_plain_python_has_them", || compared("second")),
];

/// Runs half of the comparison, one half per core.
fn compared(half: &str) -> Result<(), Missing> {
    // `tomllib` exists since Python 3.11.
    let python = Command::new("python3").args(["-c", "import tomllib"]).output();
    if !python.is_ok_and(|python| python.status.success()) {
        return Err(Missing("python3 (3.11 or newer) is not installed".to_owned()));
    }
    let compare = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference/compare.py");
    // `-B`: no compiled modules beside the sources.
    let mut python = Command::new("python3");
    python.arg("-B").arg(compare).arg(env!("CARGO_BIN_EXE_abbe")).args(["--half", half]);
    python.args(thorough().then_some("--all"));
    let output = python.output().expect("python3 has just run");
    let printed = [output.stdout, output.stderr].concat();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&printed));
    Ok(())
}
