//! Shows a document as a page.
//!
//! Numbered figures: the SVG of a scene with title and caption.
//!
//! Provenance of a page: record, options, files, instrument, and the place to sign.

use std::path::Path;

use abbe::analysis::sampling;
use abbe_metrology::data::{Map, Source};
use abbe_spec::Spec;
use abbe_study::explore::{self, Explore};
use abbe_study::number::{error_unit, fixed};
use abbe_study::{Machine, Notes, Residuals, Result, RunRecord, version};

use super::document::cards;
use super::table::{facts, ledger, row_header};
use super::{document, escaped, folded, heading, panel, panels, paragraphs, section, verdict};
use crate::document::{Block, Depth, Document, Figure, Section, Table};
use crate::svg;

/// Rows of a table from which on its section is closed on a screen.
const LONG: usize = 12;

impl Document {
    /// Builds the page of a report on measurements, with a live panel of the machine, and its
    /// residuals row by row, if there are any. `files` are the kinds and the data of the job.
    ///
    /// # Errors
    ///
    /// A file cannot be read, or `notes` stop the job.
    pub fn measured_page<'f>(
        &self,
        machine: &Machine,
        map: Option<&Map>,
        files: impl IntoIterator<Item = (&'static str, impl Into<Source<'f>>)>,
        residuals: Option<Residuals>,
        notes: &mut dyn Notes,
    ) -> Result<String> {
        let provenance = Provenance::new(Some(&machine.spec), map, files)?;
        let rows = residuals.as_ref().map(|residuals| {
            Section::full("Row by row").table(row_by_row(residuals, machine.spec.length.symbol()))
        });
        let sections = self.sections.iter().cloned().chain(rows).collect();
        let live = Explore::measured(machine.clone(), residuals).run(notes)?;
        Ok(Self { sections, ..self.clone() }.page(&provenance, Some(&live)))
    }

    /// Builds the page of a report on data without a machine; `kind` is what the data are.
    ///
    /// # Errors
    ///
    /// The data cannot be read.
    pub fn page_of_data(&self, kind: &'static str, data: Source<'_>, record: RunRecord) -> Result<String> {
        let provenance = Provenance::new(None, None, [(kind, data)])?;
        Ok(Self { record, ..self.clone() }.page(&provenance, None))
    }

    /// Builds the page of the report; `live` is the data of its live panel.
    pub(crate) fn page(&self, provenance: &Provenance, live: Option<&explore::Report>) -> String {
        let panels = panels(live);
        let mut body = heading(self.kind, &self.machine, &self.title);
        body += &match &self.verdict {
            Some(reached) => verdict(reached.is_met, &reached.text, &[self.first_line()]),
            None => paragraphs(&[self.first_line()]),
        };
        let blocks = self.sections.iter().flat_map(|section| &section.blocks);
        body.extend(blocks.filter_map(|block| match block {
            Block::Cards(numbers) => Some(cards(numbers)),
            _ => None,
        }));
        body += &panel(self.panel, panels.as_ref());
        let mut drawn = 0;
        body.extend(self.sections.iter().map(|section| shown(section, &mut drawn)));
        body += &provenance.sections(&self.record, self.is_signed);
        document(&format!("{}: {}", self.machine, self.kind.to_lowercase()), &body, panels.as_ref())
    }
}

/// Tabulates the errors of measured rows, in `F_0`.
fn row_by_row(residuals: &Residuals, length: &str) -> Table {
    let (factor, unit) = error_unit(length);
    let Residuals { before, after, count, rows, .. } = residuals;
    let chosen = match rows.len() == *count {
        true => String::new(),
        false => format!(" of {} rows, evenly chosen from {count}", rows.len()),
    };
    let [norm, x, y, z] = ["norm", "x", "y", "z"].map(|part| format!(">{after}: {part}"));
    let before = before.as_deref().map(|name| format!(">{name}: norm"));
    let columns: Vec<String> = ["line".to_owned()].into_iter().chain(before).chain([norm, x, y, z]).collect();
    let rows = rows.iter().map(|row| {
        let sizes = row.before.map(sampling::norm).into_iter().chain([sampling::norm(row.after)]);
        let numbers = sizes.chain(row.after).map(|value| fixed(factor * value, 4));
        [row.line.to_string()].into_iter().chain(numbers).collect()
    });
    Table::listing(
        format!("Position errors{chosen}, in the axes of F_0, in {unit}"),
        &columns,
        rows.collect(),
    )
}

/// Formats a section with its figures numbered after the `drawn` ones; empty without blocks.
fn shown(part: &Section, drawn: &mut usize) -> String {
    let title = if part.depth == Depth::Answer { "Result" } else { part.title };
    let body: String = part.blocks.iter().map(|block| html(block, title, drawn)).collect();
    let is_long = |block: &Block| matches!(block, Block::Table(table) if table.rows.len() > LONG);
    match body.is_empty() {
        true => body,
        false if part.depth == Depth::Full && part.blocks.iter().any(is_long) => folded(title, &body),
        false => section(title, &body),
    }
}

fn html(block: &Block, title: &str, drawn: &mut usize) -> String {
    match block {
        Block::Facts(all) => {
            let mut rows: Vec<(String, String)> = Vec::new();
            for (name, text) in all {
                match rows.last_mut() {
                    Some((_, last)) if name.is_empty() => *last += &format!("<br>{}", escaped(text)),
                    _ => rows.push((escaped(name), escaped(text))),
                }
            }
            facts(title, rows)
        }
        Block::Table(table) => of_table(table, title),
        Block::Statement(statement) => paragraphs(std::slice::from_ref(&statement.text)),
        Block::List(items) => {
            let items = items.iter().map(|item| format!("<li>{}</li>\n", escaped(item)));
            format!("<ul>\n{}</ul>\n", items.collect::<String>())
        }
        Block::Code(lines) => format!("<pre>{}</pre>\n", escaped(&lines.join("\n"))),
        Block::Figures(scenes) => {
            *drawn += scenes.len();
            let numbered = (*drawn - scenes.len() + 1..).zip(scenes);
            numbered.map(|(number, drawn)| figure(number, drawn)).collect()
        }
        // They are above all sections.
        Block::Cards(_) => String::new(),
    }
}

fn of_table(table: &Table, title: &str) -> String {
    let lines = |cell: &str| escaped(cell).replace('\n', "<br>");
    let row = |row: &Vec<String>| {
        let cells = row.iter().zip(&table.columns).skip(1).map(|(cell, column)| {
            let class = if column.is_number { "" } else { " class=\"words\"" };
            format!("<td{class}>{}</td>", lines(cell))
        });
        let name = match row.first().map(String::as_str) {
            None | Some("") => "<td></td>".to_owned(),
            Some(name) => row_header(&lines(name)),
        };
        format!("<tr>{name}{}</tr>\n", cells.collect::<String>())
    };
    let body = table.rows.iter().map(row).collect::<String>();
    let names: Vec<String> = table.heading().into_iter().flatten().map(escaped).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let words = table.columns.iter().enumerate().filter(|(_, column)| !column.is_number).map(|(i, _)| i);
    let caption = if table.caption.is_empty() { title } else { &table.caption };
    let rest =
        if table.rest.is_empty() { String::new() } else { paragraphs(std::slice::from_ref(&table.rest)) };
    let body = format!("<tbody>{body}</tbody>\n");
    ledger(&escaped(caption), &names, &words.collect::<Vec<_>>(), &body) + &rest
}

/// Formats a figure with its number.
pub(super) fn figure(number: usize, Figure { scene, note, file }: &Figure) -> String {
    let reference = match scene.reference.as_str() {
        "" => String::new(),
        reference => format!(" <span class=\"paper\">{}</span>", escaped(reference)),
    };
    let subtitle = if scene.subtitle.is_empty() { String::new() } else { format!("{}.", scene.subtitle) };
    let file = match file.as_str() {
        "" => String::new(),
        file => format!("<a href=\"{file}\">{file}</a>"),
    };
    let caption = [&subtitle, &scene.caption, note].map(|text| escaped(text));
    let caption = caption.iter().chain([&file]).filter(|text| !text.is_empty());
    format!(
        "<figure>\n<h3>{number}. {}{reference}</h3>\n<div class=\"picture\">{}</div>\n<figcaption>{}</figcaption>\n\
         </figure>\n",
        escaped(&scene.title),
        svg::embedded(scene),
        caption.map(String::as_str).collect::<Vec<_>>().join(" ")
    )
}

/// Input files of a report, which the report itself does not contain.
#[derive(Clone, Debug, Default)]
pub(crate) struct Provenance {
    /// Kind, name and SHA-256 of each file or table.
    pub(crate) files: Vec<(&'static str, String, String)>,
}

impl Provenance {
    /// Collects the spec and the map if there are any, and the files or tables of the job.
    ///
    /// # Errors
    ///
    /// A file cannot be read.
    pub(crate) fn new<'f>(
        spec: Option<&Spec>,
        map: Option<&Map>,
        files: impl IntoIterator<Item = (&'static str, impl Into<Source<'f>>)>,
    ) -> Result<Self> {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut all: Vec<_> =
            spec.map(|spec| ("spec", spec.file.clone(), spec.hash.clone())).into_iter().collect();
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
        let stated = record.stated().map(|(title, text)| (title, escaped(text)));
        let signature = if is_signed { SIGNATURE } else { "" };
        let stated = match record.is_empty() {
            true if is_signed => format!("<section>\n{signature}</section>\n"),
            true => String::new(),
            false => section("Record", &(facts("Stated by the user", stated) + signature)),
        };
        stated + &section("Input files and options", &(self.table() + &options(record)))
    }

    /// Formats the kind, the name and the SHA-256 of input files, and the version of abbe.
    fn table(&self) -> String {
        let rows = self.files.iter().map(|(kind, name, hash)| {
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
