//! `abbe merge`: merges the parts of an analysis into its report.

use std::path::PathBuf;

use abbe_study::Reads;
use abbe_study::analyze::parts::{self, AnalysisRequest, Part};

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
    let begun = match (&arguments.out, parts.first()) {
        (Some(folder), Some((name, part))) => {
            let question = part.request();
            if !question.figures {
                return Err(Failure::new(name, "this part was made with --no-figures")
                    .help("leave --out away: text and --json are complete; or make the parts with figures"));
            }
            let job = question.job(&mut ())?;
            let inputs = [arguments.parts.clone(), job.files(), named(question)].concat();
            let mut outputs = Outputs::new(&inputs, arguments.writing.force);
            let drawn = job.monte_carlo.is_some();
            Some((folder, Files::for_parts(folder, &mut outputs, VaryingColumns::new(&job), drawn)?, outputs))
        }
        _ => None,
    };
    let (_, mut report) = parts::merge(parts, &mut console)?;
    arguments.dated.date(&mut report.record);
    if let Some((folder, files, outputs)) = begun {
        analyze::write(folder, files, outputs, &report)?;
        note("note: configurations.csv is not written: parts hold no single configurations");
    }
    analyze::outcome(
        &report,
        arguments.running.json,
        arguments.check,
        &arguments.showing,
        "--full for every table",
    )
}

/// Returns the paths of the spec and the study of the question.
fn named(question: &AnalysisRequest) -> Vec<PathBuf> {
    let files = question.spec_text.iter().chain(&question.study);
    files.map(|written| PathBuf::from(&written.name)).collect()
}
