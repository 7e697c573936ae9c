//! TOML documents with the location of every item, from which specs, studies, maps and plans are
//! read.

use std::cell::RefCell;
use std::collections::HashSet;
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe_core::LengthUnit;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::bounded::{Bounded, Contents, UnreadableFile, not_text};
use crate::diagnostic::{Diagnostic, Diagnostics, Span, decimal, nearest_after, suggestion};
use crate::expr::{
    Allowed, Dimension, Entry, Expression, LARGEST as LARGEST_NUMBER, LocatedText, Scope, TextLocation,
    parse_expression,
};
use crate::keys::Keys;
use crate::not_toml::not_toml;

/// Maximum size of a file in bytes; a chain of a hundred frames takes about 30 kB.
const LARGEST: u64 = 4 << 20;

/// A file with the diagnostics found so far.
#[derive(Debug)]
pub struct Document {
    /// Name of the file as given by the user.
    pub path: String,
    /// Text of the file.
    pub text: Arc<str>,
    /// Unit of lengths without a unit.
    pub length: LengthUnit,
    /// Diagnostics found so far.
    pub found: RefCell<Vec<Diagnostic>>,
    /// Folder of the file; `None` for text that is not in a file.
    pub folder: Option<PathBuf>,
    /// Contents of all files that the document may name; `None` opens the files.
    pub contents: Option<Arc<Contents>>,
    /// Additional files read for this one, and their contents.
    pub(crate) beside: RefCell<Vec<(PathBuf, Vec<u8>)>>,
    /// Every file that was read, this one first.
    pub files: RefCell<Vec<PathBuf>>,
    /// Diagnostics about a missing key that is present under a misspelled name, by location and
    /// message.
    pub(crate) meant: RefCell<HashSet<(Span, String)>>,
}

impl Document {
    /// Creates a document from text. Lines may end as on old computers: by a carriage return alone.
    pub fn new(path: impl Display, text: impl Into<Arc<str>>) -> Self {
        let text: Arc<str> = text.into();
        let is_old = text.contains('\r') && !text.contains('\n');
        Self {
            path: path.to_string(),
            text: if is_old { text.replace('\r', "\n").into() } else { text },
            length: LengthUnit::Metre,
            found: RefCell::default(),
            folder: None,
            contents: None,
            beside: RefCell::default(),
            files: RefCell::default(),
            meant: RefCell::default(),
        }
    }

    /// Reads a file. A file that is missing, unreadable, too large or not UTF-8 gives
    /// [`Diagnostics`] like any other mistake.
    pub fn read(path: &Path) -> Result<Self, Diagnostics> {
        let name = path.display().to_string();
        let fail =
            |text: Arc<str>, diagnostic| Diagnostics { path: name.clone(), text, list: vec![diagnostic] };
        let unfit = |UnreadableFile { message, help }: UnreadableFile| {
            fail(Arc::from(""), Diagnostic::whole_file(message).help(help))
        };
        let bytes = Bounded::read_all(path, LARGEST).map_err(|error| {
            unfit(UnreadableFile::from_error(&error, "give the path of a file that can be read"))
        })?;
        if let Some(found) = not_text(&bytes) {
            return Err(unfit(found));
        }
        let bytes = match String::from_utf8(bytes) {
            Ok(text) => {
                let folder = path.parent().map(Path::to_owned);
                return Ok(Self { folder, files: vec![path.to_owned()].into(), ..Self::new(name, text) });
            }
            Err(error) => error,
        };
        let valid = bytes.utf8_error().valid_up_to();
        let text: Arc<str> = String::from_utf8_lossy(bytes.as_bytes()).into();
        let mistake = Diagnostic::new(valid..valid + 1, "this file is not UTF-8 text")
            .label("not a UTF-8 character")
            .help("save it as UTF-8, or write names without accents");
        Err(fail(text, mistake))
    }

    /// Opens a file that the document names, or finds it in [`contents`](Self::contents).
    pub fn named_file(&self, path: &Path, most: u64) -> io::Result<Bounded> {
        self.contents.as_ref().map_or_else(|| Bounded::open(path, most), |all| Bounded::find(all, path, most))
    }

    /// Parses `text`, the document's own, or records all syntax errors.
    pub fn tables<'t>(&self, text: &'t str) -> Option<Spanned<DeTable<'t>>> {
        let (table, errors) = DeTable::parse_recoverable(text);
        let (mut last_line, mut repeated): (_, Option<usize>) = (None, None);
        for error in &errors {
            let end = text.len();
            // Further errors on the same line are mostly consequences of the first.
            let line = error
                .span()
                .map(|span| text.as_bytes()[..span.start.min(end)].iter().filter(|b| **b == b'\n').count());
            if line.is_some() && std::mem::replace(&mut last_line, line) == line {
                continue;
            }
            let message = error.message().lines().collect::<Vec<_>>().join(", ");
            let span = error.span().unwrap_or(end..end);
            let is_table = text.get(..span.start).is_some_and(|before| before.ends_with('['));
            let is_duplicate = message == "duplicate key";
            // The keys of a repeated table are duplicates, too.
            let keys = repeated.and_then(|header| text.get(header..span.start));
            if is_duplicate && !is_table && keys.is_some_and(|keys| !keys.contains("\n[")) {
                continue;
            }
            if is_duplicate && is_table {
                repeated = Some(span.end);
            }
            let (span, help) = match text.get(span.clone()) {
                Some(name) if is_table && is_duplicate => {
                    (span, format!("write `[[{name}]]` for an array of tables, or merge the two tables"))
                }
                Some(_) if text.get(span.start..).is_some_and(|rest| rest.starts_with(',')) => {
                    with_point(text, span.start).unwrap_or_else(|| (span, TOML.to_owned()))
                }
                Some(word)
                    if message.starts_with("string values must be")
                        && word.starts_with(char::is_alphanumeric) =>
                {
                    (span, format!("write it in quotes: `\"{}\"`", word.trim()))
                }
                _ => (span, TOML.to_owned()),
            };
            self.found.borrow_mut().push(Diagnostic::new(span, message).help(help));
        }
        let mistake = not_toml(text, &self.found.borrow());
        if let Some(mistake) = mistake {
            self.found.replace(vec![mistake]);
        }
        errors.is_empty().then_some(table)
    }

    /// Returns the number of the line of a byte, from 1.
    pub fn line(&self, at: usize) -> usize {
        self.text.as_bytes()[..at.min(self.text.len())].iter().filter(|byte| **byte == b'\n').count() + 1
    }

    /// Returns the number of diagnostics found so far.
    pub fn mistakes(&self) -> usize {
        self.found.borrow().len()
    }

    /// Records a diagnostic.
    pub fn mistake(&self, diagnostic: Diagnostic) {
        self.found.borrow_mut().push(diagnostic);
    }

    /// Records a diagnostic, and returns none.
    pub fn fail<T>(&self, diagnostic: Diagnostic) -> Option<T> {
        self.found.borrow_mut().push(diagnostic);
        None
    }

    /// Records a mistake with its help, and returns none.
    pub fn refuse<T>(&self, span: Span, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.fail(Diagnostic::new(span, message).help(help))
    }

    /// Parses and reads the document: returns the result, or all diagnostics in the order of the
    /// file.
    pub fn read_tables<T>(self, read: impl FnOnce(&Section<'_>) -> Option<T>) -> Result<T, Diagnostics> {
        let text = Arc::clone(&self.text);
        let tables = self.tables(&text);
        let result = tables.and_then(|tables| read(&Section::root(&tables, &self)));
        self.finish(result)
    }

    /// Finishes reading: returns the result, or all diagnostics in the order of the file.
    pub fn finish<T>(self, result: Option<T>) -> Result<T, Diagnostics> {
        match result {
            Some(result) if self.mistakes() == 0 => Ok(result),
            _ => {
                let (mut list, meant) = (self.found.into_inner(), self.meant.into_inner());
                list.retain(|Diagnostic { span, message, .. }| {
                    !span.clone().is_some_and(|span| meant.contains(&(span, message.clone())))
                });
                list.sort_by_key(|diagnostic| diagnostic.span.as_ref().map_or(0, |span| span.start));
                list.dedup();
                Err(Diagnostics { path: self.path, text: self.text, list })
            }
        }
    }
}

/// A key and its value.
#[derive(Clone, Debug)]
pub struct Item<'d> {
    /// The key.
    pub key: String,
    /// Location of the key.
    pub key_span: Span,
    value: &'d Spanned<DeValue<'d>>,
    /// Document that it is of.
    pub document: &'d Document,
}

impl<'d> Item<'d> {
    fn new(
        (key, value): (&'d Spanned<DeString<'d>>, &'d Spanned<DeValue<'d>>),
        document: &'d Document,
    ) -> Self {
        Self { key: key.get_ref().to_string(), key_span: key.span(), value, document }
    }

    /// Returns the location of the value.
    pub fn span(&self) -> Span {
        self.value.span()
    }

    /// Returns the item of a key if the value is a table that contains it.
    pub(crate) fn key_of_table(&self, key: &str) -> Option<Self> {
        self.as_table()?.get(key)
    }

    /// Returns the number if the value is a number, or a string with nothing else.
    pub(crate) fn number(&self) -> Option<f64> {
        match self.value.get_ref() {
            DeValue::Integer(number) => number.to_string().parse().ok(),
            DeValue::Float(number) => number.to_string().parse().ok(),
            DeValue::String(text) => text.trim().parse().ok(),
            _ => None,
        }
    }

    /// Returns `true` for a list.
    pub fn is_list(&self) -> bool {
        self.value.get_ref().is_array()
    }

    /// Returns the entries if the value is an array; none otherwise. They have its key.
    pub fn list(&self) -> Vec<Self> {
        let entries = self.value.get_ref().as_array().into_iter().flat_map(|array| array.iter());
        entries.map(|value| Self { key: self.key.clone(), key_span: value.span(), value, ..*self }).collect()
    }

    /// Returns the text if the value is a string.
    pub fn text(&self) -> Option<&'d str> {
        self.value.get_ref().as_str()
    }

    /// Returns the table if the value is one.
    pub fn as_table(&self) -> Option<Section<'d>> {
        let table = self.value.get_ref().as_table()?;
        let (span, name) = (self.key_span.clone(), self.key.clone());
        Some(Section { table, span, name, is_root: false, document: self.document })
    }

    /// Returns `true` if the value is a string.
    pub fn is_text(&self) -> bool {
        self.text().is_some()
    }

    /// Returns `true` if the value is a table.
    pub fn is_table(&self) -> bool {
        self.value.get_ref().is_table()
    }

    /// Records a mistake of the value with its help, and returns none.
    pub fn refuse<T>(&self, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.document.refuse(self.span(), message, help)
    }

    /// Records a mistake of the key with its help, and returns none.
    pub fn refuse_key<T>(&self, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.document.refuse(self.key_span.clone(), message, help)
    }

    /// Records that a value has another type than expected.
    fn wrong_type<T>(&self, expected: &str) -> Option<T> {
        let found = self.value.get_ref().type_str();
        let message = format!("`{}` must be {expected}, not {}", self.key, with_article(found));
        let help = match self.value.get_ref() {
            DeValue::Array(all) if matches!(all.first().map(Spanned::get_ref), Some(DeValue::Table(_))) => {
                format!("write one table: `[{}]`", self.key)
            }
            _ => format!("write `{} = …` with {expected}", self.key),
        };
        self.document
            .fail(Diagnostic::new(self.span(), message).label(format!("expected {expected}")).help(help))
    }

    /// Reads a string.
    pub fn string(&self) -> Option<String> {
        self.text().map(str::to_owned).or_else(|| self.wrong_type("a string"))
    }

    /// Reads `true` or `false`.
    pub fn boolean(&self) -> Option<bool> {
        self.value.get_ref().as_bool().or_else(|| self.wrong_type("true or false"))
    }

    /// Reads one of a few words.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let word = self.string()?;
        if let Some((_, value)) = choices.iter().find(|(name, _)| *name == word) {
            return Some(*value);
        }
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        let message = format!("`{}` cannot be `{}`", self.key, word.escape_debug());
        let quoted = names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(" or ");
        let mistake = Diagnostic::new(self.span(), message).label(format!("expected {quoted}"));
        self.document.fail(mistake.help(suggestion(self.document.mistakes(), &word, &names, "choices")))
    }

    /// Reads a table.
    pub fn section(&self) -> Option<Section<'d>> {
        self.as_table().or_else(|| self.wrong_type("a table"))
    }

    /// Reads a table; mistakes call it by `name`.
    pub fn named(&self, name: impl Into<String>) -> Option<Section<'d>> {
        Some(Section { name: name.into(), ..self.section()? })
    }

    /// Reads a table with these keys; mistakes call it by `name`.
    pub fn table(&self, name: impl Into<String>, keys: &[&Keys]) -> Option<Section<'d>> {
        let section = self.named(name)?;
        section.check_keys(keys);
        Some(section)
    }

    /// Reads an array, whose entries become items of the same key.
    pub fn array(&self, expected: &str) -> Option<Vec<Item<'d>>> {
        self.is_list().then(|| self.list()).or_else(|| self.wrong_type(expected))
    }

    /// Reads an array of tables, `[[key]]`. A single table `[key]` is a mistake of its own.
    pub fn array_of_tables(&self, key: &str) -> Option<Vec<Item<'d>>> {
        if self.is_table() {
            let message = format!("`{}` must be an array of tables, not a single table", self.key);
            let mistake = Diagnostic::new(self.span(), message).label("a single table");
            return self.document.fail(mistake.help(format!("write `[[{key}]]` instead of `[{key}]`")));
        }
        self.array(&format!("an array of tables [[{key}]]"))
    }

    /// Reads an array of exactly `N` entries.
    pub fn entries<const N: usize>(&self, expected: &str) -> Option<[Item<'d>; N]> {
        let entries = self.array(expected)?;
        let count = entries.len();
        entries.try_into().ok().or_else(|| {
            let message = format!("`{}` must be {expected}; this has {count}", self.key);
            let help = format!("write {expected} in brackets");
            let mistake = Diagnostic::new(self.span(), message);
            self.document.fail(mistake.label(format!("expected {N} entries, found {count}")).help(help))
        })
    }

    /// Records a diagnostic and returns `None` if there are more than `most` of something.
    pub fn at_most(&self, count: usize, most: usize, what: &str, help: &str) -> Option<()> {
        if count > most {
            let message = format!("too many {what}: found {count}, the maximum is {most}");
            self.document.mistake(Diagnostic::new(self.key_span.clone(), message).help(help));
        }
        (count <= most).then_some(())
    }

    /// Reads a string with its location in the file.
    pub(crate) fn located_text(&self) -> Option<LocatedText<'d>> {
        let Some(text) = self.text() else { return self.wrong_type("a string") };
        let span = self.span();
        let raw = &self.document.text[span.clone()];
        // Quotes precede the text; a text with escapes differs from the file.
        let place = match raw.find(text) {
            Some(offset) if !text.is_empty() && offset <= 4 => TextLocation::Exact(span.start + offset),
            _ => TextLocation::Within(span),
        };
        Some(LocatedText { text, place })
    }

    /// Reads a number, or an expression in a string.
    pub fn expression(&self, scope: &Scope, entry: Entry<'_>) -> Option<Expression> {
        let span = self.span();
        let (text, place) = match self.value.get_ref() {
            DeValue::String(_) => {
                let located = self.located_text()?;
                if located.text.trim().is_empty() {
                    let message = format!("{} is missing", entry.what);
                    let mistake = Diagnostic::new(span, message).label("this is empty");
                    return self.document.fail(mistake.help("write 0 if it is zero"));
                }
                return parse_expression(&located, scope, entry, &mut self.document.found.borrow_mut());
            }
            DeValue::Integer(number) => (number.to_string(), span.clone()),
            DeValue::Float(number) => (number.to_string(), span.clone()),
            _ => return self.wrong_type("a number or an expression in quotes"),
        };
        let value = match text.parse::<f64>() {
            Ok(value) if value.abs() <= LARGEST_NUMBER => Some(value),
            Ok(value) => {
                let what = match value {
                    _ if value.is_nan() => "NaN",
                    _ if value.is_infinite() => "infinite or larger than 1.8e308",
                    _ => "larger than 1e150",
                };
                let message = format!("{} cannot be {what}", entry.what);
                let mistake = Diagnostic::new(span.clone(), message).label("expected a finite number");
                self.document.fail(mistake.help("leave the entry out if there is no limit"))
            }
            Err(_) => self.refuse("expected a decimal number", "write `255`, not `0xff`"),
        };
        let dimension = entry.dimension.unwrap_or(Dimension::NONE);
        if !dimension.takes_bare(value?) {
            let message = format!("{} must be {dimension}, not a number without a unit", entry.what);
            let units = dimension.units(scope.length.symbol());
            let texts = units.iter().map(|unit| format!("`\"{text} {unit}\"`")).collect::<Vec<_>>();
            let help = format!("add its unit, in quotes: {}", texts.join(" or "));
            return self.document.fail(Diagnostic::new(span, message).label("this has no unit").help(help));
        }
        Some(Expression::number(value?, dimension, place))
    }

    /// Reads a constant: its value in coherent units and its dimension.
    pub fn constant(&self, scope: &Scope, entry: Entry<'_>) -> Option<(f64, Dimension)> {
        let expression = self.expression(scope, entry)?;
        expression.constant().zip(expression.whole().dimension)
    }

    /// Reads a constant of this dimension in coherent units, whose bare lengths are in
    /// [`Document::length`].
    pub fn quantity(&self, dimension: Dimension) -> Option<f64> {
        self.amount(&Scope::new(self.document.length), dimension, &format!("`{}`", self.key))
    }

    /// Reads a constant of this dimension in coherent units; mistakes call it `what`.
    pub fn amount(&self, scope: &Scope, dimension: Dimension, what: &str) -> Option<f64> {
        let entry = Entry { dimension: Some(dimension), what, names: Allowed::Nothing };
        self.constant(scope, entry).map(|(value, _)| value)
    }

    /// Reads an array of `N` such constants.
    pub fn quantities<const N: usize>(&self, expected: &str, dimension: Dimension) -> Option<[f64; N]> {
        let entries: [Item<'_>; N] = self.entries(expected)?;
        let values = entries.map(|item| item.quantity(dimension));
        values.into_iter().collect::<Option<Vec<f64>>>()?.try_into().ok()
    }
}

/// Help for a line that is not TOML.
const TOML: &str = "expected TOML: `key = value`, `[table]`";

/// Returns the location of the number around a comma, and what to write for it.
fn with_point(text: &str, comma: usize) -> Option<(Span, String)> {
    let [before, after] = [text.get(..comma)?, text.get(comma + 1..)?];
    let is_digit = |c: char| c.is_ascii_digit();
    let whole = &before[before.trim_end_matches(is_digit).len()..];
    let part = &after[..after.len() - after.trim_start_matches(is_digit).len()];
    let span = comma - whole.len()..comma + 1 + part.len();
    (!whole.is_empty() && !part.is_empty()).then(|| (span, decimal(whole, part)))
}

/// Keys that every table may have for human readers only.
const TEXTS: [&str; 2] = ["description", "reference"];

/// A table of the file.
#[derive(Clone, Debug)]
pub struct Section<'d> {
    table: &'d DeTable<'d>,
    /// Location of the table's name.
    pub span: Span,
    /// Name of the table.
    pub name: String,
    is_root: bool,
    /// Document that it is of.
    pub document: &'d Document,
}

impl<'d> Section<'d> {
    /// Creates the section of the whole file.
    pub fn root(table: &'d Spanned<DeTable<'d>>, document: &'d Document) -> Self {
        Self { table: table.get_ref(), span: 0..0, name: "this file".to_owned(), is_root: true, document }
    }

    /// Records a mistake of the whole table with its help, and returns none.
    pub fn refuse<T>(&self, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.document.refuse(self.span.clone(), message, help)
    }

    /// Iterates over all items, in order.
    pub fn items(&self) -> impl Iterator<Item = Item<'d>> + use<'d> {
        let document = self.document;
        self.table.iter().map(move |entry| Item::new(entry, document))
    }

    /// Returns the item of a key.
    pub fn get(&self, key: &str) -> Option<Item<'d>> {
        self.table.get_key_value(key).map(|entry| Item::new(entry, self.document))
    }

    /// Returns the item of a key, or records that it is missing.
    pub fn required(&self, key: &str) -> Option<Item<'d>> {
        let form = if self.is_root { format!("a table `[{key}]`") } else { format!("`{key} = …`") };
        self.required_as(key, &form)
    }

    /// Returns the item of a key for an array of tables, or records that it is missing.
    pub fn required_list(&self, key: &str) -> Option<Item<'d>> {
        self.required_as(key, &format!("a table `[[{key}]]` for each"))
    }

    /// Returns the item of a key, or records that it is missing; `form` is what to add.
    pub(crate) fn required_as(&self, key: &str, form: &str) -> Option<Item<'d>> {
        self.get(key).or_else(|| {
            let mistake = Diagnostic::new(self.span.clone(), self.missing(key));
            self.document.fail(mistake.label(format!("`{key}` belongs here")).help(format!("add {form}")))
        })
    }

    fn missing(&self, key: &str) -> String {
        format!("`{key}` is missing in {}", self.name)
    }

    /// Returns the text of a key on one line; empty if there is none. A value that is no string is
    /// a mistake, which for `description` and `reference` [`check_keys`](Self::check_keys) records.
    pub fn optional_text(&self, key: &str) -> String {
        let item = self.get(key).filter(|item| item.is_text() || !TEXTS.contains(&key));
        let text = item.and_then(|item| item.string()).unwrap_or_default();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Returns the tables of a list `[[key]]`; none without it, or if there are more than `most`,
    /// which is a mistake.
    pub(crate) fn tables(&self, key: &str, most: usize, help: &str) -> Vec<Item<'d>> {
        let items = self.get(key).and_then(|item| {
            let items = item.array_of_tables(key)?;
            item.at_most(items.len(), most, &format!("{key}s"), help).map(|()| items)
        });
        items.unwrap_or_default()
    }

    /// Returns the section of a key; `None` without it, or if it has more than `most` entries,
    /// which is a mistake.
    pub(crate) fn section(&self, key: &str, most: usize, help: &str) -> Option<Self> {
        let item = self.get(key)?;
        let section = item.section()?;
        item.at_most(section.items().count(), most, key, help).map(|()| section)
    }

    /// Records every unknown key with the most similar known one, and every `description` or
    /// `reference` that is no string.
    pub fn check_keys(&self, known: &[&Keys]) {
        let names: Vec<&str> = known.iter().flat_map(|keys| keys.names()).collect();
        self.check_names(&names);
    }

    /// Records the mistakes of [`check_keys`](Self::check_keys), for keys with these names.
    pub fn check_names(&self, names: &[&str]) {
        let (known, unknown): (Vec<_>, Vec<_>) =
            self.items().partition(|item| names.contains(&item.key.as_str()));
        for item in known.iter().filter(|item| TEXTS.contains(&item.key.as_str())) {
            item.string();
        }
        for item in unknown {
            let message = format!("there is no key `{}` in {}", item.key.escape_debug(), self.name);
            let help = suggestion(self.document.mistakes(), &item.key, names, "known keys");
            self.document
                .mistake(Diagnostic::new(item.key_span.clone(), message).label("unknown key").help(help));
            // A misspelled key is not reported as missing as well.
            let near = nearest_after(self.document.mistakes() - 1, &item.key, names.iter().copied());
            if let Some(meant) = near.filter(|meant| self.get(meant).is_none()) {
                self.document.meant.borrow_mut().insert((self.span.clone(), self.missing(meant)));
            }
        }
    }
}

fn with_article(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
    format!("{article} {name}")
}
