//! Sources of rows: a CSV file, or columns in memory.
//!
//! Tables of numbers without a map.

use std::path::Path;
use std::sync::Arc;

use abbe_study::{Result, hash, mistake};
use sha2::{Digest, Sha256};

use super::cells::Cells;
use super::file::{File, MOST_ROWS};
use super::record::Record;

/// Source of rows.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// A CSV file.
    File(&'a Path),
    /// Columns in memory.
    Columns(&'a Columns),
}

/// Named columns of equal lengths, and the names of ignored ones.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Name in diagnostics.
    name: String,
    pub(super) heading: Arc<[String]>,
    cells: Vec<Arc<Cells>>,
    rows: usize,
}

impl Columns {
    /// Creates columns with their names.
    ///
    /// `name` is used in diagnostics; `others` are the names of ignored columns. Columns of
    /// different lengths are an error.
    pub fn new(name: &str, columns: Vec<(String, Cells)>, others: Vec<String>) -> Result<Self> {
        let rows = columns.first().map_or(0, |(_, cells)| cells.len());
        if let Some((other, cells)) = columns.iter().find(|(_, cells)| cells.len() != rows) {
            let message = format!(
                "`{}` has {} rows, and `{}` has {rows}",
                other.escape_debug(),
                cells.len(),
                columns[0].0.escape_debug()
            );
            return Err(mistake::with_help(name, message, "give columns of equal length"));
        }
        if rows > MOST_ROWS {
            let message = format!("this table has {rows} rows; the maximum is {MOST_ROWS}");
            return Err(mistake::with_help(name, message, "split it, or keep every second row"));
        }
        let (mut heading, cells): (Vec<_>, Vec<_>) =
            columns.into_iter().map(|(name, cells)| (name, Arc::new(cells))).unzip();
        heading.extend(others);
        Ok(Self { name: name.to_owned(), heading: heading.into(), cells, rows })
    }

    /// Returns the SHA-256 of names, numbers and texts, without ignored columns.
    fn hash(&self) -> String {
        let mut hasher = Sha256::new();
        let mut text = |text: &str| {
            hasher.update((text.len() as u64).to_le_bytes());
            hasher.update(text);
        };
        self.heading[..self.cells.len()].iter().for_each(|name| text(name));
        for cells in &self.cells {
            match &**cells {
                Cells::Texts(cells) => cells.iter().for_each(|cell| text(cell)),
                Cells::Numbers(cells) => {
                    cells.iter().for_each(|number| text(&format!("{:016x}", number.to_bits())));
                }
            }
        }
        hash::hex(&hasher.finalize())
    }
}

/// A heading, and an iterator over the rows below it.
pub(super) struct Opened {
    pub(super) heading: Arc<[String]>,
    /// Description of the dialect, if it is not the usual one.
    pub(super) dialect: Option<&'static str>,
    pub(super) records: Box<dyn Iterator<Item = Result<Record>>>,
}

impl Source<'_> {
    /// Returns the name in diagnostics.
    pub fn name(&self) -> String {
        match self {
            Self::File(file) => file.display().to_string(),
            Self::Columns(columns) => columns.name.clone(),
        }
    }

    /// Returns the path, if it is a file.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(file) => Some(file),
            Self::Columns(_) => None,
        }
    }

    /// Returns the SHA-256 of a file, as `sha256sum` does, or of the names, numbers and texts of
    /// columns.
    pub fn hash(&self) -> Result<String> {
        match self {
            Self::File(file) => hash::file(file),
            Self::Columns(columns) => Ok(columns.hash()),
        }
    }

    /// Reads the heading, unless the names of the columns of the file are given.
    pub(super) fn open(&self, columns: &[String]) -> Result<Opened> {
        match self {
            Self::File(file) => {
                let file = File::open(file, columns)?;
                let (heading, dialect) = (Arc::clone(&file.heading), file.dialect.words());
                Ok(Opened { heading, dialect, records: Box::new(file.records()) })
            }
            Self::Columns(columns) => {
                let (heading, cells) = (Arc::clone(&columns.heading), Arc::<[_]>::from(&columns.cells[..]));
                let row = {
                    let heading = Arc::clone(&heading);
                    move |row| Ok(Record::of_columns(row, Arc::clone(&heading), Arc::clone(&cells)))
                };
                Ok(Opened { heading, dialect: None, records: Box::new((0..columns.rows).map(row)) })
            }
        }
    }
}

impl<'a, P: AsRef<Path> + ?Sized> From<&'a P> for Source<'a> {
    fn from(file: &'a P) -> Self {
        Self::File(file.as_ref())
    }
}

impl<'a> From<&'a Columns> for Source<'a> {
    fn from(columns: &'a Columns) -> Self {
        Self::Columns(columns)
    }
}

/// Cells of a file or a table.
pub(crate) struct RawTable {
    /// Names of the columns.
    pub(crate) heading: Vec<String>,
    /// Numbers by row; NaN for a cell that is not a number.
    pub(crate) rows: Vec<Vec<f64>>,
    /// First line of each column with a cell that is not a number, and the reason.
    pub(crate) slips: Vec<Option<(u64, String)>>,
}

/// Reads all rows.
pub(crate) fn raw_table(source: Source<'_>) -> Result<RawTable> {
    let Opened { heading, records, .. } = source.open(&[])?;
    let heading = heading.to_vec();
    if source.file().is_some() && heading.iter().any(|name| name.parse::<f64>().is_ok()) {
        let message = "the first line of this file contains numbers";
        let help = "add a heading with a name for each column, such as q1, …, x, y, z, a, b, c";
        return Err(mistake::with_help(source.name(), message, help));
    }
    let (mut rows, mut slips) = (Vec::new(), vec![None; heading.len()]);
    for record in records {
        let record = record?;
        if let Some(reason) = record.too_long() {
            let message = format!("line {}: {reason}", record.line);
            let help = "write one row of numbers in every line below the heading";
            return Err(mistake::with_help(source.name(), message, help));
        }
        let cell = |(place, slip): (usize, &mut Option<(u64, String)>)| {
            record.number(place).unwrap_or_else(|reason| {
                slip.get_or_insert((record.line, reason));
                f64::NAN
            })
        };
        rows.push(slips.iter_mut().enumerate().map(cell).collect());
    }
    Ok(RawTable { heading, rows, slips })
}
