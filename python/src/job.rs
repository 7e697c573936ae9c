//! Execution of a job of `abbe-study` beside Python: Ctrl-C stops it, and a callback gets its
//! progress.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use abbe_spec::diagnostic::Diagnostics;
use abbe_study::Notes;
use abbe_study::options::THREADS;
use pyo3::exceptions::{PyRuntimeError, PyUserWarning};
use pyo3::prelude::*;

use crate::failure::{panicked, spec_error};
use crate::options::within;

/// Interval at which signals are checked and progress is reported.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Stack size of a thread, that of a main thread.
const STACK: usize = 8 << 20;

/// Message of a running job.
enum Message {
    Note(String),
    Warning(String),
    Progress(usize, usize),
}

struct Listener<'a> {
    sender: Sender<Message>,
    stop: &'a AtomicBool,
    last: Instant,
}

impl Notes for Listener<'_> {
    fn note(&mut self, note: &str) {
        let _ = self.sender.send(Message::Note(note.to_owned()));
    }

    fn warn(&mut self, warning: &str) {
        let _ = self.sender.send(Message::Warning(warning.to_owned()));
    }

    fn progress(&mut self, done: usize, total: usize) {
        if done >= total || self.last.elapsed() >= POLL_INTERVAL {
            self.last = Instant::now();
            let _ = self.sender.send(Message::Progress(done, total));
        }
        // Not every job polls `stop`; jobs that report progress can be stopped here.
        if self.stop() {
            resume_unwind(Box::new("stopped"));
        }
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Runs a job on a thread pool that ends with it, so that a process forked later has no threads to
/// wait for. Returns the result and the notes; warnings are raised as Python warnings as well.
pub(crate) fn run<R: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut dyn Notes) -> Result<R, Diagnostics> + Send,
) -> PyResult<(R, Vec<String>)> {
    let threads = threads.map(|threads| within("threads", threads, THREADS)).transpose()?.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let (stop, (sender, receiver)) = (AtomicBool::new(false), channel());
    let (mut result, receiver) = (None, Mutex::new(receiver));
    let (mut notes, mut failure) = (Vec::new(), Ok(()));
    pool.in_place_scope(|scope| {
        let (result, stop) = (&mut result, &stop);
        scope.spawn(move |_| {
            let mut listener = Listener { sender, stop, last: Instant::now() };
            *result = Some(catch_unwind(AssertUnwindSafe(|| work(&mut listener))));
        });
        loop {
            let next = py.detach(|| {
                receiver.lock().map_or(Err(RecvTimeoutError::Disconnected), |receiver| {
                    receiver.recv_timeout(POLL_INTERVAL)
                })
            });
            let handled = match next {
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => py.check_signals(),
                Ok(Message::Note(note)) => {
                    notes.push(note);
                    Ok(())
                }
                Ok(Message::Warning(warning)) => {
                    let warned = warn(py, &warning);
                    notes.push(warning);
                    warned
                }
                Ok(Message::Progress(done, total)) => match progress {
                    Some(progress) if failure.is_ok() => {
                        progress.call1((done, total)).and_then(|_| py.check_signals())
                    }
                    _ => py.check_signals(),
                },
            };
            if let (Ok(()), Err(error)) = (&failure, handled) {
                stop.store(true, Ordering::Relaxed);
                failure = Err(error);
            }
        }
    });
    failure?;
    match result {
        Some(Ok(Ok(report))) => Ok((report, notes)),
        Some(Ok(Err(mistakes))) => Err(spec_error(py, &mistakes)),
        Some(Err(panic)) => Err(panicked(&*panic)),
        None => Err(PyRuntimeError::new_err("the work was not done")),
    }
}

fn warn(py: Python<'_>, warning: &str) -> PyResult<()> {
    py.import("warnings")?.call_method1("warn", (warning, py.get_type::<PyUserWarning>(), 1)).map(drop)
}
