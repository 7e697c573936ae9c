//! Dialect of a CSV file: separator and decimal mark.

use std::io::Read;

use csv::{ReaderBuilder, Trim};

/// Possible separators.
pub(super) const SEPARATORS: [u8; 3] = [b'\t', b';', b','];

/// Number of records that are examined.
const LOOKED_AT: usize = 200;

/// Dialect of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dialect {
    /// Separator: comma, semicolon or tab.
    delimiter: u8,
    /// The decimal mark is a comma.
    decimal_comma: bool,
}

impl Dialect {
    /// Detects the dialect of a text.
    ///
    /// The separator is the most frequent candidate in the heading outside of quotes, unless
    /// `stated`. The decimal mark is a comma if a cell is a number with a comma and none is a
    /// number with a point.
    pub(super) fn detect(bytes: &[u8], stated: Option<u8>) -> Self {
        let counts = separators(bytes);
        // `max_by_key` returns the last of equal counts.
        let most = || SEPARATORS.into_iter().max_by_key(|byte| counts[usize::from(*byte)]);
        let delimiter = stated.or_else(most);
        let plain = Self { delimiter: delimiter.unwrap_or(b','), decimal_comma: false };
        let records =
            plain.reader(bytes).into_records().take(LOOKED_AT).filter_map(Result::ok).collect::<Vec<_>>();
        let any = |mark: char| {
            let mut cells = records.iter().flatten();
            cells
                .any(|cell| cell.matches(mark).count() == 1 && cell.replace(mark, ".").parse::<f64>().is_ok())
        };
        Self { decimal_comma: any(',') && !any('.'), ..plain }
    }

    pub(super) fn reader<R: Read>(&self, bytes: R) -> csv::Reader<R> {
        self.builder().from_reader(bytes)
    }

    /// Returns a reader that treats the heading as a record.
    pub(super) fn all_records<R: Read>(&self, bytes: R) -> csv::Reader<R> {
        self.builder().has_headers(false).from_reader(bytes)
    }

    fn builder(&self) -> ReaderBuilder {
        let mut builder = ReaderBuilder::new();
        builder.trim(Trim::All).comment(Some(b'#')).flexible(true).delimiter(self.delimiter);
        builder
    }

    /// Returns the dialect with another separator.
    pub(super) fn separated(self, delimiter: u8) -> Self {
        Self { delimiter, ..self }
    }

    /// Parses the number in a cell.
    pub(super) fn number(&self, cell: &str) -> Option<f64> {
        match self.decimal_comma {
            true if cell.contains('.') => None,
            true => cell.replacen(',', ".", 1).parse().ok(),
            false => cell.parse().ok(),
        }
    }

    /// Describes a dialect that is not the usual one.
    pub(super) fn words(&self) -> Option<&'static str> {
        Some(match (self.delimiter, self.decimal_comma) {
            (b',', false) => return None,
            (b',', true) => "with decimal commas",
            (b';', false) => "separated by semicolons",
            (b';', true) => "separated by semicolons, with decimal commas",
            (_, false) => "separated by tabs",
            (_, true) => "separated by tabs, with decimal commas",
        })
    }

    /// Returns the plural name of the separator.
    pub(super) fn delimiter(&self) -> &'static str {
        match self.delimiter {
            b';' => "semicolons",
            b'\t' => "tabs",
            _ => "commas",
        }
    }
}

/// Counts each byte in the heading, outside of quotes.
fn separators(bytes: &[u8]) -> [usize; 256] {
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    while let [b'\n' | b'\r' | b'#', ..] = rest {
        let comment = rest.iter().take_while(|byte| rest[0] == b'#' && **byte != b'\n').count();
        rest = &rest[comment.max(1)..];
    }
    let (mut counts, mut quoted, mut before) = ([0; 256], false, b',');
    for byte in rest.iter().copied() {
        match byte {
            // A quote inside a cell is literal; the second of two in a quoted cell reopens it.
            b'"' if quoted || matches!(before, b',' | b';' | b'\t' | b'"') => quoted = !quoted,
            b'\n' | b'\r' if !quoted => break,
            _ if quoted => {}
            _ => counts[usize::from(byte)] += 1,
        }
        before = byte;
    }
    counts
}

#[cfg(test)]
mod tests;
