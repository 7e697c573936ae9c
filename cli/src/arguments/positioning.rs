use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Showing, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe positioning x-axis.csv --reading-uncertainty 0.1um --scale-uncertainty 1um/m
  abbe positioning x-axis.csv --out exx.csv
  abbe positioning diagonals.csv
"))]
pub(crate) struct Positioning {
    /// Runs: a CSV file with columns `position (mm)`, `direction` (`+` or `-`) and `deviation
    /// (um)`, or `actual (mm)`; or with one column for each pass, `1+ (um)`, `1- (um)`, …
    ///
    /// A column `diagonal` names the body diagonal of each row, and the runs are evaluated by
    /// ISO 230-6.
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// Standard uncertainty of one reading of the instrument: `0.1um`, `0.05arcsec`
    #[arg(long, value_name = "VALUE")]
    pub(crate) reading_uncertainty: Option<String>,
    /// Standard uncertainty of the scale of the instrument, with that of the temperature: `1um/m`
    #[arg(long, value_name = "VALUE")]
    pub(crate) scale_uncertainty: Option<String>,
    /// Write the mean deviations at the positions to this CSV file, for a table of a spec
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
