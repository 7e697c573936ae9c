//! Rows of `J_q`, whose least singular value measures dexterity.

use abbe_spec::Spec;

use super::{JOINTS_OF_A_POINT, JOINTS_OF_A_POSE, Links, at_tool, errors_of_joints, units};
use crate::graph::{Graph, Node};

/// Rows of `J_q` at the tool point, in metres and radians, one entry per joint. They are expressed
/// in the axes of the frame where they take the fewest operations.
#[derive(Clone, Debug)]
pub struct Dexterity {
    /// The graph of the nodes.
    pub graph: Graph,
    /// Rows 1–3.
    pub point: Vec<Vec<Node>>,
    /// Six rows of the pose; `None` for fewer than six joints.
    pub pose: Option<Vec<Vec<Node>>>,
}

impl Dexterity {
    /// Builds the rows for a checked spec. Returns `None` for fewer than three joints.
    pub fn new(spec: &Spec) -> Option<Self> {
        let joints = spec.variables.len();
        if joints < JOINTS_OF_A_POINT {
            return None;
        }
        let mut graph = Graph::with_tables(&spec.tables);
        let g = &mut graph;
        let links = Links::new(g, spec);
        let errors = errors_of_joints(g, spec);
        let units = units(spec).into_iter().map(|unit| g.constant(unit)).collect::<Vec<_>>();
        let metre = g.constant(spec.length.in_metres());
        let mut at_frame = |frame: usize| {
            let mut rows = vec![Vec::new(); 6];
            for (errors, unit) in errors.iter().zip(&units) {
                let there = at_tool(g, &links, errors, frame);
                let shift = there.shift.map(|entry| g.mul(metre, entry));
                for (row, entry) in rows.iter_mut().zip([shift, there.turn].concat()) {
                    row.push(g.mul(*unit, entry));
                }
            }
            rows
        };
        let frames: Vec<Vec<Vec<Node>>> = (0..spec.frames.len()).map(&mut at_frame).collect();
        let fewest = |count: usize| {
            let rows = frames.iter().map(|rows| rows[..count].to_vec());
            rows.min_by_key(|rows| graph.size(&rows.concat()))
        };
        let point = fewest(3)?;
        let pose = if joints >= JOINTS_OF_A_POSE { fewest(6) } else { None };
        Some(Self { graph, point, pose })
    }
}
