use std::path::PathBuf;

use abbe_metrology::simulate::options::{OUTLIERS, SAMPLES};
use clap::{Args, ValueHint};

use super::shared::{Running, Subject, Writing};
use super::values::{share, whole};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe simulate ur5 plan.csv --map ur5 --out data.csv
  abbe simulate ur5 --map ur5 --samples 200 --noise 0.02mm --seed 1 --out test.csv
"))]
pub(crate) struct Simulate {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Configurations: a CSV file with the joint and input columns of the map. [default: random
    /// configurations within the limits]
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: Option<PathBuf>,
    /// Map (TOML) that describes the columns to write, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Number of random configurations
    #[arg(long, value_name = "N", default_value_t = SAMPLES.default, conflicts_with = "data", value_parser = whole(SAMPLES.range))]
    pub(crate) samples: usize,
    /// Standard deviation of the noise of each coordinate: `0.04mm`. [default: the uncertainty in
    /// the map]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) noise: Option<String>,
    /// Fraction of the rows that are outliers, from 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = OUTLIERS.default, value_parser = share)]
    pub(crate) outliers: f64,
    /// Also draw the random sources of the spec, anew in every row, and its tolerances, once
    #[arg(long)]
    pub(crate) random: bool,
    /// Seed of the configurations, noise, outliers and random sources
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
