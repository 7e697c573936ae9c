//! Displacement of the tool point per force there: the matrix whose largest singular value is
//! sought.

use abbe_core::Class;
use abbe_spec::{Source, Spec};

use super::{Links, Loads, at_tool, elastic_errors};
use crate::graph::{Graph, Node};

/// Compliance of the tool point due to the enabled repeatable elastic sources, in the spec's
/// unit of length per its unit of force. That is m/N for any unit of length.
#[derive(Clone, Debug)]
pub struct ToolCompliance {
    /// The graph of the nodes.
    pub graph: Graph,
    /// Displacement in the axes of `F_1`, one row for each axis of the force. Nothing deflects
    /// before `F_1`, so the singular values equal those in `F_0` and the first joint is not needed.
    pub rows: Vec<Vec<Node>>,
}

impl ToolCompliance {
    /// Builds the compliance of a checked spec. Returns `None` if no force displaces the tool
    /// point.
    pub fn new(spec: &Spec) -> Option<Self> {
        let mut sources = spec.enabled_sources().filter(|source| source.class == Class::Repeatable);
        if !sources.any(Source::is_elastic) {
            return None;
        }
        let mut graph = Graph::with_tables(&spec.tables);
        let g = &mut graph;
        let links = Links::new(g, spec);
        let mut frames = vec![g.identity()];
        for link in 1..spec.frames.len() {
            let next = links.onwards(g, link, frames[link - 1]);
            frames.push(next);
        }
        let rows = (0..3).map(|axis| {
            let mut force = [g.zero(); 3];
            force[axis] = g.constant(1.0);
            let loads = Loads::at_tool(g, spec, &frames, force);
            let errors = elastic_errors(g, spec, &loads);
            at_tool(g, &links, &errors, 0).shift.to_vec()
        });
        let rows: Vec<Vec<Node>> = rows.collect();
        let moves = rows.concat().iter().any(|entry| graph.value(*entry) != Some(0.0));
        moves.then_some(Self { graph, rows })
    }
}
