//! The tables of an input file and their keys: what the readers know, and what `docs/reference` has a row for.

/// Keys that stand together, in one table or in several.
#[derive(Debug)]
pub struct Keys {
    /// The tables that have them, as TOML heads them; `NAME` is a name of the user's, `the file` stands before any table.
    pub tables: &'static [&'static str],
    /// The keys.
    pub keys: &'static [&'static str],
}

impl Keys {
    /// Whether `key` is one of them.
    pub fn contain(&self, key: &str) -> bool {
        self.keys.contains(&key)
    }
}

/// The tables of a file: a constant for the keys of each, and `TABLES` with all of them.
#[macro_export]
macro_rules! tables {
    ($($name:ident: $tables:expr, $keys:expr;)*) => {
        $(pub(crate) const $name: $crate::keys::Keys = $crate::keys::Keys { tables: &$tables, keys: &$keys };)*

        /// All of them.
        pub const TABLES: &[$crate::keys::Keys] = &[$($name),*];
    };
}
