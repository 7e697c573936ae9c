use std::path::PathBuf;

use abbe_study::simulate::options::{OUTLIERS, SAMPLES};
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
    /// Configurations: a CSV file with the joints and inputs of the map. Random ones within the limits if not given
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: Option<PathBuf>,
    /// What the columns are to be: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// How many random configurations, if no file says which
    #[arg(long, value_name = "N", default_value_t = SAMPLES.default, conflicts_with = "data", value_parser = whole(SAMPLES.range))]
    pub(crate) samples: usize,
    /// One standard deviation of a coordinate: `0.04mm`. That of the map if not given
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) noise: Option<String>,
    /// Which share of the rows is grossly wrong
    #[arg(long, value_name = "SHARE", default_value_t = OUTLIERS.default, value_parser = share)]
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
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
