//! Versions of the Functional Mock-up Interface.

/// A version of the Functional Mock-up Interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fmi {
    /// 2.0.
    Two,
    /// 3.0.
    Three,
}

impl Fmi {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Two, Self::Three];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Two => "2",
            Self::Three => "3",
        }
    }

    /// Its functions.
    pub(super) fn source(self) -> (&'static str, &'static str) {
        match self {
            Self::Two => ("fmi-2.c", include_str!("fmi-2.c")),
            Self::Three => ("fmi-3.c", include_str!("fmi-3.c")),
        }
    }
}
