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
mod tests;
