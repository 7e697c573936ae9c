//! Shows a document as plain text of [`WIDTH`](crate::text::WIDTH) columns, or as many as
//! [`at_width`](crate::text::at_width) sets: for terminals, and for `print` in Python.

use crate::document::{Block, Depth, Document, Section, Table};
use crate::text::{self, Detail, aligned, fact, wrapped};

impl Document {
    /// Returns the first screen, or all of the report, which begins with the first screen.
    pub fn text(&self, detail: Detail) -> String {
        let mut text = wrapped(&self.first_line(), 0) + "\n";
        let answers = self.sections.iter().filter(|section| section.depth == Depth::Answer);
        answers.flat_map(|section| &section.blocks).for_each(|block| text += &format!("\n{}", answer(block)));
        if detail == Detail::Answer {
            return text;
        }
        let full = |section: &&Section| section.depth == Depth::Full && !section.blocks.is_empty();
        for section in self.sections.iter().filter(full) {
            text += &format!("\n{}\n", section.title);
            text.extend(section.blocks.iter().map(details));
        }
        let stated = self.record.stated().map(|(title, text)| format!("{title:<25}{}\n", wrapped(text, 25)));
        match stated.collect::<String>() {
            stated if stated.is_empty() => text,
            stated => format!("{text}\n{stated}"),
        }
    }
}

/// Formats a block of the first screen.
fn answer(block: &Block) -> String {
    match block {
        Block::Table(table) => {
            let header = table.heading().map(|names| names.map(str::to_owned).collect());
            let rows: Vec<Vec<String>> = header.into_iter().chain(table.rows.iter().cloned()).collect();
            let right: Vec<bool> = table.columns.iter().map(|column| column.is_number).collect();
            aligned(&rows, &right) + &rest(table)
        }
        block => details(block),
    }
}

/// Formats a block of a full report.
fn details(block: &Block) -> String {
    let lines = |lines: &[String], shown: fn(&String) -> String| lines.iter().map(shown).collect::<String>();
    match block {
        Block::Facts(facts) => facts.iter().map(|(name, text)| fact(name, text)).collect(),
        Block::Table(table) => ruled(table),
        Block::Statement(statement) => wrapped(&statement.text, 0) + "\n",
        Block::List(items) => lines(items, |item| format!("  {}\n", wrapped(item, 2))),
        Block::Code(code) => lines(code, |line| format!("  {line}\n")),
        Block::Cards(_) | Block::Figures(_) => String::new(),
    }
}

/// Formats a table below a rule.
fn ruled(table: &Table) -> String {
    let header: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    let mut ruled = text::Table::new(&header);
    table.rows.iter().for_each(|row| ruled.row(row.clone()));
    let numbers = table.columns.iter().enumerate().filter(|(_, column)| column.is_number);
    let ruled = ruled.right(&numbers.map(|(i, _)| i).collect::<Vec<_>>());
    let caption = match table.caption.as_str() {
        "" => String::new(),
        caption => wrapped(caption, 0) + "\n",
    };
    format!("{caption}{ruled}{}", rest(table))
}

fn rest(table: &Table) -> String {
    if table.rest.is_empty() { String::new() } else { format!("  {}\n", table.rest) }
}
