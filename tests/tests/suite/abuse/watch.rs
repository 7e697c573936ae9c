//! Supervision of every input: its outcome and its time.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::exit;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use abbe_spec::diagnostic::Diagnostics;
use abbe_tests::processes::WATCHDOG;
use abbe_tests::thorough;

/// Limit of the processor time of this process for an input, per processor: in unoptimized tests,
/// with other tests at the same time. Unlike time, it does not depend on other processes.
const LONGEST: Duration = Duration::from_secs(30);

/// Processor time above which an input is reported.
const LONG: Duration = Duration::from_secs(5);

/// Returns the number of inputs of a kind: `ABBE_ABUSE` if set, otherwise `thoroughly` in a
/// thorough run and an eighth of it in an ordinary one.
pub(crate) fn many(thoroughly: u64) -> u64 {
    asked().unwrap_or(if thorough() { thoroughly } else { thoroughly / 8 })
}

fn asked() -> Option<u64> {
    std::env::var("ABBE_ABUSE").ok().and_then(|many| many.parse().ok())
}

/// Returns the processor time of this process, if the system reports it: the time of one test, if
/// it runs alone.
fn worked() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // After the name, which may contain any character: user and system time, in hundredths of a
    // second.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks()? + ticks()?)))
}

/// Outcomes of the inputs.
#[derive(Default)]
pub(crate) struct Figures {
    kind: &'static str,
    pub(crate) answered: usize,
    refused: usize,
    slowest: Duration,
}

impl Figures {
    pub(crate) fn new(kind: &'static str) -> Self {
        Self { kind, ..Self::default() }
    }

    pub(crate) fn add(&mut self, (answered, taken): (bool, Duration)) {
        if answered {
            self.answered += 1;
        } else {
            self.refused += 1;
        }
        self.slowest = self.slowest.max(taken);
    }

    pub(crate) fn all(&self) -> usize {
        self.answered + self.refused
    }

    pub(crate) fn print(&self) {
        let Self { kind, answered, refused, slowest } = self;
        eprintln!(
            "{kind}: {} inputs, {answered} answered, {refused} refused, slowest {slowest:.1?}",
            self.all()
        );
    }
}

/// Runs one input. Returns whether it succeeded, and its processor time, or wall time if that is
/// unknown. A panic, and a diagnostic without a location or a help, fail the test; more than
/// [`LONGEST`] or [`WATCHDOG`] aborts it.
pub(crate) fn watched(
    kind: &str,
    seed: u64,
    input: &str,
    run: impl FnOnce() -> Result<(), Diagnostics>,
) -> (bool, Duration) {
    let (done, watch) = channel::<()>();
    let (begun, worked_before, said) = (Instant::now(), worked(), format!("{kind} {seed}"));
    let kept = input.to_owned();
    let watching = thread::spawn(move || {
        let longest = LONGEST * thread::available_parallelism().map_or(1, |count| count.get() as u32);
        while watch.recv_timeout(Duration::from_secs(1)) == Err(RecvTimeoutError::Timeout) {
            let taken = worked().zip(worked_before).map(|(after, before)| after - before);
            if taken.is_some_and(|taken| taken > longest) || begun.elapsed() > WATCHDOG {
                eprintln!("{said} does not end:\n{kept}");
                exit(1);
            }
        }
    });
    let result = catch_unwind(AssertUnwindSafe(run));
    drop(done);
    watching.join().unwrap();
    let Ok(result) = result else { panic!("{kind} {seed} panics:\n{input}") };
    if let Err(refused) = &result {
        assert!(!refused.list.is_empty());
        for mistake in &refused.list {
            let has_place = mistake.span.is_some() || !refused.path.is_empty();
            let has_way_out = mistake.help.as_ref().is_some_and(|help| !help.trim().is_empty());
            assert!(
                has_place && has_way_out && !mistake.message.is_empty(),
                "{kind} {seed}:\n{refused}\nof\n{input}"
            );
        }
        assert!(refused.to_string().lines().count() < 400, "{kind} {seed}:\n{refused}");
    }
    let taken = worked().zip(worked_before).map_or(begun.elapsed(), |(after, before)| after - before);
    if taken > LONG {
        eprintln!("{kind} {seed} takes {taken:.1?}:\n{input}");
    }
    (result.is_ok(), taken)
}
