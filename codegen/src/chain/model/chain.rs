//! The kinematics of a chain of frames.

use abbe_spec::{Spec, Symbol};

use super::machine::Machine;
use crate::chain::equivalent_forms::{EquivalentForms, equate_at_origin};
use crate::chain::error_jacobian::{self, Moments};
use crate::chain::inverse::Inverse;
use crate::chain::kinematics::{Kinematics, magnitudes, symbols};
use crate::chain::symbol_jacobian::{Steps, local_twists, twist};
use crate::chain::walk::{Step, walk};
use crate::chain::{Accumulated, Causes, Columns, Covariance, Links, RealChain, Rows, by_source, is_long};
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// A chain of frames, from the base to the tool.
pub(super) struct Chain {
    frames: Vec<Frame>,
    tool: Frame,
    /// Steps along the chain, until `errors` has used them.
    path: Vec<Step>,
    /// Number of steps up to the end of each frame.
    ends: Vec<usize>,
    steps: Steps,
    by_frame: Vec<Columns>,
    /// Links, and rows along them, for sums.
    along: Option<(Links, Rows)>,
}

impl Chain {
    pub(super) fn new(graph: &mut Graph, spec: &Spec) -> Self {
        let mut path: Vec<Step> = Vec::new();
        let (mut frames, mut ends) = (Vec::new(), Vec::new());
        let mut at = graph.identity();
        for frame in &spec.frames {
            at = walk(graph, at, &frame.factors, &mut path);
            frames.push(at);
            ends.push(path.len());
        }
        let tool = walk(graph, at, &spec.tool, &mut path);
        let steps = Steps::new(graph, Vec::new());
        Self { frames, tool, path, ends, steps, by_frame: Vec::new(), along: None }
    }

    /// Returns the exact chain with errors, and what only chains have.
    pub(super) fn machine(
        self,
        graph: &mut Graph,
        spec: &Spec,
        causes: &Causes,
        errors: [&[Six]; 2],
    ) -> Machine {
        let [repeatable, drawn] = magnitudes(graph, spec);
        let real = RealChain::new(graph, spec, causes, repeatable);
        let drawn = RealChain::new(graph, spec, causes, drawn);
        let (real_poses, drawn_poses) = (real.poses(graph), drawn.poses(graph));
        let is_long = is_long(spec);
        let more = is_long && real.is_more_than_errors_of_frames(graph);
        let real_errors = more.then(|| real.errors(graph));
        let drawn_errors = if is_long { drawn.errors(graph) } else { Vec::new() };
        let local_twists = symbols(spec).map(|symbols| match is_long {
            true => local_twists(graph, spec, &symbols),
            false => Vec::new(),
        });
        if let Some((links, _)) = self.along.as_ref().filter(|_| !is_long) {
            for errors in errors {
                equate_at_origin(graph, links, errors);
            }
            let poses: Vec<Frame> = self.frames.iter().copied().chain([self.tool]).collect();
            for (chain, real) in [(&real, &real_poses), (&drawn, &drawn_poses)] {
                if *real != poses {
                    let links = chain.links(graph);
                    EquivalentForms::of_poses(graph, &links, real);
                }
            }
            let forms = EquivalentForms::new(graph, links, &poses);
            forms.moments(graph, &self.by_frame);
            for symbols in symbols(spec) {
                let twists = self.twists(graph, &symbols);
                forms.twists(graph, spec, &symbols, &twists);
            }
        }
        Machine {
            real_pose: real_poses[real_poses.len() - 1],
            drawn_pose: drawn_poses[drawn_poses.len() - 1],
            real_errors,
            drawn_errors,
            local_twists,
            inverse: Inverse::new(graph, spec),
            loops: None,
        }
    }
}

impl Kinematics for Chain {
    fn poses(&self) -> (&[Frame], Frame) {
        (&self.frames, self.tool)
    }

    fn errors(&mut self, graph: &mut Graph, rows: &Rows) -> (Vec<Six>, Vec<Vec<Node>>) {
        let moments = Moments::new(graph, &self.frames, &self.tool, &self.path, &self.ends);
        self.by_frame = error_jacobian::columns(graph, &self.frames, moments, rows);
        self.steps = Steps::new(graph, std::mem::take(&mut self.path));
        let columns = self.by_frame.iter().flat_map(|columns| columns.dense(graph)).collect();
        (columns, self.by_frame.iter().map(|columns| columns.distinct(rows)).collect())
    }

    fn twists(&self, graph: &mut Graph, symbols: &[Symbol]) -> Vec<[Vector; 2]> {
        symbols.iter().map(|symbol| twist(graph, &self.steps, *symbol, self.tool.position)).collect()
    }

    fn prepare_sums(&mut self, graph: &mut Graph, spec: &Spec) -> Option<Option<Node>> {
        let links = Links::new(graph, spec);
        let last_axis = links.last_axis(graph, spec.orientation);
        let rows = Rows::new(graph, spec.orientation, last_axis);
        let margin = rows.margin();
        self.along = Some((links, rows));
        Some(margin)
    }

    fn displacement(&self, graph: &mut Graph, _: &Rows, errors: &[Six]) -> Six {
        let Some((links, rows)) = &self.along else { return [graph.zero(); 6] };
        by_source::along(graph, links, rows, errors)
    }

    fn covariance(&self, graph: &mut Graph, _: &[Six], variances: &[Six]) -> Vec<Six> {
        let Some((links, rows)) = &self.along else { return Vec::new() };
        let none = Covariance::none(graph);
        links.accumulate(graph, variances, 0, none).rows(graph, rows)
    }
}
