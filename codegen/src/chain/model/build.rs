//! The nodes of a chain or a tree of frames.

use abbe_core::Class;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::chain::Chain;
use super::names::{name, name_lengths};
use super::{Jacobian, Model};
use crate::chain::by_source;
use crate::chain::elastic::Loads;
use crate::chain::inverse::Inverse;
use crate::chain::local_twist::LocalTwist;
use crate::chain::rows::Rows;
use crate::chain::sources::{self, Causes};
use crate::chain::tree::{ClosedLoops, Tree};
use crate::chain::walk::transform;
use crate::graph::{Frame, Graph, Node, Vector};

/// Kinematics of frames, from which all nodes are built in the order of the methods.
pub(crate) trait Kinematics {
    /// Returns the poses of the frames and of the tool point in `F_0`.
    fn poses(&self) -> (&[Frame], Frame);

    /// Returns the six columns of `J_e` of each frame, and for each frame its entries that are
    /// neither zero nor repeated.
    fn errors(&mut self, graph: &mut Graph, rows: &Rows) -> (Vec<[Node; 6]>, Vec<Vec<Node>>);

    /// Returns the velocity of the tool point and the rotation per unit of each symbol.
    fn twists(&self, graph: &mut Graph, symbols: &[Symbol]) -> Vec<[Vector; 2]>;

    /// Prepares sums over the frames, and returns the margin of their rows, if it is another node.
    fn prepare_sums(&mut self, graph: &mut Graph, spec: &Spec) -> Option<Option<Node>>;

    /// Returns `J_e ε`, summed over the frames.
    fn displacement(&self, graph: &mut Graph, rows: &Rows, errors: &[[Node; 6]]) -> [Node; 6];

    /// Returns the columns of `J_e diag(σ²) J_eᵀ`.
    fn covariance(&self, graph: &mut Graph, columns: &[[Node; 6]], variances: &[[Node; 6]])
    -> Vec<[Node; 6]>;

    /// Returns what chains and trees have in forms of their own.
    fn machine(self, graph: &mut Graph, spec: &Spec, causes: &Causes, errors: [&[[Node; 6]]; 2]) -> Machine;
}

/// The machine with its errors, and what only chains or only trees have; see the fields of
/// [`Model`].
pub(crate) struct Machine {
    pub(crate) real_pose: Frame,
    pub(crate) drawn_pose: Frame,
    pub(crate) real_errors: Option<Vec<[Node; 6]>>,
    pub(crate) drawn_errors: Vec<[Node; 6]>,
    pub(crate) local_twists: [Vec<LocalTwist>; 2],
    pub(crate) inverse: Option<Inverse>,
    pub(crate) loops: Option<ClosedLoops>,
}

/// Returns the magnitudes that select the repeatable sources, and the symbols of all.
pub(crate) fn magnitudes(graph: &mut Graph, spec: &Spec) -> [Vec<Node>; 2] {
    let repeatable = spec.enabled_sources().map(|source| source.class == Class::Repeatable);
    let selected = repeatable.map(|one| graph.constant(if one { 1.0 } else { 0.0 })).collect();
    [selected, (0..spec.enabled_sources().count()).map(|i| graph.symbol(Symbol::Magnitude(i))).collect()]
}

/// Returns the symbols of the variables and of the parameters.
pub(crate) fn symbols(spec: &Spec) -> [Vec<Symbol>; 2] {
    [
        (0..spec.variables.len()).map(Symbol::Variable).collect(),
        (0..spec.parameters.len()).map(Symbol::Parameter).collect(),
    ]
}

impl Model {
    /// Builds all nodes. This cannot fail for a checked spec.
    pub fn new(spec: &Spec) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
        if spec.is_serial() {
            let chain = Chain::new(&mut graph, spec);
            Self::of(graph, spec, chain)
        } else {
            let tree = Tree::new(&mut graph, spec);
            Self::of(graph, spec, tree)
        }
    }

    fn of(mut graph: Graph, spec: &Spec, mut kinematics: impl Kinematics) -> Self {
        let g = &mut graph;
        let (frames, tool) = kinematics.poses();
        let frames = frames.to_vec();
        for (i, (pose, frame)) in frames.iter().zip(&spec.frames).enumerate() {
            name(g, pose, &(i + 1).to_string());
            name_lengths(g, &frame.factors, &(i + 1).to_string());
        }
        name(g, &tool, "t");
        name_lengths(g, &spec.tool, "t");

        let rows = Rows::new(g, spec.orientation, tool.axes[spec.orientation.last_axis().unwrap_or(0)]);
        let margin = rows.margin();
        let (columns, distinct) = kinematics.errors(g, &rows);
        let error_jacobian = Jacobian { columns, margin };
        let [(joint_twists, joint_jacobian), (_, parameter_jacobian)] = symbols(spec).map(|symbols| {
            let twists = kinematics.twists(g, &symbols);
            let columns = twists.iter().map(|[velocity, turn]| rows.column(g, *velocity, *turn)).collect();
            (twists, Jacobian { columns, margin })
        });
        let joint_twists =
            joint_twists.iter().map(|[[x, y, z], [a, b, c]]| [*x, *y, *z, *a, *b, *c]).collect();

        let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
        let transforms = factors.map(|factors| transform(g, factors)).collect();
        let axes = g.identity().axes;
        let loads = Loads::new(g, spec, &frames, &axes);
        let (effects, causes) = sources::effects_in(g, spec, |_| &loads);
        let generalized_errors = sources::generalized_errors(g, spec, &effects);

        let zero = g.zero();
        let of_sums = kinematics.prepare_sums(g, spec).unwrap_or(margin);
        let errors: Vec<[Node; 6]> = (0..spec.frames.len())
            .map(|i| std::array::from_fn(|k| g.symbol(Symbol::Error(6 * i + k))))
            .collect();
        let columns = vec![kinematics.displacement(g, &rows, &errors)];
        let displacement = Jacobian { columns, margin: of_sums };
        let columns = kinematics.covariance(g, &error_jacobian.columns, &errors);
        let covariance = Jacobian { columns, margin: of_sums };
        let mut two_ways = |errors: &[Vec<[Node; 6]>]| {
            let sums = errors.iter().map(|errors| kinematics.displacement(g, &rows, errors)).collect();
            let product = |errors: &Vec<_>| by_source::product(g, &error_jacobian.columns, errors);
            let products = errors.iter().map(product).collect();
            [(sums, of_sums), (products, margin)].map(|(columns, margin)| Jacobian { columns, margin })
        };
        let predicted_displacement = two_ways(std::slice::from_ref(&generalized_errors));
        let source_displacements = two_ways(&by_source::errors_by_source(zero, spec, &effects));
        let machine = kinematics.machine(g, spec, &causes, [&errors, &generalized_errors]);
        let [joint_local_twists, parameter_local_twists] = machine.local_twists;
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
            real_pose: machine.real_pose,
            drawn_pose: machine.drawn_pose,
            real_errors: machine.real_errors,
            drawn_errors: machine.drawn_errors,
            joint_twists,
            joint_local_twists,
            parameter_local_twists,
            inverse: machine.inverse,
            loops: machine.loops,
        }
    }
}
