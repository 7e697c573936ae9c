//! Tables of input files and their keys: the facts that the readers, the JSON Schemas and
//! `docs/reference` share.

use std::str::Split;

/// Keys that belong together, in one table or in several.
#[derive(Debug)]
pub struct Keys {
    /// Headers of the tables with these keys; `NAME` is a user's name, and `the file` stands for
    /// keys before any table.
    pub tables: Vec<&'static str>,
    /// The keys.
    pub keys: Vec<Key>,
}

/// Key of a table.
#[derive(Clone, Debug)]
pub struct Key {
    /// Name of the key.
    pub name: &'static str,
    /// Kind of its value.
    pub value: Value,
    /// The kind of value as users read it.
    pub phrase: String,
    /// Unit of a number without one; `-` for a value that is no number.
    pub unit: &'static str,
    /// Value without the key; begins with `required` if there is none.
    pub default: &'static str,
    /// Description for users, without a full stop.
    pub what: &'static str,
}

/// Kind of a value.
#[derive(Clone, Debug)]
pub enum Value {
    /// A string.
    Text,
    /// A number, or a quantity or expression in quotes.
    Number,
    /// A whole number, from the least to the largest.
    Whole(u32, Option<u32>),
    /// `true` or `false`.
    Boolean,
    /// One of a few words.
    Choice(Vec<&'static str>),
    /// A list with this many entries; any number of them if `None`.
    List(Option<usize>, Box<Self>),
    /// The table with this header.
    Table(&'static str),
    /// An array of the tables with this header.
    Tables(&'static str),
    /// The table with this header, which may also have names of the user.
    Open(&'static str, Box<Self>),
    /// A table of names of the user.
    Names(Box<Self>),
    /// One of two forms.
    Either(Box<[Self; 2]>),
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
    /// Reads the keys below the heading `name: TABLE, …` of a file of keys, which has a line for
    /// each: `name | value: phrase | unit | default | description`. `words` returns the words of a
    /// choice by its name.
    ///
    /// # Panics
    ///
    /// If the file is not so written.
    pub fn read(file: &'static str, name: &str, words: fn(&str) -> Vec<&'static str>) -> Self {
        let heading = file.lines().position(|line| line.starts_with(&format!("{name}: ")));
        let mut lines = file.lines().skip(heading.unwrap_or_else(|| panic!("there is no heading {name}")));
        let tables = lines.next().map(|line| line[name.len() + 2..].split(", ").collect());
        let key = |line: &'static str| {
            let [name, value, unit, default, what] = line.split(" | ").collect::<Vec<_>>()[..] else {
                panic!("a key has five cells: {line}")
            };
            let (notation, phrase) = value.split_once(": ").unwrap_or((value, ""));
            let value = Value::read(&mut notation.split(' '), words);
            let phrase = if phrase.is_empty() { value.phrase() } else { phrase.to_owned() };
            Key { name, value, phrase, unit, default, what }
        };
        let keys = lines.take_while(|line| !line.is_empty()).map(key).collect();
        Self { tables: tables.unwrap_or_default(), keys }
    }

    /// Returns `true` if `key` is one of them.
    pub fn contain(&self, key: &str) -> bool {
        self.names().any(|name| name == key)
    }

    /// Iterates over the names.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.keys.iter().map(|key| key.name)
    }
}

impl Value {
    /// Reads the notation of a value: `text`, `number`, `boolean`, `whole 1..9`, `word CHOICE`,
    /// `table HEADER`, `tables HEADER`, and of others `open HEADER of …`, `names of …`, `list of
    /// …`, `3 of …`, `either … or …`.
    fn read(notation: &mut Split<'static, char>, words: fn(&str) -> Vec<&'static str>) -> Self {
        let word = notation.next().unwrap_or_default();
        let mut next = || notation.next().unwrap_or_default();
        match word {
            "text" => Self::Text,
            "number" => Self::Number,
            "boolean" => Self::Boolean,
            "whole" => {
                let (least, most) = next().split_once("..").expect("a range");
                Self::Whole(least.parse().expect("a number"), most.parse().ok())
            }
            "word" => Self::Choice(words(next())),
            "table" => Self::Table(next()),
            "tables" => Self::Tables(next()),
            "either" => {
                let first = Self::read(notation, words);
                assert_eq!(notation.next(), Some("or"), "two forms");
                Self::Either(Box::new([first, Self::read(notation, words)]))
            }
            _ => {
                let header = if word == "open" { next() } else { "" };
                assert_eq!(next(), "of", "{word} is no kind of value");
                let each = Box::new(Self::read(notation, words));
                match word {
                    "open" => Self::Open(header, each),
                    "names" => Self::Names(each),
                    "list" => Self::List(None, each),
                    count => Self::List(Some(count.parse().expect("a number of entries")), each),
                }
            }
        }
    }

    /// Returns the kind of value as users read it, where a file of keys has no phrase.
    fn phrase(&self) -> String {
        match self {
            Self::Text => "text".to_owned(),
            Self::Number => "number".to_owned(),
            Self::Whole(least, None) => format!("whole number from {least}"),
            Self::Whole(least, Some(most)) => format!("whole number from {least} to {most}"),
            Self::Boolean => "`true` or `false`".to_owned(),
            Self::Choice(words) => {
                let quoted: Vec<String> = words.iter().map(|word| format!("`\"{word}\"`")).collect();
                match &quoted[..] {
                    [before @ .., last] if !before.is_empty() => format!("{} or {last}", before.join(", ")),
                    _ => quoted.concat(),
                }
            }
            Self::Tables(header) => format!("`{header}` tables"),
            _ => "table".to_owned(),
        }
    }
}

/// Returns the words of a table of choices.
pub fn words<T>(choices: &[(&'static str, T)]) -> Vec<&'static str> {
    choices.iter().map(|(word, _)| *word).collect()
}

/// Defines the tables of a file of keys: a static for the keys of each, and `tables` with all of
/// them. `words` are tables of choices, `lists` other lists of words.
#[macro_export]
macro_rules! tables {
    ($file:literal, words { $($words:ident)* } lists { $($list:ident: $of:expr,)* } $($table:ident)*) => {
        fn choice(name: &str) -> Vec<&'static str> {
            match name {
                $(stringify!($words) => $crate::keys::words(&$words),)*
                $(stringify!($list) => $of,)*
                _ => panic!("there are no words {name}"),
            }
        }

        $(pub(crate) static $table: std::sync::LazyLock<$crate::keys::Keys> = std::sync::LazyLock::new(|| {
            $crate::keys::Keys::read(include_str!($file), stringify!($table), choice)
        });)*

        /// Returns every table of the file.
        pub fn tables() -> Vec<&'static $crate::keys::Keys> {
            vec![$(&*$table),*]
        }
    };
}
