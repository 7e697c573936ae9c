//! The nodes of a chain or a tree of frames.

use abbe_spec::{Spec, Symbol};

use super::chain::Chain;
use super::machine::Machine;
use super::names::{name, name_lengths};
use crate::chain::inverse::Inverse;
use crate::chain::kinematics::{Kinematics, symbols};
use crate::chain::tree::Parts;
use crate::chain::{Causes, ClosedLoops, Jacobian, Loads, Model, Rows, by_source, sources, transform};
use crate::graph::{Graph, Six};
use crate::procedure::Precision;

impl Model {
    /// Builds all nodes. This cannot fail for a checked spec.
    pub fn new(spec: &Spec) -> Self {
        Self::with_precision(spec, Precision::Double)
    }

    /// Builds all nodes for numbers of a precision.
    pub fn with_precision(spec: &Spec, precision: Precision) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
        graph.is_single = precision == Precision::Single;
        if spec.is_serial() {
            let chain = Chain::new(&mut graph, spec);
            Self::from_kinematics(graph, spec, chain, Chain::machine)
        } else {
            let parts = Parts::new(&mut graph, spec);
            Self::from_kinematics(graph, spec, parts, |parts, g, spec, causes, [errors, _]| {
                let loops = ClosedLoops::new(g, spec, &parts, causes, errors);
                Machine::of_loops(loops, Inverse::new(g, spec))
            })
        }
    }

    /// Builds the nodes that chains and trees share, then the machine with its errors from its
    /// causes, the symbols of the errors and the errors of the sources.
    fn from_kinematics<K: Kinematics>(
        mut graph: Graph,
        spec: &Spec,
        mut kinematics: K,
        machine: impl FnOnce(K, &mut Graph, &Spec, &Causes, [&[Six]; 2]) -> Machine,
    ) -> Self {
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
        let leg_forces = loads.of_loops(g);
        let generalized_errors = sources::generalized_errors(g, spec, &effects);

        let zero = g.zero();
        let of_sums = kinematics.prepare_sums(g, spec).unwrap_or(margin);
        let errors: Vec<Six> = (0..spec.frames.len())
            .map(|i| std::array::from_fn(|k| g.symbol(Symbol::Error(6 * i + k))))
            .collect();
        let columns = vec![kinematics.displacement(g, &rows, &errors)];
        let displacement = Jacobian { columns, margin: of_sums };
        let columns = kinematics.covariance(g, &error_jacobian.columns, &errors);
        let covariance = Jacobian { columns, margin: of_sums };
        let mut two_ways = |errors: &[Vec<Six>]| {
            let sums = errors.iter().map(|errors| kinematics.displacement(g, &rows, errors)).collect();
            let product = |errors: &Vec<_>| by_source::product(g, &error_jacobian.columns, errors);
            let products = errors.iter().map(product).collect();
            [(sums, of_sums), (products, margin)].map(|(columns, margin)| Jacobian { columns, margin })
        };
        let predicted_displacement = two_ways(std::slice::from_ref(&generalized_errors));
        let source_displacements = two_ways(&by_source::errors_by_source(zero, spec, &effects));
        let machine = machine(kinematics, g, spec, &causes, [&errors, &generalized_errors]);
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
            leg_forces,
        }
    }
}
