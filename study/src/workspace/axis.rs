//! Values of a variable, a parameter or an input.
//!
//! Reads constants with units and converts them to the coherent units of the spec.

use std::ops::Range;

use abbe::analysis::{Axis, sampling};
use abbe::{LengthUnit, VariableKind};
use abbe_spec::expr::{Dimension, Scope};
use abbe_spec::value::find_name;
use abbe_spec::{Diagnostic, Document, Item, Spec, Variable};

use super::keys;
use crate::number;

/// Largest number of values of an axis, because they are stored.
const VALUES: usize = 10_000_000;

/// Symbols that can be an axis.
pub struct Candidates<'a> {
    /// Kind of the symbols: `variable`, `parameter` or `input`.
    pub(super) what: &'static str,
    list: Vec<Candidate<'a>>,
}

/// Symbol that can be an axis.
struct Candidate<'a> {
    name: &'a str,
    dimension: Dimension,
    unit: Unit<'a>,
    /// `limits` or `range`, and its ends; infinite if there are none.
    within: (&'static str, [f64; 2]),
}

/// Unit for the display of values.
enum Unit<'a> {
    Joint(VariableKind, LengthUnit),
    Coherent(&'a str),
}

impl<'a> Candidates<'a> {
    /// Returns the variables of a spec.
    pub fn variables(spec: &'a Spec) -> Self {
        Self::joints(&spec.variables, spec.length)
    }

    fn joints(variables: &'a [Variable], length: LengthUnit) -> Self {
        let list = variables.iter().map(|variable| Candidate {
            name: &variable.name,
            dimension: variable.kind.either(Dimension::NONE, Dimension::LENGTH),
            unit: Unit::Joint(variable.kind, length),
            within: ("limits", variable.limits),
        });
        Self { what: "variable", list: list.collect() }
    }

    pub(super) fn parameters(spec: &'a Spec) -> Self {
        let list = spec.parameters.iter().map(|parameter| Candidate {
            name: &parameter.name,
            dimension: parameter.dimension,
            unit: Unit::Coherent(&parameter.unit),
            within: ("range", [f64::NEG_INFINITY, f64::INFINITY]),
        });
        Self { what: "parameter", list: list.collect() }
    }

    /// Returns the inputs of a spec.
    pub fn inputs(spec: &'a Spec) -> Self {
        let list = spec.inputs.iter().map(|input| Candidate {
            name: &input.name,
            dimension: input.dimension,
            unit: Unit::Coherent(&input.unit),
            within: ("range", input.range),
        });
        Self { what: "input", list: list.collect() }
    }

    /// Returns the variables of a spec, then its inputs.
    pub(super) fn variables_and_inputs(spec: &'a Spec) -> Self {
        let mut all = Self::variables(spec);
        all.list.extend(Self::inputs(spec).list);
        let what = if spec.inputs.is_empty() { "variable" } else { "variable or input" };
        Self { what, ..all }
    }

    /// Returns the passive variables of a spec, then its inputs.
    pub(super) fn passive_and_inputs(spec: &'a Spec) -> Self {
        let mut all = Self::joints(&spec.passive, spec.length);
        all.list.extend(Self::inputs(spec).list);
        Self { what: "passive variable", ..all }
    }

    /// Removes the limits: values beyond them count as unreachable instead of invalid.
    pub(super) fn unlimited(mut self) -> Self {
        self.list.iter_mut().for_each(|candidate| candidate.within.1 = [f64::NEG_INFINITY, f64::INFINITY]);
        self
    }

    fn find(&self, document: &Document, span: Range<usize>, name: &str) -> Option<usize> {
        let names = self.list.iter().map(|candidate| candidate.name).collect::<Vec<_>>();
        find_name(document, span, name, &names, self.what)
    }

    /// Reads a table of axes, `NAME = VALUES` each.
    pub fn axes(&self, item: &Item<'_>) -> Vec<Axis> {
        let Some(section) = item.section() else { return Vec::new() };
        let mut axes = Vec::new();
        for item in section.items() {
            let Some(index) = self.find(item.document, item.key_span.clone(), &item.key) else { continue };
            let candidate = &self.list[index];
            if let Some(mut values) = values(&item, candidate.dimension) {
                candidate.round_to_ends(&mut values);
                candidate.require_within(&values, &item);
                axes.push(Axis { index, values });
            }
        }
        axes
    }

    /// Reads a list of names as indices.
    pub(super) fn list(&self, item: &Item<'_>) -> Vec<usize> {
        let items = item.array(&format!("a list of names, each a {}", self.what)).unwrap_or_default();
        let mut indices = Vec::new();
        for item in items {
            let Some(name) = item.string() else { continue };
            let index = self.find(item.document, item.span(), &name);
            if index.is_some_and(|index| indices.contains(&index)) {
                let mistake = Diagnostic::new(item.span(), format!("duplicate name `{name}`"));
                item.document.mistake(mistake.help("remove one of them"));
            }
            indices.extend(index);
        }
        indices
    }
}

impl Candidate<'_> {
    /// Replaces values that differ from an end only by rounding: `-0.0908884 m` is not
    /// `-90.8884 mm` to the last digit.
    fn round_to_ends(&self, values: &mut [f64]) {
        for value in values {
            for end in self.within.1 {
                if (*value - end).abs() <= 1e-12 * value.abs() {
                    *value = end;
                }
            }
        }
    }

    /// Reports values outside the limits or the range as a mistake, because the machine does not
    /// work there.
    fn require_within(&self, values: &[f64], item: &Item<'_>) {
        let (what, [lower, upper]) = self.within;
        let Some(outside) = values.iter().find(|value| !(lower..=upper).contains(*value)) else { return };
        let message = format!("`{}` exceeds its {what}", self.name);
        let label = format!("{} is requested here", self.show(*outside));
        let help = format!(
            "its {what} in the spec: {} … {}; use values within, or change the spec",
            self.show(lower),
            self.show(upper)
        );
        item.document.mistake(Diagnostic::new(item.span(), message).label(label).help(help));
    }

    fn show(&self, value: f64) -> String {
        match self.unit {
            Unit::Joint(kind, length) => number::of_variable(value, kind, length),
            Unit::Coherent(unit) => number::quantity(value, unit),
        }
    }
}

/// Reads `[1, 2, 5]`, `{ from = 0, to = 10, count = 3 }` or `{ from = 0, to = 10, step = 5 }`.
pub(super) fn values(item: &Item<'_>, dimension: Dimension) -> Option<Vec<f64>> {
    let what = format!("a value of `{}`", item.key);
    if !item.is_table() {
        let items = item.array("a list of values, or { from, to, count } or { from, to, step }")?;
        let values = items.iter().filter_map(|item| constant(item, dimension, &what));
        let values = values.collect::<Vec<_>>();
        if items.is_empty() {
            let mistake = Diagnostic::new(item.span(), format!("`{}` has no values", item.key));
            item.document.mistake(mistake.help("give at least one value"));
        }
        return (values.len() == items.len() && !items.is_empty()).then_some(values);
    }
    let section = item.table(format!("the range of `{}`", item.key), &[&keys::VALUES])?;
    let end = |key: &str| constant(&section.required(key)?, dimension, &what);
    let (from, to) = (end("from"), end("to"));
    match (section.get("count"), section.get("step")) {
        (Some(counted), None) => Some(sampling::grid([from?, to?], count(&counted, VALUES)?)),
        (None, Some(item)) => stepped([from?, to?], constant(&item, dimension, "a step")?, &item),
        _ => {
            let message = format!("{} needs either `count` or `step`", section.name);
            item.document.refuse(section.span.clone(), message, "add `count`, such as `count = 5`")
        }
    }
}

/// Returns equal steps from one end to the other, both ends included.
fn stepped([from, to]: [f64; 2], step: f64, item: &Item<'_>) -> Option<Vec<f64>> {
    let steps = ((to - from) / step).abs();
    let mistake = if step <= 0.0 {
        "a step must be positive".to_owned()
    } else if steps.is_nan() || steps >= VALUES as f64 {
        format!("this step makes more than {VALUES} values")
    } else if (steps - steps.round()).abs() > 1e-6 {
        "this step does not reach `to`".to_owned()
    } else {
        return Some(sampling::grid([from, to], steps.round() as usize + 1));
    };
    item.refuse(mistake, "or write `count`, which includes both ends")
}

/// Reads a constant of a dimension.
pub fn constant(item: &Item<'_>, dimension: Dimension, what: &str) -> Option<f64> {
    item.amount(&Scope::new(item.document.length), dimension, what)
}

/// Reads a quantity above zero.
pub fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value > 0.0 {
        return Some(value);
    }
    let mistake = Diagnostic::new(item.span(), format!("`{}` must be positive", item.key));
    item.document.fail(mistake.label("zero or negative").help("remove it if there is none"))
}

/// Reads a whole number from 1 to `largest`.
pub fn count(item: &Item<'_>, largest: usize) -> Option<usize> {
    whole(item, [1, largest])
}

/// Reads a whole number within limits.
pub fn whole(item: &Item<'_>, [least, largest]: [usize; 2]) -> Option<usize> {
    let value = item.quantity(Dimension::NONE)?;
    if value.fract() == 0.0 && (least as f64..=largest as f64).contains(&value) {
        return Some(value as usize);
    }
    let message = format!("`{}` must be an integer from {least} to {largest}", item.key);
    let mistake = Diagnostic::new(item.span(), message).label("not such an integer");
    item.document.fail(mistake.help("write a number such as 100"))
}
