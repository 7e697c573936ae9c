//! Jobs on a manipulator as its spec describes it, without arguments and text output. Those on
//! measurements are in `abbe-metrology`.
//!
//! A **job** is a struct that holds its options and inputs, owned and plain, and has one function,
//!
//! ```text
//! pub fn run(&self, notes: &mut dyn Notes) -> Result<Report>
//! ```
//!
//! All jobs follow the same rules, so that the command, the Python module and tests call them
//! alike:
//!
//! - **One folder per job**, named after the command: `check/`, `jacobian/`, `analyze/` … The job
//!   has the command's name; its first field is the [`Machine`]. Its report is one struct that
//!   derives `Serialize` and owns its data. Serialized, it is the output of `--json`. Fields that
//!   only text or pages need are marked `#[serde(skip)]`.
//! - **Invalid input returns `Diagnostics`**, with the file or option and the place.
//!   [`mistake::with_help`] creates one without a place, [`mistake::not_evaluated`] one for a
//!   configuration without a finite result.
//! - **Messages and progress go to [`Notes`]**, which can also interrupt a long job. Nothing here
//!   prints, exits, or knows command-line arguments. `&mut ()` ignores all messages.
//! - **The caller names all files.** A job reads the files it is given and writes none; output is
//!   returned as text or rows. [`Reads`] lists the input files, which must not be overwritten.
//! - Reports hold numbers in the spec's coherent units, like the spec and `abbe`. [`number`]
//!   formats them for display.
//! - [`Machine::change`] changes the spec once, before the job starts.
//!
//! A study in ten lines:
//!
//! ```
//! use abbe_study::analyze::Analyze;
//! use abbe_study::{Machine, Study};
//!
//! let machine = Machine::find("pps")?; // or the path of your own spec
//! let study = Study::find(None, &machine)?; // the shipped study
//! let report = Analyze::new(machine, study).run(&mut ())?;
//! assert_eq!(report.budget.configurations, 999);
//! let [first, ..] = &report.ledger.sources[..] else { panic!("there are sources") };
//! println!("radius {:.3} mm; largest source: {}", report.budget.combined.radius.value, first.name);
//! # assert_eq!(first.name, "assembly");
//! # Ok::<(), abbe_spec::diagnostic::Diagnostics>(())
//! ```
//!
//! [`Machine`] is a spec with its name, and with its generated code if it is shipped. [`Changes`]
//! are the changes of one run. [`study_file`] holds study files, [`workspace`] the configurations
//! that they describe.

pub mod allocate;
pub mod analyze;
pub mod bound;
pub mod check;
pub mod explore;
pub mod export;
pub mod generate;
pub mod import;
pub mod jacobian;
pub mod list;

pub mod date;
pub mod hash;
pub mod number;
pub mod options;
pub mod study_file;
pub mod template;
pub mod workspace;

mod archive;
pub mod calibration;
mod changes;
mod closing;
pub mod dead_point;
pub mod extrapolation;
mod factors;
pub mod finite;
mod iso230;
pub mod lines;
mod machine;
mod machine_tool;
pub mod named;
pub mod open_loops;
mod reads;
mod release;
mod residuals;
mod result;
mod run_record;
mod table_paths;

use closing::Closing;

pub use abbe_spec::{mistake, notes, notes::Notes};
pub use changes::{Changes, changed_text, find_symbol};
pub use extrapolation::{Extrapolation, ToolPointDeviation};
pub use finite::finite;
pub use iso230::IsoAxis;
pub use machine::{Evaluator, Machine};
pub use reads::Reads;
pub use release::{set_version, version};
pub use residuals::{Residual, Residuals};
pub use result::{About, Result};
pub use run_record::{RunRecord, check_date};
pub use study_file::Study;
