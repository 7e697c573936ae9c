//! What all sources do together over the workspace.

use super::Row;
use super::sampling::norm;
use super::single::position;

/// The largest value over the workspace, and where.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// The value, in the length unit; 0 for an empty workspace.
    pub value: f64,
    /// Index of its configuration; none for an empty workspace.
    pub configuration: Option<usize>,
}

impl Extreme {
    fn add(&mut self, index: usize, value: f64) {
        if self.configuration.is_none() || value > self.value {
            *self = Self { value, configuration: Some(index) };
        }
    }
}

/// What all sources do together over the workspace: repeatable ones are summed with their signs, the bounds of
/// random ones combine as root sum of squares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combined {
    /// max ‖Σ repeatable‖.
    pub repeatable_radius: Extreme,
    /// max ‖RSS random‖.
    pub random_radius: Extreme,
    /// max over the configurations of ‖Σ repeatable‖ + ‖RSS random‖.
    pub radius: Extreme,
    /// The largest \|Σ repeatable\| along x, y, z of `F_0`.
    pub repeatable: [f64; 3],
    /// The largest root sum of squares along x, y, z of `F_0`.
    pub random: [f64; 3],
}

impl Combined {
    pub(super) fn add(&mut self, row: &Row) {
        let (repeatable, random) = (position(&row.repeatable), position(&row.random));
        self.repeatable_radius.add(row.index, norm(repeatable));
        self.random_radius.add(row.index, norm(random));
        self.radius.add(row.index, norm(repeatable) + norm(random));
        for i in 0..3 {
            self.repeatable[i] = self.repeatable[i].max(repeatable[i].abs());
            self.random[i] = self.random[i].max(random[i]);
        }
    }
}
