//! `abbe allocate`: factors of the error sources that keep a tolerance at least cost.

use std::path::PathBuf;

use abbe_report::views;
use abbe_study::{Changes, allocate, changed_text};
use clap::Args;

use crate::arguments::{Common, Subject, study};
use crate::output::{Outcome, Outputs, quoted};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe allocate pps
  abbe allocate pps --out improved.toml
  abbe allocate arm.toml --study cell.toml --tolerance 0.3mm --loosen
"))]
pub(crate) struct Allocate {
    #[command(flatten)]
    subject: Subject,
    /// Study file (TOML) with workspace, tolerance and costs of the factors. [default: the study
    /// that `abbe analyze` uses]
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    tolerance: Vec<String>,
    /// Allow factors above 1: errors that may be larger than they are
    #[arg(long)]
    loosen: bool,
    /// Write the spec with the factors, as `scale` of its sources, to this file
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Allocate) -> Result<Outcome> {
    arguments.common.running.start()?;
    let machine = arguments.subject.as_written()?;
    let study = study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes.read(&machine.spec)?;
    let mut job = allocate::Allocate::new(machine.clone(), study);
    job.change(&changes);
    job.loosen = arguments.loosen;
    let mut outputs = Outputs::new(&job, arguments.common.writing.force);
    let mut file = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let mut next =
        "--out FILE writes the spec with these factors, --full the options for abbe analyze".to_owned();
    if let (Some(path), Some(pending)) = (&arguments.out, file.take()) {
        let mut scaled = machine.clone();
        scaled.change(&changes);
        scaled.change(&Changes::read([&[], &[], &[], &report.scales()], &machine.spec)?);
        let text = changed_text(&machine.text_for(path)?, &machine.spec, &scaled.spec);
        let failed = || Failure::new(path.display(), "the spec has no place for the factors");
        file = Some(pending.fill(&text.ok_or_else(failed)?)?);
        let path = quoted(&path.to_string_lossy());
        next = format!("abbe analyze {path}, with the study and the tolerance of this run, checks the file");
    }
    let printed = outputs.finish(file)?;
    let text = arguments.common.showing.answer(&report, views::allocation(&report), &next)?;
    Ok(Outcome::passed(text).beside(printed))
}
