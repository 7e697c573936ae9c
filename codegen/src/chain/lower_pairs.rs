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
            let expected = match kind {
                VariableKind::Revolute => Motion::Rotation,
                VariableKind::Prismatic => Motion::Translation,
            };
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
mod tests {
    use super::*;

    /// Parses a spec of one frame with the revolute variable `q` after one with `d`, and a tool.
    fn pairs(frame: &str, tool: &str) -> Vec<bool> {
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"m\"\n[parameters]\na = \"0.3 m\"\nk = 1\n\
             [[frame]]\nname = \"1\"\nvariable = {{ name = \"d\", kind = \"prismatic\" }}\ntransform = \"Rx(0.3) Tz(a - d)\"\n\
             [[frame]]\nname = \"2\"\nvariable = {{ name = \"q\", kind = \"revolute\" }}\n{frame}\n\
             [tool]\ntransform = \"{tool}\"\n"
        );
        lower_pairs(&Spec::parse("arm.toml", &text).expect("a spec"))
    }

    #[test]
    fn turns_and_slides_are_lower_pairs() {
        for frame in [
            "transform = \"Tx(a) Rz(q + 0.1) Ry(k)\"",
            "transform = \"Ry(-q)\"",
            "dh = { theta = \"q\", d = \"a\", a = 0.2, alpha = 0.4 }",
            "mdh = { theta = \"0.3 - q\", d = \"a\", a = 0.2, alpha = 0.4 }",
            "origin = { xyz = [0, 1, 0] }\naxis = [0.6, 0, -0.8]",
            "matrix = [[\"cos(q)\", 0, \"sin(q)\", \"a*cos(q)\"], [0, 1, 0, \"a\"], [\"-sin(q)\", 0, \"cos(q)\", \"-a*sin(q)\"], [0, 0, 0, 1]]",
        ] {
            assert_eq!(pairs(frame, "Tx(a)"), [true, true], "{frame}");
            // A tool that moves does so behind the last frame.
            assert_eq!(pairs(frame, "Tx(a) Rz(q)"), [true, false], "{frame}");
        }
    }

    #[test]
    fn what_is_coupled_geared_or_screwed_is_none() {
        for frame in [
            "transform = \"Rz(2*q)\"",
            "transform = \"Rz(k*q)\"",
            "transform = \"Rz(q) Tz(a*q)\"",
            "transform = \"Rz(q) Rx(q)\"",
            "transform = \"Rz(q + d/(1 m))\"",
            "transform = \"Rz(abs(q))\"",
            "transform = \"Rz(q + 0.1*sin(q))\"",
            "matrix = [[\"cos(2*q)\", 0, \"sin(2*q)\", 0], [0, 1, 0, 0], [\"-sin(2*q)\", 0, \"cos(2*q)\", 0], [0, 0, 0, 1]]",
        ] {
            assert_eq!(pairs(frame, "Tx(a)"), [true, false], "{frame}");
        }
    }
}
