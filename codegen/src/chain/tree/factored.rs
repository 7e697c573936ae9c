//! Solution of linear equations in straight-line code.

use crate::graph::{Graph, Node};

/// A square matrix A = QR by modified Gram-Schmidt orthogonalization. It is stable without pivots
/// if right-hand sides are orthogonalized like columns (Björck 1967).
pub(super) struct Factored {
    /// Columns of Q.
    orthonormal: Vec<Vec<Node>>,
    /// Columns of R above the diagonal.
    upper: Vec<Vec<Node>>,
    /// Reciprocals of the diagonal of R.
    reciprocals: Vec<Node>,
}

impl Factored {
    /// Factors a matrix given by columns.
    pub(super) fn new(graph: &mut Graph, columns: Vec<Vec<Node>>) -> Self {
        let mut factored = Self { orthonormal: Vec::new(), upper: Vec::new(), reciprocals: Vec::new() };
        for mut column in columns {
            let projections = factored.project(graph, &mut column);
            let square = dot(graph, &column, &column);
            let (length, one) = (graph.sqrt(square), graph.constant(1.0));
            let reciprocal = graph.div(one, length);
            let unit = column.iter().map(|entry| graph.mul(*entry, reciprocal)).collect();
            factored.orthonormal.push(unit);
            factored.upper.push(projections);
            factored.reciprocals.push(reciprocal);
        }
        factored
    }

    /// Removes the components along the columns of Q from a vector, and returns them.
    fn project(&self, graph: &mut Graph, vector: &mut [Node]) -> Vec<Node> {
        let project = |unit: &Vec<Node>| {
            let component = dot(graph, unit, vector);
            for (entry, direction) in vector.iter_mut().zip(unit) {
                let part = graph.mul(component, *direction);
                *entry = graph.sub(*entry, part);
            }
            component
        };
        self.orthonormal.iter().map(project).collect()
    }

    /// Returns the solution x of `A x = b`.
    pub(super) fn solve(&self, graph: &mut Graph, right: &[Node]) -> Vec<Node> {
        let mut solution = self.project(graph, &mut right.to_vec());
        for k in (0..solution.len()).rev() {
            for j in k + 1..solution.len() {
                let part = graph.mul(self.upper[j][k], solution[j]);
                solution[k] = graph.sub(solution[k], part);
            }
            solution[k] = graph.mul(solution[k], self.reciprocals[k]);
        }
        solution
    }

    /// Returns the solution y of `y A = c`, a row: `y = c R⁻¹ Qᵀ`.
    pub(super) fn solve_row(&self, graph: &mut Graph, row: &[Node]) -> Vec<Node> {
        let mut weights: Vec<Node> = Vec::new();
        let mut solution = vec![graph.zero(); row.len()];
        for (k, entry) in row.iter().enumerate() {
            let known = dot(graph, &self.upper[k], &weights);
            let rest = graph.sub(*entry, known);
            let weight = graph.mul(rest, self.reciprocals[k]);
            weights.push(weight);
            for (sum, direction) in solution.iter_mut().zip(&self.orthonormal[k]) {
                let part = graph.mul(weight, *direction);
                *sum = graph.add(*sum, part);
            }
        }
        solution
    }
}

/// Returns the sum of products of the entries.
pub(super) fn dot(graph: &mut Graph, a: &[Node], b: &[Node]) -> Node {
    let products: Vec<Node> = a.iter().zip(b).map(|(a, b)| graph.mul(*a, *b)).collect();
    products.into_iter().fold(graph.zero(), |sum, product| graph.add(sum, product))
}

#[cfg(test)]
mod tests {
    use abbe_spec::expr::Symbol;

    use super::*;

    /// Both solutions satisfy their equations, also where elimination without pivots would divide
    /// by zero.
    #[test]
    fn solutions_satisfy_the_equations() {
        let mut graph = Graph::new();
        let g = &mut graph;
        let entries: Vec<Node> = (0..25).map(|i| g.symbol(Symbol::Local(i))).collect();
        let zero = g.zero();
        let columns: Vec<Vec<Node>> = (0..5)
            .map(|j| (0..5).map(|i| if (i + j) % 4 == 0 { zero } else { entries[5 * j + i] }).collect())
            .collect();
        let right: Vec<Node> = (0..5).map(|i| g.symbol(Symbol::Parameter(i))).collect();
        let factored = Factored::new(g, columns.clone());
        let (x, y) = (factored.solve(g, &right), factored.solve_row(g, &right));
        let rows: Vec<Vec<Node>> = (0..5).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
        let mut residuals: Vec<Node> = Vec::new();
        for k in 0..5 {
            for product in [dot(g, &rows[k], &x), dot(g, &columns[k], &y)] {
                residuals.push(g.sub(product, right[k]));
            }
        }
        let value = |symbol| match symbol {
            Symbol::Local(i) => (1.7 * i as f64).sin(),
            Symbol::Parameter(i) => 1.0 + i as f64,
            _ => f64::NAN,
        };
        for residual in graph.evaluate(&residuals, value) {
            assert!(residual.abs() < 1e-13, "{residual}");
        }
    }
}
