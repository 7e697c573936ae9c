//! Paths of the files that a spec names, in a copy of its text.

use std::path::{Component, MAIN_SEPARATOR, Path, PathBuf};

use abbe_spec::{edit::Edits, edit::write::quoted};

/// Returns the text of a spec in the folder `from` as a file in the folder `to` needs it: relative
/// paths of tables lead to the same files.
pub(crate) fn with_table_paths(text: &str, from: &Path, to: &Path) -> String {
    let [Ok(from), Ok(to)] = [from, to].map(|folder| match folder.as_os_str().is_empty() {
        true => Path::new(".").canonicalize(),
        false => folder.canonicalize(),
    }) else {
        return text.to_owned();
    };
    let edited = Edits::apply(text, |root, edits| {
        for table in root.get("tables").filter(|_| from != to)?.as_table()?.items() {
            let item = table.as_table().and_then(|table| table.get("file"));
            let file = item.as_ref().and_then(|item| item.text()).map(Path::new);
            if let (Some(item), Some(file)) = (&item, file.filter(|file| file.is_relative())) {
                edits.replace(item.span(), quoted(&relative(&from.join(file), &to)));
            }
        }
        Some(())
    });
    edited.unwrap_or_else(|| text.to_owned())
}

/// Returns the path of a file as seen from a folder; both are absolute. The file keeps an absolute
/// path if they have no common root. A relative path has slashes on every system.
fn relative(file: &Path, folder: &Path) -> String {
    let file = without_dots(file);
    let common = file.components().zip(folder.components()).take_while(|(one, other)| one == other).count();
    if common == 0 {
        return file.to_string_lossy().replace(r"\\?\UNC\", r"\\").replace(r"\\?\", "");
    }
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(file.components().skip(common)).collect();
    path.to_string_lossy().replace(MAIN_SEPARATOR, "/")
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
mod tests;
