use std::path::PathBuf;

use abbe_metrology::compensate::options::TOLERANCE;
use clap::{Args, ValueHint};

use super::shared::{Page, Running, Showing, Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe compensate found.toml plan.csv --map found.map.toml --out commands.csv
  abbe compensate found.toml plan.csv --map found.map.toml --tolerance 0.01mm --json
", "some rows are not compensated within the tolerance"))]
pub(crate) struct Compensate {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Joint commands: a CSV file with the joint and input columns of the map
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// Map (TOML) that describes the columns, or name of a shipped map. [default: columns named as
    /// the variables and inputs of the spec, in its length unit and in rad]
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Option<PathBuf>,
    /// Compensate the poses in the map's `[pose]` columns instead of the joint commands; the joints
    /// of each row are the start of the iteration
    #[arg(long, requires = "map")]
    pub(crate) poses: bool,
    /// Largest error allowed to remain at the tool point, as a length; for orientations, 1 rad
    /// counts as 1 m
    #[arg(long, value_name = "LENGTH", default_value = TOLERANCE, allow_hyphen_values = true)]
    pub(crate) tolerance: String,
    /// Write the corrected commands and their remaining errors to this CSV file
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
