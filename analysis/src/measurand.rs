//! Measurands: the position of the tool point, and the orientation of the tool.

/// Half of the rows of ΔX.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measurand {
    /// Rows 1–3: position of the tool point in `F_0`, in the length unit.
    Position,
    /// Rows 4–6: orientation as the manipulator's [`Orientation`](abbe_core::Orientation) says, in
    /// rad.
    Orientation,
}

impl Measurand {
    /// Position and orientation, in the order of the rows.
    pub const ALL: [Self; 2] = [Self::Position, Self::Orientation];

    /// Returns the index of the first row, from 0.
    pub const fn first(self) -> usize {
        match self {
            Self::Position => 0,
            Self::Orientation => 3,
        }
    }

    /// Returns the rows of a deviation.
    pub const fn rows(self, deviation: &[f64; 6]) -> [f64; 3] {
        let first = self.first();
        [deviation[first], deviation[first + 1], deviation[first + 2]]
    }
}
