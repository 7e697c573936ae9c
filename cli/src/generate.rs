//! `abbe generate`: the closed form as source code.

use abbe_study::{Machine, generate};

use crate::arguments::Generate;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, note};

pub(crate) fn run(arguments: &Generate) -> Result<Outcome, Failure> {
    let job = generate::Generate { machine: Machine::find(&arguments.spec)?, language: arguments.lang };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let out = outputs.wanted(arguments.out.as_deref())?;
    let code = job.run(&mut Console::default())?;
    let (Some(file), Some(path)) = (out, &arguments.out) else {
        return Ok(Outcome::passed(code));
    };
    outputs.finish([file.fill(&code)?])?;
    note(&format!("wrote {}: {} lines, {} bytes", path.display(), code.lines().count(), code.len()));
    Ok(Outcome::passed(String::new()))
}
