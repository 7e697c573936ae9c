//! Configurations at which Euler angles are singular: they have no orientation rows.

use abbe::analysis::Measurand;

use super::report::Report;

impl Report {
    /// Returns the number of configurations at which the rows of a measurand exist.
    pub fn configurations_of(&self, measurand: Measurand) -> usize {
        match measurand {
            Measurand::Position => self.configurations,
            Measurand::Orientation => self.orientation.configurations,
        }
    }

    /// Returns the number of reached configurations at which Euler angles are singular: they count
    /// for the position alone.
    pub fn singular(&self) -> usize {
        self.configurations - self.orientation.configurations
    }
}
