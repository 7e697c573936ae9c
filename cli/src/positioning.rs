//! `abbe positioning`: evaluates runs of an axis by ISO 230-2, or of body diagonals by ISO 230-6.

use abbe_metrology::positioning;
use abbe_report::views;

use crate::arguments::Positioning;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs};

pub(crate) fn run(arguments: &Positioning) -> Result<Outcome, Failure> {
    let Positioning { data, reading_uncertainty, scale_uncertainty, out, writing, showing, json: is_json } =
        arguments;
    let job = positioning::Positioning {
        data: data.into(),
        reading: reading_uncertainty.clone(),
        scale: scale_uncertainty.clone(),
    };
    let mut outputs = Outputs::new(&job, writing.force);
    let file = out.as_deref().map(|file| outputs.file(file)).transpose()?;
    let report = job.run(&mut Console::default())?;
    let next = match file {
        Some(_) => "--full for every position",
        None => "--out FILE writes the mean deviations for a table of a spec, --full shows every position",
    };
    let text = showing.answer(*is_json, &report, views::positioning(&report), next)?;
    let Some(file) = file else { return Ok(Outcome::passed(text)) };
    let Some(table) = report.table() else {
        let message = "the deviations of several diagonals are not a table of one axis";
        return Err(Failure::new("--out", message).help("leave `--out` out"));
    };
    let printed = outputs.finish([file.fill(&table.csv())?])?;
    Ok(Outcome::passed(text).beside(printed))
}
