//! Result of jobs, and of reading their input.

use std::fmt::Display;

use abbe::Remedy;
use abbe_spec::{Diagnostics, mistake};

/// A result whose error, unless another one is named, is [`Diagnostics`]: it names the file or
/// option, and the place.
pub type Result<T, E = Diagnostics> = std::result::Result<T, E>;

/// Says which file or option an error concerns.
pub trait About<T> {
    /// Returns the value, or the diagnostics of the error, which concerns `subject` as a whole.
    fn about(self, subject: impl Display) -> Result<T>;
}

impl<T, E: Remedy> About<T> for Result<T, E> {
    fn about(self, subject: impl Display) -> Result<T> {
        self.map_err(|error| mistake::whole(subject, &error))
    }
}
