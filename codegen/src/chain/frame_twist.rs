//! Twist of a frame.

use crate::graph::Vector;

/// Velocity and rotation per unit of a number of the chain, in the axes of a frame.
#[derive(Clone, Copy, Debug)]
pub struct FrameTwist {
    /// The frame, from 0.
    pub frame: usize,
    /// Velocity of the frame's origin.
    pub velocity: Vector,
    /// Rotation about the frame's axes.
    pub rotation: Vector,
}
