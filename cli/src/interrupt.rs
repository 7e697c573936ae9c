//! Termination by a signal: no partial file remains, and the exit status is 128 + the number of the
//! signal.

use std::process;

use crate::output::folders;

/// Ends the process with this status. Removes the folders that it made and that are still empty.
fn end(status: i32) -> ! {
    // The guard lives until the exit: no folder is made meanwhile, and no file is half moved.
    let made = folders::hold();
    folders::remove_empty(&made);
    process::exit(status)
}

/// Installs a handler for SIGINT (Ctrl-C), SIGTERM and SIGHUP that cleans up and ends the process.
///
/// Must be called before other threads start: they inherit the blocked signals, and one thread
/// waits for them.
#[cfg(unix)]
pub(crate) fn clean_up_on_signals() {
    use nix::sys::signal::{SigSet, Signal};

    let mut signals = SigSet::empty();
    signals.add(Signal::SIGINT);
    signals.add(Signal::SIGTERM);
    if !hangup_is_ignored() {
        signals.add(Signal::SIGHUP);
    }
    // If the signals cannot be blocked, empty folders may remain after an interruption.
    if signals.thread_block().is_ok() {
        std::thread::spawn(move || {
            if let Ok(signal) = signals.wait() {
                // A second signal ends the process at once, even while the first waits for the
                // guard.
                let _ = signals.thread_unblock();
                end(128 + signal as i32);
            }
        });
    }
}

/// Returns true if SIGHUP is ignored, as under `nohup`. Only Linux shows this without unsafe code.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| mask & (1 << (nix::sys::signal::Signal::SIGHUP as u32 - 1)) != 0)
}

/// Installs a handler for Ctrl-C that cleans up and ends the process.
#[cfg(not(unix))]
pub(crate) fn clean_up_on_signals() {
    const INTERRUPTED: i32 = 130;
    // Without the handler, empty folders may remain after an interruption.
    let _ = ctrlc::set_handler(|| end(INTERRUPTED));
}

#[cfg(test)]
mod tests {
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
}
