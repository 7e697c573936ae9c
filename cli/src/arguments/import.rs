use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::Writing;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe import robot.urdf --base base_link --tip tool0 -o robot.toml
  abbe import robot.urdf --tip tool0 --fold --round-angles
"))]
pub(crate) struct Import {
    /// URDF file; a xacro is expanded first: `xacro robot.urdf.xacro > robot.urdf`
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) file: PathBuf,
    /// The link whose frame is F_0. The root if not given
    #[arg(long, value_name = "LINK")]
    pub(crate) base: Option<String>,
    /// The link whose frame is the tool point. The last link, if there is only one
    #[arg(long, value_name = "LINK")]
    pub(crate) tip: Option<String>,
    /// Put fixed joints into the frames that follow them, and the last ones into the tool; without, each is a frame of its own
    /// that has errors of its own
    #[arg(long)]
    pub(crate) fold: bool,
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
