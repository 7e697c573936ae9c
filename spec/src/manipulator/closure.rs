//! Loops of frames, and the conditions under which they close.

use crate::diagnostic::Span;
use crate::expr::Expression;

/// A loop: a condition on two frames that the machine always meets, with errors too.
#[derive(Clone, Debug)]
pub struct Loop {
    /// Name of the loop.
    pub name: String,
    /// The two frames, from 0; `None` is `F_0`.
    pub frames: [Option<usize>; 2],
    /// The condition.
    pub closure: Closure,
    /// Location of the name in the file.
    pub span: Span,
}

/// Condition on the two frames of a loop.
#[derive(Clone, Debug)]
pub enum Closure {
    /// Coordinates of the first frame's pose relative to the second's that are zero, ascending: 0
    /// to 2 the position along x, y, z, 3 to 5 the rotation about x, y, z, in the axes of the frame
    /// that the second one hangs on.
    Coordinates(Vec<usize>),
    /// Distance between the origins of the two frames.
    Distance(Expression),
}

impl Closure {
    /// Names of the six coordinates.
    pub const COORDINATES: [&'static str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

    /// Returns the distance; `None` for coordinates.
    pub fn length(&self) -> Option<&Expression> {
        match self {
            Self::Distance(length) => Some(length),
            Self::Coordinates(_) => None,
        }
    }

    /// Returns the name of the coordinate of an equation, or `distance`.
    pub fn coordinate(&self, equation: usize) -> &'static str {
        match self {
            Self::Coordinates(coordinates) => Self::COORDINATES[coordinates[equation]],
            Self::Distance(_) => "distance",
        }
    }

    /// Returns `true` if an equation is about an angle, `false` if it is about a length.
    pub fn is_angle(&self, equation: usize) -> bool {
        match self {
            Self::Coordinates(coordinates) => coordinates.get(equation).is_some_and(|one| *one >= 3),
            Self::Distance(_) => false,
        }
    }

    /// Returns the number of equations.
    pub fn equations(&self) -> usize {
        match self {
            Self::Coordinates(coordinates) => coordinates.len(),
            Self::Distance(_) => 1,
        }
    }
}
