use std::path::PathBuf;

use abbe_spec::DhConvention;
use abbe_study::import::Units;
use abbe_study::options::CONVENTIONS;
use clap::{Args, ValueHint};

use super::shared::Writing;
use super::values::named;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe import robot.urdf --base base_link --tip tool0 -o robot.toml
  abbe import robot.urdf --tip tool0 --fold --round-angles
  abbe import dh.csv --dh standard --units mm,deg -o dh.toml
"))]
pub(crate) struct Import {
    /// URDF file (expand xacro files first: `xacro robot.urdf.xacro > robot.urdf`). With --dh: a
    /// table of Denavit-Hartenberg parameters, as CSV or as the Robotics Toolbox prints it
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) file: PathBuf,
    /// Link whose frame is F_0. [default: the root link]
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    pub(crate) base: Option<String>,
    /// Link whose frame is the tool point. [default: the last link, if there is only one]
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    pub(crate) tip: Option<String>,
    /// Merge fixed joints into the frames that follow them, and trailing ones into the tool; by
    /// default each fixed joint is a frame with errors of its own
    #[arg(long, conflicts_with = "dh")]
    pub(crate) fold: bool,
    /// Read a table with the columns theta, d, a and alpha of this convention: standard is
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha), modified (Craig) is Rx(alpha) Tx(a) Rz(theta) Tz(d)
    #[arg(long, value_name = "CONVENTION", value_parser = named(CONVENTIONS))]
    pub(crate) dh: Option<DhConvention>,
    /// Units of the table if its header names none: `mm,deg` or `m,rad`, for example
    #[arg(long, value_name = "UNITS", requires = "dh")]
    pub(crate) units: Option<Units>,
    /// Round angles within 1e-5 rad of a multiple of 45° to that multiple
    #[arg(long)]
    pub(crate) round_angles: bool,
    /// Write the spec to this file instead of stdout
    #[arg(long, short, value_name = "SPEC")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
