//! The kernels of every shipped robot, in a separate executable.

use std::path::Path;
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, thorough};

pub(crate) const TESTS: Tests = &[("of_every_shipped_robot", of_every_shipped_robot)];

fn of_every_shipped_robot() -> Result<(), Missing> {
    thorough()?;
    let mut cargo = Command::new(env!("CARGO"));
    // In the whole workspace: a single package would be compiled again, with other features.
    cargo.args(["test", "--workspace", "--locked", "--test", "kernels"]);
    cargo.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    let output = cargo.output().expect("cargo runs this test");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&[output.stdout, output.stderr].concat()));
    Ok(())
}
