//! The model of a tree of frames.

use abbe_core::Component;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::loops::ClosedLoops;
use super::parts::Parts;
use crate::chain::by_source;
use crate::chain::elastic::Loads;
use crate::chain::model::names::{name, name_lengths};
use crate::chain::rows::Rows;
use crate::chain::{Jacobian, Model, sources, transform};
use crate::graph::{Graph, Node, Vector};

/// Builds all nodes of a tree of frames. This cannot fail for a checked spec.
pub(crate) fn model(spec: &Spec) -> Model {
    let mut graph = Graph::with_tables(&spec.tables);
    let g = &mut graph;
    let parts = Parts::new(g, spec);
    let frames = parts.whole.frames().to_vec();
    let tool = *parts.whole.pose(Some(parts.whole.tool()));
    for (i, frame) in frames.iter().enumerate() {
        name(g, frame, &(i + 1).to_string());
        name_lengths(g, &spec.frames[i].factors, &(i + 1).to_string());
    }
    name(g, &tool, "t");
    name_lengths(g, &spec.tool, "t");

    let rows = Rows::new(g, spec.orientation, tool.axes[spec.orientation.last_axis().unwrap_or(0)]);
    let margin = rows.margin();
    let mut columns = Vec::new();
    for frame in 0..frames.len() {
        for component in Component::ALL {
            let [velocity, rotation] = parts.by_error(g, frame, component);
            columns.push(rows.column(g, velocity, rotation));
        }
    }
    let distinct = columns.chunks_exact(6).map(<[_]>::concat).collect();
    let error_jacobian = Jacobian { columns, margin };
    let jacobian = |g: &mut Graph, symbols: Vec<Symbol>| {
        let twists: Vec<[Vector; 2]> = symbols.into_iter().map(|symbol| parts.by_symbol(g, symbol)).collect();
        let columns = twists.iter().map(|[velocity, turn]| rows.column(g, *velocity, *turn)).collect();
        (twists, Jacobian { columns, margin })
    };
    let (twists, joint_jacobian) = jacobian(g, (0..spec.variables.len()).map(Symbol::Variable).collect());
    let (_, parameter_jacobian) = jacobian(g, (0..spec.parameters.len()).map(Symbol::Parameter).collect());
    let joint_twists = twists.into_iter().map(|[[x, y, z], [a, b, c]]| [x, y, z, a, b, c]).collect();

    let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
    let transforms = factors.map(|factors| transform(g, factors)).collect();
    let axes = g.identity().axes;
    let loads = Loads::new(g, spec, &frames, &axes);
    let (effects, causes) = sources::effects_in(g, spec, |_| &loads);
    let generalized_errors = sources::generalized_errors(g, spec, &effects);

    let symbols: Vec<[Node; 6]> =
        (0..frames.len()).map(|i| std::array::from_fn(|k| g.symbol(Symbol::Error(6 * i + k)))).collect();
    let displaced = |g: &mut Graph, errors: &[[Node; 6]]| {
        let [velocity, rotation] = parts.by_errors(g, errors);
        rows.column(g, velocity, rotation)
    };
    let displacement = Jacobian { columns: vec![displaced(g, &symbols)], margin };
    let covariance =
        Jacobian { columns: covariance(g, &error_jacobian.columns, symbols.as_flattened()), margin };
    let two_forms = |g: &mut Graph, errors: &[Vec<[Node; 6]>]| {
        let summed = errors.iter().map(|errors| displaced(g, errors)).collect();
        let product = |errors: &Vec<_>| by_source::product(g, &error_jacobian.columns, errors);
        let products = errors.iter().map(product).collect();
        [summed, products].map(|columns| Jacobian { columns, margin })
    };
    let predicted_displacement = two_forms(g, std::slice::from_ref(&generalized_errors));
    let zero = g.zero();
    let source_displacements = two_forms(g, &by_source::errors_by_source(zero, spec, &effects));
    let loops = ClosedLoops::new(g, spec, &parts, &causes, &symbols);
    let (real_pose, drawn_pose) = (loops.real.pose, loops.drawn.pose);
    Model {
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
        real_errors: None,
        drawn_errors: Vec::new(),
        joint_twists,
        joint_local_twists: Vec::new(),
        parameter_local_twists: Vec::new(),
        inverse: None,
        loops: Some(loops),
        graph,
    }
}

/// Returns the columns of `J_e diag(σ²) J_eᵀ`.
fn covariance(graph: &mut Graph, columns: &[[Node; 6]], variances: &[Node]) -> Vec<[Node; 6]> {
    let mut sums = vec![[graph.zero(); 6]; 6];
    for (column, variance) in columns.iter().zip(variances) {
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
