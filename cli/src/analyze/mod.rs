//! `abbe analyze`: section 5 of the paper. What every source does over a workspace, alone and together.
//!
//! The job is asked and its report shown; `files` writes every configuration on the way, and the pictures in the end.

mod files;

use abbe::analysis::Row;
use abbe_study::analyze::{Analyze, Report, Verdict};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{self, Outcome, Outputs, note};

use files::{Files, Moved};

pub(crate) fn run(arguments: &arguments::Analyze) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let mut console = Console::default();
    let job = job(arguments, &mut console)?;
    let report = match &arguments.out {
        None => job.run(&mut console)?,
        Some(folder) => {
            let mut outputs = Outputs::new(&job, arguments.writing.force);
            let drawn = job.monte_carlo.is_some();
            let mut files =
                Files::create(folder, &mut outputs, &job.machine().spec, Moved::new(&job), drawn)?;
            let mut page = Some(outputs.file(&folder.join(abbe_report::PAGE))?);
            let mut show = |row: &Row| files.configuration(row);
            let report = job.run_showing(Some(&mut show), &mut console)?;
            let mut complete = files.finish(&report)?;
            for file in abbe_report::analysis(&report)? {
                let begun = match page.take_if(|_| file.name == abbe_report::PAGE) {
                    Some(page) => page,
                    None => outputs.file(&folder.join(&file.name))?,
                };
                complete.push(begun.fill(&file.text)?);
            }
            outputs.finish(complete)?;
            note_what_is_not_listed(&report);
            report
        }
    };
    let text =
        if arguments.running.json { output::json(&report)? } else { abbe_report::text::analysis(&report) };
    match (arguments.check, report.verdict()) {
        (true, None) => Err(Failure::of("--check", "the study has no tolerance")
            .help("give one: tolerance = \"0.5 mm\" in its [study]")),
        (true, Some(Verdict::NotMet)) => Ok(Outcome::checked(text, false)),
        _ => Ok(Outcome::passed(text)),
    }
}

fn job(arguments: &arguments::Analyze, console: &mut Console) -> Result<Analyze, Failure> {
    let machine = arguments.subject.as_written()?;
    let study = arguments::study(arguments.study.as_deref(), &machine)?;
    let changes = arguments.subject.changes(&machine.spec)?;
    let mut job = Analyze::new(machine, study);
    job.change(&changes, console);
    job.monte_carlo = arguments.monte_carlo.map(|draws| draws as usize);
    job.seed = arguments.seed;
    job.interpret = arguments.interpret;
    job.figures = arguments.out.is_some();
    Ok(job)
}

fn note_what_is_not_listed(report: &Report) {
    let (listed, count) = (report.budget.unreachable.first.len(), report.budget.unreachable.count);
    if listed < count {
        note(&format!("note: unreachable.csv has the first {listed} of {count}"));
    }
}
