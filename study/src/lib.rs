//! What can be asked of a manipulator, and what comes out: every command of `abbe` without its arguments and its text.
//!
//! A **job** is one question. It is a struct that holds what is asked, owned and plain, and has one function,
//!
//! ```text
//! pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics>
//! ```
//!
//! The rules that all jobs keep, so that a command, a Python module and a test can call them alike:
//!
//! - **One folder per job**, named as the command: `check/`, `jacobian/`, `analyze/`, `measure/` … The struct of the
//!   question has the command's name ([`Machine`] first, then what else is asked); its report is one struct that
//!   derives `Serialize`, owns everything in it and borrows nothing. Serialized it is what `--json` prints. What only a
//!   text or a page needs stands in the same report, marked `#[serde(skip)]`.
//! - **A mistake in what is asked is `Diagnostics`**, with the file or option and the place: [`mistake::with_help`] makes one
//!   without a place, [`mistake::not_evaluated`] that of a configuration without a finite result.
//! - **What is said on the way goes to [`Notes`]**: a note, a warning, how far the work is; and a job that takes long
//!   asks it whether to stop. Nothing here prints, exits, or knows arguments. `&mut ()` hears nothing.
//! - **Files are named by the caller.** A job reads the ones it is given and writes none: what is to be written comes
//!   back as text or rows. [`Reads`] says which ones it rests on, so that nobody writes over them.
//! - Numbers are in the spec's coherent system, as in the spec and in `abbe`. [`number`] is how people read them: views
//!   use it, reports hold numbers.
//! - The spec of a [`Machine`] is changed once, by [`Machine::change`], before the job starts.
//!
//! A study in ten lines:
//!
//! ```
//! use abbe_study::analyze::Analyze;
//! use abbe_study::{Machine, Study};
//!
//! let machine = Machine::find("pps")?; // or the path of a spec of your own
//! let study = Study::find(None, &machine)?; // the one that is shipped with it
//! let report = Analyze::new(machine, study).run(&mut ())?;
//! assert_eq!(report.budget.configurations, 999);
//! let [first, ..] = &report.budget.tighten_first()[..] else { panic!("there are sources") };
//! println!("radius {:.3} mm; tighten first: {}", report.budget.combined.radius.value, report.sources[*first].name);
//! # assert_eq!(report.sources[*first].name, "assembly");
//! # Ok::<(), abbe_spec::diagnostic::Diagnostics>(())
//! ```
//!
//! [`Machine`] is a spec with its name, and its generated code if it is shipped; [`Changes`] what differs from it in one
//! run; [`study_file`] the study files, [`workspace`] the configurations that they ask for; [`data`] measurements.

pub mod analyze;
pub mod bound;
pub mod check;
pub mod compensate;
pub mod doctor;
pub mod export;
pub mod generate;
pub mod identify;
pub mod import;
pub mod jacobian;
pub mod list;
pub mod measure;
pub mod monitor;
pub mod plan;
pub mod simulate;

pub mod data;
pub mod hash;
pub mod mistake;
pub mod number;
pub mod options;
pub mod study_file;
pub mod workspace;

mod acceptance;
mod archive;
mod changes;
mod extrapolated;
mod finite;
mod interpretations;
mod lines;
mod listing;
mod machine;
mod named;
mod notes;
mod reads;
mod sizes;
mod toml_text;

pub use acceptance::{Acceptance, Accepted, Limit};
pub use changes::{Changes, find_symbol};
pub use extrapolated::{Extrapolated, Known};
pub use finite::finite;
pub use listing::Listing;
pub use machine::{Evaluator, Machine};
pub use notes::Notes;
pub use reads::Reads;
pub use study_file::Study;
