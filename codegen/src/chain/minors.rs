//! Minors of a matrix of nodes, and the solution of linear equations from them without a pivot that
//! may be 0.

use crate::graph::{Graph, Node};

/// Returns the minors of all rows, for each set of as many columns. A set is a bit mask.
///
/// The minors of the first k rows follow from those of the first k − 1 (Laplace expansion):
///
/// ```text
/// M_k(S) = Σ_{c ∈ S} (−1)^(k − 1 + place of c in S) a_kc M_{k−1}(S without c)
/// ```
///
/// Six rows of seven columns take at most 448 products, and give the determinant and every
/// numerator of Cramer's rule.
pub(super) fn minors(graph: &mut Graph, rows: &[Vec<Node>]) -> Vec<Node> {
    let zero = graph.zero();
    let columns = rows.first().map_or(0, Vec::len);
    let mut known = vec![zero; 1 << columns];
    known[0] = graph.constant(1.0);
    for (k, row) in rows.iter().enumerate() {
        let mut next = vec![zero; 1 << columns];
        for (set, minor) in next.iter_mut().enumerate().filter(|(set, _)| set.count_ones() as usize == k + 1)
        {
            for (place, column) in (0..columns).filter(|column| set >> column & 1 == 1).enumerate() {
                let product = graph.mul(row[column], known[set & !(1 << column)]);
                *minor = match (k + place) % 2 {
                    0 => graph.add(*minor, product),
                    _ => graph.sub(*minor, product),
                };
            }
        }
        known = next;
    }
    known
}

/// Solves `A x = b` by Cramer's rule; `rows` are the rows of the square matrix A.
pub(super) fn solve(graph: &mut Graph, rows: &[Vec<Node>], b: &[Node]) -> Vec<Node> {
    let count = rows.len();
    let extended: Vec<Vec<Node>> = rows.iter().zip(b).map(|(row, b)| [&row[..], &[*b]].concat()).collect();
    let minors = minors(graph, &extended);
    let all = (1 << (count + 1)) - 1;
    let determinant = minors[all & !(1 << count)];
    let unknown = |j: usize| {
        // b stands behind the columns that follow x_j's.
        let quotient = graph.div(minors[all & !(1 << j)], determinant);
        if (count - 1 - j).is_multiple_of(2) { quotient } else { graph.neg(quotient) }
    };
    (0..count).map(unknown).collect()
}

#[cfg(test)]
mod tests;
