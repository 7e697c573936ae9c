//! Everything that is generated for a manipulator, as nodes of one graph.

use super::error_jacobian;
use super::moments::Moments;
use super::rows::Rows;
use super::sources::{self, EffectNode};
use super::symbol_jacobian;
use super::walk::{Step, transform, walk};
use crate::expr::Symbol;
use crate::graph::{Frame, Graph, Node};
use crate::spec::{Source, Spec};

/// A Jacobian: its columns, rows as the spec's orientation says.
#[derive(Clone, Debug)]
pub struct Jacobian {
    /// The columns.
    pub columns: Vec<[Node; 6]>,
    /// `cos ρ` where the rows are Euler angles: they are meaningless where it is 0.
    pub margin: Option<Node>,
}

/// The nodes of everything that is generated for a manipulator.
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph they are nodes of.
    pub graph: Graph,
    /// `A_1 … A_n` and the tool, each by itself.
    pub transforms: Vec<Frame>,
    /// The poses of `F_1 … F_n` in `F_0`.
    pub frames: Vec<Frame>,
    /// The pose of the tool point in `F_0`: `A_T`.
    pub tool: Frame,
    /// `J_e`: six columns per frame.
    pub error_jacobian: Jacobian,
    /// `J_q`: one column per variable.
    pub joint_jacobian: Jacobian,
    /// `∂X_T/∂s`: one column per parameter.
    pub parameter_jacobian: Jacobian,
    /// The effects of the enabled sources, source by source.
    pub effects: Vec<EffectNode>,
    /// ε: the sum of the enabled repeatable sources, six per frame.
    pub generalized_errors: Vec<[Node; 6]>,
}

impl Model {
    /// Builds all nodes. A checked spec cannot fail.
    pub fn new(spec: &Spec) -> Self {
        let mut graph = Graph::new();
        let g = &mut graph;
        let mut steps: Vec<Step> = Vec::new();
        let mut frames = Vec::with_capacity(spec.frames.len());
        let mut ends = Vec::with_capacity(spec.frames.len());
        let mut at = g.identity();
        for (i, frame) in spec.frames.iter().enumerate() {
            at = walk(g, at, &frame.factors, &mut steps);
            name(g, &at, &(i + 1).to_string());
            frames.push(at);
            ends.push(steps.len());
        }
        let tool = walk(g, at, &spec.tool, &mut steps);
        name(g, &tool, "t");

        let rows = Rows::new(g, spec.orientation, &tool);
        let margin = match &rows {
            Rows::RotationVector => None,
            Rows::EulerYzx(euler) => Some(euler.margin),
        };
        let moments = Moments::new(g, &frames, &tool, &steps, &ends);
        let columns = error_jacobian::columns(g, &frames, moments, &rows);
        let error_jacobian = Jacobian { columns, margin };
        let mut by_symbols = |symbols: Vec<Symbol>| {
            let column = |symbol| symbol_jacobian::column(g, &steps, symbol, tool.position, &rows);
            Jacobian { columns: symbols.into_iter().map(column).collect(), margin }
        };
        let joint_jacobian = by_symbols((0..spec.variables.len()).map(Symbol::Variable).collect());
        let parameter_jacobian = by_symbols((0..spec.parameters.len()).map(Symbol::Parameter).collect());

        let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
        let transforms = factors.map(|factors| transform(g, factors)).collect();
        let effects = sources::effects(g, spec, &frames);
        let generalized_errors = sources::generalized_errors(g, spec, &effects);
        Self {
            graph,
            transforms,
            frames,
            tool,
            error_jacobian,
            joint_jacobian,
            parameter_jacobian,
            effects,
            generalized_errors,
        }
    }
}

/// Names the entries of a pose: `r2_13` is row 1, column 3 of `R_2`, `p2_x` the x of its position.
fn name(graph: &mut Graph, frame: &Frame, index: &str) {
    for (j, column) in frame.axes.iter().enumerate() {
        for (i, node) in column.iter().enumerate() {
            graph.propose(*node, || format!("r{index}_{}{}", i + 1, j + 1));
        }
    }
    for (node, axis) in frame.position.iter().zip("xyz".chars()) {
        graph.propose(*node, || format!("p{index}_{axis}"));
    }
}

impl Spec {
    /// The sources that are switched on, in the order of the file.
    pub fn enabled_sources(&self) -> impl Iterator<Item = &Source> {
        self.sources.iter().filter(|source| source.enabled)
    }
}
