//! The values that a variable or a parameter goes through.

use abbe::analysis::{Axis, sampling};
use abbe_codegen::diagnostic::Diagnostic;
use abbe_codegen::document::{Document, Item};
use abbe_codegen::expr::{Dimension, find_name};
use abbe_codegen::spec::{Spec, VariableKind};

use super::constant::{constant, count};
use super::keys;

/// The most values of an axis: they are stored.
const VALUES: usize = 10_000_000;

/// What can be an axis, with its dimensions.
pub struct Candidates<'a> {
    /// `variable` or `parameter`.
    pub(super) what: &'static str,
    names: Vec<&'a str>,
    dimensions: Vec<Dimension>,
}

impl<'a> Candidates<'a> {
    /// The variables of a spec.
    pub fn variables(spec: &'a Spec) -> Self {
        let dimension = |kind| match kind {
            VariableKind::Revolute => Dimension::NONE,
            VariableKind::Prismatic => Dimension::LENGTH,
        };
        Self {
            what: "variable",
            names: spec.variables.iter().map(|variable| variable.name.as_str()).collect(),
            dimensions: spec.variables.iter().map(|variable| dimension(variable.kind)).collect(),
        }
    }

    pub(super) fn parameters(spec: &'a Spec) -> Self {
        Self {
            what: "parameter",
            names: spec.parameters.iter().map(|parameter| parameter.name.as_str()).collect(),
            dimensions: spec.parameters.iter().map(|parameter| parameter.dimension).collect(),
        }
    }

    /// The inputs of a spec.
    pub fn inputs(spec: &'a Spec) -> Self {
        Self {
            what: "input",
            names: spec.inputs.iter().map(|input| input.name.as_str()).collect(),
            dimensions: spec.inputs.iter().map(|input| input.dimension).collect(),
        }
    }

    /// A table of axes, `NAME = VALUES` each.
    pub fn axes(&self, item: &Item<'_>, document: &mut Document, spec: &Spec) -> Vec<Axis> {
        let Some(section) = document.section(item) else { return Vec::new() };
        let mut axes = Vec::new();
        for item in section.items() {
            let index = find_name(document, item.key_span.clone(), &item.key, &self.names, self.what);
            let Some(index) = index else { continue };
            let values = values(&item, document, spec, self.dimensions[index]);
            axes.extend(values.map(|values| Axis { index, values }));
        }
        axes
    }

    /// A list of names, as indices.
    pub(super) fn list(&self, item: &Item<'_>, document: &mut Document) -> Vec<usize> {
        let items = document.array(item, "a list of names of variables").unwrap_or_default();
        let mut indices = Vec::new();
        for item in items {
            let Some(name) = document.string(&item) else { continue };
            let index = find_name(document, item.span(), &name, &self.names, self.what);
            if index.is_some_and(|index| indices.contains(&index)) {
                document.mistake(
                    Diagnostic::new(item.span(), format!("`{name}` stands here twice"))
                        .help("keep one of them"),
                );
            }
            indices.extend(index);
        }
        indices
    }
}

/// `[1, 2, 5]`, `{ from = 0, to = 10, count = 3 }` or `{ from = 0, to = 10, step = 5 }`.
pub(super) fn values(
    item: &Item<'_>,
    document: &mut Document,
    spec: &Spec,
    dimension: Dimension,
) -> Option<Vec<f64>> {
    let what = format!("a value of `{}`", item.key);
    if !item.is_table() {
        let items = document.array(item, "a list of values, or { from, to, count } or { from, to, step }")?;
        let values = items.iter().filter_map(|item| constant(item, document, spec, dimension, &what));
        let values = values.collect::<Vec<_>>();
        if items.is_empty() {
            document.mistake(
                Diagnostic::new(item.span(), format!("`{}` has no values", item.key))
                    .help("give at least one value"),
            );
        }
        return (values.len() == items.len() && !items.is_empty()).then_some(values);
    }
    let mut section = document.section(item)?;
    section.name = format!("the range of `{}`", item.key);
    section.check_keys(&[&keys::VALUES], document);
    let mut end = |key: &str| {
        let end = section.required(key, document)?;
        constant(&end, document, spec, dimension, &what)
    };
    let (from, to) = (end("from"), end("to"));
    match (section.get("count"), section.get("step")) {
        (Some(counted), None) => {
            let count = count(&counted, VALUES, document, spec)?;
            Some(sampling::grid([from?, to?], count))
        }
        (None, Some(item)) => {
            let step = constant(&item, document, spec, dimension, "a step")?;
            stepped([from?, to?], step, &item, document)
        }
        _ => {
            let message = format!("{} needs either `count` or `step`", section.name);
            document.mistake(Diagnostic::new(section.span.clone(), message).help("add `count = 5`, say"));
            None
        }
    }
}

/// From one end to the other in equal steps, both ends included.
fn stepped([from, to]: [f64; 2], step: f64, item: &Item<'_>, document: &mut Document) -> Option<Vec<f64>> {
    let steps = ((to - from) / step).abs();
    let mistake = if step <= 0.0 {
        "a step must be more than zero".to_owned()
    } else if steps.is_nan() || steps >= VALUES as f64 {
        format!("this step makes more than {VALUES} values")
    } else if (steps - steps.round()).abs() > 1e-6 {
        "this step does not end at `to`".to_owned()
    } else {
        return Some(sampling::grid([from, to], steps.round() as usize + 1));
    };
    document.mistake(Diagnostic::new(item.span(), mistake).help("or give `count`, both ends included"));
    None
}
