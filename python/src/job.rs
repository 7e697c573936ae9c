//! A job of `abbe-study`, run beside Python: Ctrl-C stops it, and whoever asks is told how far it is.

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

/// How often Python looks at its signals, and is told of the progress.
const OFTEN: Duration = Duration::from_millis(50);

/// As much as a main thread has.
const STACK: usize = 8 << 20;

/// What a job says.
enum Said {
    Note(String),
    Warning(String),
    Progress(usize, usize),
}

struct Listener<'a> {
    said: Sender<Said>,
    stop: &'a AtomicBool,
    last: Instant,
}

impl Notes for Listener<'_> {
    fn note(&mut self, note: &str) {
        let _ = self.said.send(Said::Note(note.to_owned()));
    }

    fn warn(&mut self, warning: &str) {
        let _ = self.said.send(Said::Warning(warning.to_owned()));
    }

    fn progress(&mut self, done: usize, total: usize) {
        if done >= total || self.last.elapsed() >= OFTEN {
            self.last = Instant::now();
            let _ = self.said.send(Said::Progress(done, total));
        }
        // Not every job asks between its parts: whoever says how far he is can be stopped there.
        if self.stop() {
            resume_unwind(Box::new("stopped"));
        }
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Runs a job on threads of its own, which end with it: a process that is forked later has nothing to wait for. Notes come back;
/// warnings are those of Python, too.
pub(crate) fn run<R: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut dyn Notes) -> Result<R, Diagnostics> + Send,
) -> PyResult<(R, Vec<String>)> {
    let threads = threads.map(|threads| within("threads", threads, THREADS)).transpose()?.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let (stop, (said, heard)) = (AtomicBool::new(false), channel());
    let (mut result, heard) = (None, Mutex::new(heard));
    let (mut notes, mut failure) = (Vec::new(), Ok(()));
    pool.in_place_scope(|scope| {
        let (result, stop) = (&mut result, &stop);
        scope.spawn(move |_| {
            let mut listener = Listener { said, stop, last: Instant::now() };
            *result = Some(catch_unwind(AssertUnwindSafe(|| work(&mut listener))));
        });
        loop {
            let next = py.detach(|| {
                heard.lock().map_or(Err(RecvTimeoutError::Disconnected), |heard| heard.recv_timeout(OFTEN))
            });
            let told = match next {
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => py.check_signals(),
                Ok(Said::Note(note)) => {
                    notes.push(note);
                    Ok(())
                }
                Ok(Said::Warning(warning)) => {
                    let warned = warn(py, &warning);
                    notes.push(warning);
                    warned
                }
                Ok(Said::Progress(done, total)) => match progress {
                    Some(progress) if failure.is_ok() => {
                        progress.call1((done, total)).and_then(|_| py.check_signals())
                    }
                    _ => py.check_signals(),
                },
            };
            if let (Ok(()), Err(error)) = (&failure, told) {
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
    py.import("warnings")?.call_method1("warn", (warning, py.get_type::<PyUserWarning>(), 2)).map(drop)
}
