//! What was drawn at the worst configuration and at home, as a table.

use abbe::analysis::MonteCarlo;

use super::{Analysis, Drawn};
use crate::number::{self, fixed};
use crate::table::{Table, wrapped};

impl Drawn {
    /// Both places, with their names.
    pub(super) fn places(&self) -> [(&'static str, &MonteCarlo); 2] {
        [("worst", &self.worst), ("home", &self.home)]
    }
}

pub(super) fn table(analysis: &Analysis, drawn: &Drawn) -> String {
    let decimals = analysis.decimals();
    let mut table = Table::new(&["at", "50 %", "95 %", "99 %", "largest", "σ x", "σ y", "σ z", "inside"]);
    for (place, found) in drawn.places() {
        let mut cells = vec![format!("{place}\n  standard error\n  first order")];
        cells.extend(found.quantiles.map(|quantile| {
            let [value, error] = [(quantile.value, 0), (quantile.standard_error, 1)]
                .map(|(value, more)| fixed(value, decimals + more));
            format!("{value}\n{error}")
        }));
        cells.push(fixed(found.largest, decimals));
        cells.extend([0, 1, 2].map(|i| {
            // d√v = dv / 2√v.
            let [sigma, first_order] = [found.covariance[i][i], found.first_order[i][i]].map(f64::sqrt);
            let error = if sigma > 0.0 { found.standard_error[i][i] / (2.0 * sigma) } else { 0.0 };
            let [sigma, error, first_order] =
                [(sigma, 0), (error, 1), (first_order, 0)].map(|(value, more)| fixed(value, decimals + more));
            format!("{sigma}\n{error}\n{first_order}")
        }));
        cells.push(found.inside_ellipsoid.map(|share| format!("{:.2} %", 100.0 * share)).unwrap_or_default());
        table.row(cells);
    }
    let text = format!(
        "{} draws at each place, seed {}: quantiles and the largest of the norm of the whole error; standard \
         deviations σ; the share of the draws inside the first-order 95 % ellipsoid, which is 95 % if all random \
         sources are normal.",
        number::short(drawn.worst.draws as f64),
        drawn.seed,
    );
    format!("{}{}\n", table.right(&[1, 2, 3, 4, 5, 6, 7, 8]).unwrapped(&[0]), wrapped(&text, 0))
}
