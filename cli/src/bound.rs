//! `abbe bound`: certified upper bounds of the errors.

use abbe_bound::Effort;
use abbe_report::views;
use abbe_study::bound::Bound;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::Outcome;

pub(crate) fn run(arguments: &arguments::Bound) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.as_written()?;
    let study = arguments::study(arguments.study.as_deref(), &arguments.tolerance, &machine)?;
    let changes = arguments.subject.changes(&machine.spec)?;
    let mut job = Bound::new(machine, study);
    job.change(&changes);
    job.effort = Effort { gap: arguments.gap.share(), boxes: arguments.boxes, ..job.effort };
    job.least = arguments.least;
    job.time = arguments.time;
    let report = job.run(&mut Console::default())?;
    let next = match report.complete {
        true => "--full for x, y, z and every kind of error",
        false => "--boxes or --time for a closer bound, --full for x, y, z and every kind of error",
    };
    let is_json = arguments.running.json;
    Ok(Outcome::passed(arguments.showing.answer(is_json, &report, views::bound(&report), next)?))
}
