//! `abbe explore`: a page that evaluates the generated code of a machine, or of two.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use abbe_study::analyze::Analyze;
use abbe_study::explore::{Explore, Report};
use abbe_study::{Machine, Reads};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, is_stdout, json, note};

pub(crate) fn run(arguments: &arguments::Explore) -> Result<Outcome, Failure> {
    let jobs: Vec<Explore<'_>> =
        arguments.specs.iter().map(|spec| job(arguments, spec)).collect::<Result<_, _>>()?;
    let run = || -> Result<Vec<Report>, Failure> {
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
        return pages(&folder, &names, outputs, run);
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
    run: impl FnOnce() -> Result<Vec<Report>, Failure>,
) -> Result<Outcome, Failure> {
    let is_taken = |i: usize| names[..i].contains(&names[i]) || names[i] == "index";
    if let Some(i) = (0..names.len()).find(|i| is_taken(*i)) {
        let message = format!("two pages would have the name {}.html", names[i]);
        return Err(Failure::new("SPEC", message).help("give the manipulator of the spec another name"));
    }
    outputs.folder(folder)?;
    let files = abbe_report::gallery(&run()?);
    let complete = files.iter().map(|file| outputs.file(&folder.join(&file.name))?.fill(&file.text));
    let complete = complete.collect::<Result<Vec<_>, _>>()?;
    outputs.finish(complete)?;
    let index = folder.join(abbe_report::INDEX);
    note(&format!("wrote {} pages; open {} in a browser", names.len(), index.display()));
    Ok(Outcome::passed(String::new()))
}

fn job(arguments: &arguments::Explore, spec: &OsStr) -> Result<Explore<'static>, Failure> {
    let machine = Machine::find(spec)?;
    let study = arguments::study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.changes.read(&machine.spec)?;
    let mut analysis = Analyze::new(machine, study);
    // The page compares no published figures.
    analysis.change(&changes, &mut ());
    let study = arguments.study.as_ref().map(|study| study.to_string_lossy().into_owned());
    Ok(Explore { analysis: Cow::Owned(analysis), study, residuals: None })
}
