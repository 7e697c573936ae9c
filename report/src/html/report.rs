//! Shows a document as a page.

use abbe_metrology::data::{Map, Source};
use abbe_spec::Diagnostics;
use abbe_study::explore::{self, Explore};
use abbe_study::{Machine, Notes, Residuals};

use super::document::cards;
use super::figure::figure;
use super::provenance::Provenance;
use super::table::{facts, ledger, row_header};
use super::{document, escaped, folded, heading, panel, panels, paragraphs, section, verdict};
use crate::document::{Block, Depth, Document, Section, Table};

/// Rows of a table from which on its section is closed on a screen.
const LONG: usize = 12;

impl Document {
    /// Builds the page of a report on measurements, with a live panel of the machine and its
    /// residuals, if there are any. `files` are the kinds and the data of the job.
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
    ) -> Result<String, Diagnostics> {
        let provenance = Provenance::new(&machine.spec, map, files)?;
        let live = Explore::measured(machine.clone(), residuals).run(notes)?;
        Ok(self.page(&provenance, Some(&live)))
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
