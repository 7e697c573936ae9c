//! Corrected commands on emulated controllers: `benches/controller/run` prints what its page has.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, tool};

pub(crate) const TESTS: Tests = &[("the_page_has_the_printed_rows", the_page_has_the_printed_rows)];

/// Other versions of the compiler make other code.
const COMPILER: &str = "12.2";

fn the_page_has_the_printed_rows() -> Result<(), Missing> {
    tool("qemu-system-arm", "")?;
    let version = tool("arm-none-eabi-gcc", "")?;
    if !version.lines().next().is_some_and(|line| line.contains(COMPILER)) {
        return Err(Missing(format!("arm-none-eabi-gcc {COMPILER} is not installed")));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../benches/controller");
    let mut run = Command::new("bash");
    run.arg(folder.join("run")).env("ABBE", env!("CARGO_BIN_EXE_abbe")).env("ROBOTS", "ur5");
    let run = run.output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let printed = String::from_utf8(run.stdout).unwrap();
    let page = fs::read_to_string(folder.join("README.md")).unwrap();
    assert_eq!(printed.lines().count(), 5, "{printed}");
    for line in printed.lines() {
        assert!(page.contains(line), "the page does not have: {line}");
    }
    Ok(())
}
