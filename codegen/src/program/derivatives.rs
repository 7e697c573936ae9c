//! Derivatives of the results of a function by the structural parameters.

use abbe_core::{Function, function::Count};
use abbe_spec::{Spec, Symbol};

use super::{Array, Program, Role, Routine, results, routines::at_once};
use crate::chain::{Model, passive_by_symbol};
use crate::graph::Node;

/// Returns a routine that takes the arguments of a function and fills one array: for each
/// parameter s, the derivatives of all results f, in their order. Passive variables p change with
/// the parameters so that the loops stay closed:
///
/// ```text
/// df/ds = ∂f/∂s + Σ_j ∂f/∂p_j ∂p_j/∂s        ∂p/∂s = −φ_p⁻¹ φ_s
/// ```
///
/// Returns `None` for poses with errors of machines with loops, whose passive variables are others.
pub fn parameter_derivatives(spec: &Spec, function: Function) -> Option<Routine> {
    let has_errors = matches!(function, Function::RealPose | Function::DrawnPose | Function::DisplacedPose);
    if has_errors && !spec.loops.is_empty() {
        return None;
    }
    let mut model = Model::new(spec);
    let nodes = results(function, &model).0.concat();
    let graph = &mut model.graph;
    let count = spec.parameters.len();
    let rates: Vec<Vec<Node>> =
        (0..count).map(|i| passive_by_symbol(graph, spec, Symbol::Parameter(i))).collect();
    graph.forget_equal();
    let by_passive: Vec<Vec<Node>> =
        (0..spec.passive.len()).map(|j| graph.diff_all(&nodes, Symbol::Local(j))).collect();
    let mut derivatives = Vec::new();
    for (i, rates) in rates.iter().enumerate() {
        for (k, direct) in graph.diff_all(&nodes, Symbol::Parameter(i)).into_iter().enumerate() {
            let parts: Vec<Node> =
                by_passive.iter().zip(rates).map(|(by, rate)| graph.mul(by[k], *rate)).collect();
            derivatives.push(parts.into_iter().fold(direct, |sum, part| graph.add(sum, part)));
        }
    }
    let program = Program::new(graph, &derivatives);
    let arguments = function.signature().arguments.iter();
    let arguments =
        arguments.map(|array| Array { name: array.name, shape: array.shape.to_vec(), role: Role::Argument });
    let shape = vec![Count::Exactly(count), Count::Exactly(nodes.len())];
    let filled = Array { name: "derivatives", shape, role: Role::Result };
    let mut arrays: Vec<Array> = arguments.chain([filled]).collect();
    let stages = at_once(&model, &mut arrays, program);
    Some(Routine {
        function: None,
        name: "parameter_derivatives",
        documentation: "",
        arrays,
        stages,
        operations: Default::default(),
    })
}
