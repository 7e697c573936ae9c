//! Provenance of a page: record, options, files, instrument, and the place to sign.

use std::path::Path;

use abbe_metrology::data::{Map, Source};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::{RunRecord, version};

use super::table::{facts, ledger, row_header};
use super::{escaped, section};

/// Input files of a report, which the report itself does not contain.
#[derive(Clone, Debug, Default)]
pub(crate) struct Provenance {
    /// Kind, name and SHA-256 of each file or table.
    pub(crate) files: Vec<(&'static str, String, String)>,
}

impl Provenance {
    /// Collects the spec, the map if there is one, and the files or tables of the job.
    ///
    /// # Errors
    ///
    /// A file cannot be read.
    pub(crate) fn new<'f>(
        spec: &Spec,
        map: Option<&Map>,
        files: impl IntoIterator<Item = (&'static str, impl Into<Source<'f>>)>,
    ) -> Result<Self, Diagnostics> {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut all = vec![("spec", spec.file.clone(), spec.hash.clone())];
        all.extend(map.map(|map| ("map", name(Path::new(map.path())), map.hash())));
        for (kind, source) in files {
            let source = source.into();
            let name = source.file().map_or_else(|| format!("{}, a table", source.name()), name);
            all.push((kind, name, source.hash()?));
        }
        Ok(Self { files: all })
    }

    /// Formats the sections of record, options and files. A page with a verdict is signed.
    pub(super) fn sections(&self, record: &RunRecord, is_signed: bool) -> String {
        sections(record, is_signed, self.files.iter().map(|(kind, name, hash)| (*kind, name, hash)))
    }
}

/// Formats the stated entries of a record, with lines to sign below them, and the input files and
/// options of its run.
pub(super) fn sections<'f>(
    record: &RunRecord,
    is_signed: bool,
    files: impl Iterator<Item = (&'static str, &'f String, &'f String)>,
) -> String {
    let stated = record.stated().map(|(title, text)| (title, escaped(text)));
    let signature = if is_signed { SIGNATURE } else { "" };
    let stated = match record.is_empty() {
        true if is_signed => format!("<section>\n{signature}</section>\n"),
        true => String::new(),
        false => section("Record", &(facts("Stated by the user", stated) + signature)),
    };
    stated + &section("Input files and options", &(table(files) + &options(record)))
}

/// Lines for name, date and signature, which are on paper alone.
const SIGNATURE: &str =
    "<div class=\"signature\" aria-hidden=\"true\">\n<p>Name</p>\n<p>Date</p>\n<p>Signature</p>\n</div>\n";

/// Formats the options that the figures were computed with.
fn options(record: &RunRecord) -> String {
    let named = |(name, value): &(&'static str, String)| (*name, escaped(value));
    match &record.options[..] {
        [] => "<p>No options were given.</p>\n".to_owned(),
        options => facts("Options of the run, defaults included", options.iter().map(named)),
    }
}

/// Formats the kind, the name and the SHA-256 of input files, and the version of abbe.
fn table<'f>(files: impl Iterator<Item = (&'static str, &'f String, &'f String)>) -> String {
    let rows = files.map(|(kind, name, hash)| {
        let name = escaped(name);
        format!(
            "<tr>{}<td class=\"words\">{name}</td><td class=\"words\"><code>{hash}</code></td></tr>\n",
            row_header(kind)
        )
    });
    let body = format!("<tbody>{}</tbody>\n", rows.collect::<String>());
    format!(
        "{}<p>Written by abbe {}. The same files and options give the same bytes.</p>\n",
        ledger("Input files of this report", &["input", "file", "SHA-256"], &[0, 1, 2], &body),
        version()
    )
}
