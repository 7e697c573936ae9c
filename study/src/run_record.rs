//! Record of a run: what a person signs, and the options that the figures depend on.

use serde::{Serialize, Serializer};

use crate::date::{Calendar, parse_date};
use crate::version;

/// Key and title of each entry of a record, in the order of a page.
const ENTRIES: [(&str, &str); 6] = [
    ("date", "Date"),
    ("operator", "Operator"),
    ("machine", "Machine"),
    ("serial", "Serial number"),
    ("instrument", "Instrument"),
    ("certificate", "Calibration certificate"),
];

/// Form of a date.
const DATE: &str = "expected a date such as 2026-03-14, with a time behind it or without";

/// Statements of the user about a run, and the options of its job.
///
/// Serialized, it is the object of the stated entries, and of the version of abbe as `abbe`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunRecord {
    /// Key and text of each stated entry.
    entries: Vec<(&'static str, String)>,
    /// Name and value of each option that the figures depend on.
    pub options: Vec<(&'static str, String)>,
}

impl RunRecord {
    /// Returns true if nothing is stated.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// States an entry of `[record]`; an empty text states nothing.
    pub fn state(&mut self, key: &str, text: String) {
        let known = ENTRIES.iter().find(|(known, _)| *known == key);
        if let Some((key, _)) = known.filter(|_| !text.is_empty()) {
            self.entries.retain(|(stated, _)| stated != key);
            self.entries.push((key, text));
        }
    }

    /// Replaces the date, if another one is given.
    pub fn dated(mut self, date: Option<&String>) -> Self {
        if let Some(date) = date {
            self.state("date", date.clone());
        }
        self
    }

    /// Adds the options of a job.
    pub fn with_options(&self, options: Vec<(&'static str, String)>) -> Self {
        Self { options, ..self.clone() }
    }

    /// Iterates over the title and the text of each stated entry.
    pub fn stated(&self) -> impl Iterator<Item = (&'static str, &str)> {
        ENTRIES.iter().filter_map(|(key, title)| {
            let (_, text) = self.entries.iter().find(|(stated, _)| stated == key)?;
            Some((*title, text.as_str()))
        })
    }
}

impl Serialize for RunRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.entries.iter().map(|(key, text)| (*key, text.as_str()));
        serializer.collect_map(entries.chain([("abbe", version())]))
    }
}

/// Checks the date of a record, such as `2026-03-14` or `2026-03-14 08:30`.
///
/// # Errors
///
/// The text is no date of the calendar; the message states the expected form.
pub fn check_date(text: &str) -> Result<String, String> {
    match parse_date(text) {
        Some((Calendar::Dates, _)) => Ok(text.to_owned()),
        _ => Err(DATE.to_owned()),
    }
}

#[cfg(test)]
mod tests;
