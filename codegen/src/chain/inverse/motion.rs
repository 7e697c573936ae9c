//! Motion of the tool.

use super::Probes;
use crate::graph::{Frame, Graph, Vector};

/// Motion of the tool from its pose with all joints at zero to the target, or back from there:
/// `exp(S_1 q_1) … exp(S_6 q_6)`.
pub(super) struct Motion {
    pub(super) target: Frame,
    pub(super) tool: Frame,
    pub(super) is_reversed: bool,
}

impl Motion {
    /// Returns a direction behind the motion.
    pub(super) fn turn(&self, g: &mut Graph, v: Vector) -> Vector {
        let [first, last] =
            if self.is_reversed { [self.target, self.tool] } else { [self.tool, self.target] };
        let local = first.axes.map(|axis| g.dot(axis, v));
        g.turn(&last.axes, local)
    }

    /// Returns a direction before the motion.
    pub(super) fn turn_back(&self, g: &mut Graph, v: Vector) -> Vector {
        Self { is_reversed: !self.is_reversed, ..*self }.turn(g, v)
    }

    /// Returns a point behind the motion.
    pub(super) fn point(&self, g: &mut Graph, probes: &Probes, point: Vector) -> Vector {
        let [first, last] =
            if self.is_reversed { [self.target, self.tool] } else { [self.tool, self.target] };
        let away = g.sub_vectors(point, first.position);
        let away = if self.is_reversed { away } else { probes.cleaned_vector(g, away, probes.size) };
        let local = first.axes.map(|axis| g.dot(axis, away));
        let turned = g.turn(&last.axes, local);
        g.add_vectors(last.position, turned)
    }
}
