//! Joints that come round: a node that has an angle only in sines and cosines is the same after a whole turn.

use std::f64::consts::TAU;

use abbe_codegen::graph::{Graph, Node, Op};
use abbe_spec::expr::{Function, Symbol};

/// How a node depends on an angle.
#[derive(Clone, Copy, PartialEq)]
enum Dependence {
    None,
    /// The angle, or its negative, and what does not depend on it.
    Angle,
    /// Only by sines and cosines of that.
    Turned,
    Other,
}

/// Whether a node is the same after a whole turn of a symbol.
pub(crate) fn is_angle(graph: &Graph, node: Node, symbol: Symbol) -> bool {
    use Dependence::{Angle, None, Other, Turned};
    let mut known: Vec<Dependence> = Vec::with_capacity(node.index() + 1);
    for op in graph.ops().take(node.index() + 1) {
        let mut operands = op.operands().map(|operand| known[operand.index()]);
        let [first, second] = [operands.next().unwrap_or(None), operands.next().unwrap_or(None)];
        known.push(match (op, first, second) {
            (Op::Symbol(other), ..) if other == symbol => Angle,
            (_, None, None) => None,
            (_, None | Turned, None | Turned) => Turned,
            (Op::Neg(_), Angle, _) | (Op::Add(..) | Op::Sub(..), Angle, None) => Angle,
            (Op::Add(..) | Op::Sub(..), None, Angle) => Angle,
            (Op::Call(Function::Sin | Function::Cos, _), Angle, _) => Turned,
            _ => Other,
        });
    }
    known[node.index()] != Dependence::Other && known[node.index()] != Dependence::Angle
}

/// No more than one turn of a range, and a little.
pub(crate) fn once_around([low, high]: [f64; 2]) -> [f64; 2] {
    [low, high.min((low + TAU).next_up().next_up())]
}
