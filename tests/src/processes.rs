//! Other processes: waiting for their events, and their processor time, which does not depend on
//! the load of the computer.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// Limit of every wait, so that what hangs fails. No wait takes as long on a busy computer.
pub const WATCHDOG: Duration = Duration::from_secs(600);

/// Hundredths of a second, in which [`processor_time`] counts.
pub const SECOND: u64 = 100;

/// Waits for an event, which is tested every millisecond.
///
/// # Panics
///
/// If the event does not occur within [`WATCHDOG`].
pub fn wait_for(event: &str, has_occurred: impl FnMut() -> bool) {
    wait(event, has_occurred, || thread::sleep(Duration::from_millis(1)));
}

/// Waits for a short event, which is tested without a pause.
///
/// # Panics
///
/// If the event does not occur within [`WATCHDOG`].
pub fn watch_for(event: &str, has_occurred: impl FnMut() -> bool) {
    wait(event, has_occurred, thread::yield_now);
}

fn wait(event: &str, mut has_occurred: impl FnMut() -> bool, pause: fn()) {
    let begun = Instant::now();
    while !has_occurred() {
        assert!(begun.elapsed() < WATCHDOG, "hangs: {event} does not occur");
        pause();
    }
}

/// Returns the state of a process and the processor time of all its threads.
fn state(process: u32) -> Option<(String, u64)> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // After the name, which may contain any character: the state, and at 11 and 12 the user and
    // the system time.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace();
    let state = fields.next()?.to_owned();
    let mut times = fields.skip(10).map_while(|time| time.parse::<u64>().ok());
    Some((state, times.next()? + times.next()?))
}

/// Returns the processor time of a process in hundredths of a second, also if it has ended but is
/// not waited for. None if the system does not report it.
#[must_use]
pub fn processor_time(process: u32) -> Option<u64> {
    state(process).map(|(_, time)| time)
}

/// Returns whether a process has ended, also if it is not waited for.
#[must_use]
pub fn has_ended(process: u32) -> bool {
    state(process).is_none_or(|(state, _)| state == "Z")
}
