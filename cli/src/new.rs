//! `abbe new`: a first spec from a template.

use std::path::PathBuf;

use crate::arguments::New;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, is_stdout, quoted};

pub(crate) fn run(arguments: &New) -> Result<Outcome, Failure> {
    let New { name, template, out, writing } = arguments;
    let spec = template.spec(name)?;
    let path = out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let mut outputs = Outputs::new(&(), writing.force);
    let pending = outputs.file(&path)?.fill(&spec)?;
    outputs.finish(vec![pending])?;
    let text = match is_stdout(&path) {
        true => String::new(),
        false => format!(
            "Wrote {}, a spec with the numbers of an invented machine: replace them by yours.\n\
             Next      abbe check {}\n",
            path.display(),
            quoted(&path.to_string_lossy())
        ),
    };
    Ok(Outcome::passed(text))
}
