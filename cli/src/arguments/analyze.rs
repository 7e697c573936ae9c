use std::path::PathBuf;

use abbe_study::analyze::options::DRAWS;
use abbe_study::analyze::parts::Shard;
use clap::Args;

use super::shared::{Running, Subject, Writing};
use super::values::whole;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe analyze pps
  abbe analyze arm.toml --set payload=2kg --monte-carlo 10000
  abbe analyze arm.toml --study cell.toml --check
  abbe analyze arm.toml --out arm       pictures, too: arm/report.html opens offline
  abbe analyze arm.toml --shard 1/2 --out 1.part
  abbe analyze arm.toml --shard 2/2 --out 2.part    on another machine: see `abbe merge`
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Analyze {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Study file: workspace, tolerance, published figures. If not given: beside arm.toml the study arm.study.toml, or the one
    /// shipped with the manipulator, or else 1000 joint samples
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Draw all errors this often at the worst configuration and at home, on the exact chain with true rotations
    #[arg(long, value_name = "N", value_parser = whole(DRAWS))]
    pub(crate) monte_carlo: Option<usize>,
    /// Seed of everything random: the draws, and a study's random samples
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// Run the spec of a shipped manipulator, not its generated code: the same, slower
    #[arg(long)]
    pub(crate) interpret: bool,
    /// End with status 1 if a tolerance of the study is not met
    #[arg(long)]
    pub(crate) check: bool,
    /// Write into this folder: report.html, its figures as SVG, and configurations.csv, sources.csv,
    /// unreachable.csv, with draws monte_carlo.csv. With --shard: into this file
    #[arg(long, value_name = "PATH")]
    pub(crate) out: Option<PathBuf>,
    /// Sweep one of N shares of the workspace, I from 1 to N, and write what `abbe merge` needs of it
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with_all = ["json", "check"])]
    pub(crate) shard: Option<Shard>,
    /// With --shard: gather nothing for pictures, which is sooner; merged are the text and --json
    #[arg(long, requires = "shard")]
    pub(crate) no_figures: bool,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
