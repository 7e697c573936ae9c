//! Monte Carlo results at the worst configuration and at home.

use super::super::{Table, wrapped};
use abbe_study::analyze::{MonteCarloReport, Report};
use abbe_study::number::{self, fixed};

pub(super) fn table(report: &Report, drawn: &MonteCarloReport) -> String {
    format!("{}\n{}{}\n", norms(report, drawn), deviations(report, drawn), wrapped(&explained(drawn), 0))
}

/// States the number of draws, and what the tables have of them.
pub(crate) fn explained(drawn: &MonteCarloReport) -> String {
    format!(
        "{} draws per configuration, seed {}: quantiles and maximum of the norm of the total error, \
         the share of draws inside the first-order 95 % ellipsoid, which is 95 % if all random \
         sources are normal, and standard deviations.",
        number::short(drawn.draws as f64),
        drawn.seed,
    )
}

fn norms(report: &Report, drawn: &MonteCarloReport) -> Table {
    let decimals = report.decimals();
    let mut table = Table::new(&["at", "50 %", "95 %", "99 %", "largest", "in ellipsoid"]);
    for (place, found) in drawn.results() {
        let mut cells = vec![format!("{place}\n  standard error")];
        cells.extend(found.quantiles.map(|quantile| {
            let (value, error) = (quantile.value, quantile.standard_error);
            format!("{}\n{}", fixed(value, decimals), fixed(error, decimals + 1))
        }));
        cells.push(fixed(found.largest, decimals));
        let inside = found.inside_ellipsoid.map(|share| format!("{:.2} %", 100.0 * share));
        cells.push(inside.unwrap_or_default());
        table.row(cells);
    }
    table.right(&[1, 2, 3, 4, 5]).unwrapped(&[0])
}

fn deviations(report: &Report, drawn: &MonteCarloReport) -> Table {
    let decimals = report.decimals();
    let mut table = Table::new(&["at", "σ x", "σ y", "σ z"]);
    for (place, found) in drawn.results() {
        let mut cells = vec![format!("{place}\n  standard error\n  first order")];
        cells.extend([0, 1, 2].map(|i| {
            let [sigma, first_order] = [found.covariance[i][i], found.first_order[i][i]].map(f64::sqrt);
            // d√v = dv / 2√v.
            let error = if sigma > 0.0 { found.standard_error[i][i] / (2.0 * sigma) } else { 0.0 };
            let [sigma, error, first_order] =
                [(sigma, 0), (error, 1), (first_order, 0)].map(|(value, more)| fixed(value, decimals + more));
            format!("{sigma}\n{error}\n{first_order}")
        }));
        table.row(cells);
    }
    table.right(&[1, 2, 3]).unwrapped(&[0])
}
