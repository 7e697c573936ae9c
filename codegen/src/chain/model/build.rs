//! The model of a chain of frames.

use abbe_core::Class;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::names::{name, name_lengths};
use super::{Jacobian, Model, is_long};
use crate::chain::accumulate::{Accumulated, Links};
use crate::chain::by_source;
use crate::chain::covariance::Covariance;
use crate::chain::displacement::Displacement;
use crate::chain::elastic::Loads;
use crate::chain::equivalent_forms::EquivalentForms;
use crate::chain::error_jacobian;
use crate::chain::inverse::Inverse;
use crate::chain::local_twist::local_twists;
use crate::chain::moments::Moments;
use crate::chain::origin_form;
use crate::chain::real::RealChain;
use crate::chain::rows::Rows;
use crate::chain::sources;
use crate::chain::symbol_jacobian;
use crate::chain::tree;
use crate::chain::walk::{Step, transform, walk};
use crate::graph::{Frame, Graph, Node, Vector};

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
                origin_form::equate(g, &links, errors);
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
        let inverse = Inverse::new(g, spec);
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
            inverse,
            loops: None,
        }
    }
}
