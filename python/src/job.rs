//! Execution of a job of `abbe-study` beside Python: Ctrl-C stops it, and a callback gets its
//! progress.
//!
//! Options of jobs in Python. Their ranges and names are defined with each job in `abbe_study`.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use abbe_spec::{Document, Spec, expr::Dimension};
use abbe_study::options::{Choices, THREADS, quantity};
use abbe_study::{Notes, Result, Study};
use pyo3::exceptions::{PyRuntimeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::failure::{panicked, spec_error};

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
    threads: Option<Whole>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut dyn Notes) -> Result<R> + Send,
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

/// Whole number of an argument, before its range is checked.
pub(crate) type Whole = i128;

/// Checks that a number is in the range of its option.
pub(crate) fn within<T: PartialOrd + Display>(
    name: &str,
    value: impl TryInto<T>,
    range: RangeInclusive<T>,
) -> PyResult<T> {
    let value = value.try_into().ok().filter(|value| range.contains(value));
    let message = || format!("`{name}` is from {} to {}", range.start(), range.end());
    value.ok_or_else(|| PyValueError::new_err(message()))
}

/// Range of seeds.
pub(crate) const SEEDS: RangeInclusive<u64> = 0..=u64::MAX;

/// Returns the value with this name.
pub(crate) fn named<T: Copy + PartialEq>(option: &str, name: &str, choices: Choices<T>) -> PyResult<T> {
    let names = || one_of(choices.0.iter().map(|(_, name, _)| *name));
    choices.find(name).ok_or_else(|| PyValueError::new_err(format!("{option}={name:?}: {}", names())))
}

/// Lists names: `"v" or "d"`.
pub(crate) fn one_of<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, before)) => format!("{} or {last}", before.join(", ")),
        None => String::new(),
    }
}

/// Converts a time in seconds.
pub(crate) fn seconds(name: &str, value: Option<f64>) -> PyResult<Option<Duration>> {
    let time = value.map(Duration::try_from_secs_f64).transpose();
    time.map_err(|error| PyValueError::new_err(format!("`{name}`: {error}")))
}

/// Formats a dict, or an object of `abbe.spec`, as TOML.
pub(crate) fn toml(value: &Bound<'_, PyAny>) -> PyResult<String> {
    value.py().import("abbe._toml")?.getattr("toml")?.call1((value,))?.extract()
}

/// Study of an argument: the path of a file, or a dict as its text.
#[derive(Default)]
pub(crate) struct GivenStudy {
    pub(crate) file: Option<PathBuf>,
    pub(crate) text: Option<String>,
}

impl<'py> FromPyObject<'_, 'py> for GivenStudy {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match value.is_instance_of::<PyDict>() {
            true => Ok(Self { file: None, text: Some(toml(&value)?) }),
            false => Ok(Self { file: Some(value.extract()?), text: None }),
        }
    }
}

impl GivenStudy {
    /// Returns the file and the text of the arguments `study` and `study_text`.
    pub(crate) fn or_text(study: Option<Self>, text: Option<&str>) -> (Option<PathBuf>, Option<String>) {
        let study = study.unwrap_or_default();
        (study.file, study.text.or_else(|| text.map(str::to_owned)))
    }
}

/// Reads the study of a file or of a text; without both, returns the study that belongs to the
/// machine.
pub(crate) fn study(file: Option<&Path>, text: Option<&str>, machine: &abbe_study::Machine) -> Result<Study> {
    match (text, file) {
        (Some(text), None) => Study::read(Document::new("study_text", text), &machine.spec),
        (_, file) => Study::find(file, machine),
    }
}

/// Tolerances: a text, or several.
#[derive(FromPyObject)]
pub(crate) enum Tolerances {
    One(String),
    All(Vec<String>),
}

impl Tolerances {
    /// Returns the texts of an argument.
    pub(crate) fn texts(given: Option<Self>) -> Vec<String> {
        match given {
            None => Vec::new(),
            Some(Self::One(text)) => vec![text],
            Some(Self::All(texts)) => texts,
        }
    }
}

/// Reads a length that must not be negative: a number in the unit of the spec, or text with a unit.
pub(crate) fn length(name: &str, value: &Bound<'_, PyAny>, spec: &Spec) -> PyResult<f64> {
    let number: f64 = match value.cast::<PyString>() {
        Ok(text) => quantity(name, text.to_str()?, spec.length, Dimension::LENGTH, "this")
            .map_err(|mistakes| spec_error(value.py(), &mistakes))?,
        Err(_) => value.extract()?,
    };
    match number.is_finite() && number >= 0.0 {
        true => Ok(number),
        false => Err(PyValueError::new_err(format!("`{name}` must be a length of zero or more"))),
    }
}
