//! The kinematics of a tree of frames.

use abbe_core::Component;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::parts::Parts;
use crate::chain::kinematics::Kinematics;
use crate::chain::rows::Rows;
use crate::graph::{Frame, Graph, Node, Vector};

impl Kinematics for Parts<'_> {
    fn poses(&self) -> (&[Frame], Frame) {
        let whole = &self.whole;
        (whole.frames(), *whole.pose(Some(whole.tool())))
    }

    fn errors(&mut self, graph: &mut Graph, rows: &Rows) -> (Vec<[Node; 6]>, Vec<Vec<Node>>) {
        let mut columns = Vec::new();
        for frame in 0..self.whole.frames().len() {
            for component in Component::ALL {
                let [velocity, rotation] = self.by_error(graph, frame, component);
                columns.push(rows.column(graph, velocity, rotation));
            }
        }
        let distinct = columns.chunks_exact(6).map(<[_]>::concat).collect();
        (columns, distinct)
    }

    fn twists(&self, graph: &mut Graph, symbols: &[Symbol]) -> Vec<[Vector; 2]> {
        symbols.iter().map(|symbol| self.by_symbol(graph, *symbol)).collect()
    }

    fn prepare_sums(&mut self, _: &mut Graph, _: &Spec) -> Option<Option<Node>> {
        None
    }

    fn displacement(&self, graph: &mut Graph, rows: &Rows, errors: &[[Node; 6]]) -> [Node; 6] {
        let [velocity, rotation] = self.by_errors(graph, errors);
        rows.column(graph, velocity, rotation)
    }

    fn covariance(
        &self,
        graph: &mut Graph,
        columns: &[[Node; 6]],
        variances: &[[Node; 6]],
    ) -> Vec<[Node; 6]> {
        let mut sums = vec![[graph.zero(); 6]; 6];
        for (column, variance) in columns.iter().zip(variances.as_flattened()) {
            let weighted = column.map(|entry| graph.mul(*variance, entry));
            for i in 0..6 {
                for j in i..6 {
                    let part = graph.mul(weighted[i], column[j]);
                    sums[i][j] = graph.add(sums[i][j], part);
                    sums[j][i] = sums[i][j];
                }
            }
        }
        sums
    }
}
