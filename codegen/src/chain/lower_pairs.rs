//! Recognizes frames that are lower pairs: a rotation about a fixed axis, or a translation along
//! one, by their own variable only and with slope ±1.

use std::collections::BTreeSet;

use abbe_spec::{Elementary, Expression, Factor, Frame, Motion, Spec, Symbol};

use crate::graph::{Graph, Node};

/// Returns, for every frame, whether it is a lower pair or fixed; for the last frame the tool must
/// be fixed as well.
///
/// The proof is symbolic: derivatives that are the constants ±1, and for a matrix `y‴ = −y′` (a
/// constant, a sine and a cosine only) or `y″ = 0` for every entry. A frame for which the proof
/// fails counts as no lower pair.
pub(crate) fn lower_pairs(spec: &Spec) -> Vec<bool> {
    couplings(spec).into_iter().map(|others| others.is_some_and(|others| others.is_empty())).collect()
}

/// Returns, for every frame, the earlier variables that move it together with its own, as a sum
/// that makes a lower pair of it, each with its share of ±1 per unit of its own: of `Rz(q2 - q3)`,
/// `q2` and −1. `None` is no lower pair even so.
pub(super) fn couplings(spec: &Spec) -> Vec<Option<Vec<(usize, f64)>>> {
    let moves = |factor: &Factor| {
        let variable = |symbol| matches!(symbol, Symbol::Variable(_));
        factor.expressions().iter().any(|amount| amount.symbols().any(variable))
    };
    let fixed_tool = !spec.tool.iter().any(moves);
    let pair = |(i, frame): (usize, &Frame)| {
        let moving: Vec<&Factor> = frame.factors.iter().filter(|factor| moves(factor)).collect();
        let others = match (&moving[..], frame.variable) {
            ([], None) => Some(Vec::new()),
            ([factor], Some(own)) => coupled(factor, own, spec),
            _ => None,
        };
        others.filter(|_| fixed_tool || i + 1 < spec.frames.len())
    };
    spec.frames.iter().enumerate().map(pair).collect()
}

fn coupled(factor: &Factor, own: usize, spec: &Spec) -> Option<Vec<(usize, f64)>> {
    let mut graph = Graph::with_tables(&spec.tables);
    let (symbol, kind) = (Symbol::Variable(own), spec.variables[own].kind);
    let expressions = factor.expressions();
    let symbols = expressions.iter().flat_map(|amount| amount.symbols());
    let variables = symbols.filter_map(|other| if let Symbol::Variable(i) = other { Some(i) } else { None });
    let others: BTreeSet<usize> = variables.filter(|other| *other != own).collect();
    match factor {
        Factor::Elementary(Elementary { motion, amount, .. }) | Factor::About { motion, amount, .. } => {
            let amount = graph.lower(amount);
            let mut slope = |variable: usize| {
                let slope = graph.diff(amount, Symbol::Variable(variable));
                graph.value(slope).filter(|slope| slope.abs() == 1.0)
            };
            let sign = slope(own)?;
            let expected = kind.either(Motion::Rotation, Motion::Translation);
            let mut share = |other: usize| {
                let is_known = other < own && spec.variables[other].kind == kind;
                Some((other, sign * slope(other).filter(|_| is_known)?))
            };
            others.into_iter().map(&mut share).collect::<Option<_>>().filter(|_| *motion == expected)
        }
        Factor::Matrix(matrix) => {
            let mut is_pair = |entry: &Expression| {
                let entry = graph.lower(entry);
                let first = graph.diff(entry, symbol);
                let second = graph.diff(first, symbol);
                let third = graph.diff(second, symbol);
                let sum = graph.add(third, first);
                is_zero(&graph, kind.either(sum, second))
            };
            let is_pair = others.is_empty() && matrix.rows.iter().flatten().all(&mut is_pair);
            is_pair.then(Vec::new)
        }
    }
}

fn is_zero(graph: &Graph, node: Node) -> bool {
    graph.value(node) == Some(0.0)
}

#[cfg(test)]
mod tests;
