//! How far a force at the tool point moves it: the matrix whose largest singular value is sought.

use abbe_core::Class;
use abbe_spec::Spec;

use super::accumulate::Links;
use super::elastic::Loads;
use super::joint_columns::at_tool;
use super::sources::elastic_errors;
use crate::graph::{Graph, Node};

/// How far a force at the tool point moves it, because of the enabled repeatable beams and compliances: in the spec's unit of length per
/// its unit of force, which makes m/N of any unit of length.
#[derive(Clone, Debug)]
pub struct ToolCompliance {
    /// The graph they are nodes of.
    pub graph: Graph,
    /// The motion along each axis of `F_1`, one row for each axis along which the force acts. Nothing gives way before `F_1`: the singular
    /// values are those in `F_0`, and the joint before it is not needed.
    pub rows: Vec<Vec<Node>>,
}

impl ToolCompliance {
    /// That of a checked spec; none if no force moves the tool point.
    pub fn new(spec: &Spec) -> Option<Self> {
        let mut sources = spec.enabled_sources().filter(|source| source.class == Class::Repeatable);
        if !sources.any(|source| source.effects.iter().any(|effect| effect.cause.is_elastic())) {
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
