//! `abbe monitor`: control charts of repeated checks of a machine.

use abbe_metrology::data::Map;
use abbe_metrology::monitor::{Checks, Monitor, Settings};
use abbe_report::{Provenance, views};
use abbe_study::explore::Explore;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::number::length;
use crate::output::{Outcome, Outputs};

pub(crate) fn run(arguments: &arguments::Monitor) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.machine()?;
    let mut map = Map::find(&arguments.map, &machine.spec)?;
    arguments.page.dated.date(&mut map.record);
    let mut checks = Checks::read(&arguments.data, &map)?;
    if let Some(date) = &arguments.since {
        checks.since("--since", date)?;
    }
    let tolerance =
        arguments.tolerance.as_ref().map(|text| length("--tolerance", text, &machine.spec)).transpose()?;
    let settings =
        Settings { checks_per_false_alarm: arguments.false_alarm as f64, tolerance, ..Settings::default() };
    let job = Monitor { machine, map, checks, settings };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let page = outputs.wanted(arguments.page.report.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let document = || views::monitoring(&job.machine.spec, &job.map, &report);
    let page = page.map(|file| {
        let (spec, files) = (&job.machine.spec, arguments.data.iter().map(|file| ("check", file)));
        let provenance = Provenance::new(spec, Some(&job.map), files)?;
        let residuals = report.residuals.clone();
        let live = Explore::measured(job.machine.clone(), residuals).run(&mut Console::default())?;
        file.fill(&document().page(&provenance, Some(&live)))
    });
    let printed = outputs.finish(page.transpose()?)?;
    let passed = !arguments.check || report.alarm.is_none();
    let next = match &arguments.page.report {
        None => "--report FILE for a page with the charts, --full for all charts",
        Some(_) => "--full for all charts",
    };
    let text = arguments.showing.answer(arguments.running.json, &report, document(), next)?;
    Ok(Outcome::checked(text, passed).beside(printed))
}
