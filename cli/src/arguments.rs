//! What the command is told.

use std::path::PathBuf;

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
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    pub(crate) lang: Language,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Language {
    Rust,
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
    /// Write into this folder: report.html, its figures as SVG, and configurations.csv, sources.csv,
    /// unreachable.csv
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
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
