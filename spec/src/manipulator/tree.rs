//! Frames that hang on each other, and the loops between them.
//!
//! Loops of frames, and the conditions under which they close.

use super::Frame;
use crate::diagnostic::Span;
use crate::expr::{Expression, Symbol};

/// A tree of frames with its loops.
#[derive(Clone, Copy, Debug)]
pub struct Tree<'s> {
    /// All frames, each after the one that it hangs on.
    pub frames: &'s [Frame],
    /// Loops between them.
    pub loops: &'s [Loop],
    /// Index of the frame that carries the tool.
    pub tool_frame: usize,
}

impl Tree<'_> {
    /// Returns `true` if the frames are a chain from the base to the tool, without loops.
    pub fn is_serial(self) -> bool {
        let follows = |(i, frame): (usize, &Frame)| frame.parent == i.checked_sub(1);
        self.loops.is_empty()
            && self.tool_frame + 1 == self.frames.len()
            && self.frames.iter().enumerate().all(follows)
    }

    /// Returns the frames from `F_0` to a frame, this one last; none for `F_0` itself.
    pub fn path(self, frame: Option<usize>) -> Vec<usize> {
        let mut path: Vec<usize> = std::iter::successors(frame, |frame| self.frames[*frame].parent).collect();
        path.reverse();
        path
    }

    /// Returns `true` if `other` moves with `frame`: that frame itself, or one that hangs on it.
    pub fn carries(self, frame: usize, other: usize) -> bool {
        std::iter::successors(Some(other), |at| self.frames[*at].parent).any(|at| at == frame)
    }

    /// Returns `true` if a load on `other` may deflect an elastic element at `frame`: it carries
    /// the load, or the forces of a loop, of which one end moves with the frame and the other does
    /// not.
    pub fn is_loaded(self, frame: usize, other: usize) -> bool {
        self.carries(frame, other)
            || self.loops.iter().any(|closed| {
                let [first, second] =
                    closed.frames.map(|end| end.is_some_and(|end| self.carries(frame, end)));
                first != second
            })
    }

    /// Returns the frames whose transforms move one end of a loop relative to the other.
    pub fn between(self, closed: &Loop) -> Vec<usize> {
        let [first, second] = closed.frames.map(|frame| self.path(frame));
        let only = |path: &[usize], other: &[usize]| -> Vec<usize> {
            path.iter().copied().filter(|frame| !other.contains(frame)).collect()
        };
        [only(&first, &second), only(&second, &first)].concat()
    }

    /// Returns the symbols that change a loop: those between its ends, and of its length.
    pub fn symbols(self, closed: &Loop) -> Vec<Symbol> {
        let frames = self.between(closed).into_iter().flat_map(|frame| self.frames[frame].symbols());
        frames.chain(closed.closure.length().into_iter().flat_map(Expression::symbols)).collect()
    }

    /// Returns the end of a loop that belongs to it alone, and −1 for the first frame or 1 for the
    /// second: nothing hangs on it, no other loop ends there, and it does not carry the tool.
    pub fn own_end(self, closed: &Loop) -> Option<(usize, f64)> {
        let is_own = |frame: usize| {
            let uses = self.loops.iter().flat_map(|other| other.frames).filter(|end| *end == Some(frame));
            frame != self.tool_frame
                && uses.count() == 1
                && self.frames.iter().all(|other| other.parent != Some(frame))
        };
        let ends = closed.frames.into_iter().zip([-1.0, 1.0]);
        ends.filter_map(|(frame, sign)| Some((frame?, sign))).find(|(frame, _)| is_own(*frame))
    }
}

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
