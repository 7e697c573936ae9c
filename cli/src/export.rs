//! `abbe export`: what was found of a machine, in the files that controllers and other programs load.

use std::path::PathBuf;

use abbe_report::text::{Table, wrapped};
use abbe_study::export::{self, Difference, Report};
use abbe_study::number::digits;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, Pending, json};

pub(crate) fn run(arguments: &arguments::Export) -> Result<Outcome, Failure> {
    let arguments::Export { subject, out, samples, seed, writing, json: is_json, .. } = arguments;
    let format = arguments.format()?;
    let machine = subject.machine()?;
    let job = export::Export { machine, format, samples: *samples, seed: *seed };
    let mut outputs = Outputs::new(&job, writing.force);
    let report = job.run(&mut Console::default())?;
    let paths = match (out, &report.files[..]) {
        (None, _) if *is_json => Vec::new(),
        (None, [_]) => vec![PathBuf::from("-")],
        (None, several) => {
            let message = format!("this is written as {} files", several.len());
            return Err(Failure::of("--to", message).help("name a folder for them: `-o DIR`"));
        }
        (Some(file), [_]) => vec![file.clone()],
        (Some(folder), several) => {
            outputs.folder(folder)?;
            several.iter().map(|file| folder.join(&file.name)).collect()
        }
    };
    let files = paths.iter().zip(&report.files);
    let pending: Result<Vec<Pending>, Failure> =
        files.map(|(path, file)| outputs.file(path)?.fill(&file.text)).collect();
    let printed = outputs.finish(pending?)?;
    let text = if *is_json { json(&report)? } else { text(&report, out.is_some().then_some(&paths[..])) };
    Ok(Outcome::passed(text).beside(printed))
}

fn text(report: &Report, paths: Option<&[PathBuf]>) -> String {
    let Report { name, format, changes, left_out, sign, configurations, seed, .. } = report;
    let mut parts = vec![
        format!("{name}: {format}\n"),
        format!(
            "{}, over {configurations} random configurations (seed {seed})\n{}",
            question(report),
            differences(report)
        ),
    ];
    if !changes.is_empty() {
        parts.push(format!("What is changed\n{}", changes.concat()));
    }
    if !left_out.is_empty() {
        let lines: Vec<String> = left_out.iter().map(|line| format!("  {}\n", wrapped(line, 4))).collect();
        parts.push(format!("What the format does not hold\n{}", lines.concat()));
    }
    parts.push(format!("The sign\n  {}\n", wrapped(sign, 4)));
    parts.extend(paths.iter().copied().flatten().map(|path| format!("Written to {}.\n", path.display())));
    parts.join("\n")
}

/// Of a model, or of corrected commands.
fn question(report: &Report) -> &'static str {
    match report.compared {
        ["nominal", _] => "How far the tool is from where it really is",
        _ => "How far the tool really is from where it should be",
    }
}

fn differences(report: &Report) -> String {
    let heading = [report.length, "mrad"];
    let [largest, rms] = ["largest", "rms"].map(|figure| heading.map(|unit| format!("{figure} ({unit})")));
    let mut table = Table::new(&["", &largest[0], &rms[0], &largest[1], &rms[1]]);
    let [before, remains] = report.compared;
    let at_nodes = report.at_nodes.as_ref().map(|difference| ("at the nodes", difference));
    let rows = [(before, &report.before)].into_iter().chain(at_nodes).chain([(remains, &report.remains)]);
    for (name, difference) in rows {
        let Difference { position, angle } = difference;
        let figures = [position.largest, position.rms, 1e3 * angle.largest, 1e3 * angle.rms];
        table.row([&[name.to_owned()][..], &figures.map(|value| digits(value, 3))].concat());
    }
    table.right(&[1, 2, 3, 4]).to_string()
}
