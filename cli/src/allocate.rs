//! `abbe allocate`: factors of the error sources that keep a tolerance at least cost.

use abbe_report::views;
use abbe_study::allocate::Allocate;
use abbe_study::{Changes, changed_text};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, quoted};

pub(crate) fn run(arguments: &arguments::Allocate) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.as_written()?;
    let study = arguments::study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes(&machine.spec)?;
    let mut job = Allocate::new(machine.clone(), study);
    job.change(&changes);
    job.loosen = arguments.loosen;
    let mut outputs = Outputs::new(&job, arguments.writing.force);
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
    let is_json = arguments.running.json;
    let text = arguments.showing.answer(is_json, &report, views::allocation(&report), &next)?;
    Ok(Outcome::passed(text).beside(printed))
}
