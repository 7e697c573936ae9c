//! Diagnostics for columns of a map that are missing in a file.

use abbe_spec::diagnostic::{Diagnostic, Diagnostics};

use super::{Column, Map};

impl Map {
    /// Reports all missing columns, each at its position in the map.
    pub(super) fn missing(&self, file: &str, columns: &[&Column], header: &[String]) -> Diagnostics {
        let there_are = first_of(header);
        let wanted: Vec<&str> =
            self.commanded().chain(self.measured()).map(|column| column.name.as_str()).collect();
        // Many missing columns have a common cause.
        if let [first, .., last] = columns
            && columns.len() > 3
        {
            let name = |column: &Column| column.name.escape_debug().to_string();
            let message = format!(
                "{} columns of the map are missing in {}: `{}` … `{}`",
                columns.len(),
                file,
                name(first),
                name(last)
            );
            let help = match not_a_heading(header, &wanted) {
                Some(why) if header.len() > 1 => {
                    format!("{why}; or give them in the map, as `columns` in `[data]`")
                }
                other => other.unwrap_or_else(|| format!("the columns are: {there_are}")),
            };
            let mistake = Diagnostic { span: first.span.clone(), ..Diagnostic::whole_file(message) }
                .label("first missing column")
                .help(help);
            return Diagnostics { path: self.path.clone(), text: self.text.clone(), list: vec![mistake] };
        }
        let list = columns.iter().map(|column| {
            // Columns that other keys of the map name are no suggestions.
            let free = header.iter().filter(|name| !wanted.contains(&name.as_str()));
            let similarity = |name: &&String| match name.contains(column.name.as_str()) {
                true => 0.9,
                false => strsim::jaro_winkler(&column.name, name),
            };
            let near = free.max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
            let near = near.filter(|name| similarity(name) > 0.55);
            let help = match near {
                Some(name) => format!("did you mean `{name}`? the columns are: {there_are}"),
                None => format!("the columns are: {there_are}"),
            };
            let message = format!("there is no column `{}` in {}", column.name.escape_debug(), file);
            Diagnostic { span: column.span.clone(), ..Diagnostic::whole_file(message) }
                .label("the map names this column")
                .help(help)
        });
        Diagnostics { path: self.path.clone(), text: self.text.clone(), list: list.collect() }
    }
}

/// Returns why the first line of a file names no columns, and what to do, if it does not. `wanted`
/// are the names that are looked for.
pub(super) fn not_a_heading(header: &[String], wanted: &[&str]) -> Option<String> {
    let is_number = |cell: &String| cell.replace(',', ".").trim().parse::<f64>().is_ok();
    match header {
        [] => Some("the file has no heading".to_owned()),
        [only] if only.contains(char::is_whitespace) => Some(format!(
            "its cells are separated by blanks: `{}`. Separate them by commas, below a heading",
            only.escape_debug()
        )),
        [only] => Some(format!("its heading has one cell, `{}`", only.escape_debug())),
        all => all.iter().all(is_number).then(|| {
            let names = if wanted.len() == all.len() { format!(", such as `{}`", wanted.join(",")) } else { String::new() };
            let count = all.len();
            format!("the file has no heading: its first line is numbers. Put a line with its {count} names, in the order of the columns, above it{names}")
        }),
    }
}

/// Lists the names of the first columns.
fn first_of(header: &[String]) -> String {
    const SHOWN: usize = 60;
    let shown = header[..header.len().min(SHOWN)].join(", ");
    match header.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown}, and {more} more"),
    }
}
