//! Full text of an error budget.

mod drawn;
mod tables;

use abbe::analysis::Measurand;
use abbe_study::analyze::{self, Report, UncertaintyBudget};
use abbe_study::number::{self, unbroken};

use super::{listed, wrapped};
pub(crate) use drawn::explained;

/// Prints verdict, ledgers, each source alone, all sources together, uncertainty budgets and
/// conclusions.
pub(in crate::text) fn analysis(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let mut parts = vec![answer(report), heading(report)];
    if report.sources.is_empty() {
        parts.push("No error source is enabled: there is no error to predict.\n".into());
    } else {
        parts.push(format!("Ledger: norms of the errors ({unit})\n{}", listed(&analyze::ledger(report))));
        parts.push(format!("All together ({unit})\n{}", tables::combined(report)));
        for measurand in Measurand::ALL {
            let (_, unit) = analyze::unit::display_unit(report, measurand);
            if let Some(allowed) = analyze::allowance_table(report, measurand) {
                let table = listed(&allowed);
                parts.push(format!(
                    "Error allowance: factors that meet the tolerance, most effective source first \
                 ({unit})\n{table}"
                ));
            }
        }
        parts.push(format!(
            "Each source alone ({unit})\n{}{}",
            tables::sources(report),
            wrapped(METRICS, 0) + "\n"
        ));
        if let Some(turns) = analyze::orientation_ledger(report) {
            parts.push(format!("Ledger of the orientation: rows 4 to 6 (mrad)\n{}", listed(&turns)));
        }
        parts.extend(budgets(report));
        if let Some(drawn) = &report.monte_carlo {
            parts.push(format!("Monte Carlo on the exact chain ({unit})\n{}", drawn::table(report, drawn)));
        }
        parts.push(paragraphs(&report.conclusions()));
    }
    parts.extend(report.other_tool.iter().map(|tool| wrapped(&tool.sentence, 0) + "\n"));
    parts.extend(report.extrapolated.iter().map(|extrapolated| wrapped(&extrapolated.sentence, 0) + "\n"));
    if !report.study.not_reproducible.is_empty() {
        let notes = report.study.not_reproducible.iter().map(|note| format!("- {}\n", wrapped(note, 2)));
        parts.push(format!("Not reproducible from {}\n{}", report.publisher(), notes.collect::<String>()));
    }
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

const METRICS: &str = "plain maximum: the largest error; half peak-to-peak: half of its range; relative to home: the \
 largest difference from the error at home";

/// Is the tolerance met, which error matters most, and where.
fn answer(report: &Report) -> String {
    let verdict = report.verdict_line().map(|verdict| format!("{verdict}\n")).unwrap_or_default();
    verdict + &paragraphs(&report.verdict_sentences()) + &paragraphs(&report.summary())
}

/// The budgets of the GUM; what holds for several is said once.
fn budgets(report: &Report) -> Vec<String> {
    let mut printed: Vec<String> = Vec::new();
    let budget = |budget: &UncertaintyBudget| {
        let (_, unit) = analyze::unit::display_unit(report, budget.measurand);
        let sources = listed(&analyze::uncertainty_contributions(report, budget));
        let totals = listed(&analyze::uncertainty_totals(report, budget));
        let mut sentences = analyze::uncertainty_sentences(report, budget);
        sentences.retain(|sentence| !printed.contains(sentence));
        printed.extend_from_slice(&sentences);
        format!("Uncertainty budget ({unit})\n{sources}\n{totals}\n{}", paragraphs(&sentences))
    };
    report.uncertainty_budgets().map(budget).collect()
}

fn paragraphs(sentences: &[String]) -> String {
    sentences.iter().map(|sentence| format!("{}\n", wrapped(sentence, 0))).collect()
}

fn heading(report: &Report) -> String {
    let Report { spec, study, budget, .. } = report;
    let unreachable = &budget.unreachable;
    let mut text = format!("{} ({})\n{}\n", spec.title, spec.name, study.title);
    text += &format!("\nWorkspace       {}\n", wrapped(&report.workspace, 16));
    let mut reached = format!("{}, {} unreachable", budget.configurations, unreachable.count);
    if unreachable.count > 0 {
        reached += &format!(": {}", analyze::unreachable_summary(unreachable, spec));
    }
    text += &format!("Configurations  {}\n", wrapped(&reached, 16));
    for example in analyze::first_unreachable(unreachable, &report.home, spec) {
        text += &format!("                - {}\n", wrapped(&example, 18));
    }
    if report.singular() > 0 {
        text += &format!("                {}\n", wrapped(&report.singular_sentence(), 16));
    }
    let home = number::variables(&report.home.q, spec);
    text += &format!("Home            {}\n", wrapped(&unbroken(&home), 16));
    let inputs = report.inputs().join(", ");
    if !inputs.is_empty() {
        text += &format!("Inputs          {}\n", wrapped(&unbroken(&inputs), 16));
    }
    let errors = "ΔX = J_e ε of the tool point, along x, y, z of F_0; for a random source its bound (±)";
    text + &format!("Errors          {}\n", wrapped(errors, 16))
}
