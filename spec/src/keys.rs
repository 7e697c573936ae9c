//! Tables of input files and their keys: the facts that the readers, the JSON Schemas and
//! `docs/reference` share.

/// Keys that belong together, in one table or in several.
#[derive(Debug)]
pub struct Keys {
    /// Headers of the tables with these keys; `NAME` is a user's name, and `the file` stands for
    /// keys before any table.
    pub tables: &'static [&'static str],
    /// The keys.
    pub keys: &'static [Key],
}

/// Key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Name of the key.
    pub name: &'static str,
    /// Kind of its value.
    pub value: Value,
    /// Unit of a number without one; `-` for a value that is no number.
    pub unit: &'static str,
    /// Value without the key; begins with `required` if there is none.
    pub default: &'static str,
    /// Description for users, without a full stop.
    pub what: &'static str,
}

/// Kind of a value. The phrase of a variant is what users read.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    /// A string.
    Text(&'static str),
    /// A number, or a quantity or expression in quotes.
    Number(&'static str),
    /// A whole number, from the least to the largest.
    Whole(u32, Option<u32>),
    /// `true` or `false`.
    Boolean,
    /// One of a few words.
    Choice(fn() -> Vec<&'static str>),
    /// A list with this many entries; any number of them if `None`.
    List(&'static str, Option<usize>, &'static Value),
    /// The table with this header.
    Table(&'static str),
    /// An array of the tables with this header.
    Tables(&'static str),
    /// The table with this header, which may also have names of the user.
    Open(&'static str, &'static Value),
    /// A table of names of the user.
    Names(&'static str, &'static Value),
    /// One of several forms.
    Either(&'static str, &'static [Value]),
}

/// Relation between keys of one table, which holds for every valid file.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Header of the table.
    pub table: &'static str,
    /// Condition.
    pub when: When,
    /// Consequence.
    pub then: Then,
}

/// Condition of a [`Rule`]. A path such as `data.uncertainty` leads into a table.
#[derive(Clone, Debug)]
pub enum When {
    /// Holds always.
    Always,
    /// The key is present.
    Has(&'static str),
    /// None of these keys is present.
    Lacks(Vec<&'static str>),
    /// The key has this word.
    Is(&'static str, &'static str),
}

/// Consequence of a [`Rule`]. A path such as `instrument[].uncertainty` leads into each table of an
/// array.
#[derive(Clone, Debug)]
pub enum Then {
    /// These keys are required.
    Needs(Vec<&'static str>),
    /// At least one of these keys is required.
    NeedsOne(Vec<&'static str>),
    /// These keys are unknown.
    Refuses(Vec<&'static str>),
}

impl Keys {
    /// Returns `true` if `key` is one of them.
    pub fn contain(&self, key: &str) -> bool {
        self.names().any(|name| name == key)
    }

    /// Iterates over the names.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.keys.iter().map(|key| key.name)
    }
}

impl Value {
    /// Returns the kind of value as users read it.
    pub fn phrase(&self) -> String {
        match self {
            Self::Text(phrase)
            | Self::Number(phrase)
            | Self::List(phrase, ..)
            | Self::Names(phrase, _)
            | Self::Either(phrase, _) => (*phrase).to_owned(),
            Self::Whole(least, None) => format!("whole number from {least}"),
            Self::Whole(least, Some(most)) => format!("whole number from {least} to {most}"),
            Self::Boolean => "`true` or `false`".to_owned(),
            Self::Choice(words) => {
                let quoted: Vec<String> = words().iter().map(|word| format!("`\"{word}\"`")).collect();
                match &quoted[..] {
                    [before @ .., last] if !before.is_empty() => format!("{} or {last}", before.join(", ")),
                    _ => quoted.concat(),
                }
            }
            Self::Table(_) | Self::Open(..) => "table".to_owned(),
            Self::Tables(header) => format!("`{header}` tables"),
        }
    }
}

/// Returns the words of a table of choices.
pub fn words<T>(choices: &[(&'static str, T)]) -> Vec<&'static str> {
    choices.iter().map(|(word, _)| *word).collect()
}

/// Defines the tables of a file: a constant for the keys of each, and `TABLES` with all of them.
#[macro_export]
macro_rules! tables {
    ($($table:ident: $headers:expr, [
        $($name:literal: $value:expr, $unit:literal, $default:literal, $what:literal;)*
    ])*) => {
        $(pub(crate) const $table: $crate::keys::Keys = $crate::keys::Keys {
            tables: &$headers,
            keys: &[$($crate::keys::Key {
                name: $name, value: $value, unit: $unit, default: $default, what: $what,
            }),*],
        };)*

        /// Every table of the file.
        pub const TABLES: &[$crate::keys::Keys] = &[$($table),*];
    };
}
