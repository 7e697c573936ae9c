//! From where to where a workspace goes: the box that contains it.

use abbe::analysis::{Axis, BaseBox, Presentation};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Symbol;

use super::region::{Form, Region};
use crate::mistake;

/// From where to where a variable, parameter or input goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Which.
    pub symbol: Symbol,
    /// Both ends.
    pub range: [f64; 2],
}

impl Region {
    /// The box of joints, parameters and inputs that contains every configuration; what is not named stays at home and nominal.
    ///
    /// Joints that are solved for go through all of their limits, since nothing is known of them before. An error if one of
    /// those, or of the ones that are sampled, has no limits; `origin` is what messages call the spec.
    pub fn spans(&self, spec: &Spec, origin: &str) -> Result<Vec<Span>, Diagnostics> {
        let limits = |i: &usize| Span { symbol: Symbol::Variable(*i), range: spec.variables[*i].limits };
        let over = |symbol: fn(usize) -> Symbol| move |axis: &Axis| hull(symbol(axis.index), &axis.values);
        let mut spans: Vec<Span> = match &self.form {
            Form::Presented(Presentation { tool_points, approaches, solved, .. }) => {
                let points = tool_points.iter().map(over(Symbol::Parameter));
                let held = approaches.iter().map(over(Symbol::Variable));
                points.chain(held).chain(solved.iter().map(limits)).collect()
            }
            Form::Grid(axes) => axes.iter().map(over(Symbol::Variable)).collect(),
            Form::Samples { moved, .. } => moved.iter().map(limits).collect(),
            Form::Box(BaseBox { solved, .. }) => solved.iter().map(limits).collect(),
            Form::Path(path) => path.columns().map(|(symbol, values)| hull(symbol, &values)).collect(),
        };
        spans.extend(self.inputs.iter().map(over(Symbol::Input)));
        let sampled = self.sampled_inputs.iter();
        spans.extend(sampled.map(|i| Span { symbol: Symbol::Input(*i), range: spec.inputs[*i].range }));
        match spans.iter().find(|span| !span.range.iter().all(|end| end.is_finite())) {
            None => Ok(spans),
            Some(endless) => Err(mistake::with_help(
                origin,
                format!("`{}` has no limits: no box contains its values", name(endless.symbol, spec)),
                "give it `limits` in the spec, or a study whose workspace is a `grid`",
            )),
        }
    }

    /// Whether every value of the box is one that the workspace asks for, or lies between two of them.
    pub fn is_box(&self) -> bool {
        matches!(self.form, Form::Grid(_) | Form::Samples { .. })
    }
}

/// The name of a variable, parameter or input.
pub fn name(symbol: Symbol, spec: &Spec) -> &str {
    match symbol {
        Symbol::Variable(i) => &spec.variables[i].name,
        Symbol::Parameter(i) => &spec.parameters[i].name,
        Symbol::Input(i) => &spec.inputs[i].name,
        _ => "",
    }
}

fn hull(symbol: Symbol, values: &[f64]) -> Span {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Span { symbol, range: [least, largest] }
}
