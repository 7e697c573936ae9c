use std::path::PathBuf;
use std::time::Duration;

use abbe_study::bound::options::{BOXES, Gap};
use clap::Args;

use super::shared::{Running, Subject};
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
    /// Study file: its workspace is the box. If not given as for `abbe analyze`; without any, the limits of the joints and the
    /// ranges of the inputs
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// How much more than the largest error that was found the certified one may be, in percent or as a share
    #[arg(long, value_name = "GAP", default_value_t)]
    pub(crate) gap: Gap,
    /// Also say how far the joints move the tool at least (the dexterity, 0 in a singular place) and, where beams or compliances give way, how stiff the
    /// tool point is at least
    #[arg(long)]
    pub(crate) least: bool,
    /// The most boxes that are looked at for each error
    #[arg(long, value_name = "N", default_value_t = BOXES.default, value_parser = whole(BOXES.range))]
    pub(crate) boxes: usize,
    /// End after this time, with what is proved until then: `60s`, `5min`
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    #[command(flatten)]
    pub(crate) running: Running,
}
