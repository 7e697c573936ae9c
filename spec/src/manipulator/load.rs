//! Loads: what acts on beams and compliances.

use crate::expr::Expression;

/// What acts on the structure: the weight of a mass, a force, a moment.
#[derive(Clone, Debug)]
pub struct Load {
    /// What weighs under gravity.
    pub mass: Option<Expression>,
    /// A force, along x, y and z.
    pub force: Option<[Expression; 3]>,
    /// A moment, about x, y and z.
    pub moment: Option<[Expression; 3]>,
    /// Whose axes force and moment are in.
    pub axes: Axes,
    /// The frame it moves with, from 0.
    pub frame: usize,
    /// Where it acts.
    pub point: Point,
}

/// The axes of a force or moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Those of its load's frame: it turns with that.
    Frame,
    /// Those of `F_0`.
    Base,
}

/// Where a load acts.
#[derive(Clone, Debug)]
pub enum Point {
    /// Here, as seen from its frame.
    Here([Expression; 3]),
    /// At the tool point; its frame is the last one.
    Tool,
}
