//! Sections of an analysis about coverage: verdict, orientation, uncertainty budget and Monte Carlo
//! draws.

use abbe::analysis::MonteCarlo;
use abbe_study::analyze::{self, Report, Verdict};
use abbe_study::number;

use super::ledger::listed;
use super::table::{ledger, row_header};
use super::{folded, paragraphs};
use crate::text::draws_explained;

/// Formats the verdict and the largest error. Without a tolerance there is no verdict.
pub(super) fn verdict(report: &Report) -> String {
    let Some(line) = report.verdict_line() else { return paragraphs(&report.summary()) };
    let is_met = report.verdict() != Some(Verdict::NotMet);
    super::verdict(is_met, &line, &[report.verdict_sentences(), report.summary()].concat())
}

/// Formats the ledger of the orientation, rows 4 to 6.
pub(super) fn turns(report: &Report) -> String {
    let table = analyze::orientation_ledger(report).map(|turns| {
        let caption = "Rows 4 to 6 of ΔX in mrad, largest over the workspace";
        folded("Ledger of the orientation", &listed(caption, &turns))
    });
    table.unwrap_or_default()
}

/// Formats the uncertainty budgets according to the GUM.
pub(super) fn uncertainty(report: &Report) -> String {
    let budgets = report.uncertainty_budgets().map(|budget| {
        let (_, unit) = analyze::unit::display_unit(report, budget.measurand);
        let body = format!(
            "{}{}{}",
            listed(
                &format!("Standard uncertainty of each source ({unit})"),
                &analyze::uncertainty_contributions(report, budget)
            ),
            listed(
                &format!("Expanded uncertainty and bias ({unit})"),
                &analyze::uncertainty_totals(report, budget)
            ),
            paragraphs(&analyze::uncertainty_sentences(report, budget)),
        );
        folded(&format!("Uncertainty budget ({unit})"), &body)
    });
    budgets.collect()
}

/// Formats the Monte Carlo results, if there are draws.
pub(super) fn monte_carlo(report: &Report) -> String {
    let Some(drawn) = &report.monte_carlo else { return String::new() };
    let error = |value| number::fixed(value, report.decimals());
    let row = |(place, found): (&str, &MonteCarlo)| {
        let quantiles = found.quantiles.map(|quantile| {
            let spread = number::fixed(quantile.standard_error, report.decimals() + 1);
            format!("<td>{} ± {spread}</td>", error(quantile.value))
        });
        let sigma = [0, 1, 2].map(|i| format!("<td>{}</td>", error(found.covariance[i][i].sqrt())));
        let inside = found.inside_ellipsoid.map(|share| format!("{:.2} %", 100.0 * share));
        format!(
            "<tr>{}{}<td>{}</td><td>{}</td>{}</tr>\n",
            row_header(place),
            quantiles.concat(),
            error(found.largest),
            inside.unwrap_or_default(),
            sigma.concat()
        )
    };
    let rows = drawn.results().map(row).concat();
    let unit = report.spec.length.symbol();
    let caption = "Quantiles of the norm of the error with their standard errors, and standard deviations";
    let columns = ["at", "50 %", "95 %", "99 %", "largest", "in ellipsoid", "σ x", "σ y", "σ z"];
    let table = ledger(caption, &columns, &[0], &format!("<tbody>{rows}</tbody>\n"));
    let explained = paragraphs(&[draws_explained(drawn)]);
    folded(&format!("Monte Carlo on the exact chain ({unit})"), &(table + &explained))
}
