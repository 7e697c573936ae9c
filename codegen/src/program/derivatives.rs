//! Derivatives of the results of a function by the structural parameters.

use abbe_core::Function;
use abbe_core::function::Count;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::Program;
use super::outputs::results;
use super::routine::{Array, ArrayRows, Block, Role, Routine, Row, Stage};
use crate::chain::Model;

/// Returns a routine that takes the arguments of a function of a chain and fills one array: for
/// each parameter, the derivatives of all results, in their order. Returns `None` for frames that
/// branch.
pub fn parameter_derivatives(spec: &Spec, function: Function) -> Option<Routine> {
    let model = Model::new(spec);
    if model.loops.is_some() {
        return None;
    }
    let nodes = results(function, &model).0.concat();
    let mut graph = model.graph;
    graph.forget_equal();
    let count = spec.parameters.len();
    let derivatives: Vec<_> = (0..count).flat_map(|i| graph.diff_all(&nodes, Symbol::Parameter(i))).collect();
    let program = Program::new(&graph, &derivatives);
    let arguments = function.signature().arguments.iter();
    let arguments =
        arguments.map(|array| Array { name: array.name, shape: array.shape.to_vec(), role: Role::Argument });
    let shape = vec![Count::Exactly(count), Count::Exactly(nodes.len())];
    let filled = Array { name: "derivatives", shape, role: Role::Result };
    let arrays: Vec<Array> = arguments.chain([filled]).collect();
    let writes = vec![ArrayRows { array: arrays.len() - 1, row: Row::All }];
    let block = Block { reads: Vec::new(), program, writes, repeated: None };
    Some(Routine {
        function: None,
        name: "parameter_derivatives",
        documentation: "",
        arrays,
        stages: vec![Stage::Block(block)],
        operations: Default::default(),
    })
}
