//! Loads on beams and compliances.

use crate::expr::Expression;

/// A load on the structure: the weight of a mass, a force, a moment.
#[derive(Clone, Debug)]
pub struct Load {
    /// Mass, whose weight acts under gravity.
    pub mass: Option<Expression>,
    /// Force along x, y and z.
    pub force: Option<[Expression; 3]>,
    /// Moment about x, y and z.
    pub moment: Option<[Expression; 3]>,
    /// Axes in which force and moment are given.
    pub axes: Axes,
    /// Index of the frame that the load is fixed to, from 0.
    pub frame: usize,
    /// Point of application.
    pub point: Point,
}

/// The axes of a force or moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Axes of the load's frame: the force rotates with it.
    Frame,
    /// Axes of `F_0`.
    Base,
}

/// Point of application of a load.
#[derive(Clone, Debug)]
pub enum Point {
    /// Position relative to the frame.
    Here([Expression; 3]),
    /// The tool point; the frame is the one that carries the tool.
    Tool,
}
