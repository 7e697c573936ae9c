use std::path::PathBuf;

use abbe_study::analyze::options::DRAWS;
use abbe_study::analyze::parts::Shard;
use clap::Args;

use super::shared::{Dated, Running, Showing, Subject, Writing};
use super::values::whole;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe analyze pps
  abbe analyze arm.toml --set payload=2kg --monte-carlo 10000
  abbe analyze arm.toml --study cell.toml --check
  abbe analyze arm.toml --out arm       with figures: arm/report.html needs no network
  abbe analyze arm.toml --q 300,30deg,-45deg    at one configuration
  abbe analyze arm.toml --shard 1/2 --out 1.part
  abbe analyze arm.toml --shard 2/2 --out 2.part    on another machine: see `abbe merge`
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Analyze {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Study file (TOML), or name of a shipped study: workspace, tolerance, published figures.
    /// [default: arm.study.toml beside arm.toml, or the study shipped with the manipulator, or 1000
    /// joint samples]
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    pub(crate) tolerance: Vec<String>,
    /// Analyze one configuration instead of the study's workspace: joint variables in the order of
    /// the spec, as for `abbe jacobian`, with nominal inputs or those of --set. Published figures
    /// are not compared
    #[arg(long, value_name = "V,V,…", allow_hyphen_values = true, conflicts_with = "shard")]
    pub(crate) q: Option<String>,
    /// Number of Monte Carlo draws of all error sources, at the worst configuration and at home,
    /// through the exact chain with finite rotations. [default: no draws]
    #[arg(long, value_name = "N", value_parser = whole(DRAWS))]
    pub(crate) monte_carlo: Option<usize>,
    /// Seed of the Monte Carlo draws and of the study's random samples. [default: 0 for the draws,
    /// the study's seed for its samples]
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// Interpret the spec of a shipped manipulator instead of running its generated code: the same
    /// results, slower
    #[arg(long)]
    pub(crate) interpret: bool,
    /// Exit with status 1 if a tolerance of the study is not met
    #[arg(long)]
    pub(crate) check: bool,
    /// Write report.html, its figures as SVG, configurations.csv, sources.csv, unreachable.csv and,
    /// with --monte-carlo, monte_carlo.csv into this folder. With --shard: write the part to this
    /// file
    #[arg(long, value_name = "PATH")]
    pub(crate) out: Option<PathBuf>,
    /// Sweep part I of N of the workspace (I from 1 to N) and write a part file for `abbe merge`
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with_all = ["json", "check", "date"])]
    pub(crate) shard: Option<Shard>,
    /// Do not collect data for figures in this part, which is faster; the merged text and --json
    /// stay complete
    #[arg(long, requires = "shard")]
    pub(crate) no_figures: bool,
    #[command(flatten)]
    pub(crate) dated: Dated,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
