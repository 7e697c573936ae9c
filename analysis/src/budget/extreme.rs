//! Largest value over the workspace; of equal ones, that of the first configuration.

use abbe_core::Scalar;

/// Rounds an error to 26 significant bits, by which those of two configurations are compared.
///
/// Errors that differ only by rounding, such as those of a machine that turns about its base, are
/// equal then, and the first configuration counts as the worst on every processor. See Dekker, "A
/// floating-point technique for extending the available precision" (1971), for the split.
#[inline(always)]
pub fn comparable<S: Scalar>(error: S) -> S {
    let scaled = error * S::constant(134_217_729.0);
    scaled - (scaled - error)
}

/// Largest value over the workspace, and the first configuration with a [`comparable`] one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extreme {
    /// Value, in the length unit. 0 for an empty workspace.
    pub value: f64,
    /// Index of the configuration. `None` for an empty workspace.
    pub configuration: Option<usize>,
}

impl Extreme {
    /// Takes in the value at a configuration.
    pub fn add(&mut self, index: usize, value: f64) {
        if self.configuration.is_none() || comparable(value * value) > comparable(self.value * self.value) {
            self.configuration = Some(index);
        }
        self.value = self.value.max(value);
    }

    /// Returns the root of the largest square.
    pub(super) fn root(self) -> Self {
        Self { value: self.value.max(0.0).sqrt(), ..self }
    }

    /// Takes in the largest value of the following configurations.
    pub fn merge(&mut self, other: &Self) {
        other.configuration.into_iter().for_each(|index| self.add(index, other.value));
    }
}
