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
mod tests;
