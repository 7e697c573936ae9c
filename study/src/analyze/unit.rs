//! Positions and orientations as people read them: the spec's length unit, and mrad.

use abbe::analysis::Measurand;

use super::report::Report;
use crate::number::{self, error_decimals};

/// What a figure is multiplied by, and the symbol of the unit it is in then.
pub fn of(report: &Report, measurand: Measurand) -> (f64, &'static str) {
    match measurand {
        Measurand::Position => (1.0, report.spec.length.symbol()),
        Measurand::Orientation => (1e3, "mrad"),
    }
}

/// The names of the three rows.
pub fn rows(report: &Report, measurand: Measurand) -> [&'static str; 3] {
    match measurand {
        Measurand::Position => ["x", "y", "z"],
        Measurand::Orientation => report.orientation.rows,
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

impl Report {
    /// How many decimals errors have: three digits of the smallest source that matters.
    pub fn decimals(&self) -> usize {
        self.decimals_of(Measurand::Position)
    }

    /// The same of a measurand in the unit in which it is printed; of mrad at least four.
    pub(super) fn decimals_of(&self, measurand: Measurand) -> usize {
        let (sources, combined, _) = self.budget.errors(measurand);
        let (factor, _) = of(self, measurand);
        let least = match measurand {
            Measurand::Position => error_decimals(self.spec.length),
            Measurand::Orientation => 4,
        };
        let negligible = 1e-6 * factor * combined.radius.value;
        let norms = sources.iter().map(|errors| factor * errors.plain_max.norm);
        let smallest = norms.filter(|norm| *norm > negligible).fold(f64::INFINITY, f64::min);
        let needed = 2.0 - smallest.log10().floor();
        (needed.max(0.0) as usize).clamp(least, least + 4)
    }
}
