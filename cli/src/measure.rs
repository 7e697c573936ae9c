//! `abbe measure`: evaluates measurements of a machine.

use abbe_metrology::data::{Data, Map};
use abbe_metrology::measure::{Measure, Report};
use abbe_report::{Provenance, views};
use abbe_spec::Spec;
use abbe_study::explore::Explore;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::identify::accept;
use crate::output::{Outcome, Outputs};

pub(crate) fn run(arguments: &arguments::Measure) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.measured.map, &machine.spec)?;
    let mut map = if arguments.station.is_some() { map.newly_stationed() } else { map };
    arguments.dated.date(&mut map.record);
    let data = Data::read(&arguments.measured.data, &map)?;
    let accept = accept(arguments.accept.as_deref(), &machine.spec, &map)?;
    let job = Measure { machine, map, data, accept };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let files = match &arguments.out {
        None => None,
        Some(folder) => {
            outputs.folder(folder)?;
            Some((outputs.file(&folder.join("errors.csv"))?, outputs.file(&folder.join(abbe_report::PAGE))?))
        }
    };
    let (spec, map) = (job.machine.spec.clone(), job.map.clone());
    let Some((errors, page)) = files else {
        return outcome(arguments, &spec, &map, &job.figures(&mut Console::default())?);
    };
    let report = job.run(&mut Console::default())?;
    let files = [("measurements", &arguments.measured.data)];
    let provenance = Provenance::new(&spec, Some(&job.map), files)?;
    let live = Explore::measured(job.machine.clone(), report.residuals()).run(&mut Console::default())?;
    let text = views::measurement(&spec, &map, &report).page(&provenance, Some(&live));
    outputs.finish([errors.fill(&report.table().csv())?, page.fill(&text)?])?;
    outcome(arguments, &spec, &map, &report)
}

fn outcome(
    arguments: &arguments::Measure,
    spec: &Spec,
    map: &Map,
    report: &Report,
) -> Result<Outcome, Failure> {
    let accepted = report.accepted.as_ref().is_none_or(|accepted| accepted.met);
    let next = match (report.explained.repeatable, &arguments.out) {
        (0, _) => "abbe identify finds the errors of this machine; --full for all figures of ISO 9283",
        (_, None) => "--out DIR for a page and the errors of each row, --full for all figures of ISO 9283",
        _ => "--full for all figures of ISO 9283",
    };
    let document = views::measurement(spec, map, report);
    let text = arguments.showing.answer(arguments.running.json, report, document, next)?;
    Ok(Outcome::checked(text, accepted))
}
