//! Limits of sums of joint variables.

use abbe_core::{SumLimit, VariableKind};

use super::{Declarations, keys};
use crate::degrees::check_angle_item;
use crate::diagnostic::Diagnostic;
use crate::document::Section;
use crate::expr::{Allowed, Dimension, Entry, Expression, Symbol};

/// Maximum number of limits.
const MOST: usize = 100;

/// Reads the `[[limit]]` tables.
pub(super) fn read_sum_limits(root: &Section<'_>, declarations: &Declarations) -> Vec<SumLimit> {
    let help = "keep those that configurations can exceed within the limits of each joint";
    let mut limits: Vec<SumLimit> = Vec::new();
    for (index, item) in root.tables("limit", MOST, help).iter().enumerate() {
        let section = item.table(format!("limit {}", index + 1), &[&keys::LIMIT]);
        limits.extend(section.and_then(|section| read_sum_limit(&section, declarations)));
    }
    limits
}

fn read_sum_limit(section: &Section<'_>, declarations: &Declarations) -> Option<SumLimit> {
    let item = section.required("sum")?;
    let text = item.string()?;
    let sum = item.expression(&declarations.scope, Entry::new(None, "the sum", Allowed::Geometry))?;
    let dimension = sum.whole().dimension.unwrap_or(Dimension::NONE);
    let Some(terms) = weights(&sum, declarations) else {
        let mistake = Diagnostic::new(item.span(), "a limit needs a sum of joint variables")
            .label("not driven joints, each times a constant, and nothing else");
        return section.document.fail(mistake.help("write the sum as `a2 + a3` or `2*x1 - x2`"));
    };
    let kind = if dimension == Dimension::NONE { VariableKind::Revolute } else { VariableKind::Prismatic };
    let ends = section.items().filter(|item| item.key != "sum");
    let ends = ends.flat_map(|item| if item.is_list() { item.list() } else { vec![item] });
    let of_angles = ends.collect::<Vec<_>>().into_iter().filter(|_| kind == VariableKind::Revolute);
    let doubted = of_angles.filter(|end| check_angle_item(end, &format!("a limit of `{text}`")));
    if doubted.count() > 0 {
        return None;
    }
    let [lower, upper] = match (section.get("limits"), section.get("equals")) {
        (Some(limits), None) => declarations.interval(&limits, dimension)?,
        (None, Some(value)) => [value.amount(&declarations.scope, dimension, "the sum")?; 2],
        _ => {
            let message = format!("{} needs either `limits` or `equals`", section.name);
            let help = "write `limits = [SMALLEST, LARGEST]`, or `equals = 0` for joints that move together";
            return section.refuse(message, help);
        }
    };
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let (sum, terms) = (text.as_str().into(), terms.into_iter().collect());
    let limit = SumLimit { sum, kind, terms, range: [lower, upper] };
    let home: Vec<f64> = declarations.variables.iter().map(|variable| variable.home).collect();
    if !limit.permits(&home) {
        let message = format!("home is outside the limits of `{text}`");
        let label = format!("the sum is {} at home", limit.value(&home));
        let help = "give the variables a `home` that the limit permits; it is 0 if not given";
        return section.document.fail(Diagnostic::new(item.span(), message).label(label).help(help));
    }
    Some(limit)
}

/// Returns the weights of the variables in a sum; `None` if it is not linear, has a constant, or
/// depends on anything else.
fn weights(sum: &Expression, declarations: &Declarations) -> Option<Vec<(usize, f64)>> {
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
    let weight = |variable: &usize| (*variable, at(&|other| f64::from(other == *variable)));
    let terms: Vec<(usize, f64)> =
        variables.iter().map(weight).filter(|(_, weight)| *weight != 0.0).collect();
    let is_linear = [-1.7, 0.0, 0.3, 2.9].iter().all(|scale| {
        let value = |variable: usize| scale * (1.0 + 0.37 * variable as f64);
        let parts = || terms.iter().map(|(variable, weight)| weight * value(*variable));
        let size: f64 = parts().map(f64::abs).sum();
        (at(&value) - parts().sum::<f64>()).abs() <= 1e-9 * size
    });
    (is_linear && !terms.is_empty()).then_some(terms)
}
