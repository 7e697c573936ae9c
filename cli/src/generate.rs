//! `abbe generate`: the closed form as source code.

use std::io::Write;

use abbe_study::{Machine, generate};

use crate::arguments::Generate;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Pending, cannot_write, note};

pub(crate) fn run(arguments: &Generate) -> Result<Outcome, Failure> {
    let job = generate::Generate { machine: Machine::find(&arguments.spec)?, language: arguments.lang };
    let code = job.run(&mut Console::default())?;
    let Some(path) = &arguments.out else {
        return Ok(Outcome::passed(code));
    };
    let mut file = Pending::create(path)?;
    file.write_all(code.as_bytes()).map_err(|error| cannot_write(path, &error))?;
    file.finish()?;
    note(&format!("wrote {}: {} lines, {} bytes", path.display(), code.lines().count(), code.len()));
    Ok(Outcome::passed(String::new()))
}
