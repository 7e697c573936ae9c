//! Tests of `interrupt.rs`.

use std::fs;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use super::*;
use crate::output::Outputs;

/// Environment variable with the folder in which the child process works until it ends.
const WORKING: &str = "ABBE_TEST_WORKING";

const STATUS: i32 = 143;

/// Number of files before the end.
const FILES: usize = 8;

#[test]
fn work_until_the_end() {
    static WRITTEN: AtomicUsize = AtomicUsize::new(0);

    let Some(folder) = std::env::var_os(WORKING) else { return };
    for name in ["a", "b", "c", "d"] {
        let folder = std::path::PathBuf::from(&folder);
        // Commands write like this until a signal ends them.
        thread::spawn(move || {
            loop {
                let mut outputs = Outputs::new(&(), true);
                let _ = outputs.folder(&folder.join(name).join("inner"));
                let file = outputs.file(&folder.join(format!("{name}.csv")));
                let _ = file.and_then(|file| outputs.finish([file.fill("whole")?]));
                WRITTEN.fetch_add(1, Ordering::Relaxed);
            }
        });
    }
    while WRITTEN.load(Ordering::Relaxed) < FILES {
        thread::yield_now();
    }
    end(STATUS);
}

#[test]
fn nothing_is_begun_after_the_end() {
    for round in 0..20 {
        let folder = tempfile::tempdir().unwrap();
        let status = Command::new(std::env::current_exe().unwrap())
            .args(["interrupt::tests::work_until_the_end", "--exact"])
            .env(WORKING, folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        assert_eq!(status.unwrap().code(), Some(STATUS));
        for path in fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let whole = name == ".abbe-written"
                || name.ends_with(".csv") && fs::read_to_string(&path).unwrap() == "whole";
            assert!(whole, "round {round}: {name}");
        }
    }
}
