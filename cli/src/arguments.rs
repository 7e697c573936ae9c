//! What the command is told.

use std::path::PathBuf;

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::print::Language;
use abbe_codegen::spec::Spec;
use abbe_study::identify::Prior;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

/// Predict, rank and check the position errors of a manipulator from its spec
#[derive(Debug, Parser)]
#[command(name = "abbe", version, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

const EXAMPLES: &str = "\
A SPEC is the path of a spec file (TOML), or the name of a shipped manipulator.

Examples:
  abbe analyze pps                which error matters, and how much
  abbe check my-arm.toml          is the spec right, and what follows from it
  abbe jacobian puma560 --q 0,-45deg,0,0,30deg,0
  abbe generate my-arm.toml --out my_arm.rs
";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the shipped manipulators
    List(List),
    /// Check a spec; show its frames, variables, sources, operation counts and what can be identified
    Check(Check),
    /// Generate code: pose, error Jacobian and sources in closed form
    Generate(Generate),
    /// Pose, error Jacobian and generalized errors at one configuration
    Jacobian(Jacobian),
    /// What every error source does over a workspace, alone and together
    Analyze(Analyze),
    /// How good a machine is, from measurements: accuracy, repeatability, and what its sources explain
    Measure(Measure),
    /// The errors of the real machine, from measurements
    Identify(Identify),
    /// Whether a machine that is checked again and again is still what it was
    Monitor(Monitor),
    /// Joint commands that put the real tool where the ideal one should be
    Compensate(Compensate),
    /// Where to measure: sets of configurations, or the best of many
    Plan(Plan),
    /// Measurements of a machine whose errors are known
    Simulate(Simulate),
}

#[derive(Args, Debug)]
pub(crate) struct List {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Check {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Generate {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Language of the code
    #[arg(long, value_parser = language(), default_value = Language::Rust.name())]
    pub(crate) lang: Language,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// The languages by their names.
fn language() -> impl TypedValueParser<Value = Language> {
    PossibleValuesParser::new(Language::ALL.map(Language::name)).try_map(|name| {
        Language::ALL.into_iter().find(|language| language.name() == name).ok_or("no such language")
    })
}

#[derive(Args, Debug)]
pub(crate) struct Jacobian {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Joint variables, in order: `--q 500,0.2m,0,-90deg,pi/180,0`; home if not given
    ///
    /// A number without a unit is in the spec's length unit, or in rad.
    #[arg(long, value_name = "V,V,…", allow_hyphen_values = true)]
    pub(crate) q: Option<String>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Analyze {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Study file: workspace, tolerance, published figures. If not given, the study shipped with the
    /// manipulator, or else 1000 joint samples
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Draw all errors this often at the worst configuration and at home, on the exact chain with true rotations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    pub(crate) monte_carlo: Option<u64>,
    /// Seed of everything random: the draws, and a study's random samples
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// How many threads work; the results are the same for any number. All cores if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Run the spec of a shipped manipulator, not its generated code: the same, slower
    #[arg(long)]
    pub(crate) interpret: bool,
    /// End with status 1 if a tolerance of the study is not met
    #[arg(long)]
    pub(crate) check: bool,
    /// Write into this folder: report.html, its figures as SVG, and configurations.csv, sources.csv,
    /// unreachable.csv, with draws monte_carlo.csv
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Identify {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Measurements: a CSV file
    pub(crate) data: PathBuf,
    /// What the columns are: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Measurements to judge by; nothing is chosen after them
    #[arg(long, value_name = "FILE")]
    pub(crate) test: Option<PathBuf>,
    /// Richer terms to try beside constant errors; those stay that help on rows left out in turn
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FAMILY,…")]
    pub(crate) terms: Vec<Terms>,
    /// Gear ratios: errors of a joint so many times per turn of it are tried as well: `--harmonics q2=1,2,101`
    #[arg(long, value_name = "JOINT=N,…")]
    pub(crate) harmonics: Vec<String>,
    /// How long richer terms are tried: `60s`, `5min`; then what comes out depends on the computer. As long as it takes if not
    /// given
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<std::time::Duration>,
    /// A loss that gross errors cannot pull at
    #[arg(long, value_enum, default_value_t = Robust::None)]
    pub(crate) robust: Robust,
    /// How large errors are expected to be, as a share of the arm's length and in rad, 0 for no expectation; `spec`: as its
    /// random sources have them; `auto`: as rows left out in turn fit best
    #[arg(long, value_name = "SHARE", default_value = "0.01", value_parser = prior)]
    pub(crate) prior: Prior,
    /// Limits for rows that nothing is fitted to, `mean 0.15 mm, max 0.3 mm`: of mean, rms, p95 and max. End with status 1 if
    /// they are not met
    #[arg(long, value_name = "LIMITS")]
    pub(crate) accept: Option<String>,
    /// Into how many parts the rows are dealt, each left out in turn
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = folds)]
    pub(crate) folds: usize,
    /// Write the spec with the errors found, as repeatable sources; beside it, as FILE.map.toml, the map with where the
    /// machine stands and what is mounted on its tool
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Write a page with pictures: an HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// The date that the page shows; it knows no clock
    #[arg(long, value_name = "DATE", requires = "report")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Measure {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Measurements: a CSV file
    pub(crate) data: PathBuf,
    /// What the columns are: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// The instrument stands elsewhere than the map says: its station is found from the data, for the machine as it is
    #[arg(long, value_enum, value_name = "WHICH")]
    pub(crate) station: Option<Station>,
    /// Limits for what the sources of the spec leave, `mean 0.15 mm, max 0.3 mm`: of mean, rms, p95 and max. End with status
    /// 1 if they are not met
    #[arg(long, value_name = "LIMITS")]
    pub(crate) accept: Option<String>,
    /// Write into this folder: report.html, and errors.csv with ΔX of every row
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// The date that the page shows; it knows no clock
    #[arg(long, value_name = "DATE", requires = "out")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Monitor {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// Checks in the order of their dates: CSV files with the same few configurations each, or one with a column of dates
    #[arg(required = true)]
    pub(crate) data: Vec<PathBuf>,
    /// What the columns are: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// How far the tool point may move from where it was at the first check: when that is used up
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) tolerance: Option<String>,
    /// Begin with the check of this date: after the machine was serviced or zeroed
    #[arg(long, value_name = "DATE", allow_hyphen_values = true)]
    pub(crate) since: Option<String>,
    /// On average no more than one false alarm in so many checks, over all charts together
    #[arg(long, value_name = "CHECKS", default_value_t = 365, value_parser = clap::value_parser!(u32).range(10..=100_000))]
    pub(crate) false_alarm: u32,
    /// End with status 1 if there is an alarm
    #[arg(long)]
    pub(crate) check: bool,
    /// Write a page with pictures: an HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// The date that the page shows; it knows no clock
    #[arg(long, value_name = "DATE", requires = "report")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Compensate {
    /// Spec file, or shipped name: its repeatable sources are the errors of the machine
    pub(crate) spec: String,
    /// Configurations: a CSV file with the joints and inputs of the map
    #[arg(long, value_name = "FILE")]
    pub(crate) data: PathBuf,
    /// What the columns are: a map (TOML), or the name of a shipped one. If not given, they are named as the variables and
    /// inputs of the spec, in its length unit and in rad
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Option<PathBuf>,
    /// Bring the tool to the poses of the map's `[pose]` columns, from the joints of the row on
    #[arg(long, requires = "map")]
    pub(crate) poses: bool,
    /// What may be left at the tool point; of an angle, 1 rad counts as 1 m
    #[arg(long, value_name = "LENGTH", default_value = "0.001mm", allow_hyphen_values = true)]
    pub(crate) tolerance: String,
    /// Write the corrected commands and what they leave: a CSV file
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Write a page with pictures: an HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// The date that the page shows; it knows no clock
    #[arg(long, value_name = "DATE", requires = "report")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Plan {
    /// Spec file, or shipped name
    pub(crate) spec: String,
    /// What the columns will be: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Sets of configurations: a plan file (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE", conflicts_with = "optimal")]
    pub(crate) sets: Option<PathBuf>,
    /// The N configurations that tell most
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=5000))]
    pub(crate) optimal: Option<u16>,
    /// What is best: the smallest mean variance of the tool point where the machine is used, or the largest determinant of
    /// the information
    #[arg(long, value_enum, default_value_t = Criterion::V)]
    pub(crate) criterion: Criterion,
    /// From how many samples within the limits these are chosen
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1_000_000))]
    pub(crate) candidates: usize,
    /// What the identified model leaves of the tool point by itself, beside the instrument's noise: the root mean square of its
    /// distance in an earlier fit
    #[arg(long, value_name = "LENGTH", default_value = "0mm", allow_hyphen_values = true)]
    pub(crate) model_error: String,
    /// Where the machine is to be used: the workspace of this study. If not given, that of the study shipped with the
    /// manipulator, or else joint samples
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Write the configurations: a CSV file to be completed by measuring
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Simulate {
    /// Spec file, or shipped name: its repeatable sources are the errors of the machine
    pub(crate) spec: String,
    /// What the columns are to be: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Configurations: a CSV file with the joints and inputs of the map
    #[arg(long, value_name = "FILE")]
    pub(crate) at: Option<PathBuf>,
    /// How many random configurations within the limits, if no file says which
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=10_000_000))]
    pub(crate) samples: usize,
    /// One standard deviation of a coordinate: `0.04mm`. That of the map if not given
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) noise: Option<String>,
    /// Which share of the rows is grossly wrong
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    pub(crate) outliers: f64,
    /// Draw the random sources of the spec too, anew in every row
    #[arg(long)]
    pub(crate) random: bool,
    /// Seed of everything random
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) changes: Changes,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Terms {
    /// All that follow
    Auto,
    /// Errors that change with a frame's own joint: one to four times per turn, or with its travel
    Joint,
    /// Errors in proportion to an input: a load, a temperature, a motor's current
    Load,
    /// Turns in proportion to the moment of weights
    Elastic,
    /// Errors of joints by the direction they came from, row by row, or in which a weight pulls
    Backlash,
    /// Errors of joints with another joint, or with two
    Product,
    /// Errors that grow or settle from row to row: they are of the file, not of the machine
    Drift,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Criterion {
    /// V-optimal: the tool point is known best where it is used
    V,
    /// D-optimal
    D,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Robust {
    None,
    Huber,
    Tukey,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Station {
    /// One that no map knows
    New,
}

fn prior(text: &str) -> Result<Prior, String> {
    match text {
        "spec" => Ok(Prior::Spec),
        "auto" => Ok(Prior::Auto),
        text => share(text).map(Prior::Share),
    }
}

fn duration(text: &str) -> Result<std::time::Duration, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..].trim() {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("a time has a unit: `60s`, `5min`, `1h`".to_owned()),
    };
    let seconds = digits.trim().parse::<f64>().map_err(|error| error.to_string())? * factor;
    std::time::Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

fn share(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().map_err(|error| error.to_string())?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share is from 0 to 1".to_owned()) }
}

fn folds(text: &str) -> Result<usize, String> {
    let value = text.parse::<usize>().map_err(|error| error.to_string())?;
    if (2..=1000).contains(&value) { Ok(value) } else { Err("from 2 to 1000 parts".to_owned()) }
}

#[derive(Args, Debug)]
pub(crate) struct Changes {
    /// Set a parameter or an input: `--set x=250mm`
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Switch an error source on
    #[arg(long, value_name = "SOURCE")]
    pub(crate) enable: Vec<String>,
    /// Switch an error source off
    #[arg(long, value_name = "SOURCE")]
    pub(crate) disable: Vec<String>,
}

impl Changes {
    /// Reads them; the options are where mistakes are shown.
    pub(crate) fn read(&self, spec: &Spec) -> Result<abbe_study::Changes, Diagnostics> {
        abbe_study::Changes::read(&self.set, &self.enable, &self.disable, spec)
    }
}
