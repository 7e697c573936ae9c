//! The `abbe` command: predicts, ranks and checks the errors of a manipulator from its spec.
//!
//! `arguments` parses the command line. Each command has one module, which turns its arguments into
//! a job of `abbe_study`, and the report into text (by `abbe_report`), JSON and files. Results go
//! to stdout, all other messages to stderr. The exit status is 0, 1 if a check failed, 2 for wrong
//! usage or input, and 128 + n after signal n.

mod allocate;
mod analyze;
mod arguments;
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
mod number;
mod output;
mod plan;
mod positioning;
mod schema;
mod signs;
mod simulate;

use std::process::ExitCode;

use abbe_report::text::at_width;
use clap::{CommandFactory, Parser};

use arguments::{Arguments, Command};
use failure::Failure;
use output::Outcome;

fn main() -> ExitCode {
    interrupt::clean_up_on_signals();
    abbe_study::set_version(env!("ABBE_VERSION"));
    let result = Arguments::try_parse().map_or_else(
        |usage| output::print_usage(&usage),
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

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
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
        Some(Command::Completions(arguments)) => completions::run(arguments),
        Some(Command::Man(arguments)) => man::run(arguments),
    }
}
