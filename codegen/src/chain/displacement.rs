//! Computes `ΔX = J_e ε` without `J_e`.

use super::accumulate::Accumulated;
use super::local::Local;
use super::rows::Rows;
use super::six::vectors;
use crate::graph::{Graph, Node, Vector};

/// Displacement of the tool point caused by the frames from the tip to the current one:
///
/// ```text
/// δ ← R_i (δ + d_i + θ_i × ρ)        θ ← R_i (θ + θ_i)
/// ```
pub(crate) struct Displacement {
    /// Translation δ.
    pub(super) shift: Vector,
    /// Rotation θ.
    pub(super) turn: Vector,
}

impl Displacement {
    pub(super) fn none(graph: &mut Graph) -> Self {
        let zero = [graph.zero(); 3];
        Self { shift: zero, turn: zero }
    }

    /// Returns the six rows of ΔX.
    pub(super) fn column(&self, graph: &mut Graph, rows: &Rows) -> [Node; 6] {
        rows.column(graph, self.shift, self.turn)
    }
}

impl Accumulated for Displacement {
    const NUMBERS: usize = 6;

    fn from_numbers(numbers: &[Node]) -> Self {
        let vector = |first: usize| [0, 1, 2].map(|i| numbers[first + i]);
        Self { shift: vector(0), turn: vector(3) }
    }

    fn numbers(&self) -> Vec<Node> {
        [self.shift, self.turn].concat()
    }

    /// Returns ΔX as the only column.
    fn rows(&self, graph: &mut Graph, rows: &Rows) -> Vec<[Node; 6]> {
        vec![self.column(graph, rows)]
    }

    fn add(&mut self, graph: &mut Graph, errors: [Node; 6], lever: Vector) {
        let (shift, turn) = vectors(errors);
        let swing = graph.cross(turn, lever);
        self.shift = graph.add_vectors(self.shift, shift);
        self.shift = graph.add_vectors(self.shift, swing);
        self.turn = graph.add_vectors(self.turn, turn);
    }

    fn turn(&mut self, graph: &mut Graph, motion: &Local) {
        self.shift = motion.direction(graph, self.shift);
        self.turn = motion.direction(graph, self.turn);
    }
}
