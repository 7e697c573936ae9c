//! `abbe analyze`: the errors of every source over a workspace, alone and together (section 5 of
//! the paper).
//!
//! `files` writes each configuration during the sweep, and the figures at its end. With `--shard`,
//! the command computes one part of the analysis for `abbe merge`.

mod files;

use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

use abbe::analysis::Row;
use abbe_study::Reads;
use abbe_study::analyze::options::DRAWS;
use abbe_study::analyze::parts::{AnalysisRequest, Part, Shard};
use abbe_study::analyze::{self, Report, Verdict};
use abbe_study::explore::{self, Explore};
use abbe_study::jacobian::read_joint_variables;
use clap::Args;

use crate::arguments::{Common, Dated, Showing, Subject, study, whole};
use crate::output::{Outcome, Outputs, cannot_write, note};
use crate::{Console, Failure, Result};

pub(crate) use files::{Files, VaryingColumns};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe analyze pps
  abbe analyze arm.toml --set payload=2kg --monte-carlo 10000
  abbe analyze arm.toml --study cell.toml --check
  abbe analyze arm.toml --out arm       with figures: arm/report.html needs no network
  abbe analyze arm.toml --q 300,30deg,-45deg    at one configuration
  abbe analyze arm.toml --shard 1/2 --out 1.part
  abbe analyze arm.toml --shard 2/2 --out 2.part    on another machine: see `abbe merge`
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Analyze {
    #[command(flatten)]
    subject: Subject,
    /// Study file (TOML), or name of a shipped study: workspace, tolerance, published figures.
    /// [default: arm.study.toml beside arm.toml, or the study shipped with the manipulator, or 1000
    /// joint samples]
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    tolerance: Vec<String>,
    /// Analyze one configuration instead of the study's workspace: joint variables in the order of
    /// the spec, as for `abbe jacobian`, with nominal inputs or those of --set. Published figures
    /// are not compared
    #[arg(long, value_name = "V,V,…", allow_hyphen_values = true, conflicts_with = "shard")]
    q: Option<String>,
    /// Number of Monte Carlo draws of all error sources, at the worst configuration and at home,
    /// through the exact chain with finite rotations. [default: no draws]
    #[arg(long, value_name = "N", value_parser = whole(DRAWS))]
    monte_carlo: Option<usize>,
    /// Seed of the Monte Carlo draws and of the study's random samples. [default: 0 for the draws,
    /// the study's seed for its samples]
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Interpret the spec of a shipped manipulator instead of running its generated code: the same
    /// results, slower
    #[arg(long)]
    interpret: bool,
    /// Exit with status 1 if a tolerance of the study is not met
    #[arg(long)]
    check: bool,
    /// Write report.html, its figures as SVG, configurations.csv, sources.csv, unreachable.csv and,
    /// with --monte-carlo, monte_carlo.csv into this folder. With --shard: write the part to this
    /// file
    #[arg(long, short, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Sweep part I of N of the workspace (I from 1 to N) and write a part file for `abbe merge`
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with_all = ["json", "check", "date"])]
    shard: Option<Shard>,
    /// Do not collect data for figures in this part, which is faster; the merged text and --json
    /// stay complete
    #[arg(long, requires = "shard")]
    no_figures: bool,
    #[command(flatten)]
    dated: Dated,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Analyze) -> Result<Outcome> {
    arguments.common.running.start()?;
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
            let mut outputs = Outputs::new(&job, arguments.common.writing.force);
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
    outcome(&report, arguments.check, &arguments.common.showing, next)
}

/// Writes the files of a report into its folder. `live` is the data of its live panel, if
/// it has one.
pub(crate) fn write(
    folder: &Path,
    files: Files,
    mut outputs: Outputs,
    report: &Report,
    live: Option<&explore::Report>,
) -> Result<()> {
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
pub(crate) fn outcome(report: &Report, check: bool, shown: &Showing, next: &str) -> Result<Outcome> {
    let text = shown.answer(report, abbe_report::budget(report), next)?;
    match (check, report.verdict()) {
        (true, None) => Err(Failure::new("--check", "the study has no tolerance")
            .help("add one: --tolerance \"0.5 mm\", or tolerance = \"0.5 mm\" in its [study]")),
        (true, Some(Verdict::NotMet)) => Ok(Outcome::checked(text, false)),
        _ => Ok(Outcome::passed(text)),
    }
}

/// Sweeps one part of the workspace and writes its part file.
fn part(arguments: &Analyze, (shard, file): (Shard, &Path), console: &mut Console) -> Result<Outcome> {
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
    let mut outputs = Outputs::new(&inputs, arguments.common.writing.force);
    let mut pending = outputs.file(file)?;
    let part = Part::new(question, shard, console)?;
    pending.write_all(&part.to_bytes()).map_err(|error| cannot_write(file, &error))?;
    let printed = outputs.finish([pending])?;
    let [reached, not] = part.configurations();
    let name = part.spec();
    let text = format!("part {shard} of {name}: {reached} configurations, {not} unreachable\n");
    Ok(Outcome::passed(text).beside(printed))
}

fn job(arguments: &Analyze, console: &mut Console) -> Result<analyze::Analyze> {
    let machine = arguments.subject.as_written()?;
    let study = study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes.read(&machine.spec)?;
    let mut job = analyze::Analyze::new(machine, study);
    job.change(&changes, console);
    if let Some(q) = &arguments.q {
        job.restrict(vec![read_joint_variables(q, &job.machine().spec)?], console);
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
