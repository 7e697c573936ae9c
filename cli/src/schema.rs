//! `abbe schema`: the JSON Schema of an input file.

use crate::arguments::Schema;
use crate::failure::Failure;
use crate::output::Outcome;

pub(crate) fn run(arguments: &Schema) -> Result<Outcome, Failure> {
    let schema = serde_json::to_string_pretty(&arguments.file.schema());
    Ok(Outcome::passed(schema.map_err(|error| Failure::new("JSON", error))? + "\n"))
}
