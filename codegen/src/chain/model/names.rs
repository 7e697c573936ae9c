//! Names of nodes in generated code.

use abbe_spec::{Elementary, Factor, Motion};

use crate::graph::{Frame, Graph, Node, Op};

/// Names the entries of a pose: `r2_13` is row 1, column 3 of `R_2`, `p2_x` the x of its position.
pub(in crate::chain) fn name(graph: &mut Graph, frame: &Frame, index: &str) {
    for (j, column) in frame.axes.iter().enumerate() {
        for (i, node) in column.iter().enumerate() {
            graph.propose(*node, || format!("r{index}_{}{}", i + 1, j + 1));
        }
    }
    for (node, axis) in frame.position.iter().zip("xyz".chars()) {
        graph.propose(*node, || format!("p{index}_{axis}"));
    }
}

/// Names the constant lengths of a transform: `x2` is the length along x from frame 1 to frame 2,
/// `a2` the radius where a matrix has `a cos θ` and `a sin θ`.
pub(in crate::chain) fn name_lengths(graph: &mut Graph, factors: &[Factor], index: &str) {
    for factor in factors {
        match factor {
            Factor::Elementary(Elementary { motion: Motion::Translation, axis, amount }) => {
                let amount = graph.lower(amount);
                name_length(graph, amount, *axis, index);
            }
            Factor::Matrix(matrix) => {
                for (axis, row) in matrix.rows.iter().enumerate() {
                    let amount = graph.lower(&row[3]);
                    name_length(graph, amount, axis, index);
                }
            }
            _ => {}
        }
    }
}

fn name_length(graph: &mut Graph, amount: Node, axis: usize, index: &str) {
    let letter = ["x", "y", "z"][axis];
    match graph.op(amount) {
        Op::Constant(bits) => graph.propose_number(f64::from_bits(bits), &format!("{letter}{index}")),
        Op::Mul(a, b) => {
            let factor = graph.value(a).or(graph.value(b));
            factor.into_iter().for_each(|value| graph.propose_number(value, &format!("a{index}")));
        }
        _ => {}
    }
}
