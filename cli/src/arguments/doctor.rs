use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Showing, Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe doctor ur5 pendant.csv
  abbe doctor ur5 pendant.csv --within 5mm -o pendant.toml
  abbe doctor ur5 pendant.csv -o pendant.toml --corrected corrected.toml
", "no interpretation of the data fits"))]
pub(crate) struct Doctor {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// CSV file of about ten rows: one column per joint, then x, y, z and, optionally, an
    /// orientation (three angles, a quaternion, a 3×3 matrix of nine columns, or a homogeneous
    /// matrix of twelve or sixteen). Joint columns are found by name; otherwise they are the first
    /// columns
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// Largest position residual of an interpretation that fits, as a length. [default: 2 % of the
    /// spread of the positions]
    #[arg(long, value_name = "LENGTH")]
    pub(crate) within: Option<String>,
    /// Write the map of the best interpretation to this file
    #[arg(long, short, value_name = "MAP")]
    pub(crate) out: Option<PathBuf>,
    /// Write a corrected spec to this file if the best interpretation needs one: another
    /// convention, a joint coupling, a base or a tool
    #[arg(long, value_name = "SPEC")]
    pub(crate) corrected: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
