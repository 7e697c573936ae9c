//! Arguments of the command: one file per command, and in `shared` the arguments that several
//! commands have.

#[macro_use]
mod help;
mod allocate;
mod analyze;
mod bound;
mod check;
mod compensate;
mod completions;
mod doctor;
mod explore;
mod export;
mod generate;
mod identify;
mod import;
mod jacobian;
mod list;
mod man;
mod measure;
mod merge;
mod monitor;
mod new;
mod plan;
mod positioning;
mod schema;
mod shared;
mod simulate;
mod values;

pub(crate) use allocate::Allocate;
pub(crate) use analyze::Analyze;
pub(crate) use bound::Bound;
pub(crate) use check::Check;
pub(crate) use compensate::Compensate;
pub(crate) use completions::Completions;
pub(crate) use doctor::Doctor;
pub(crate) use explore::Explore;
pub(crate) use export::Export;
pub(crate) use generate::Generate;
pub(crate) use identify::Identify;
pub(crate) use import::Import;
pub(crate) use jacobian::Jacobian;
pub(crate) use list::List;
pub(crate) use man::Man;
pub(crate) use measure::Measure;
pub(crate) use merge::Merge;
pub(crate) use monitor::Monitor;
pub(crate) use new::New;
pub(crate) use plan::Plan;
pub(crate) use positioning::Positioning;
pub(crate) use schema::Schema;
pub(crate) use shared::{Showing, study};
pub(crate) use simulate::Simulate;

use clap::{Parser, Subcommand};

/// Predict, rank and check the position errors of a manipulator from its spec
///
/// A SPEC is the path of a spec file (TOML) or the name of a shipped manipulator (`abbe list`).
/// Data files follow it. `abbe COMMAND --help` shows examples of each command.
///
/// Output files are written completely or not at all, and never replace an input of the same run.
/// Files that abbe wrote, and that have not been changed since, are replaced; other files only with
/// `--force`. `-` is stdout.
#[derive(Debug, Parser)]
#[command(name = "abbe", version = env!("ABBE_VERSION"), after_help = after_help!(
    "  abbe analyze pps                rank the error sources
  abbe check arm.toml             check the spec, show the model
  abbe jacobian puma560 --q 0,-45deg,0,0,30deg,0
  abbe generate arm.toml --out arm.rs
",
    "a check failed, or a tolerance is not met"
), max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

// Sorted by use: first the spec, then its analysis, then measurements.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the shipped manipulators
    List(List),
    /// Write a first spec from a template
    New(New),
    /// Convert a URDF robot or a table of Denavit-Hartenberg parameters to a spec
    Import(Import),
    /// Check a spec; show its frames, variables, sources, operation counts and identifiable errors
    Check(Check),
    /// Print pose, error Jacobian and generalized errors at one configuration
    Jacobian(Jacobian),
    /// Compute the errors of every source, and of all sources together, over a workspace
    Analyze(Analyze),
    /// Write a page on which joints, inputs and error sources can be varied
    ///
    /// One HTML file, which needs no network: it contains the generated code of the machine, and
    /// shows its errors while values change. With two specs, both machines side by side.
    Explore(Explore),
    /// Certify upper bounds of the errors, beside the largest errors found
    Bound(Bound),
    /// Allocate the tolerance: factors of the error sources that keep it at least cost
    ///
    /// It is kept with all smaller factors, too: no error is relied on to cancel another one.
    Allocate(Allocate),
    /// Merge the parts of an analysis that was computed in several runs
    Merge(Merge),
    /// Generate code for the pose, the error Jacobian and the error sources in closed form
    Generate(Generate),
    /// Find the conventions of measured data: units, signs, order, zeros, Euler angles and more,
    /// from a few rows of joints and poses
    Doctor(Doctor),
    /// Plan measurements: evaluate sets of configurations, or choose optimal ones
    Plan(Plan),
    /// Simulate measurements of a machine with the repeatable sources of its spec
    Simulate(Simulate),
    /// Evaluate measurements of a machine: accuracy, repeatability, and the part that its sources
    /// explain
    Measure(Measure),
    /// Evaluate runs of one axis by ISO 230-2, or of body diagonals by ISO 230-6
    ///
    /// The characteristics A, E, M, R and B come with their uncertainty, if that of the instrument
    /// is stated.
    Positioning(Positioning),
    /// Identify the errors of a real machine from measurements
    Identify(Identify),
    /// Compute joint commands that compensate the errors of the machine
    ///
    /// The repeatable sources of the spec are the errors of the machine.
    Compensate(Compensate),
    /// Export the errors of a machine to files that controllers and other programs load
    ///
    /// The repeatable sources of the spec are exported. The errors that remain when the file is
    /// used are computed and printed.
    Export(Export),
    /// Monitor a machine by repeated checks: detect drift and jumps with control charts
    Monitor(Monitor),
    /// Print the JSON Schema of an input file, for completion and checks in editors
    Schema(Schema),
    /// Print the completion script of a shell
    Completions(Completions),
    /// Write the manual pages, for packagers
    Man(Man),
}
