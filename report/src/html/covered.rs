//! What the figures cover: the verdict, the uncertainty budget, what was drawn; and the orientation.

use abbe::analysis::MonteCarlo;
use abbe_study::analyze::{self, Report, Verdict};
use abbe_study::number;

use super::{escaped, ledger, section};

fn paragraphs(sentences: &[String]) -> String {
    sentences.iter().map(|said| format!("<p>{}</p>\n", escaped(said))).collect()
}

/// Whether the tolerance is met, if there is one.
pub(super) fn verdict(report: &Report) -> String {
    let Some(line) = report.verdict_line() else { return String::new() };
    let class = if report.verdict() == Some(Verdict::NotMet) { "missed" } else { "met" };
    let sentences = paragraphs(&report.verdict_sentences());
    format!(
        "<section class=\"verdict\">\n<h2 class=\"{class}\">{}</h2>\n{sentences}</section>\n",
        escaped(&line)
    )
}

/// Rows 4–6.
pub(super) fn turns(report: &Report) -> String {
    let table = analyze::turns(report).map(|turns| {
        let about = "<p>Rows 4 to 6 of ΔX in mrad, largest over the workspace.</p>\n";
        section("Ledger of the orientation", &format!("{about}{}", ledger::listed(&turns)))
    });
    table.unwrap_or_default()
}

/// The budgets of the GUM.
pub(super) fn uncertainty(report: &Report) -> String {
    let budgets = report.uncertainty_budgets().map(|budget| {
        let (_, unit) = analyze::unit::of(report, budget.measurand);
        let body = format!(
            "{}{}{}",
            ledger::listed(&analyze::contributions(report, budget)),
            ledger::listed(&analyze::totals(report, budget)),
            paragraphs(&analyze::sentences(report, budget)),
        );
        section(&format!("Uncertainty budget ({unit})"), &body)
    });
    budgets.collect()
}

/// What was drawn, if anything was.
pub(super) fn monte_carlo(report: &Report) -> String {
    let Some(drawn) = &report.monte_carlo else { return String::new() };
    let error = |value| number::fixed(value, report.decimals());
    let row = |(place, found): (&str, &MonteCarlo)| {
        let quantiles = found.quantiles.map(|quantile| {
            let spread = number::fixed(quantile.standard_error, report.decimals() + 1);
            format!("<td>{} ± {spread}</td>", error(quantile.value))
        });
        let sigma = [0, 1, 2].map(|i| format!("<td>{}</td>", error(found.covariance[i][i].sqrt())));
        format!(
            "<tr><td class=\"words\">{place}</td>{}<td>{}</td>{}</tr>\n",
            quantiles.concat(),
            error(found.largest),
            sigma.concat()
        )
    };
    let rows = drawn.places().map(row).concat();
    let unit = report.spec.length.symbol();
    section(
        &format!("Monte Carlo on the exact chain ({unit})"),
        &format!(
            "<p>{} draws at each place, seed {}: quantiles of the norm of the whole error with their standard errors, the largest, \
             and standard deviations.</p>\n<table class=\"ledger\"><thead><tr><th class=\"words\">at</th><th>50 %</th><th>95 %</th>\
             <th>99 %</th><th>largest</th><th>σ x</th><th>σ y</th><th>σ z</th></tr></thead>\n<tbody>{rows}</tbody></table>\n",
            number::short(drawn.draws as f64),
            drawn.seed,
        ),
    )
}
