//! Resolves arguments that name a file or a shipped item.

use std::path::Path;

use crate::Result;
use abbe_spec::diagnostic::nearest_file;
use abbe_spec::option::NamedOption;
use abbe_spec::value::find_name;
use abbe_spec::{Diagnostic, Diagnostics, Document};

/// Returns true if an argument is a path: the file exists, or the text looks like one.
pub fn is_path(argument: &Path) -> bool {
    let name = argument.to_string_lossy();
    name.contains(std::path::is_separator)
        || name.ends_with(".toml")
        || (argument.exists() && !argument.is_dir())
}

/// Reads a file, or the shipped document with that name. `folder` is the folder of the shipped
/// documents, `what` their kind in messages.
pub fn document(
    option: &NamedOption,
    argument: &Path,
    shipped: &[(&str, &str)],
    folder: &str,
    what: &str,
) -> Result<Document> {
    let name = argument.to_string_lossy();
    if is_path(argument) {
        return Document::read(argument);
    }
    match shipped.iter().find(|(shipped, _)| *shipped == name) {
        Some((name, text)) => Ok(Document::new(format!("{folder}/{name}.toml"), *text)),
        None => {
            let names = shipped.iter().map(|(name, _)| *name).collect::<Vec<_>>();
            Err(unknown(&option.to_string(), &name, &names, what))
        }
    }
}

/// Returns the diagnostic for an argument that names neither, with the nearest names.
pub fn unknown(option: &str, argument: &str, names: &[&str], what: &str) -> Diagnostics {
    let document = Document::new(option, argument);
    find_name(&document, 0..argument.len(), argument, names, what);
    let Document { path, text, found, .. } = document;
    // Suggest `arm.toml` for `arm`.
    let near = [argument.to_owned() + ".toml", argument.to_owned()].into_iter();
    let near = near.filter(|_| !argument.is_empty()).find_map(|name| nearest_file(Path::new(&name)));
    let label = |mistake: Diagnostic| match &near {
        _ if Path::new(argument).is_dir() => mistake.label("this is a folder, not a file"),
        Some(file) => mistake.label(format!("there is no such file; did you mean `{}`?", file.display())),
        None => mistake.label("there is no such file"),
    };
    Diagnostics { path, text, list: found.into_inner().into_iter().map(label).collect() }
}
