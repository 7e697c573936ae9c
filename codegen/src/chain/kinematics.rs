//! Kinematics of frames, which a chain and a tree of frames have in forms of their own.

use abbe_core::Class;
use abbe_spec::{Spec, Symbol};

use super::Rows;
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// Kinematics of frames, from which all nodes are built in the order of the methods.
pub(crate) trait Kinematics {
    /// Returns the poses of the frames and of the tool point in `F_0`.
    fn poses(&self) -> (&[Frame], Frame);

    /// Returns the six columns of `J_e` of each frame, and for each frame its entries that are
    /// neither zero nor repeated.
    fn errors(&mut self, graph: &mut Graph, rows: &Rows) -> (Vec<Six>, Vec<Vec<Node>>);

    /// Returns the velocity of the tool point and the rotation per unit of each symbol.
    fn twists(&self, graph: &mut Graph, symbols: &[Symbol]) -> Vec<[Vector; 2]>;

    /// Prepares sums over the frames, and returns the margin of their rows, if it is another node.
    fn prepare_sums(&mut self, graph: &mut Graph, spec: &Spec) -> Option<Option<Node>>;

    /// Returns `J_e ε`, summed over the frames.
    fn displacement(&self, graph: &mut Graph, rows: &Rows, errors: &[Six]) -> Six;

    /// Returns the columns of `J_e diag(σ²) J_eᵀ`.
    fn covariance(&self, graph: &mut Graph, columns: &[Six], variances: &[Six]) -> Vec<Six>;
}

/// Returns the magnitudes that select the repeatable sources, and the symbols of all.
pub(crate) fn magnitudes(graph: &mut Graph, spec: &Spec) -> [Vec<Node>; 2] {
    let (one, zero) = (graph.constant(1.0), graph.zero());
    [
        of_repeatable(spec, one, zero),
        (0..spec.enabled_sources().count()).map(|i| graph.symbol(Symbol::Magnitude(i))).collect(),
    ]
}

/// Returns the magnitudes of the sources: `share` of the repeatable ones, `zero` of the others.
pub(super) fn of_repeatable(spec: &Spec, share: Node, zero: Node) -> Vec<Node> {
    let of = |class| if class == Class::Repeatable { share } else { zero };
    spec.enabled_sources().map(|source| of(source.class)).collect()
}

/// Returns the symbols of the variables and of the parameters.
pub(crate) fn symbols(spec: &Spec) -> [Vec<Symbol>; 2] {
    [
        (0..spec.variables.len()).map(Symbol::Variable).collect(),
        (0..spec.parameters.len()).map(Symbol::Parameter).collect(),
    ]
}
