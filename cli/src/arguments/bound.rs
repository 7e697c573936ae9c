use std::path::PathBuf;
use std::time::Duration;

use abbe_study::bound::options::{BOXES, Gap};
use clap::Args;

use super::shared::{Running, Showing, Subject};
use super::values::{duration, whole};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe bound pps
  abbe bound arm.toml --gap 0.1%
  abbe bound arm.toml --study cell.toml --set payload=5kg --json
"))]
pub(crate) struct Bound {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Study file (TOML) whose workspace is the search box. [default: the study that `abbe analyze`
    /// uses; without one, the joint limits and the ranges of the inputs]
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    pub(crate) tolerance: Vec<String>,
    /// Relative gap at which to stop: by how much the certified bound may exceed the largest error
    /// found, in percent or as a fraction
    #[arg(long, value_name = "GAP", default_value_t)]
    pub(crate) gap: Gap,
    /// Also certify lower bounds: the dexterity (smallest joint-to-tool motion, 0 at a singular
    /// pose) and, if the spec has beams or compliances, the stiffness at the tool point
    #[arg(long)]
    pub(crate) least: bool,
    /// Maximum number of boxes to examine for each error
    #[arg(long, value_name = "N", default_value_t = BOXES.default, value_parser = whole(BOXES.range))]
    pub(crate) boxes: usize,
    /// Time limit (`60s`, `5min`, `1h`), after which the bounds proved so far are reported.
    /// [default: none]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
