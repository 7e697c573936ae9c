//! Tables of input files and their keys, as the readers accept them and `docs/reference` documents
//! them.

/// Keys that belong together, in one table or in several.
#[derive(Debug)]
pub struct Keys {
    /// Headers of the tables with these keys; `NAME` is a user's name, and `the file` stands for
    /// keys before any table.
    pub tables: &'static [&'static str],
    /// The keys.
    pub keys: &'static [&'static str],
}

impl Keys {
    /// Returns `true` if `key` is one of them.
    pub fn contain(&self, key: &str) -> bool {
        self.keys.contains(&key)
    }
}

/// Defines the tables of a file: a constant for the keys of each, and `TABLES` with all of them.
#[macro_export]
macro_rules! tables {
    ($($name:ident: $tables:expr, $keys:expr;)*) => {
        $(pub(crate) const $name: $crate::keys::Keys = $crate::keys::Keys { tables: &$tables, keys: &$keys };)*

        /// Every table of the file.
        pub const TABLES: &[$crate::keys::Keys] = &[$($name),*];
    };
}
