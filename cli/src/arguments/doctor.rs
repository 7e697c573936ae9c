use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe doctor ur5 pendant.csv
  abbe doctor ur5 pendant.csv --within 5mm -o pendant.toml
  abbe doctor ur5 pendant.csv -o pendant.toml --corrected corrected.toml
", "no reading fits"))]
pub(crate) struct Doctor {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// A CSV file of some ten rows: a column for each joint, then x, y, z, then an orientation if there is one: three angles, a
    /// quaternion, a matrix of nine, or a homogeneous one of twelve or sixteen. Joints are found by their names, or are the first columns
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// What may be left of a position for a reading to fit. 2 % of how far the positions spread, if not given
    #[arg(long, value_name = "LENGTH")]
    pub(crate) within: Option<String>,
    /// Write the map of the reading to this file
    #[arg(long, short, value_name = "MAP")]
    pub(crate) out: Option<PathBuf>,
    /// Write the spec as the reading has it to this file, where it is other than the spec: another convention, a coupling, base or tool
    #[arg(long, value_name = "SPEC")]
    pub(crate) corrected: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    /// Print JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
