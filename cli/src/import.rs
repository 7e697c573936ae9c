//! `abbe import`: robots that are described in other formats, as specs.

use std::fmt::Write;

use abbe_study::import::{Format, Import, ImportedFrame, Report};
use abbe_study::number::counted;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, json};

pub(crate) fn run(arguments: &arguments::Import) -> Result<Outcome, Failure> {
    let arguments::Import { file, base, tip, out, .. } = arguments;
    let format = match arguments.dh {
        None => Format::Urdf { base: base.clone(), tip: tip.clone(), fold: arguments.fold },
        Some(convention) => {
            Format::Table { convention: convention.into(), units: arguments.units.unwrap_or_default() }
        }
    };
    let job = Import { file: file.clone(), format, round_angles: arguments.round_angles };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let wanted = outputs.wanted(out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let printed = outputs.finish(wanted.map(|file| file.fill(&report.spec)).transpose()?)?;
    let text = match out {
        _ if arguments.json => json(&report)?,
        Some(_) => summary(&report),
        None => report.spec,
    };
    Ok(Outcome::passed(text).beside(printed))
}

fn summary(report: &Report) -> String {
    let Report { manipulator, base, tip, frames, loads, largest_difference, configurations, length, .. } =
        report;
    let moving = frames.iter().filter(|frame| frame.variable.is_some()).count();
    let mut text = format!(
        "{manipulator}: from {base} to {tip}, {}, {moving} of them moved, {} as loads\n\n",
        counted(frames.len(), "frame", "frames"),
        counted(*loads, "mass", "masses")
    );
    let width = frames.iter().map(|frame| frame.joint.chars().count()).max().unwrap_or_default();
    for ImportedFrame { joint, link, variable, follows } in frames {
        let variable = match variable {
            None => "fixed".to_owned(),
            Some(name) if *follows => format!("follows {name}"),
            Some(name) => name.clone(),
        };
        let _ = match link {
            Some(link) => writeln!(text, "  {joint:width$}  {variable:width$}  carries {link}"),
            None => writeln!(text, "  {joint:width$}  {variable}"),
        };
    }
    let _ = writeln!(
        text,
        "\nThe poses of the spec are those of the file: at {configurations} configurations they differ by {largest_difference:.1e} {length} or rad at most."
    );
    text
}
