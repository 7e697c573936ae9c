//! `abbe plan`: plans measurements, and predicts the uncertainty of the errors that they identify.

use abbe_metrology::data::Map;
use abbe_metrology::plan::options::COUNT;
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_report::views;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::number::length;
use crate::output::{Outcome, Outputs};

pub(crate) fn run(arguments: &arguments::Plan) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.map, &machine.spec)?;
    let choice = match &arguments.sets {
        Some(file) => Choice::Sets(Sets::find(file, &machine.spec)?),
        None => Choice::Optimal {
            criterion: arguments.criterion,
            count: arguments.optimal.unwrap_or(COUNT.default),
            candidates: arguments.candidates,
        },
    };
    let model_error = length("--model-error", &arguments.model_error, &machine.spec)?;
    let study = arguments::study(arguments.study.as_deref(), &[], &machine)?;
    let job = Plan { machine, map, choice, study, model_error, seed: arguments.seed };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let out = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let out = out.map(|file| file.fill(&report.table(&job.map).csv())).transpose()?;
    let printed = outputs.finish(out)?;
    let next = match &arguments.out {
        None => "--out FILE writes the configurations, --full lists indistinguishable errors",
        Some(_) => "--full lists indistinguishable errors",
    };
    let is_json = arguments.running.json;
    let document = views::plan(&job.machine.spec, &job.map, &report);
    let mut text = arguments.showing.answer(is_json, &report, document, next)?;
    if let (Some(file), false) = (&arguments.out, is_json) {
        text += &format!("Written to {}.\n", file.display());
    }
    Ok(Outcome::passed(text).beside(printed))
}
