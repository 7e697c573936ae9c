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
    /// URDF file (a xacro is expanded first: `xacro robot.urdf.xacro > robot.urdf`); with `--dh` a table of Denavit-Hartenberg
    /// numbers, as CSV or as the Robotics Toolbox prints it
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) file: PathBuf,
    /// The link whose frame is F_0. The root if not given
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    pub(crate) base: Option<String>,
    /// The link whose frame is the tool point. The last link, if there is only one
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    pub(crate) tip: Option<String>,
    /// Put fixed joints into the frames that follow them, and the last ones into the tool; without, each is a frame of its own
    /// that has errors of its own
    #[arg(long, conflicts_with = "dh")]
    pub(crate) fold: bool,
    /// The file is a table with the columns theta, d, a and alpha, of this convention: standard is Rz(theta) Tz(d) Tx(a) Rx(alpha),
    /// modified (Craig) Rx(alpha) Tx(a) Rz(theta) Tz(d)
    #[arg(long, value_name = "CONVENTION", value_parser = named(CONVENTIONS))]
    pub(crate) dh: Option<DhConvention>,
    /// The units of the table where its heading does not say them, as `mm,deg` or `m,rad`
    #[arg(long, value_name = "UNITS", requires = "dh")]
    pub(crate) units: Option<Units>,
    /// Write angles that are multiples of 45° but for rounding in the file (up to 1e-5 rad) as such
    #[arg(long)]
    pub(crate) round_angles: bool,
    /// Write the spec to this file instead of stdout
    #[arg(long, short, value_name = "SPEC")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    /// Print JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
