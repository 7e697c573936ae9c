//! Reports as plain text of [`WIDTH`] columns, or as many as [`at_width`] sets, for terminals and
//! for `print` in Python.
//!
//! `answer` has the first screen of each job, at most 25 lines; `full` has every table.

mod answer;
mod full;
mod imported;
mod jacobian;
mod list;
mod table;

use abbe::Description;
use abbe_metrology::data::Map;
use abbe_metrology::{compensate, doctor, identify, measure, monitor, plan, positioning};
use abbe_spec::Spec;
use abbe_study::RunRecord;
use abbe_study::{analyze, bound, check, export};

pub use answer::next;
pub(crate) use full::analysis::explained as draws_explained;
pub(crate) use full::monitoring::{findings as changes, not_observable};
pub use imported::imported;
pub use jacobian::jacobian;
pub use list::list;
pub use table::{Table, WIDTH, at_width, listed, wrapped};

/// Amount of a report to print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// The answer on one screen: at most 25 lines.
    #[default]
    Answer,
    /// Every table and every sentence.
    Full,
}

impl Detail {
    /// Returns [`Full`](Self::Full) if everything is wanted.
    pub fn new(full: bool) -> Self {
        if full { Self::Full } else { Self::Answer }
    }

    /// Formats the stated entries of a record, which stand below a full report.
    fn record(self, record: &RunRecord) -> String {
        let lines = record.stated().map(|(title, text)| format!("{title:<25}{}\n", wrapped(text, 25)));
        match lines.collect::<String>() {
            lines if lines.is_empty() || self == Self::Answer => String::new(),
            lines => format!("\n{lines}"),
        }
    }

    fn choose<T>(self, answer: T, full: T) -> T {
        match self {
            Self::Answer => answer,
            Self::Full => full,
        }
    }
}

/// Prints an error budget over a workspace.
pub fn analysis(report: &analyze::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> String>(answer::analysis, full::analysis)(report)
        + &detail.record(&report.record)
}

/// Prints the check of a spec.
pub fn check(report: &check::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> _>(answer::check, full::check)(report)
}

/// Prints certified bounds of errors.
pub fn bound(report: &bound::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> _>(answer::bound, full::bound)(report)
}

/// Prints an identification, without the files that it wrote.
pub fn identification(spec: &Spec, report: &identify::Report, detail: Detail) -> String {
    detail.choose::<fn(&_, &_) -> String>(answer::identification, full::identification)(spec, report)
        + &detail.record(&report.record)
}

/// Prints the errors of a measured machine.
pub fn measurement(spec: &Spec, report: &measure::Report, detail: Detail) -> String {
    detail.choose::<fn(&_, &_) -> String>(answer::measurement, full::measurement)(spec, report)
        + &detail.record(&report.record)
}

/// Prints what compensation reaches.
pub fn compensation(machine: &Description, report: &compensate::Report, detail: Detail) -> String {
    detail.choose::<fn(&_, &_) -> String>(answer::compensation, full::compensation)(machine, report)
        + &detail.record(&report.record)
}

/// Prints a plan of measurements, without the file that it wrote.
pub fn plan(spec: &Spec, map: &Map, report: &plan::Report, detail: Detail) -> String {
    detail.choose::<fn(&_, &_, &_) -> _>(answer::plan, full::plan)(spec, map, report)
}

/// Prints the characteristics of a positioning test.
pub fn positioning(report: &positioning::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> _>(answer::positioning, full::positioning)(report)
}

/// Prints control charts and the alarm they raise.
pub fn monitoring(spec: &Spec, report: &monitor::Report, detail: Detail) -> String {
    detail.choose::<fn(&_, &_) -> String>(answer::monitoring, full::monitoring)(spec, report)
        + &detail.record(&report.record)
}

/// Prints the conventions in which rows of joints and poses fit the manipulator.
pub fn doctor(report: &doctor::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> _>(answer::doctor, full::doctor)(report)
}

/// Prints the quality of exported files, without their names.
pub fn exported(report: &export::Report, detail: Detail) -> String {
    detail.choose::<fn(&_) -> _>(answer::exported, full::exported)(report)
}
