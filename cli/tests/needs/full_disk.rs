//! Behavior on a full disk: a small tmpfs of this test, where a process may mount one.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use abbe_tests::needs::{Missing, Tests};
use tempfile::tempdir;

pub(crate) const TESTS: Tests =
    &[("what_does_not_fit_leaves_what_was_there", what_does_not_fit_leaves_what_was_there)];

/// Runs `script` with a tmpfs of `size` KiB at `$1` and the command as `$0`.
fn on_disk(folder: &Path, size: usize, script: &str) -> Output {
    let script = format!("mount -t tmpfs -o size={size}k none \"$1\" || exit 77\n{script}");
    let arguments = ["--mount", "--", "sh", "-c", &script, env!("CARGO_BIN_EXE_abbe")];
    Command::new("unshare").args(arguments).arg(folder).output().expect("unshare was here before")
}

/// Sizes from nothing to enough, for a report of several files that replaces an older one.
fn what_does_not_fit_leaves_what_was_there() -> Result<(), Missing> {
    let folder = tempdir().unwrap();
    let mut may = Command::new("unshare");
    may.args(["--mount", "--", "sh", "-c", "mount -t tmpfs none \"$0\""]).arg(folder.path());
    if !may.output().is_ok_and(|tried| tried.status.success()) {
        return Err(Missing("this process may not mount a disk".to_owned()));
    }
    let (mut full, mut fits) = (0, 0);
    for size in [1000, 6000, 7000, 9000, 12_000, 12_500, 13_500, 20_000] {
        // The old report is written without limit; the test is about the second run alone.
        let script = r#"
            cd "$1"
            "$0" analyze scara --out r >old.log 2>&1 || exit 78
            old=$(cat r/* | cksum)
            "$0" analyze scara --monte-carlo 50 --out r >/dev/null 2>new.log
            status=$?
            new=$(cat r/* | cksum)
            left=$(ls -A r | grep -c '\.tmp$')
            test "$old" = "$new" && same=old || same=new
            echo "$status $same $left"
            cat new.log
        "#;
        let output = on_disk(folder.path(), size, script);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        match output.status.code() {
            // Not even the first report fits.
            Some(78) => {}
            Some(0) if said.starts_with("2 old 0") => {
                assert!(said.contains("No space left") && said.contains("error: "), "{said}");
                full += 1;
            }
            Some(0) => {
                assert!(said.starts_with("0 new 0"), "{size} KiB: {said}");
                fits += 1;
            }
            other => panic!("{size} KiB: {other:?} {said} {}", String::from_utf8_lossy(&output.stderr)),
        }
    }
    assert!(full > 0 && fits > 0, "{full} did not fit, {fits} did");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left outside");
    Ok(())
}
