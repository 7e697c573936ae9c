//! `abbe generate`: the closed form as source code.

use std::path::PathBuf;

use abbe_study::generate::SourceFile;
use abbe_study::{Machine, generate};

use crate::arguments::Generate;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, Pending, note};

pub(crate) fn run(arguments: &Generate) -> Result<Outcome, Failure> {
    let job = generate::Generate { machine: Machine::find(&arguments.spec)?, language: arguments.lang };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let files = job.run(&mut Console::default())?;
    let paths: Vec<PathBuf> = match (&arguments.out, &files[..]) {
        (None, [file]) => return Ok(Outcome::passed(file.text.clone())),
        (None, _) => {
            let message = format!("{} is written as {} files", arguments.lang.name(), files.len());
            return Err(Failure::of("--lang", message).help("name a folder for them: `--out DIR`"));
        }
        (Some(file), [_]) => vec![file.clone()],
        (Some(folder), _) => {
            outputs.folder(folder)?;
            files.iter().map(|file| folder.join(&file.name)).collect()
        }
    };
    let both = || paths.iter().zip(&files);
    let pending: Result<Vec<Pending>, Failure> =
        both().map(|(path, file)| outputs.file(path)?.fill(&file.text)).collect();
    outputs.finish(pending?)?;
    for (path, SourceFile { text, .. }) in both() {
        note(&format!("wrote {}: {} lines, {} bytes", path.display(), text.lines().count(), text.len()));
    }
    Ok(Outcome::passed(String::new()))
}
