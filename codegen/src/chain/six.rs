//! Conversion between six values in the order of ε and two vectors.

use abbe_core::Component;
use abbe_spec::expr::{Motion, motion};

use crate::graph::{Node, Vector};

/// Splits six values in the order of ε into translation and rotation, each x y z.
pub(super) fn vectors(six: [Node; 6]) -> (Vector, Vector) {
    let (mut shift, mut turn) = ([six[0]; 3], [six[0]; 3]);
    for (component, node) in Component::ALL.into_iter().zip(six) {
        match motion(component) {
            (Motion::Translation, axis) => shift[axis] = node,
            (Motion::Rotation, axis) => turn[axis] = node,
        }
    }
    (shift, turn)
}

/// Combines translation and rotation to six values in the order of ε.
pub(super) fn six(shift: Vector, turn: Vector) -> [Node; 6] {
    Component::ALL.map(|component| match motion(component) {
        (Motion::Translation, axis) => shift[axis],
        (Motion::Rotation, axis) => turn[axis],
    })
}
