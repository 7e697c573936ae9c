//! What a page of measurements rests on: the instrument, the files, the date that was given.

use std::path::Path;

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::data::{Base, Layout, Map, Source};
use abbe_study::number::{self, short};

use super::escaped;

/// What cannot be known from a report: which files it came from, and when.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The date as the user gave it; pages know no clock.
    pub date: Option<String>,
    /// What a file or table is, its name, and the SHA-256 of what is in it.
    pub files: Vec<(&'static str, String, String)>,
}

impl Provenance {
    /// The spec, the map if there is one, and files or tables by what they are.
    pub fn new<'f>(
        spec: &Spec,
        map: Option<&Map>,
        files: impl IntoIterator<Item = (&'static str, impl Into<Source<'f>>)>,
        date: Option<&String>,
    ) -> Result<Self, Diagnostics> {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut all = vec![("spec", spec.file.clone(), spec.hash.clone())];
        all.extend(map.map(|map| ("map", name(Path::new(map.path())), map.hash())));
        for (kind, source) in files {
            let source = source.into();
            let name = source.file().map_or_else(|| format!("{}, a table", source.name()), name);
            all.push((kind, name, source.hash()?));
        }
        Ok(Self { date: date.cloned(), files: all })
    }

    /// As a table.
    pub(super) fn table(&self) -> String {
        let row = |(kind, name, hash): &(&str, String, String)| {
            format!("<tr><th>{kind}</th><td>{}</td><td><code>{hash}</code></td></tr>\n", escaped(name))
        };
        let rows = self.files.iter().map(row).collect::<String>();
        let date = self.date.as_ref().map(|date| format!("<p>Date as given: {}.</p>\n", escaped(date)));
        format!(
            "<table class=\"facts\"><thead><tr><th></th><td>file</td><td>SHA-256</td></tr></thead><tbody>{rows}</tbody></table>\n{}\
             <p>Written by abbe {}. Same files and options, same bytes.</p>\n",
            date.unwrap_or_default(),
            env!("CARGO_PKG_VERSION")
        )
    }
}

/// The instrument, and what it measured.
pub(super) fn instrument(spec: &Spec, map: &Map) -> String {
    let angle = format!(" and {} mrad", short(map.uncertainty.angle * 1e3));
    let uncertainty = match &map.layout {
        Layout::Instruments(_) => "every instrument has its own".to_owned(),
        _ => format!(
            "{}{} (one standard deviation)",
            number::quantity(map.uncertainty.length, spec.length.symbol()),
            if map.is_pose() { &angle } else { "" }
        ),
    };
    let base = match map.base {
        Base::Known => "in F<sub>0</sub> but for small errors",
        Base::Unknown => "anywhere: its place was fitted",
        Base::Exact => "exactly in F<sub>0</sub>",
    };
    let measured = match &map.layout {
        Layout::Point(..) => "the tool point".to_owned(),
        Layout::Difference(..) => "the tool point, as commanded minus actual".to_owned(),
        Layout::Targets(targets) => format!("{} targets", targets.len()),
        Layout::Pose(..) => "position and orientation of the tool".to_owned(),
        Layout::Instruments(all) => {
            let names: Vec<String> = all.list.iter().map(|instrument| escaped(&instrument.name)).collect();
            names.join(", ")
        }
    };
    let facts = [
        ("Instrument", escaped(&map.title)),
        ("Uncertainty", uncertainty),
        ("Measured", measured),
        ("Stands", base.to_owned()),
        ("Map", escaped(map.path())),
    ];
    let shown = facts.iter().filter(|(_, fact)| !fact.is_empty());
    let rows =
        shown.map(|(name, fact)| format!("<tr><th>{name}</th><td>{fact}</td></tr>\n")).collect::<String>();
    format!("<table class=\"facts\"><tbody>{rows}</tbody></table>\n")
}
