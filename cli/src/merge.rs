//! `abbe merge`: merges the parts of an analysis into its report.

use std::{borrow::Cow, path::PathBuf};

use abbe_study::analyze::parts::{self, Part};
use abbe_study::explore::Explore;
use clap::{Args, ValueHint};

use crate::analyze::{self, Files, VaryingColumns};
use crate::arguments::{Common, Dated};
use crate::output::{Outcome, Outputs, note};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe merge 1.part 2.part
  abbe merge 1.part 2.part --json
  abbe merge 1.part 2.part --out merged
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Merge {
    /// Parts of one analysis, complete and in any order: the files written by `abbe analyze SPEC
    /// --shard I/N --out FILE`
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    parts: Vec<PathBuf>,
    /// Exit with status 1 if a tolerance of the study is not met
    #[arg(long)]
    check: bool,
    /// Write the files of `abbe analyze --out` into this folder, except configurations.csv: parts
    /// do not store single configurations
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    dated: Dated,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Merge) -> Result<Outcome> {
    arguments.common.running.start()?;
    let mut console = Console::default();
    let read = |path: &PathBuf| Ok::<_, Failure>((path.display().to_string(), Part::read(path)?));
    let parts = arguments.parts.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let merge = parts::Merge::new(parts, &mut console)?;
    let begun = match &arguments.out {
        Some(folder) => {
            let job = merge.job();
            if !job.figures {
                return Err(Failure::new("--out", "these parts were made with --no-figures").help(
                    "leave --out out (text and --json are complete), or create the parts \
                        without --no-figures",
                ));
            }
            let mut outputs = Outputs::new(&arguments.parts, arguments.common.writing.force);
            let drawn = job.monte_carlo.is_some();
            outputs.folder(folder)?;
            Some((folder, Files::begin(folder, &mut outputs, VaryingColumns::new(job), drawn)?, outputs))
        }
        None => None,
    };
    let live = Explore { analysis: Cow::Borrowed(merge.job()), study: merge.study(), residuals: None };
    let live = begun.as_ref().map(|_| live.run(&mut console)).transpose()?;
    let mut report = merge.report(&mut console)?;
    arguments.dated.date(&mut report.record);
    if let Some((folder, files, outputs)) = begun {
        analyze::write(folder, files, outputs, &report, live.as_ref())?;
        note("note: configurations.csv is not written: parts do not contain single configurations");
    }
    analyze::outcome(&report, arguments.check, &arguments.common.showing, "--full for every table")
}
