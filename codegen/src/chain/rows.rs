//! Rows 4–6 of a Jacobian from a small rotation.

use abbe_core::Orientation;

use crate::graph::{Graph, Node, Six, Vector};

/// Map from a small rotation ω in `F_0` to rows 4–6.
pub(crate) enum Rows {
    /// The rotation vector ω itself.
    RotationVector,
    /// Changes of three Euler angles.
    Euler(Euler),
}

/// Map to Euler angles, in axes [renamed](Orientation::last_axis) so that the last rotation is
/// about x. With `R_T = R_y(σ) R_z(ρ) R_x(π)`, the first column of `R_T` is `(cos σ cos ρ, sin ρ,
/// −sin σ cos ρ)`, and
///
/// ```text
/// ω = σ̇ ŷ + ρ̇ R_y(σ) ẑ + π̇ R_T x̂
/// π̇ = (r11 ωx + r31 ωz) / cos² ρ      ρ̇ = (r11 ωz − r31 ωx) / cos ρ      σ̇ = ωy − r21 π̇
/// ```
pub(crate) struct Euler {
    /// Axis that is renamed to x.
    axis: usize,
    /// `cos ρ = √(r11² + r31²)`; where it is 0 the rows are undefined. `None` if only the parts are
    /// known.
    margin: Option<Node>,
    /// `(r11, r31) / cos ρ`.
    roll: [Node; 2],
    /// `(r11, r31) / cos² ρ`.
    pitch: [Node; 2],
    /// `R_T x̂ = (r11, r21, r31)`, with `r21 = sin ρ`.
    first_axis: Vector,
}

impl Rows {
    /// Creates the map; `last_axis` is the axis of the tool about which the last of the Euler
    /// angles turns, in `F_0`. A rotation vector does not need it.
    pub(crate) fn new(graph: &mut Graph, orientation: Orientation, last_axis: Vector) -> Self {
        let Some(axis) = orientation.last_axis() else { return Self::RotationVector };
        let first_axis = renamed(axis, last_axis);
        let [r11, _, r31] = first_axis;
        let (first, second) = (graph.mul(r11, r11), graph.mul(r31, r31));
        let square = graph.add(first, second);
        let margin = graph.sqrt(square);
        graph.propose(margin, || ["cos_roll", "cos_pitch"][axis].to_owned());
        let one = graph.constant(1.0);
        let inverse = graph.div(one, margin);
        let roll = [r11, r31].map(|entry| graph.mul(entry, inverse));
        let pitch = roll.map(|entry| graph.mul(entry, inverse));
        Self::Euler(Euler { axis, margin: Some(margin), roll, pitch, first_axis })
    }

    /// Number of nodes that represent the map to Euler angles.
    pub(crate) const PARTS: usize = 7;

    /// Returns the nodes that represent the map; empty for a rotation vector.
    pub(crate) fn parts(&self) -> Vec<Node> {
        match self {
            Self::RotationVector => Vec::new(),
            Self::Euler(Euler { roll, pitch, first_axis, .. }) => [&roll[..], pitch, first_axis].concat(),
        }
    }

    /// Rebuilds the map to Euler angles from its parts, without the margin.
    pub(crate) fn from_parts(axis: usize, parts: &[Node]) -> Self {
        let (roll, pitch) = ([parts[0], parts[1]], [parts[2], parts[3]]);
        let first_axis = [parts[4], parts[5], parts[6]];
        Self::Euler(Euler { axis, margin: None, roll, pitch, first_axis })
    }

    /// Returns `cos ρ` if the rows are Euler angles.
    pub(crate) fn margin(&self) -> Option<Node> {
        match self {
            Self::RotationVector => None,
            Self::Euler(euler) => euler.margin,
        }
    }

    pub(super) fn orientation_rows(&self, graph: &mut Graph, omega: Vector) -> [Node; 3] {
        let Self::Euler(Euler { axis, roll, pitch, first_axis, .. }) = self else { return omega };
        let omega = renamed(*axis, omega);
        // A rotation about R_T x̂ changes the pitch only.
        let (zero, minus) = (graph.zero(), graph.neg_vector(omega));
        for (turn, pitch) in [(omega, 1.0), (minus, -1.0)] {
            if turn == *first_axis {
                return [zero, zero, graph.constant(pitch)];
            }
        }
        let [x, y, z] = omega;
        let (first, second) = (graph.mul(pitch[0], x), graph.mul(pitch[1], z));
        let pitch = graph.add(first, second);
        let (first, second) = (graph.mul(roll[0], z), graph.mul(roll[1], x));
        let roll = graph.sub(first, second);
        [graph.sub_product(y, first_axis[1], pitch), roll, pitch]
    }

    /// Returns a column from the velocity of the tool point and the rotation ω.
    pub(crate) fn column(&self, graph: &mut Graph, velocity: Vector, omega: Vector) -> Six {
        let [x, y, z] = velocity;
        let [four, five, six] = self.orientation_rows(graph, omega);
        [x, y, z, four, five, six]
    }
}

/// Returns the components along the axes that follow `axis` in cyclic order, itself first.
fn renamed(axis: usize, vector: Vector) -> Vector {
    std::array::from_fn(|i| vector[(axis + i) % 3])
}
