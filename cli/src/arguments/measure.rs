use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::shared::{Measured, Running, Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe measure ur5 data.csv --map ur5
  abbe measure ur5 data.csv --map ur5 --accept \"mean 0.5 mm\" --out measured
", "--accept, or the map's `accept`, is not met"))]
pub(crate) struct Measure {
    #[command(flatten)]
    pub(crate) subject: Subject,
    #[command(flatten)]
    pub(crate) measured: Measured,
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
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Station {
    /// One that no map knows
    New,
}
