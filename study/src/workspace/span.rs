//! Computes the box that encloses a workspace.

use abbe::Manipulator;
use abbe::analysis::sampling::range_of;
use abbe::analysis::{Axis, BaseBox, Presentation};
use abbe_spec::{Spec, expr::Symbol};

use super::region::{Form, Region};
use crate::{Result, mistake};

/// Largest number of configurations from which the ranges of joints that are solved for are
/// computed.
const SOLVED: usize = 10_000;

/// Range of a variable, parameter or input, or of a passive variable that is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Symbol with the range.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Region {
    /// Returns the smallest and the largest value of a parameter that the workspace varies.
    pub fn parameter_range(&self, parameter: usize) -> Option<[f64; 2]> {
        let symbol = Symbol::Parameter(parameter);
        let span = match &self.form {
            Form::Presented(Presentation { tool_points, .. }) => {
                hull(symbol, &tool_points.iter().find(|axis| axis.index == parameter)?.values)
            }
            Form::Path(path) => hull(symbol, &path.columns().find(|(column, _)| *column == symbol)?.1),
            _ => return None,
        };
        Some(span.range).filter(|[lower, upper]| lower < upper)
    }

    /// Returns `true` if passive variables are given, and joint variables follow from them.
    pub fn is_platform(&self) -> bool {
        matches!(self.form, Form::Platform(..))
    }

    /// Returns the box of joints, parameters and inputs that contains every configuration. Symbols
    /// without a span stay at home or nominal.
    ///
    /// Joints that are solved for span the values at which the configurations are reached; their
    /// whole limits if none are, or if there are more than 10,000 to solve for. Returns an
    /// error if such a joint, or one that is sampled, has no limits. `origin` is the name of the
    /// spec in messages.
    pub fn spans(&self, spec: &Spec, manipulator: &dyn Manipulator, origin: &str) -> Result<Vec<Span>> {
        let limits = |i: &usize| Span { symbol: Symbol::Variable(*i), range: spec.variables[*i].limits };
        let over = |symbol: fn(usize) -> Symbol| move |axis: &Axis| hull(symbol(axis.index), &axis.values);
        let reached = |solved: &[usize]| {
            self.reached(manipulator, solved).unwrap_or_else(|| solved.iter().map(limits).collect())
        };
        let mut spans: Vec<Span> = match &self.form {
            Form::Presented(Presentation { tool_points, approaches, solved, .. }) => {
                let points = tool_points.iter().map(over(Symbol::Parameter));
                points.chain(approaches.iter().map(over(Symbol::Variable))).chain(reached(solved)).collect()
            }
            Form::Grid(axes) => axes.iter().map(over(Symbol::Variable)).collect(),
            Form::Samples { moved, .. } => moved.iter().map(limits).collect(),
            Form::Box(BaseBox { approaches, solved, .. }) => {
                approaches.iter().map(over(Symbol::Variable)).chain(reached(solved)).collect()
            }
            Form::Platform(axes, _) => axes.iter().map(over(Symbol::Passive)).collect(),
            Form::Path(path) => path.columns().map(|(symbol, values)| hull(symbol, &values)).collect(),
            Form::One(q) => {
                let joint = |(i, value): (usize, &f64)| hull(Symbol::Variable(i), &[*value]);
                q.iter().enumerate().map(joint).collect()
            }
        };
        let fixed = spec.sum_limits.iter().filter(|limit| limit.range[0] == limit.range[1]);
        let of_sums = fixed.flat_map(|limit| limit.terms.iter().map(|(variable, _)| *variable));
        let is_known = |i: &usize| spans.iter().any(|span| span.symbol == Symbol::Variable(*i));
        // Joints that follow others move, too.
        let mut followers: Vec<usize> = of_sums.filter(|i| !is_known(i)).collect();
        followers.sort_unstable();
        followers.dedup();
        if !followers.is_empty() {
            spans.extend(reached(&followers));
        }
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

    /// Returns the ranges of joints that are solved for over the configurations that are reached.
    fn reached(&self, manipulator: &dyn Manipulator, solved: &[usize]) -> Option<Vec<Span>> {
        let nominal = Self { inputs: Vec::new(), ..self.clone() };
        if nominal.count()? > SOLVED {
            return None;
        }
        let reached = nominal.workspace(manipulator, None).ok()?.reached();
        reached.first()?;
        let span = |i: &usize| {
            let values = reached.iter().map(|configuration| configuration.q[*i]).collect::<Vec<_>>();
            hull(Symbol::Variable(*i), &values)
        };
        Some(solved.iter().map(span).collect())
    }

    /// Returns true if the workspace fills its box: every value of the box is in the workspace, or
    /// between two values of it.
    pub fn is_box(&self, spec: &Spec) -> bool {
        let is_filled = matches!(self.form, Form::Grid(_) | Form::Samples { .. } | Form::One(_));
        is_filled && spec.sum_limits.is_empty() && spec.inputs.iter().all(|input| input.levels.is_empty())
    }
}

fn hull(symbol: Symbol, values: &[f64]) -> Span {
    Span { symbol, range: range_of(values.iter().copied()) }
}
