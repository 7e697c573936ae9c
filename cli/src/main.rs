//! The `abbe` command: predicts, ranks and checks the errors of a manipulator from its spec.
//!
//! Each command has one module: its arguments, which `clap` parses, and `run`, which turns them
//! into a job of `abbe_study`, and the report into text (by `abbe_report`), JSON and files. Results
//! go to stdout, all other messages to stderr. The exit status is 0, 1 if a check failed, 2 for
//! wrong usage or input, and 128 + n after signal n.

#[macro_use]
mod arguments;
mod allocate;
mod analyze;
mod bound;
mod check;
mod compensate;
mod completions;
mod console;
mod doctor;
mod explore;
mod export;
mod failure;
mod generate;
mod identify;
mod import;
mod interrupt;
mod jacobian;
mod list;
mod man;
mod measure;
mod merge;
mod monitor;
mod new;
mod output;
mod plan;
mod positioning;
mod schema;
mod signs;
mod simulate;

use std::process::ExitCode;

use abbe_report::text::at_width;
use clap::{CommandFactory, Parser, Subcommand};

use arguments::with_tip;
use console::Console;
use failure::{Failure, Result};
use output::{Outcome, Outputs};

/// Predict, rank and check the position errors of a manipulator from its spec
///
/// A SPEC is the path of a spec file (TOML) or the name of a shipped manipulator (`abbe list`).
/// Data files follow it. `abbe COMMAND --help` shows examples of each command.
///
/// Output files are written completely or not at all, and never replace an input of the same run.
/// Files that abbe wrote, and that have not been changed since, are replaced; other files only with
/// `--force`. `-` is stdout.
#[derive(Debug, Parser)]
#[command(name = "abbe", bin_name = "abbe", version = env!("ABBE_VERSION"), after_help = after_help!(
    "  abbe analyze pps                rank the error sources
  abbe check arm.toml             check the spec, show the model
  abbe jacobian puma560 --q 0,-45deg,0,0,30deg,0
  abbe generate arm.toml --out arm.rs
",
    "a check failed, or a tolerance is not met"
), max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

// Sorted by use: first the spec, then its analysis, then measurements.
#[derive(Debug, Subcommand)]
enum Command {
    /// List the shipped manipulators
    List(list::List),
    /// Write a first spec from a template
    New(new::New),
    /// Convert a URDF robot or a table of Denavit-Hartenberg parameters to a spec
    Import(import::Import),
    /// Check a spec; show its frames, variables, sources, operation counts and identifiable errors
    Check(check::Check),
    /// Print pose, error Jacobian and generalized errors at one configuration
    Jacobian(jacobian::Jacobian),
    /// Compute the errors of every source, and of all sources together, over a workspace
    Analyze(analyze::Analyze),
    /// Write a page on which joints, inputs and error sources can be varied
    ///
    /// One HTML file, which needs no network: it contains the generated code of the machine, and
    /// shows its errors while values change. With two specs, both machines side by side.
    Explore(explore::Explore),
    /// Certify upper bounds of the errors, beside the largest errors found
    Bound(bound::Bound),
    /// Allocate the tolerance: factors of the error sources that keep it at least cost
    ///
    /// It is kept with all smaller factors, too: no error is relied on to cancel another one.
    Allocate(allocate::Allocate),
    /// Merge the parts of an analysis that was computed in several runs
    Merge(merge::Merge),
    /// Generate code for the pose, the error Jacobian and the error sources in closed form
    Generate(generate::Generate),
    /// Find the conventions of measured data: units, signs, order, zeros, Euler angles and more,
    /// from a few rows of joints and poses
    Doctor(doctor::Doctor),
    /// Plan measurements: evaluate sets of configurations, or choose optimal ones
    Plan(plan::Plan),
    /// Simulate measurements of a machine with the repeatable sources of its spec
    Simulate(simulate::Simulate),
    /// Evaluate measurements of a machine: accuracy, repeatability, and the part that its sources
    /// explain
    Measure(measure::Measure),
    /// Evaluate runs of one axis by ISO 230-2, diagonals by ISO 230-6, or circles by ISO 230-4
    ///
    /// The characteristics A, E, M, R and B come with their uncertainty, if that of the instrument
    /// is stated.
    Positioning(positioning::Positioning),
    /// Identify the errors of a real machine from measurements
    Identify(identify::Identify),
    /// Compute joint commands that compensate the errors of the machine
    ///
    /// The repeatable sources of the spec are the errors of the machine.
    Compensate(compensate::Compensate),
    /// Export the errors of a machine to files that controllers and other programs load
    ///
    /// The repeatable sources of the spec are exported. The errors that remain when the file is
    /// used are computed and printed.
    Export(export::Export),
    /// Monitor a machine by repeated checks: detect drift and jumps with control charts
    Monitor(monitor::Monitor),
    /// Print the JSON Schema of an input file, for completion and checks in editors
    Schema(schema::Schema),
    /// Print the completion script of a shell
    Completions(completions::Completions),
    /// Write the manual pages, for packagers
    Man(man::Man),
}

fn main() -> ExitCode {
    interrupt::clean_up_on_signals();
    abbe_study::set_version(env!("ABBE_VERSION"));
    let result = Arguments::try_parse().map_or_else(
        |usage| output::print_usage(&with_tip(usage, &Arguments::command())),
        |arguments| {
            console::watch();
            let result = at_width(console::width(), || run(&arguments));
            console::done();
            result.and_then(|outcome| outcome.print())
        },
    );
    match result {
        Ok(status) => status,
        Err(failure) => failure.report(),
    }
}

fn run(arguments: &Arguments) -> Result<Outcome> {
    match &arguments.command {
        None => Ok(Outcome::passed(Arguments::command().render_long_help().to_string() + "\n")),
        Some(Command::List(arguments)) => list::run(arguments),
        Some(Command::Check(arguments)) => check::run(arguments),
        Some(Command::Jacobian(arguments)) => jacobian::run(arguments),
        Some(Command::Analyze(arguments)) => analyze::run(arguments),
        Some(Command::Explore(arguments)) => explore::run(arguments),
        Some(Command::Bound(arguments)) => bound::run(arguments),
        Some(Command::Allocate(arguments)) => allocate::run(arguments),
        Some(Command::Merge(arguments)) => merge::run(arguments),
        Some(Command::New(arguments)) => new::run(arguments),
        Some(Command::Import(arguments)) => import::run(arguments),
        Some(Command::Doctor(arguments)) => doctor::run(arguments),
        Some(Command::Generate(arguments)) => generate::run(arguments),
        Some(Command::Plan(arguments)) => plan::run(arguments),
        Some(Command::Positioning(arguments)) => positioning::run(arguments),
        Some(Command::Simulate(arguments)) => simulate::run(arguments),
        Some(Command::Measure(arguments)) => measure::run(arguments),
        Some(Command::Identify(arguments)) => identify::run(arguments),
        Some(Command::Compensate(arguments)) => compensate::run(arguments),
        Some(Command::Export(arguments)) => export::run(arguments),
        Some(Command::Monitor(arguments)) => monitor::run(arguments),
        Some(Command::Schema(arguments)) => schema::run(arguments),
        Some(Command::Completions(arguments)) => completions::run(arguments, Arguments::command()),
        Some(Command::Man(arguments)) => man::run(arguments, Arguments::command()),
    }
}
