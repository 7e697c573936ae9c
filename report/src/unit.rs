//! Display units of errors: mm and mrad for every spec, because errors are small.

use abbe::analysis::Measurand;

use abbe_study::analyze::Report;
use abbe_study::number;

/// Returns the factor from internal to display unit, and the symbol of the display unit.
pub(crate) fn display_unit(report: &Report, measurand: Measurand) -> (f64, &'static str) {
    match measurand {
        Measurand::Position => (1e3 * report.spec.length.in_metres(), "mm"),
        Measurand::Orientation => (1e3, "mrad"),
    }
}

/// Returns the factor and the unit in which a number is shown: mrad for rad.
pub(crate) fn angle_in_mrad(unit: &str) -> (f64, &str) {
    if unit == "rad" { (1e3, "mrad") } else { (1.0, unit) }
}

/// Returns the names of the three rows.
pub(crate) fn row_names(report: &Report, measurand: Measurand) -> [&'static str; 3] {
    match measurand {
        Measurand::Position => ["x", "y", "z"],
        Measurand::Orientation => report.orientation.rows,
    }
}

/// Formats a figure in its display unit, without the symbol, with the same number of decimals as
/// its table.
pub(crate) fn fixed(report: &Report, measurand: Measurand, value: f64) -> String {
    number::fixed(value * display_unit(report, measurand).0, decimals_of(report, measurand))
}

/// Formats a figure with its unit.
pub(crate) fn with_symbol(report: &Report, measurand: Measurand, value: f64) -> String {
    let (factor, symbol) = display_unit(report, measurand);
    format!("{} {symbol}", number::trimmed(value * factor, decimals_of(report, measurand)))
}

/// Formats a position error with its unit.
pub(crate) fn position(report: &Report, value: f64) -> String {
    with_symbol(report, Measurand::Position, value)
}

/// Returns the number of decimals of position errors: three significant digits of the smallest
/// source that is not negligible.
pub(crate) fn decimals(report: &Report) -> usize {
    decimals_of(report, Measurand::Position)
}

/// Returns the number of decimals of a measurand in its display unit; at least four.
pub(crate) fn decimals_of(report: &Report, measurand: Measurand) -> usize {
    let (sources, combined) = report.budget.errors(measurand);
    let (factor, _) = display_unit(report, measurand);
    let negligible = 1e-6 * factor * combined.radius.value;
    let norms = sources.iter().map(|errors| factor * errors.plain_max.norm);
    let smallest = norms.filter(|norm| *norm > negligible).fold(f64::INFINITY, f64::min);
    let needed = 2.0 - smallest.log10().floor();
    (needed.max(0.0) as usize).clamp(4, 8)
}
