//! `abbe export`: writes the errors of a machine to files that controllers and other programs load.

use std::path::PathBuf;

use abbe_report::views;
use abbe_study::export;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, Pending};

pub(crate) fn run(arguments: &arguments::Export) -> Result<Outcome, Failure> {
    let arguments::Export { subject, out, samples, seed, writing, showing, json: is_json, .. } = arguments;
    let format = arguments.format()?;
    let machine = subject.machine()?;
    let job = export::Export { machine, format, samples: *samples, seed: *seed };
    let mut outputs = Outputs::new(&job, writing.force);
    let report = job.run(&mut Console::default())?;
    let paths = match (out, &report.files[..]) {
        (None, _) if *is_json => Vec::new(),
        (None, [_]) => vec![PathBuf::from("-")],
        (None, several) => {
            let message = format!("this format consists of {} files", several.len());
            return Err(Failure::new("--to", message).help("give a folder: `-o DIR`"));
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
    let next = "--full lists all differences and what the format cannot store";
    let mut text = showing.answer(*is_json, &report, views::exported(&report), next)?;
    if out.is_some() && !*is_json {
        text += &paths.iter().map(|path| format!("\nWritten to {}.\n", path.display())).collect::<String>();
    }
    Ok(Outcome::passed(text).beside(printed))
}
