//! Positions and orientations as people read them: the spec's length unit, and mrad.

use abbe::Orientation;
use abbe::analysis::Measurand;

use super::report::Report;
use crate::number;

/// What a figure is multiplied by, and the symbol of the unit it is in then.
pub fn of(report: &Report, measurand: Measurand) -> (f64, &'static str) {
    match measurand {
        Measurand::Position => (1.0, report.spec.length.symbol()),
        Measurand::Orientation => (1e3, "mrad"),
    }
}

/// The names of the three rows.
pub fn rows(report: &Report, measurand: Measurand) -> [&'static str; 3] {
    match (measurand, report.spec.orientation) {
        (Measurand::Position, _) => ["x", "y", "z"],
        (Measurand::Orientation, Orientation::RotationVector) => ["about x", "about y", "about z"],
        (Measurand::Orientation, Orientation::EulerYzx) => ["spin", "roll", "pitch"],
    }
}

/// A figure with as many decimals as those beside it, without its unit.
pub fn fixed(report: &Report, measurand: Measurand, value: f64) -> String {
    number::fixed(value * of(report, measurand).0, report.decimals_of(measurand))
}

/// A figure with its unit.
pub fn shown(report: &Report, measurand: Measurand, value: f64) -> String {
    let (factor, symbol) = of(report, measurand);
    format!("{} {symbol}", number::trimmed(value * factor, report.decimals_of(measurand)))
}
