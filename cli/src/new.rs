//! `abbe new`: a first spec from a template.

use std::path::PathBuf;

use abbe_study::template::Template;
use clap::{Args, ValueHint, builder::ArgPredicate};

use crate::Result;
use crate::arguments::{Writing, named};
use crate::output::{Outcome, Outputs, is_stdout, quoted};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe new my_arm
  abbe new mill --template five-axis-mill
  abbe new hall --template gantry --out hall-1.toml
  abbe new mill --axes \"w C' X' b Y Z t\"
"))]
pub(crate) struct New {
    /// Name of the manipulator, in lower case
    name: String,
    /// Kind of machine
    #[arg(long, value_name = "TEMPLATE", value_parser = named(Template::CHOICES), default_value = "six-axis", default_value_if("axes", ArgPredicate::IsPresent, "machine-tool"))]
    template: Template,
    /// Axes of a machine tool from the workpiece w over the bed b to the tool t, those that carry
    /// the workpiece with a prime: "w C' X' b Y Z t". [default: "w X' Y' b Z t"]
    #[arg(long, value_name = "ORDER")]
    axes: Option<String>,
    /// Write the spec to this file. [default: NAME.toml]
    #[arg(long, short, value_name = "SPEC", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
}

pub(crate) fn run(arguments: &New) -> Result<Outcome> {
    let New { name, template, axes, out, writing } = arguments;
    let spec = template.spec(name, axes.as_deref())?;
    let path = out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    Outputs::new(&(), writing.force).write([(path.clone(), &spec)])?;
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
