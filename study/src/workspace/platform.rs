//! Joint variables of a platform on legs, from its pose.

use std::sync::Arc;

use abbe::analysis::Legs;
use abbe_codegen::chain::LoopEquations;
use abbe_codegen::graph::Graph;
use abbe_spec::expr::{Expression, Symbol};
use abbe_spec::{Closure, Factor, Spec};

/// Returns the joint variables as a function of the passive variables, in closed form: each loop is
/// a leg whose length is `… + q`, so that `q = |p_a − p_b| − …`.
///
/// Returns what is different from that for other machines.
pub(super) fn legs(spec: &Spec) -> Result<Legs, String> {
    let mut variables = Vec::new();
    for closed in &spec.loops {
        let leg = match &closed.closure {
            Closure::Distance(length) => leg(spec, length).filter(|leg| !variables.contains(leg)),
            Closure::Coordinates(_) => None,
        };
        let name = &closed.name;
        variables.push(leg.ok_or_else(|| format!("the loop \"{name}\" is not a leg of the length `… + q`"))?);
    }
    if let Some(free) = (0..spec.variables.len()).find(|i| !variables.contains(i)) {
        return Err(format!("`{}` is not the length of a leg", spec.variables[free].name));
    }
    let factors = spec.frames.iter().flat_map(|frame| &frame.factors).chain(&spec.tool);
    let mut symbols = factors.flat_map(Factor::expressions).flat_map(|expression| expression.symbols());
    if symbols.any(|symbol| matches!(symbol, Symbol::Variable(_))) {
        return Err("frames move with the variables of legs".to_owned());
    }
    let (equations, count) = (LoopEquations::new(spec), spec.variables.len());
    Ok(Legs(Arc::new(move |p, s| {
        let lengths = equations.residual_at(&vec![0.0; count], p, s);
        let mut q = vec![0.0; count];
        for (variable, length) in variables.iter().zip(lengths) {
            q[*variable] = length;
        }
        q
    })))
}

/// Returns the variable of a leg whose length is a constant plus this variable.
fn leg(spec: &Spec, length: &Expression) -> Option<usize> {
    let mut graph = Graph::with_tables(&spec.tables);
    let length = graph.lower(length);
    let mut rate = |variable: usize| {
        let rate = graph.diff(length, Symbol::Variable(variable));
        graph.value(rate)
    };
    let rates: Vec<Option<f64>> = (0..spec.variables.len()).map(&mut rate).collect();
    let mut moved = (0..rates.len()).filter(|i| rates[*i] != Some(0.0));
    let first = moved.next().filter(|i| rates[*i] == Some(1.0));
    first.filter(|_| moved.next().is_none())
}
