//! `abbe generate`: the closed form as source code.

use std::io::Write;

use abbe_codegen::emit;

use crate::arguments::{Generate, Language};
use crate::failure::Failure;
use crate::output::{Outcome, Pending, cannot_write, note};
use abbe_study::Machine;

pub(crate) fn run(arguments: &Generate) -> Result<Outcome, Failure> {
    let found = Machine::find(&arguments.spec)?;
    let code = match arguments.lang {
        Language::Rust => emit::rust(&found.spec),
    };
    let Some(path) = &arguments.out else {
        return Ok(Outcome::passed(code));
    };
    let mut file = Pending::create(path)?;
    file.write_all(code.as_bytes()).map_err(|error| cannot_write(path, &error))?;
    file.finish()?;
    note(&format!("wrote {}: {} lines, {} bytes", path.display(), code.lines().count(), code.len()));
    Ok(Outcome::passed(String::new()))
}
