//! `abbe merge`: merges the parts of an analysis into its report.

use std::borrow::Cow;
use std::path::PathBuf;

use abbe_study::analyze::parts::{Merge, Part};
use abbe_study::explore::Explore;

use crate::analyze::{self, Files, VaryingColumns};
use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, note};

pub(crate) fn run(arguments: &arguments::Merge) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let mut console = Console::default();
    let read = |path: &PathBuf| Ok::<_, Failure>((path.display().to_string(), Part::read(path)?));
    let parts = arguments.parts.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let merge = Merge::new(parts, &mut console)?;
    let begun = match &arguments.out {
        Some(folder) => {
            let job = merge.job();
            if !job.figures {
                return Err(Failure::new("--out", "these parts were made with --no-figures").help(
                    "leave --out out (text and --json are complete), or create the parts \
                        without --no-figures",
                ));
            }
            let mut outputs = Outputs::new(&arguments.parts, arguments.writing.force);
            let drawn = job.monte_carlo.is_some();
            Some((folder, Files::for_parts(folder, &mut outputs, VaryingColumns::new(job), drawn)?, outputs))
        }
        None => None,
    };
    let live = match &begun {
        Some(_) => {
            let analysis = Cow::Borrowed(merge.job());
            Some(Explore { analysis, study: merge.study(), residuals: None }.run(&mut console)?)
        }
        None => None,
    };
    let mut report = merge.report(&mut console)?;
    arguments.dated.date(&mut report.record);
    if let Some((folder, files, outputs)) = begun {
        analyze::write(folder, files, outputs, &report, live.as_ref())?;
        note("note: configurations.csv is not written: parts do not contain single configurations");
    }
    analyze::outcome(
        &report,
        arguments.running.json,
        arguments.check,
        &arguments.showing,
        "--full for every table",
    )
}
