//! Reads `[workspace.path]`: configurations from a CSV file, one per line.
//!
//! ```text
//! d1 (mm),q4 (deg),x (mm)
//! 38,-90,250
//! ```
//!
//! Columns are named like variables, parameters and inputs, with a unit in parentheses. Without
//! a unit they are in the spec's length unit or in rad. Symbols without a column stay at home.

use std::{io::Read, path};

use abbe::{Manipulator, analysis::Configuration};
use abbe_spec::bounded::{UnreadableFile, not_text};
use abbe_spec::csv_writer::meant;
use abbe_spec::expr::{LARGEST, Symbol};
use abbe_spec::option::Q;
use abbe_spec::value::{find_name, parse_value};
use abbe_spec::{Diagnostic, Document, Input, Section, Spec};
use csv::{ReaderBuilder, StringRecord, Trim};

use super::keys;
use crate::{lines::RecordedReader, number::quantity};

/// Largest size of a file, in bytes.
const LARGEST_FILE: u64 = 1 << 30;

/// Largest number of configurations in a file.
const MOST_ROWS: usize = 2_000_000;

/// Configurations from a file.
#[derive(Clone, Debug)]
pub struct Path {
    /// Name of the file in the study.
    pub(super) file: String,
    columns: Vec<Column>,
    /// Values of every column, line by line, in the length unit, rad or coherent units.
    pub(super) configurations: Vec<Vec<f64>>,
}

/// Symbol of a column, and its unit in coherent units.
#[derive(Clone, Debug)]
struct Column {
    symbol: Symbol,
    unit: f64,
}

/// Columns, and the values of each line.
type Table = (Vec<Column>, Vec<Vec<f64>>);

impl Path {
    /// Returns configurations of the joints, each with the values of all variables.
    pub(super) fn of_joints(configurations: Vec<Vec<f64>>) -> Self {
        let count = configurations.first().map_or(0, Vec::len);
        let columns = (0..count).map(|i| Column { symbol: Symbol::Variable(i), unit: 1.0 }).collect();
        Self { file: Q.to_string(), columns, configurations }
    }

    /// Returns the parameters that have a column.
    pub fn parameters(&self) -> impl Iterator<Item = usize> {
        self.numbers(|symbol| if let Symbol::Parameter(i) = symbol { Some(i) } else { None })
    }

    /// Returns the variables that have a column.
    pub fn variables(&self) -> impl Iterator<Item = usize> {
        self.numbers(|symbol| if let Symbol::Variable(i) = symbol { Some(i) } else { None })
    }

    /// Returns the inputs that have a column.
    pub fn inputs(&self) -> impl Iterator<Item = usize> {
        self.numbers(|symbol| if let Symbol::Input(i) = symbol { Some(i) } else { None })
    }

    fn numbers(&self, number: fn(Symbol) -> Option<usize>) -> impl Iterator<Item = usize> {
        self.columns.iter().filter_map(move |column| number(column.symbol))
    }

    /// Returns the symbols that have a column, with their values.
    pub(super) fn columns(&self) -> impl Iterator<Item = (Symbol, Vec<f64>)> {
        let values = |k: usize| self.configurations.iter().map(move |values| values[k]).collect();
        self.columns.iter().enumerate().map(move |(k, column)| (column.symbol, values(k)))
    }

    /// Removes the column of an input, if it has one.
    pub(super) fn remove_input(&mut self, input: usize) {
        if let Some(column) = self.columns.iter().position(|column| column.symbol == Symbol::Input(input)) {
            self.columns.remove(column);
            self.configurations.iter_mut().for_each(|values| _ = values.remove(column));
        }
    }

    /// Returns the configurations of a manipulator.
    pub(super) fn configurations(&self, manipulator: &dyn Manipulator) -> Vec<Configuration> {
        let home = Configuration::home(manipulator.description());
        let configuration = |values: &Vec<f64>| {
            let mut configuration = home.clone();
            for (column, value) in self.columns.iter().zip(values) {
                match column.symbol {
                    Symbol::Variable(i) => configuration.q[i] = *value,
                    Symbol::Parameter(i) => configuration.s[i] = *value,
                    Symbol::Input(i) => configuration.u[i] = *value,
                    _ => {}
                }
            }
            configuration
        };
        self.configurations.iter().map(configuration).collect()
    }
}

/// Reads `file`, relative to the folder of the study.
pub(super) fn read(section: &Section<'_>, spec: &Spec) -> Option<Path> {
    section.check_keys(&[&keys::PATH]);
    let item = section.required("file")?;
    let file = item.string()?;
    let folder = path::Path::new(&section.document.path).parent().unwrap_or(path::Path::new(""));
    let path = folder.join(&file);
    let found = match shipped(section.document, &file) {
        Some(text) => read_configurations(text.as_bytes(), spec),
        None => {
            let input = section.document.named_file(&path, LARGEST_FILE);
            let input = input.map_err(|error| describe_error(&error.into()));
            let found = input.and_then(|input| read_configurations(input, spec));
            section.document.files.borrow_mut().push(path);
            found
        }
    };
    let found = found.map_err(|message| {
        let message = format!("{}: {message}", file.escape_debug());
        let help = "write a heading such as `d1 (mm),q4 (deg)`, then one configuration per line";
        section.document.mistake(Diagnostic::new(item.span(), message).label("read by this key").help(help));
    });
    let (columns, configurations) = found.ok()?;
    Some(Path { file, columns, configurations })
}

/// Returns the text of a file that a shipped study names.
fn shipped(document: &Document, file: &str) -> Option<&'static str> {
    let mut files = abbe_manipulators::STUDY_FILES.iter().filter(|_| document.folder.is_none());
    files.find(|(name, _)| *name == file).map(|(_, text)| *text)
}

fn read_configurations(input: impl Read, spec: &Spec) -> Result<Table, String> {
    let (watched, mut lines) = RecordedReader::new(input);
    let mut reader = ReaderBuilder::new().trim(Trim::All).comment(Some(b'#')).from_reader(watched);
    let heading = reader.headers().map_err(|error| describe_error(&error))?;
    if let Some(unfit) = not_text(heading.as_byte_record().as_slice()) {
        return Err(format!("{}; {}", unfit.message, unfit.help));
    }
    let columns = heading.iter().map(|name| column(meant(name), spec)).collect::<Result<Vec<_>, _>>()?;
    for (i, column) in columns.iter().enumerate() {
        if columns[..i].iter().any(|other| other.symbol == column.symbol) {
            return Err(format!("duplicate column `{}`", &heading[i]));
        }
    }
    let mut configurations = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| describe_error(&error))?;
        if configurations.len() == MOST_ROWS {
            return Err(format!("it has more than {MOST_ROWS} lines; use fewer configurations"));
        }
        let line = record.position().map_or(0, |position| lines.record_line(position.byte()));
        configurations.push(values(&record, line, &columns, spec)?);
    }
    if configurations.is_empty() {
        return Err("it contains no configuration".to_owned());
    }
    Ok((columns, configurations))
}

/// Describes an error in the format of a file.
fn describe_error(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Io(error) => {
            let UnreadableFile { message, help } = UnreadableFile::from_error(error, "");
            if help.is_empty() { error.to_string() } else { format!("{message}; {help}") }
        }
        _ => error.to_string(),
    }
}

fn values(record: &StringRecord, line: u64, columns: &[Column], spec: &Spec) -> Result<Vec<f64>, String> {
    let value = |(field, column): (&str, &Column)| {
        let value = field.parse::<f64>().ok().map(|value| value * column.unit);
        let value = value.filter(|value| value.is_finite());
        let value =
            value.ok_or_else(|| format!("line {line}: `{}` is not a number", field.escape_debug()))?;
        if value.abs() > LARGEST {
            return Err(format!(
                "line {line}: `{}` is too large; the maximum is 1e150",
                field.escape_debug()
            ));
        }
        match column.symbol {
            Symbol::Input(i) if !within(value, spec.inputs[i].range) => {
                let Input { name, unit, range: [lower, upper], .. } = &spec.inputs[i];
                let [value, lower, upper] = [value, *lower, *upper].map(|value| quantity(value, unit));
                Err(format!("line {line}: `{name}` is {value}, outside its range {lower} … {upper}"))
            }
            _ => Ok(value),
        }
    };
    record.iter().zip(columns).map(value).collect()
}

fn within(value: f64, [lower, upper]: [f64; 2]) -> bool {
    (lower..=upper).contains(&value)
}

/// Parses a heading, `d1` or `d1 (mm)`.
fn column(heading: &str, spec: &Spec) -> Result<Column, String> {
    let (name, unit) = match heading.strip_suffix(')').and_then(|heading| heading.split_once('(')) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (heading, None),
    };
    let all = spec.symbols().collect::<Vec<_>>();
    let names = all.iter().map(|(name, ..)| *name).collect::<Vec<_>>();

    let document = Document::new("", name);
    let what = if spec.inputs.is_empty() { "variable or parameter" } else { "variable, parameter or input" };
    let found = find_name(&document, 0..name.len(), name, &names, what);
    let (_, symbol, dimension) = found.map(|found| all[found]).ok_or_else(|| mistake(&document))?;
    let text = format!("1 {}", unit.unwrap_or_default());
    let document = Document::new("", text.as_str());
    let what = format!("the unit of the column `{name}`");
    let unit = parse_value(&document, 0..text.trim_end().len(), spec.length, dimension, &what);
    Ok(Column { symbol, unit: unit.ok_or_else(|| mistake(&document))? })
}

/// Returns the first mistake of a document in one line.
fn mistake(document: &Document) -> String {
    let found = document.found.borrow();
    let mistake = found.first();
    let message = mistake.map(|mistake| match &mistake.help {
        Some(help) => format!("{}; {help}", mistake.message),
        None => mistake.message.clone(),
    });
    message.unwrap_or_default()
}
