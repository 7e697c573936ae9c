//! `abbe doctor`: which convention some rows of joints and poses are in.

use abbe_codegen::document::Document;
use abbe_codegen::expr::{Dimension, parse_value};
use abbe_report::text;
use abbe_study::Notes;
use abbe_study::data::Source;
use abbe_study::doctor::Doctor;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, json};

pub(crate) fn run(arguments: &arguments::Doctor) -> Result<Outcome, Failure> {
    let machine = arguments.subject.machine()?;
    let within = match &arguments.within {
        None => None,
        Some(text) => {
            let mut document = Document::new("--within", text.as_str());
            let length = machine.spec.length;
            let value = parse_value(&mut document, 0..text.len(), length, Dimension::LENGTH, "this length");
            Some(document.finish(value)?)
        }
    };
    let job = Doctor { machine, data: Source::File(&arguments.data), within };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let wanted = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let printed = match (wanted, &report.map) {
        (Some(file), Some(map)) => Some(outputs.finish([file.fill(map)?])?),
        (Some(_), None) => {
            Console::default().note("no reading fits: no map is written, and what was there stays");
            None
        }
        _ => None,
    };
    let text = if arguments.json { json(&report)? } else { text::doctor(&report) };
    let outcome = Outcome::checked(text, report.fits);
    Ok(match printed {
        Some(printed) => outcome.beside(printed),
        None => outcome,
    })
}
