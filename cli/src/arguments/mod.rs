//! What the command is told: one file per command, and in `shared` what several are told.

#[macro_use]
mod help;
mod analyze;
mod bound;
mod check;
mod compensate;
mod completions;
mod doctor;
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
mod plan;
mod shared;
mod simulate;
mod values;

pub(crate) use analyze::Analyze;
pub(crate) use bound::Bound;
pub(crate) use check::Check;
pub(crate) use compensate::Compensate;
pub(crate) use completions::Completions;
pub(crate) use doctor::Doctor;
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
pub(crate) use plan::Plan;
pub(crate) use shared::study;
pub(crate) use simulate::Simulate;

use clap::{Parser, Subcommand};

/// Predict, rank and check the position errors of a manipulator from its spec
///
/// A SPEC is the path of a spec file (TOML), or the name of a shipped manipulator: `abbe list`. Data are the argument
/// after it. `abbe COMMAND --help` has examples of every command.
///
/// Files are written whole or not at all, and never over one that is read. What abbe wrote, and nobody has changed since, it
/// replaces; other files only with `--force`. `-` is stdout.
#[derive(Debug, Parser)]
#[command(name = "abbe", version, after_help = after_help!(
    "  abbe analyze pps                which error matters, and how much
  abbe check arm.toml             is the spec right, and what follows from it
  abbe jacobian puma560 --q 0,-45deg,0,0,30deg,0
  abbe generate arm.toml --out arm.rs
",
    "a check failed, or a tolerance is not met"
), max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

// In the order in which they are used: a spec, what follows from it, measurements.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the shipped manipulators
    List(List),
    /// Write the spec of a robot that is described in URDF
    Import(Import),
    /// Check a spec; show its frames, variables, sources, operation counts and what can be identified
    Check(Check),
    /// Pose, error Jacobian and generalized errors at one configuration
    Jacobian(Jacobian),
    /// What every error source does over a workspace, alone and together
    Analyze(Analyze),
    /// How large the errors are at most: a largest error that was found, and one that nothing exceeds, with a proof
    Bound(Bound),
    /// The report of an analysis that was made in parts, on one machine or on many
    Merge(Merge),
    /// Generate code: pose, error Jacobian and sources in closed form
    Generate(Generate),
    /// Which convention is it? Units, signs, order, zeros, Euler angles and more of some rows of joints and poses
    Doctor(Doctor),
    /// Where to measure: sets of configurations, or the best of many
    Plan(Plan),
    /// Measurements of a machine whose errors are known: the repeatable sources of its spec
    Simulate(Simulate),
    /// How good a machine is, from measurements: accuracy, repeatability, and what its sources explain
    Measure(Measure),
    /// The errors of the real machine, from measurements
    Identify(Identify),
    /// Joint commands that put the real tool where the ideal one should be
    ///
    /// The repeatable sources of the spec are the errors of the machine.
    Compensate(Compensate),
    /// What was found of a machine, in the files that controllers and other programs load
    ///
    /// Exported are the repeatable sources of the spec. What remains of the errors when the file is used is computed and printed.
    Export(Export),
    /// Whether a machine that is checked again and again is still what it was
    Monitor(Monitor),
    /// What a shell needs to complete commands and options
    Completions(Completions),
    /// Write the manual pages: for packages
    Man(Man),
}
