//! Quantities that are generated for a manipulator, as nodes of one graph.

use abbe_core::Class;
use abbe_spec::expr::{Elementary, Motion, Symbol};
use abbe_spec::{Factor, Spec};

use super::accumulate::Accumulated;
use super::accumulate::Links;
use super::by_source;
use super::covariance::Covariance;
use super::displacement::Displacement;
use super::elastic::Loads;
use super::equivalent_forms::EquivalentForms;
use super::error_jacobian;
use super::local_twist::{LocalTwist, local_twists};
use super::moments::Moments;
use super::moving;
use super::real::RealChain;
use super::rows::Rows;
use super::sources::{self, EffectNode};
use super::symbol_jacobian;
use super::tree::{self, Loops};
use super::walk::{Step, transform, walk};
use crate::graph::{Frame, Graph, Node, Op, Vector};

/// A Jacobian, or another matrix with the same six rows: columns, with rows 4–6 by the spec's
/// orientation.
#[derive(Clone, Debug)]
pub struct Jacobian {
    /// The columns.
    pub columns: Vec<[Node; 6]>,
    /// `cos ρ` if the rows are Euler angles; they are undefined where it is 0.
    pub margin: Option<Node>,
}

/// Nodes of all quantities that are generated for a manipulator.
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph of the nodes.
    pub graph: Graph,
    /// `A_1 … A_n` and the tool transform.
    pub transforms: Vec<Frame>,
    /// The poses of `F_1 … F_n` in `F_0`.
    pub frames: Vec<Frame>,
    /// Pose of the tool point in `F_0`: `A_T`.
    pub tool: Frame,
    /// `J_e`: six columns per frame.
    pub error_jacobian: Jacobian,
    /// Entries of `J_e` that are neither zero nor repeated; the same number for each frame.
    pub distinct: Vec<Vec<Node>>,
    /// `J_q`: one column per variable.
    pub joint_jacobian: Jacobian,
    /// `∂X_T/∂s`: one column per parameter.
    pub parameter_jacobian: Jacobian,
    /// Effects of the enabled sources, source by source.
    pub effects: Vec<EffectNode>,
    /// ε: sum of the enabled repeatable sources, six per frame.
    pub generalized_errors: Vec<[Node; 6]>,
    /// `ΔX = J_e ε` for any ε: one column.
    pub displacement: Jacobian,
    /// `J_e diag(σ²) J_eᵀ` for any variances σ²: six columns.
    pub covariance: Jacobian,
    /// `J_e ε` of the enabled repeatable sources, one column: accumulated along the chain, and from
    /// the columns of `J_e`.
    pub predicted_displacement: [Jacobian; 2],
    /// `J_e ε` of each enabled source alone, one column per source, computed in the same two forms.
    pub source_displacements: [Jacobian; 2],
    /// Exact pose of the tool point with the errors of the enabled repeatable sources.
    pub real_pose: Frame,
    /// Exact pose of the tool point with the errors of all enabled sources, each times its
    /// magnitude.
    pub drawn_pose: Frame,
    /// Errors of every frame with which the nominal chain gives `real_pose`. Only for a long chain
    /// with errors other than those at the frames themselves.
    pub real_errors: Option<Vec<[Node; 6]>>,
    /// Errors of every frame with which the nominal chain gives `drawn_pose`. Only for a long
    /// chain.
    pub drawn_errors: Vec<[Node; 6]>,
    /// `J_q` with rotation-vector rows for any orientation of the spec.
    pub joint_twists: Vec<[Node; 6]>,
    /// Twists of each transform per unit of the variables. Only for a long chain.
    pub joint_local_twists: Vec<LocalTwist>,
    /// Twists of each transform per unit of the parameters. Only for a long chain.
    pub parameter_local_twists: Vec<LocalTwist>,
    /// How the loops close, and the exact poses with errors. Only for a tree of frames.
    pub(crate) loops: Option<Loops>,
}

/// Largest number of frames for which straight-line code is generated. Beyond it, straight-line
/// code outgrows the instruction cache and takes minutes to compile where loops take seconds.
pub(super) const LONGEST_WITHOUT_LOOPS: usize = 30;

impl Model {
    /// Builds all nodes. This cannot fail for a checked spec.
    pub fn new(spec: &Spec) -> Self {
        if spec.is_serial() { Self::chain(spec) } else { tree::model(spec) }
    }

    fn chain(spec: &Spec) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
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

        for (i, frame) in spec.frames.iter().enumerate() {
            name_lengths(g, &frame.factors, &(i + 1).to_string());
        }
        name_lengths(g, &spec.tool, "t");

        let rows = Rows::new(g, spec.orientation, tool.axes[spec.orientation.last_axis().unwrap_or(0)]);
        let margin = rows.margin();
        let moments = Moments::new(g, &frames, &tool, &steps, &ends);
        let by_frame = error_jacobian::columns(g, &frames, moments, &rows);
        let steps = symbol_jacobian::Steps::new(g, steps);
        let columns = by_frame.iter().flat_map(|columns| columns.dense(g)).collect();
        let distinct = by_frame.iter().map(|columns| columns.distinct(&rows)).collect();
        let error_jacobian = Jacobian { columns, margin };
        let variables = (0..spec.variables.len()).map(Symbol::Variable);
        let twists: Vec<[Vector; 2]> =
            variables.map(|symbol| symbol_jacobian::twist(g, &steps, symbol, tool.position)).collect();
        let columns = twists.iter().map(|[velocity, turn]| rows.column(g, *velocity, *turn)).collect();
        let joint_jacobian = Jacobian { columns, margin };
        let joint_twists = twists.iter().map(|[[x, y, z], [a, b, c]]| [*x, *y, *z, *a, *b, *c]).collect();
        let parameters = (0..spec.parameters.len()).map(Symbol::Parameter);
        let parameter_twists: Vec<[Vector; 2]> =
            parameters.map(|symbol| symbol_jacobian::twist(g, &steps, symbol, tool.position)).collect();
        let columns =
            parameter_twists.iter().map(|[velocity, turn]| rows.column(g, *velocity, *turn)).collect();
        let parameter_jacobian = Jacobian { columns, margin };

        let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
        let transforms = factors.map(|factors| transform(g, factors)).collect();
        let axes = g.identity().axes;
        let loads = Loads::new(g, spec, &frames, &axes);
        let (effects, causes) = sources::effects_in(g, spec, |_| &loads);
        let generalized_errors = sources::generalized_errors(g, spec, &effects);

        let zero = g.zero();
        let links = Links::new(g, spec);
        let last_axis = links.last_axis(g, spec.orientation);
        let along = Rows::new(g, spec.orientation, last_axis);
        let symbols: Vec<[Node; 6]> = (0..spec.frames.len())
            .map(|i| std::array::from_fn(|k| g.symbol(Symbol::Error(6 * i + k))))
            .collect();
        let none = Displacement::none(g);
        let columns = links.accumulate(g, &symbols, none).rows(g, &along);
        let displacement = Jacobian { columns, margin: along.margin() };
        let none = Covariance::none(g);
        let columns = links.accumulate(g, &symbols, none).rows(g, &along);
        let covariance = Jacobian { columns, margin: along.margin() };
        let mut two_ways = |errors: &[Vec<[Node; 6]>]| {
            let accumulated =
                errors.iter().map(|errors| by_source::along(g, &links, &along, errors)).collect();
            let product = |errors: &Vec<_>| by_source::product(g, &error_jacobian.columns, errors);
            let products = errors.iter().map(product).collect();
            [(accumulated, along.margin()), (products, margin)]
                .map(|(columns, margin)| Jacobian { columns, margin })
        };
        let predicted_displacement = two_ways(std::slice::from_ref(&generalized_errors));
        let source_displacements = two_ways(&by_source::errors_by_source(zero, spec, &effects));
        let repeatable = spec.enabled_sources().map(|source| source.class == Class::Repeatable);
        let magnitudes = repeatable.map(|one| g.constant(if one { 1.0 } else { 0.0 })).collect();
        let real = RealChain::new(g, spec, &causes, magnitudes);
        let magnitudes =
            (0..spec.enabled_sources().count()).map(|i| g.symbol(Symbol::Magnitude(i))).collect();
        let drawn = RealChain::new(g, spec, &causes, magnitudes);
        let (real_poses, drawn_poses) = (real.poses(g), drawn.poses(g));
        let (real_pose, drawn_pose) = (real_poses[real_poses.len() - 1], drawn_poses[drawn_poses.len() - 1]);
        let more = is_long(spec) && real.is_more_than_errors_of_frames(g);
        let real_errors = more.then(|| real.errors(g));
        let drawn_errors = if is_long(spec) { drawn.errors(g) } else { Vec::new() };
        let mut twists_of = |symbols: Vec<Symbol>| match is_long(spec) {
            true => local_twists(g, spec, &symbols),
            false => Vec::new(),
        };
        let joint_local_twists = twists_of((0..spec.variables.len()).map(Symbol::Variable).collect());
        let parameter_local_twists = twists_of((0..spec.parameters.len()).map(Symbol::Parameter).collect());
        if !is_long(spec) {
            for errors in [&symbols, &generalized_errors] {
                moving::equate(g, &links, errors);
            }
            let poses: Vec<Frame> = frames.iter().copied().chain([tool]).collect();
            for (chain, real) in [(&real, &real_poses), (&drawn, &drawn_poses)] {
                if *real != poses {
                    let links = chain.links(g);
                    EquivalentForms::of_poses(g, &links, real);
                }
            }
            let forms = EquivalentForms::new(g, &links, &poses);
            forms.moments(g, &by_frame);
            let symbols: Vec<Symbol> = (0..spec.variables.len()).map(Symbol::Variable).collect();
            forms.twists(g, spec, &symbols, &twists);
            let symbols: Vec<Symbol> = (0..spec.parameters.len()).map(Symbol::Parameter).collect();
            forms.twists(g, spec, &symbols, &parameter_twists);
        }
        Self {
            graph,
            transforms,
            frames,
            tool,
            error_jacobian,
            distinct,
            joint_jacobian,
            parameter_jacobian,
            effects,
            generalized_errors,
            displacement,
            covariance,
            predicted_displacement,
            source_displacements,
            real_pose,
            drawn_pose,
            real_errors,
            drawn_errors,
            joint_twists,
            joint_local_twists,
            parameter_local_twists,
            loops: None,
        }
    }
}

/// Names the entries of a pose: `r2_13` is row 1, column 3 of `R_2`, `p2_x` the x of its position.
pub(super) fn name(graph: &mut Graph, frame: &Frame, index: &str) {
    for (j, column) in frame.axes.iter().enumerate() {
        for (i, node) in column.iter().enumerate() {
            graph.propose(*node, || format!("r{index}_{}{}", i + 1, j + 1));
        }
    }
    for (node, axis) in frame.position.iter().zip("xyz".chars()) {
        graph.propose(*node, || format!("p{index}_{axis}"));
    }
}

/// Names the constant lengths of a transform: `x2` is the length along x from frame 1 to frame 2,
/// `a2` the radius where a matrix has `a cos θ` and `a sin θ`.
pub(super) fn name_lengths(graph: &mut Graph, factors: &[Factor], index: &str) {
    for factor in factors {
        match factor {
            Factor::Elementary(Elementary { motion: Motion::Translation, axis, amount }) => {
                let amount = graph.lower(amount);
                name_length(graph, amount, *axis, index);
            }
            Factor::Matrix(matrix) => {
                for (axis, row) in matrix.rows.iter().enumerate() {
                    let amount = graph.lower(&row[3]);
                    name_length(graph, amount, axis, index);
                }
            }
            _ => {}
        }
    }
}

fn name_length(graph: &mut Graph, amount: Node, axis: usize, index: &str) {
    let letter = ["x", "y", "z"][axis];
    match graph.op(amount) {
        Op::Constant(bits) => graph.propose_number(f64::from_bits(bits), &format!("{letter}{index}")),
        Op::Mul(a, b) => {
            let factor = graph.value(a).or(graph.value(b));
            factor.into_iter().for_each(|value| graph.propose_number(value, &format!("a{index}")));
        }
        _ => {}
    }
}

/// Returns `true` if the functions of the chain are loops over its frames.
pub(crate) fn is_long(spec: &Spec) -> bool {
    spec.is_serial() && spec.frames.len() > LONGEST_WITHOUT_LOOPS
}
