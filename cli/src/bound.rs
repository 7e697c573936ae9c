//! `abbe bound`: certified upper bounds of the errors.

use std::{path::PathBuf, time::Duration};

use abbe_bound::Effort;
use abbe_report::views;
use abbe_study::bound;
use abbe_study::bound::options::{BOXES, Gap};
use clap::Args;

use crate::arguments::{Running, Showing, Subject, duration, study, whole};
use crate::{Console, Outcome, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe bound pps
  abbe bound arm.toml --gap 0.1%
  abbe bound arm.toml --study cell.toml --set payload=5kg --json
"))]
pub(crate) struct Bound {
    #[command(flatten)]
    subject: Subject,
    /// Study file (TOML) whose workspace is the search box. [default: the study that `abbe analyze`
    /// uses; without one, the joint limits and the ranges of the inputs]
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    tolerance: Vec<String>,
    /// Relative gap at which to stop: by how much the certified bound may exceed the largest error
    /// found, in percent or as a fraction
    #[arg(long, value_name = "GAP", default_value_t)]
    gap: Gap,
    /// Also certify lower bounds: the dexterity (smallest joint-to-tool motion, 0 at a singular
    /// pose) and, if the spec has beams or compliances, the stiffness at the tool point
    #[arg(long)]
    least: bool,
    /// Maximum number of boxes to examine for each error
    #[arg(long, value_name = "N", default_value_t = BOXES.default, value_parser = whole(BOXES.range))]
    boxes: usize,
    /// Time limit (`60s`, `5min`, `1h`), after which the bounds proved so far are reported.
    /// [default: none]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    time: Option<Duration>,
    #[command(flatten)]
    showing: Showing,
    #[command(flatten)]
    running: Running,
}

pub(crate) fn run(arguments: &Bound) -> Result<Outcome> {
    arguments.running.start()?;
    let machine = arguments.subject.as_written()?;
    let study = study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes.read(&machine.spec)?;
    let mut job = bound::Bound::new(machine, study);
    job.change(&changes);
    job.effort = Effort { gap: arguments.gap.share(), boxes: arguments.boxes, ..job.effort };
    job.least = arguments.least;
    job.time = arguments.time;
    let report = job.run(&mut Console::default())?;
    let next = match report.complete {
        true => "--full for x, y, z and every kind of error",
        false => "--boxes or --time for a closer bound, --full for x, y, z and every kind of error",
    };
    Ok(Outcome::passed(arguments.showing.answer(&report, views::bound(&report), next)?))
}
