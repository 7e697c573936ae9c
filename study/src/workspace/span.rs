//! Computes the box that encloses a workspace.

use abbe::analysis::{Axis, BaseBox, Presentation};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Symbol;

use super::region::{Form, Region};
use crate::mistake;

/// Range of a variable, parameter or input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Symbol with the range.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Region {
    /// Returns the box of joints, parameters and inputs that contains every configuration. Symbols
    /// without a span stay at home or nominal.
    ///
    /// Joints that are solved for span their whole limits, because their values are not known in
    /// advance. Returns an error if such a joint, or one that is sampled, has no limits. `origin`
    /// is the name of the spec in messages.
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
                format!(
                    "`{}` has no limits, so the box of its values is infinite",
                    spec.name_of(endless.symbol)
                ),
                "add `limits` in the spec, or use a study whose workspace is a `grid`",
            )),
        }
    }

    /// Returns true if the workspace fills its box: every value of the box is in the workspace, or
    /// between two values of it.
    pub fn is_box(&self) -> bool {
        matches!(self.form, Form::Grid(_) | Form::Samples { .. })
    }
}

fn hull(symbol: Symbol, values: &[f64]) -> Span {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Span { symbol, range: [least, largest] }
}
