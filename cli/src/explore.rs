//! `abbe explore`: a page that evaluates the generated code of a machine, or of two.

use std::borrow::Cow;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use abbe_study::analyze::Analyze;
use abbe_study::explore::{self, Report};
use abbe_study::{Machine, Reads};
use clap::{Args, ValueHint};

use crate::arguments::{Changes, Writing, study};
use crate::output::{Outcome, Outputs, is_stdout, json, note};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe explore pps
  abbe explore arm.toml --study cell.toml --out arm.html
  abbe explore ur5 puma560 --out two.html           two machines side by side
  abbe explore ur5 puma560 scara --out machines     one page for each, and an index
"))]
pub(crate) struct Explore {
    /// Path of a spec file (TOML), or name of a shipped manipulator; two of them are shown side by
    /// side, more of them become pages with an index
    #[arg(value_name = "SPEC", required = true, num_args = 1.., value_hint = ValueHint::FilePath)]
    specs: Vec<OsString>,
    /// Study file (TOML), or name of a shipped study: tolerance and workspace. [default:
    /// arm.study.toml beside arm.toml, or the study shipped with the manipulator, or 1000 joint
    /// samples]
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    tolerance: Vec<String>,
    /// Write the page to this file; `-` is stdout. With more than two specs: write the pages and
    /// index.html into this folder. [default: NAME.html, or the folder live-pages]
    #[arg(long, short, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    #[command(flatten)]
    writing: Writing,
    /// Print the data of the page, a list of one report per spec, as JSON; writes no page
    #[arg(long, display_order = 111, conflicts_with = "out")]
    json: bool,
}

pub(crate) fn run(arguments: &Explore) -> Result<Outcome> {
    let jobs: Vec<explore::Explore<'_>> =
        arguments.specs.iter().map(|spec| job(arguments, spec)).collect::<Result<_, _>>()?;
    let run = || -> Result<Vec<Report>> {
        let mut console = Console::default();
        jobs.iter().map(|job| Ok(job.run(&mut console)?)).collect()
    };
    if arguments.json {
        return Ok(Outcome::passed(json(&run()?)?));
    }
    let names: Vec<&str> = jobs.iter().map(|job| job.analysis.machine().spec.name.as_str()).collect();
    let files: Vec<PathBuf> = jobs.iter().flat_map(Reads::files).collect();
    let mut outputs = Outputs::new(&files, arguments.writing.force);
    if jobs.len() > 2 {
        let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from("live-pages"));
        return pages(&folder, &names, outputs, &jobs);
    }
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}.html", names.join("-"))));
    let page = outputs.file(&path)?;
    let text = abbe_report::explore(&run()?);
    outputs.finish([page.fill(&text)?])?;
    if !is_stdout(&path) {
        note(&format!("wrote {}: {} bytes; open it in a browser", path.display(), text.len()));
    }
    Ok(Outcome::passed(String::new()))
}

/// Writes one page for each machine and an index into a folder.
fn pages(
    folder: &Path,
    names: &[&str],
    mut outputs: Outputs,
    jobs: &[explore::Explore<'_>],
) -> Result<Outcome> {
    let is_taken = |i: usize| names[..i].contains(&names[i]) || names[i] == "index";
    if let Some(i) = (0..names.len()).find(|i| is_taken(*i)) {
        let message = format!("two pages would have the name {}.html", names[i]);
        return Err(Failure::new("SPEC", message).help("give the manipulator of the spec another name"));
    }
    outputs.folder(folder)?;
    let mut console = Console::default();
    let machines = jobs.iter().map(|job| {
        let mut analysis = job.analysis.clone().into_owned();
        analysis.figures = true;
        Ok((job.run(&mut console)?, analysis.run(&mut console)?))
    });
    let files = abbe_report::gallery(&machines.collect::<Result<Vec<_>, Failure>>()?);
    outputs.write(files.iter().map(|file| (folder.join(&file.name), &file.text)))?;
    let index = folder.join(abbe_report::INDEX);
    note(&format!("wrote {} pages; open {} in a browser", names.len(), index.display()));
    Ok(Outcome::passed(String::new()))
}

fn job(arguments: &Explore, spec: &OsStr) -> Result<explore::Explore<'static>> {
    let machine = Machine::find(spec)?;
    let study = study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.changes.read(&machine.spec)?;
    let mut analysis = Analyze::new(machine, study);
    // The page compares no published figures.
    analysis.change(&changes, &mut ());
    let study = arguments.study.as_ref().map(|study| study.to_string_lossy().into_owned());
    Ok(explore::Explore { analysis: Cow::Owned(analysis), study, residuals: None })
}
