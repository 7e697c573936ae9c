//! Recognizes frames that are lower pairs: a rotation about a fixed axis, or a translation along
//! one, by their own variable only and with slope ±1.

use abbe_core::VariableKind;
use abbe_spec::expr::{Elementary, Expression, Motion, Symbol};
use abbe_spec::{Factor, Frame, Spec};

use crate::graph::{Graph, Node};

/// Returns, for every frame, whether it is a lower pair or fixed; for the last frame the tool must
/// be fixed as well.
///
/// The proof is symbolic: derivatives that are the constants ±1, and for a matrix `y‴ = −y′` (a
/// constant, a sine and a cosine only) or `y″ = 0` for every entry. A frame for which the proof
/// fails counts as no lower pair.
pub(crate) fn lower_pairs(spec: &Spec) -> Vec<bool> {
    let moves = |factor: &Factor| {
        let variable = |symbol| matches!(symbol, Symbol::Variable(_));
        factor.expressions().iter().any(|amount| amount.symbols().any(variable))
    };
    let fixed_tool = !spec.tool.iter().any(moves);
    let pair = |(i, frame): (usize, &Frame)| {
        let moving: Vec<&Factor> = frame.factors.iter().filter(|factor| moves(factor)).collect();
        let pair = match (&moving[..], frame.variable) {
            ([], None) => true,
            ([factor], Some(own)) => is_pair(factor, own, spec.variables[own].kind, spec),
            _ => false,
        };
        pair && (fixed_tool || i + 1 < spec.frames.len())
    };
    spec.frames.iter().enumerate().map(pair).collect()
}

fn is_pair(factor: &Factor, own: usize, kind: VariableKind, spec: &Spec) -> bool {
    let alone = |amount: &&Expression| {
        amount.symbols().all(|symbol| !matches!(symbol, Symbol::Variable(i) if i != own))
    };
    if !factor.expressions().iter().all(alone) {
        return false;
    }
    let mut graph = Graph::with_tables(&spec.tables);
    let symbol = Symbol::Variable(own);
    match factor {
        Factor::Elementary(Elementary { motion, amount, .. }) | Factor::About { motion, amount, .. } => {
            let amount = graph.lower(amount);
            let slope = graph.diff(amount, symbol);
            let expected = kind.either(Motion::Rotation, Motion::Translation);
            *motion == expected && graph.value(slope).is_some_and(|slope| slope.abs() == 1.0)
        }
        Factor::Matrix(matrix) => matrix.rows.iter().flatten().all(|entry| {
            let entry = graph.lower(entry);
            let first = graph.diff(entry, symbol);
            let second = graph.diff(first, symbol);
            match kind {
                VariableKind::Prismatic => is_zero(&graph, second),
                VariableKind::Revolute => {
                    let third = graph.diff(second, symbol);
                    let sum = graph.add(third, first);
                    is_zero(&graph, sum)
                }
            }
        }),
    }
}

fn is_zero(graph: &Graph, node: Node) -> bool {
    graph.value(node) == Some(0.0)
}

#[cfg(test)]
mod tests;
