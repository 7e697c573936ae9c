//! Where rows come from: a CSV file, or columns that are in memory.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe_spec::diagnostic::Diagnostics;
use sha2::{Digest, Sha256};

use super::cells::Cells;
use super::file::{File, MOST_ROWS};
use super::record::Record;
use crate::{hash, mistake};

/// Where rows come from.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// A CSV file.
    File(&'a Path),
    /// Columns in memory.
    Columns(&'a Columns),
}

/// Columns of equal lengths, each with its name, and the names of others that nobody reads.
#[derive(Clone, Debug)]
pub struct Columns {
    /// What mistakes are shown under.
    name: String,
    pub(super) heading: Arc<[String]>,
    cells: Vec<Arc<Cells>>,
    rows: usize,
}

impl Columns {
    /// Columns with their names; `name` is what mistakes are shown under, `others` are columns that no map of theirs names.
    /// Those of different lengths are a mistake.
    pub fn new(name: &str, columns: Vec<(String, Cells)>, others: Vec<String>) -> Result<Self, Diagnostics> {
        let rows = columns.first().map_or(0, |(_, cells)| cells.len());
        if let Some((other, cells)) = columns.iter().find(|(_, cells)| cells.len() != rows) {
            let message = format!(
                "`{}` has {} rows, and `{}` has {rows}",
                other.escape_debug(),
                cells.len(),
                columns[0].0.escape_debug()
            );
            return Err(mistake::with_help(name, message, "all columns of a table have a cell in every row"));
        }
        if rows > MOST_ROWS {
            let message = format!("this table has {rows} rows; {MOST_ROWS} can be worked with");
            return Err(mistake::with_help(name, message, "split it, or take every second row"));
        }
        let (mut heading, cells): (Vec<_>, Vec<_>) =
            columns.into_iter().map(|(name, cells)| (name, Arc::new(cells))).unzip();
        heading.extend(others);
        Ok(Self { name: name.to_owned(), heading: heading.into(), cells, rows })
    }

    /// The SHA-256 of its names, numbers and texts; without the others.
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
        hash::digits(&hasher.finalize())
    }
}

/// A heading, and how the rows below it are read, one by one.
pub(super) struct Opened {
    pub(super) heading: Arc<[String]>,
    /// How it is written, if not as usual.
    pub(super) written: Option<&'static str>,
    pub(super) records: Box<dyn Iterator<Item = Result<Record, Diagnostics>>>,
}

impl Source<'_> {
    /// What mistakes are shown under.
    pub fn name(&self) -> String {
        match self {
            Self::File(file) => file.display().to_string(),
            Self::Columns(columns) => columns.name.clone(),
        }
    }

    /// The file, if it is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(file) => Some(file),
            Self::Columns(_) => None,
        }
    }

    /// The SHA-256 of a file as `sha256sum` says it; of columns, that of their names, numbers and texts.
    pub fn hash(&self) -> Result<String, Diagnostics> {
        match self {
            Self::File(file) => hash::of_file(file),
            Self::Columns(columns) => Ok(columns.hash()),
        }
    }

    /// Reads the heading.
    pub(super) fn open(&self) -> Result<Opened, Diagnostics> {
        match self {
            Self::File(file) => {
                let file = File::open(file)?;
                let (heading, written) = (Arc::clone(&file.heading), file.dialect.words());
                Ok(Opened { heading, written, records: Box::new(file.records()) })
            }
            Self::Columns(columns) => {
                let (heading, cells) = (Arc::clone(&columns.heading), Arc::<[_]>::from(&columns.cells[..]));
                let row = {
                    let heading = Arc::clone(&heading);
                    move |row| Ok(Record::of_columns(row, Arc::clone(&heading), Arc::clone(&cells)))
                };
                Ok(Opened { heading, written: None, records: Box::new((0..columns.rows).map(row)) })
            }
        }
    }
}

impl<'a> From<&'a Path> for Source<'a> {
    fn from(file: &'a Path) -> Self {
        Self::File(file)
    }
}

impl<'a> From<&'a PathBuf> for Source<'a> {
    fn from(file: &'a PathBuf) -> Self {
        Self::File(file)
    }
}

impl<'a> From<&'a Columns> for Source<'a> {
    fn from(columns: &'a Columns) -> Self {
        Self::Columns(columns)
    }
}
