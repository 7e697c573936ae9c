//! Checks whether the argument of a table can leave its range.

use super::{Extrapolation, Kind, Scope, Symbol, Table, Term, expression::values};
use crate::diagnostic::Diagnostic;

/// Number of configurations that are tried in addition to the corners of the ranges.
const SAMPLES: usize = 256;

/// Number of names for which all combinations of ends are tried.
const CORNERS: usize = 6;

/// Returns a diagnostic if an argument, the last of some terms, leaves a table that does not hold
/// its end values.
///
/// An argument that is a variable or input is checked by its limits. For any other argument the
/// corners of the ranges and points between them are tried. A violation that this misses gives NaN
/// at evaluation.
pub(super) fn reaches_beyond(terms: &[Term], table: &Table, scope: &Scope) -> Option<Diagnostic> {
    let argument = terms.last()?;
    if table.outside == Extrapolation::Hold || argument.dimension != Some(table.dimensions[0]) {
        return None;
    }
    let range = |symbol: Symbol| {
        let name = scope.names.values().find(|name| name.symbol == symbol);
        name.map_or([0.0; 2], |name| name.range)
    };
    let mut symbols: Vec<Symbol> = terms.iter().filter_map(symbol_of).collect();
    symbols.sort_unstable();
    symbols.dedup();
    let [low, high] = match (symbol_of(argument), argument.value) {
        (_, Some(value)) => [value; 2],
        (Some(symbol), _) => range(symbol),
        _ => extremes(terms, scope, &symbols, &symbols.iter().map(|s| range(*s)).collect::<Vec<_>>()),
    };
    let [first, last] = table.ends();
    if low >= first && high <= last || low > high {
        return None;
    }
    let unit = table.dimensions[0].unit(scope.length.symbol());
    let shown = |value: f64| format!("{value} {unit}").trim_end().to_owned();
    let message = format!("the argument of `{}` can leave the range of the table", table.name);
    let label = match argument.value {
        Some(value) => format!("this is {}", shown(value)),
        None if low == f64::NEG_INFINITY || high == f64::INFINITY => "the argument has no limits".to_owned(),
        None => format!("the argument goes from {} to {}", shown(low), shown(high)),
    };
    let help = format!(
        "its points go from {} to {}; limit the argument, or write `outside = \"hold\"` in [tables.{}]",
        shown(first),
        shown(last),
        table.name
    );
    Some(Diagnostic::new(argument.span.clone(), message).label(label).help(help))
}

fn symbol_of(term: &Term) -> Option<Symbol> {
    match term.kind {
        Kind::Symbol(symbol) => Some(symbol),
        _ => None,
    }
}

/// Returns the least and the largest value found.
fn extremes(terms: &[Term], scope: &Scope, symbols: &[Symbol], ranges: &[[f64; 2]]) -> [f64; 2] {
    // Without limits, only 0 is tried.
    let finite = |[low, high]: [f64; 2]| match (low.is_finite(), high.is_finite()) {
        (true, true) => [low, high],
        (true, false) => [low; 2],
        (false, true) => [high; 2],
        _ => [0.0; 2],
    };
    let ranges: Vec<[f64; 2]> = ranges.iter().map(|range| finite(*range)).collect();
    let mut found = [f64::INFINITY, f64::NEG_INFINITY];
    let mut try_at = |share: &dyn Fn(usize) -> f64| {
        let symbol = |symbol: Symbol| {
            let index = symbols.iter().position(|known| *known == symbol).unwrap_or(0);
            let [low, high] = ranges[index];
            // Use the ends themselves, not their rounded interpolation.
            match share(index) {
                0.0 => low,
                1.0 => high,
                share => low + share * (high - low),
            }
        };
        if let Some(value) = values(terms, &scope.tables, symbol).last().filter(|value| value.is_finite()) {
            found = [found[0].min(*value), found[1].max(*value)];
        }
    };
    for corner in 0..1 << symbols.len().min(CORNERS) {
        try_at(&|index| f64::from(corner >> index.min(CORNERS) & 1));
    }
    for sample in 1..=SAMPLES {
        // Multiples of the fractional parts of √2, √3, √5, …: evenly spread in every dimension.
        try_at(&|index| (sample as f64 * ROOTS[index % ROOTS.len()].sqrt()).fract());
    }
    found
}

/// Numbers with irrational roots and irrational ratios of roots.
const ROOTS: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];
