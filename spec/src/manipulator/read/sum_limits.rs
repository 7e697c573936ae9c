//! Limits of sums of joint variables.

use abbe_core::SumLimit;

use super::declarations::Declarations;
use super::keys;
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Symbol};

/// Reads the `[[limit]]` tables.
pub(super) fn read_sum_limits(
    root: &Section<'_>,
    declarations: &Declarations,
    document: &mut Document,
) -> Vec<SumLimit> {
    let items = root.get("limit").and_then(|item| document.array_of_tables(&item, "limit"));
    let mut limits: Vec<SumLimit> = Vec::new();
    for (index, item) in items.unwrap_or_default().iter().enumerate() {
        let Some(mut section) = document.section(item) else { continue };
        section.name = format!("limit {}", index + 1);
        section.check_keys(&[&keys::LIMIT], document);
        limits.extend(read_sum_limit(&section, declarations, document));
    }
    limits
}

fn read_sum_limit(
    section: &Section<'_>,
    declarations: &Declarations,
    document: &mut Document,
) -> Option<SumLimit> {
    let item = section.required("sum", document)?;
    let text = document.string(&item)?;
    let entry = Entry { dimension: None, what: "the sum", names: Allowed::Geometry };
    let sum = document.expression(&item, &declarations.scope, entry)?;
    let dimension = sum.whole().dimension.unwrap_or(Dimension::NONE);
    let Some((terms, constant)) = weights(&sum, declarations) else {
        let mistake = Diagnostic::new(item.span(), "a limit needs a sum of joint variables")
            .label("not driven joints, each times a constant");
        return document.fail(mistake.help("write the sum as `a2 + a3` or `2*x1 - x2`"));
    };
    let [lower, upper] = match (section.get("limits"), section.get("equals")) {
        (Some(limits), None) => declarations.interval(&limits, dimension, document)?,
        (None, Some(value)) => {
            let entry = Entry { dimension: Some(dimension), what: "the sum", names: Allowed::Nothing };
            [document.constant(&value, &declarations.scope, entry)?.0; 2]
        }
        _ => {
            let message = format!("{} needs either `limits` or `equals`", section.name);
            let help = "write `limits = [SMALLEST, LARGEST]`, or `equals = 0` for joints that move together";
            return document.refuse(section.span.clone(), message, help);
        }
    };
    let range = [lower - constant, upper - constant];
    let limit = SumLimit { sum: text.as_str().into(), terms: terms.into_iter().collect(), range };
    let home: Vec<f64> = declarations.variables.iter().map(|variable| variable.home).collect();
    if !limit.permits(&home) {
        let message = format!("home is outside the limits of `{text}`");
        let label = format!("the sum is {} at home", limit.value(&home) + constant);
        let help = "give the variables a `home` that the limit permits; it is 0 if not given";
        return document.fail(Diagnostic::new(item.span(), message).label(label).help(help));
    }
    Some(limit)
}

/// Returns the weights of the variables in a linear expression, and its constant; `None` if it is
/// not linear, or depends on anything else.
fn weights(sum: &Expression, declarations: &Declarations) -> Option<(Vec<(usize, f64)>, f64)> {
    let mut variables = Vec::new();
    for symbol in sum.symbols() {
        let Symbol::Variable(variable) = symbol else { return None };
        variables.push(variable);
    }
    variables.sort_unstable();
    variables.dedup();
    let at = |q: &dyn Fn(usize) -> f64| {
        sum.value(&declarations.scope.tables, |symbol| match symbol {
            Symbol::Variable(variable) => q(variable),
            _ => 0.0,
        })
    };
    let constant = at(&|_| 0.0);
    let weight = |variable: &usize| (*variable, at(&|other| f64::from(other == *variable)) - constant);
    let terms = variables.iter().map(weight).filter(|(_, weight)| *weight != 0.0);
    let terms: Vec<(usize, f64)> = terms.collect();
    let is_linear = [-1.7, 0.3, 2.9].iter().all(|scale| {
        let value = |variable: usize| scale * (1.0 + 0.37 * variable as f64);
        let (mut linear, mut size) = (constant, constant.abs());
        for (variable, weight) in &terms {
            linear += weight * value(*variable);
            size += (weight * value(*variable)).abs();
        }
        (at(&value) - linear).abs() <= 1e-9 * size
    });
    (is_linear && !terms.is_empty()).then_some((terms, constant))
}
