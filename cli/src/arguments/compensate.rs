use std::path::PathBuf;

use abbe_study::compensate::options::TOLERANCE;
use clap::{Args, ValueHint};

use super::shared::{Page, Running, Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe compensate found.toml plan.csv --map found.map.toml --out commands.csv
  abbe compensate found.toml plan.csv --map found.map.toml --tolerance 0.01mm --json
", "some rows are not compensated: more than the tolerance is left"))]
pub(crate) struct Compensate {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Configurations: a CSV file with the joints and inputs of the map
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// What the columns are: a map (TOML), or the name of a shipped one. If not given, they are named as the variables and
    /// inputs of the spec, in its length unit and in rad
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Option<PathBuf>,
    /// Bring the tool to the poses of the map's `[pose]` columns, from the joints of the row on
    #[arg(long, requires = "map")]
    pub(crate) poses: bool,
    /// What may be left at the tool point; of an angle, 1 rad counts as 1 m
    #[arg(long, value_name = "LENGTH", default_value = TOLERANCE, allow_hyphen_values = true)]
    pub(crate) tolerance: String,
    /// Write the corrected commands and what they leave: a CSV file
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
