//! `abbe import`: converts descriptions of robots in other formats to specs.

use abbe_report::text;
use abbe_study::import::{Format, Import};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, json};

pub(crate) fn run(arguments: &arguments::Import) -> Result<Outcome, Failure> {
    let arguments::Import { file, base, tip, out, .. } = arguments;
    let format = match arguments.dh {
        None => Format::Urdf { base: base.clone(), tip: tip.clone(), fold: arguments.fold },
        Some(convention) => Format::Table { convention, units: arguments.units.unwrap_or_default() },
    };
    let job = Import { file: file.clone(), format, round_angles: arguments.round_angles };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let wanted = outputs.wanted(out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let printed = outputs.finish(wanted.map(|file| file.fill(&report.spec)).transpose()?)?;
    let text = match out {
        _ if arguments.json => json(&report)?,
        Some(_) => text::imported(&report),
        None => report.spec,
    };
    Ok(Outcome::passed(text).beside(printed))
}
