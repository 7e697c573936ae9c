//! Versions of the Functional Mock-up Interface.

/// A version of the Functional Mock-up Interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fmi {
    /// Version 2.0.
    Two,
    /// Version 3.0.
    Three,
}

impl Fmi {
    /// Every version.
    pub const ALL: [Self; 2] = [Self::Two, Self::Three];

    /// Returns the name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Two => "2",
            Self::Three => "3",
        }
    }

    /// Returns the name and text of the C source with its functions.
    pub(super) fn source(self) -> (&'static str, &'static str) {
        match self {
            Self::Two => ("fmi-2.c", include_str!("fmi-2.c")),
            Self::Three => ("fmi-3.c", include_str!("fmi-3.c")),
        }
    }
}
