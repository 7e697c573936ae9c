//! `abbe analyze`: the errors of every source over a workspace, alone and together (section 5 of
//! the paper).
//!
//! `files` writes each configuration during the sweep, and the figures at its end. With `--shard`,
//! the command computes one part of the analysis for `abbe merge`.

mod files;

use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

use abbe::analysis::Row;
use abbe_study::Reads;
use abbe_study::analyze::parts::{AnalysisRequest, Part, Shard};
use abbe_study::analyze::{Analyze, Report, Verdict};
use abbe_study::explore::{self, Explore};
use abbe_study::jacobian::read_joint_variables;

use crate::arguments::{self, Showing};
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, cannot_write, note};

pub(crate) use files::{Files, VaryingColumns};

pub(crate) fn run(arguments: &arguments::Analyze) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let mut console = Console::default();
    if let (Some(shard), Some(file)) = (arguments.shard, &arguments.out) {
        return part(arguments, (shard, file), &mut console);
    }
    let job = job(arguments, &mut console)?;
    let dated = |mut report: Report| {
        arguments.dated.date(&mut report.record);
        report
    };
    let report = match &arguments.out {
        None => dated(job.run(&mut console)?),
        Some(folder) => {
            let mut outputs = Outputs::new(&job, arguments.writing.force);
            let drawn = job.monte_carlo.is_some();
            let mut files =
                Files::create(folder, &mut outputs, &job.machine().spec, VaryingColumns::new(&job), drawn)?;
            let mut show = |row: &Row| files.configuration(row);
            let report = dated(job.run_with_rows(Some(&mut show), &mut console)?);
            let study = arguments.study.as_ref().map(|study| study.to_string_lossy().into_owned());
            let live = Explore { analysis: Cow::Borrowed(&job), study, residuals: None }.run(&mut console)?;
            write(folder, files, outputs, &report, Some(&live))?;
            report
        }
    };
    let is_allocated = report.ledger.sources.iter().any(|source| source.factor.is_some());
    let next = match &arguments.out {
        None if is_allocated => {
            "--full for every table, --out DIR for a page; allocate: a spec with these factors"
        }
        None => "--full for every table, --out DIR for a page with figures",
        Some(_) => "--full for every table",
    };
    outcome(&report, arguments.running.json, arguments.check, &arguments.showing, next)
}

/// Writes the files of a report into its folder. `live` is the data of its live panel, if
/// it has one.
pub(crate) fn write(
    folder: &Path,
    files: Files,
    mut outputs: Outputs,
    report: &Report,
    live: Option<&explore::Report>,
) -> Result<(), Failure> {
    let (mut complete, page) = files.finish(report)?;
    let mut page = Some(page);
    for file in abbe_report::analysis(report, live) {
        let begun = match page.take_if(|_| file.name == abbe_report::PAGE) {
            Some(page) => page,
            None => outputs.file(&folder.join(&file.name))?,
        };
        complete.push(begun.fill(&file.text)?);
    }
    outputs.finish(complete)?;
    note_what_is_not_listed(report);
    Ok(())
}

/// Returns the report as text or JSON. With `check`, the outcome fails if a tolerance is not met.
///
/// # Errors
///
/// `check` needs a study with a tolerance.
pub(crate) fn outcome(
    report: &Report,
    json: bool,
    check: bool,
    showing: &Showing,
    next: &str,
) -> Result<Outcome, Failure> {
    let text = showing.answer(json, report, abbe_report::budget(report), next)?;
    match (check, report.verdict()) {
        (true, None) => Err(Failure::new("--check", "the study has no tolerance")
            .help("add one: --tolerance \"0.5 mm\", or tolerance = \"0.5 mm\" in its [study]")),
        (true, Some(Verdict::NotMet)) => Ok(Outcome::checked(text, false)),
        _ => Ok(Outcome::passed(text)),
    }
}

/// Sweeps one part of the workspace and writes its part file.
fn part(
    arguments: &arguments::Analyze,
    (shard, file): (Shard, &Path),
    console: &mut Console,
) -> Result<Outcome, Failure> {
    let machine = arguments.subject.as_written()?;
    let question = AnalysisRequest {
        tolerances: arguments.tolerance.clone(),
        changes: arguments.subject.each_change(),
        monte_carlo: arguments.monte_carlo,
        seed: arguments.seed,
        interpret: arguments.interpret,
        figures: !arguments.no_figures,
        ..AnalysisRequest::new(&machine, arguments.study.as_deref())?
    };
    let job = question.job(&mut ())?;
    let study = arguments.study.iter().cloned();
    let inputs = machine.files().into_iter().chain(job.files()).chain(study).collect::<Vec<_>>();
    let mut outputs = Outputs::new(&inputs, arguments.writing.force);
    let mut pending = outputs.file(file)?;
    let part = Part::new(question, shard, console)?;
    pending.write_all(&part.to_bytes()).map_err(|error| cannot_write(file, &error))?;
    let printed = outputs.finish([pending])?;
    let [reached, not] = part.configurations();
    let name = part.spec();
    let text = format!("part {shard} of {name}: {reached} configurations, {not} unreachable\n");
    Ok(Outcome::passed(text).beside(printed))
}

fn job(arguments: &arguments::Analyze, console: &mut Console) -> Result<Analyze, Failure> {
    let machine = arguments.subject.as_written()?;
    let study = arguments::study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes(&machine.spec)?;
    let mut job = Analyze::new(machine, study);
    job.change(&changes, console);
    if let Some(q) = &arguments.q {
        let q = read_joint_variables(q, &job.machine().spec)?;
        job.restrict(q, console);
    }
    job.monte_carlo = arguments.monte_carlo;
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
