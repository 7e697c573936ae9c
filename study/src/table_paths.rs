//! Paths of the files that a spec names, in a copy of its text.

use std::path::{Component, Path, PathBuf};

use abbe_spec::diagnostic::Span;
use abbe_spec::document::{Document, Section};
use abbe_spec::literal::quoted;

/// Returns the text of a spec in the folder `from` as a file in the folder `to` needs it: relative
/// paths of tables lead to the same files.
pub(crate) fn with_table_paths(text: &str, from: &Path, to: &Path) -> String {
    let [Ok(from), Ok(to)] = [from, to].map(|folder| match folder.as_os_str().is_empty() {
        true => Path::new(".").canonicalize(),
        false => folder.canonicalize(),
    }) else {
        return text.to_owned();
    };
    let mut edits = if from == to { Vec::new() } else { table_files(text) };
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    for (span, file) in edits.into_iter().filter(|(_, file)| Path::new(file).is_relative()) {
        text.replace_range(span, &quoted(&relative(&from.join(file), &to).to_string_lossy()));
    }
    text
}

/// Returns the place and the value of every `file` in `[tables]`.
fn table_files(text: &str) -> Vec<(Span, String)> {
    let mut document = Document::new("", text);
    let Some(root) = document.tables(text) else { return Vec::new() };
    let tables = Section::root(&root).get("tables").and_then(|item| document.section(&item));
    let tables = tables.map(|tables| tables.items().collect::<Vec<_>>()).unwrap_or_default();
    let files = tables.iter().filter_map(|table| {
        let item = document.section(table)?.get("file")?;
        Some((item.span(), document.string(&item)?))
    });
    files.collect()
}

/// Returns the path of a file as seen from a folder; both are absolute. The file keeps an absolute
/// path if they have no common root.
fn relative(file: &Path, folder: &Path) -> PathBuf {
    let file = without_dots(file);
    let common = file.components().zip(folder.components()).take_while(|(one, other)| one == other).count();
    if common == 0 {
        return file;
    }
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    up.chain(file.components().skip(common)).collect()
}

/// Resolves `.` and `..` by the text of the path.
fn without_dots(path: &Path) -> PathBuf {
    let mut resolved = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => _ = resolved.pop(),
            other => resolved.push(other),
        }
    }
    resolved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_to_the_same_file() {
        for (file, folder, expected) in [
            ("/a/b/rail.csv", "/a/c", "../b/rail.csv"),
            ("/a/rail.csv", "/a/c/d", "../../rail.csv"),
            ("/a/c/rail.csv", "/a", "c/rail.csv"),
            ("/a/b/../rail.csv", "/a", "rail.csv"),
            ("/b/./rail.csv", "/a", "../b/rail.csv"),
        ] {
            assert_eq!(relative(Path::new(file), Path::new(folder)), Path::new(expected), "{file}");
        }
    }
}
