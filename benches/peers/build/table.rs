//! The common input of all generators: the entries of `A_1 … A_n` and the tool, from the spec.

use abbe_codegen::chain::Model;
use abbe_codegen::graph::{Frame, Graph, Node, Op};
use abbe_spec::Spec;
use abbe_spec::expr::{Function, Symbol};
use serde_json::{Value, json};

/// Returns the names of the variables, and the upper three rows of every matrix as Python
/// expressions.
pub fn table(spec: &Spec) -> Value {
    let model = Model::new(spec);
    let rows = |frame: &Frame| -> Vec<Vec<String>> {
        (0..3)
            .map(|row| {
                let axes = frame.axes.iter().map(|axis| axis[row]);
                axes.chain([frame.position[row]]).map(|node| expression(&model.graph, spec, node)).collect()
            })
            .collect()
    };
    json!({
        "name": spec.name,
        "variables": spec.variables.iter().map(|variable| &variable.name).collect::<Vec<_>>(),
        "transforms": model.transforms.iter().map(rows).collect::<Vec<_>>(),
    })
}

fn expression(graph: &Graph, spec: &Spec, node: Node) -> String {
    let text = |node| expression(graph, spec, node);
    match graph.op(node) {
        // Integers are written without a fraction, so that 0 and 1 are recognized everywhere.
        Op::Constant(bits) => format!("{}", f64::from_bits(bits)),
        Op::Symbol(Symbol::Variable(index)) => spec.variables[index].name.clone(),
        Op::Neg(a) => format!("(-{})", text(a)),
        Op::Add(a, b) => format!("({} + {})", text(a), text(b)),
        Op::Sub(a, b) => format!("({} - {})", text(a), text(b)),
        Op::Mul(a, b) => format!("({} * {})", text(a), text(b)),
        Op::Call(Function::Sin, a) => format!("sin({})", text(a)),
        Op::Call(Function::Cos, a) => format!("cos({})", text(a)),
        other => panic!("{}: the generators are not told of {other:?}", spec.name),
    }
}
