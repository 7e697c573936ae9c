//! Periodic joints: a node that contains an angle only in sines and cosines has the period 2π.

use std::f64::consts::TAU;

use abbe_codegen::graph::{Graph, Node, Op};
use abbe_spec::expr::{Function, Symbol};

/// Dependence of a node on an angle.
#[derive(Clone, Copy, PartialEq)]
enum Dependence {
    None,
    /// The angle or its negative, plus terms that do not depend on it.
    Angle,
    /// Sines and cosines of such a sum only.
    Turned,
    Other,
}

/// Returns `true` if a node is periodic in a symbol with the period 2π.
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

/// Cuts a range to one turn, plus a margin for rounding.
pub(crate) fn once_around([low, high]: [f64; 2]) -> [f64; 2] {
    [low, high.min((low + TAU).next_up().next_up())]
}
