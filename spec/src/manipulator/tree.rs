//! Frames that hang on each other, and the loops between them.

use super::closure::Loop;
use super::frame::Frame;
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
        let length = closed.closure.length().into_iter().flat_map(Expression::symbols);
        frames.chain(length).collect()
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
