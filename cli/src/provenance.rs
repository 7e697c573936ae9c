//! What a page of measurements rests on: files and their hashes, and the date that was given.

use std::path::{Path, PathBuf};

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::spec::Spec;
use abbe_report::Provenance;
use abbe_study::data::Map;
use abbe_study::hash;

/// The spec, the map if there is one, and files by what they are.
pub(crate) fn provenance<'f>(
    spec: &Spec,
    map: Option<&Map>,
    files: impl IntoIterator<Item = (&'static str, &'f PathBuf)>,
    date: Option<&String>,
) -> Result<Provenance, Diagnostics> {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut all = vec![("spec", spec.file.clone(), spec.hash.clone())];
    all.extend(map.map(|map| ("map", name(Path::new(map.path())), map.hash())));
    for (kind, file) in files {
        all.push((kind, name(file), hash::of_file(file)?));
    }
    Ok(Provenance { date: date.cloned(), files: all })
}
