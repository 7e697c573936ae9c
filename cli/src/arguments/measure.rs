use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::shared::{Dated, Measured, Running, Showing, Subject, Writing};

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
    /// Estimate the station of the instrument from the data instead of taking it from the map:
    /// `new` if the instrument was moved
    #[arg(long, value_enum, value_name = "WHICH")]
    pub(crate) station: Option<Station>,
    /// Acceptance limits on mean, rms, p95 and max of the position error that remains after the
    /// sources of the spec: `mean 0.15 mm, max 0.3 mm`. Exit with status 1 if they are not met
    #[arg(long, value_name = "LIMITS")]
    pub(crate) accept: Option<String>,
    /// Write report.html, and errors.csv with ΔX, prediction and residual of every row, into this
    /// folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) dated: Dated,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Station {
    /// The instrument stands at a station that the map does not describe
    New,
}
