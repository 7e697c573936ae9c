//! Error budget: verdict, figures, sources, uncertainty, and what the numbers mean.

mod answer;
mod conclusions;
mod reference;
mod tables;
mod uncertainty;
mod verdict;

use abbe::analysis::Measurand;
use abbe_study::analyze::{self, Report, UncertaintyBudget};
use abbe_study::number::{self, percent, trimmed, unbroken};
use abbe_study::study_file::Criterion;

use conclusions::{conclusions, singular_sentence};
pub(in crate::views) use verdict::by_criterion;
use verdict::{verdict_line, verdict_sentences};

use crate::document::{Card, Document, Figure, Section, Verdict};
use crate::unit::{self, decimals};
use crate::views::shared::changed;

/// Number of unreachable configurations that are listed.
const SHOWN: usize = 3;

/// Describes an error budget over a workspace, with the figures of its page, the first of which
/// stand above all tables. `left_out` are disabled sources whose figures are missing.
pub(crate) fn analysis(report: &Report, [first, others]: [Vec<Figure>; 2], left_out: &[String]) -> Document {
    let mut sections = Vec::new();
    if report.sources.is_empty() {
        let none = "No error source is enabled: there is no error to predict.".to_owned();
        sections.push(Section::answer().state("no_source", none).facts(changed(&report.changes)));
    } else {
        sections.push(answer::answer(report));
    }
    sections.extend([
        Section::page("").cards(cards(report)),
        description(report),
        verdict(report),
        workspace(report),
        Section::page("Figures").state("units_of_figures", units(&first)).figures(first),
    ]);
    if !report.sources.is_empty() {
        sections.push(together(report));
    }
    let missing = left_out.iter().map(|source| format!("Not drawn: the source “{source}” is disabled."));
    sections.push(
        Section::page("More figures").state("units_of_figures", units(&others)).figures(others).list(
            "not_drawn",
            "",
            missing.collect(),
        ),
    );
    if !report.sources.is_empty() {
        sections.extend([
            each_alone(report),
            ledger(report),
            uncertainty(report),
            tables::monte_carlo(report),
        ]);
    }
    sections.extend([not_reproducible(report), reference::conventions(report), reference::values(report)]);
    Document {
        kind: "Error analysis",
        machine: report.spec.title.clone(),
        title: report.study.title.clone(),
        headline: answer::headline(report),
        verdict: verdict_line(report)
            .map(|text| Verdict { is_met: report.verdict() != Some(analyze::Verdict::NotMet), text }),
        panel: "Errors at a configuration",
        sections,
        is_signed: false,
        record: report.record.clone(),
    }
}

fn units(figures: &[Figure]) -> Option<String> {
    (!figures.is_empty()).then(|| "Errors are in mm, those of the orientation in mrad.".to_owned())
}

/// Formats the most important figures.
fn cards(report: &Report) -> Vec<Card> {
    let (factor, unit) = unit::display_unit(report, Measurand::Position);
    let built = report.judged_error(Measurand::Position).value;
    let by = match report.study.criterion {
        Criterion::RootSumOfSquares => "root sum of squares",
        _ => "worst case",
    };
    let decimals = decimals(report).min(4);
    let show = |value| format!("{} {unit}", trimmed(factor * value, decimals));
    let of = |value| {
        report.study.tolerance.map(|tolerance| format!("{} of the tolerance", percent(value, tolerance)))
    };
    let card = |name, value, note: Option<String>| Card { name, value, note: note.unwrap_or_default() };
    let mut all = vec![card(
        "Largest error as built",
        show(built),
        Some([Some(by.to_owned()), of(built)].into_iter().flatten().collect::<Vec<_>>().join(", ")),
    )];
    let compensated = report.verdicts.as_ref().and_then(|verdicts| verdicts.compensated.as_ref());
    let compensated = compensated.and_then(|compensated| compensated.verdicts.position.as_ref());
    let left = compensated.map(|verdict| verdict.judged_error(report.study.criterion));
    if let Some(total) = left.or(report.after_compensation.as_ref().map(|left| left.total)) {
        all.push(card("After compensation", format!("± {}", show(total)), of(total)));
    }
    all.push(card("Configurations", report.configurations.to_string(), Some(unreachable(report))));
    all
}

fn unreachable(report: &Report) -> String {
    let unreachable = &report.budget.unreachable;
    match unreachable.count {
        0 => "all reachable".to_owned(),
        count => format!("{count} unreachable: {}", analyze::unreachable_summary(unreachable, &report.spec)),
    }
}

fn description(report: &Report) -> Section {
    let words: Vec<&str> = report.spec.description.split_whitespace().collect();
    Section::page("Machine").state("description", words.join(" "))
}

/// States whether the tolerances are met, and where.
fn verdict(report: &Report) -> Section {
    let verdict = verdict_sentences(report).into_iter();
    verdict.fold(Section::full("Verdict"), |section, text| section.state("verdict", text))
}

fn workspace(report: &Report) -> Section {
    let Report { spec, budget, .. } = report;
    let inputs = report.inputs().join(", ");
    let mut facts = vec![("Covers", report.workspace.clone())];
    facts.push(("Reached", format!("{}, {}", budget.configurations, unreachable(report))));
    facts.extend(budget.unreachable.first.iter().take(SHOWN).map(|unreachable| {
        let requested = match unreachable.point {
            Some(point) => {
                let [x, y, z] = point.map(number::short);
                format!("({x}, {y}, {z}) {}", spec.length.symbol())
            }
            None => number::configuration(&unreachable.requested, &report.home, spec),
        };
        ("", format!("- {requested}: {}", analyze::unreachable_reason(unreachable, spec)))
    }));
    facts.push(("Home", unbroken(&number::variables(&report.home.q, spec))));
    if !inputs.is_empty() {
        facts.push(("Inputs", unbroken(&inputs)));
    }
    let errors = "ΔX = J_e ε of the tool point, along x, y, z of F_0; for a random source its bound (±)";
    facts.push(("Errors", errors.to_owned()));
    let singular = (report.singular() > 0).then(|| singular_sentence(report));
    Section::full("Workspace").facts(facts).state("singular_euler_angles", singular)
}

/// States the errors of all sources together.
fn together(report: &Report) -> Section {
    let section = Section::full("All sources together").table(tables::combined(report));
    let section =
        conclusions(report).into_iter().fold(section, |section, text| section.state("conclusion", text));
    section.state("extrapolated", report.extrapolated.as_ref().map(|rows| rows.sentence.clone()))
}

fn each_alone(report: &Report) -> Section {
    let metrics = "Plain maximum: the largest error. Half peak-to-peak: half of its range; for the norm, the \
                   norm of these halves. Relative to home: the largest \
                   difference from the error at home. For a random source, the bound (±).";
    Section::full("Each source alone").table(tables::sources(report)).state("metrics", metrics.to_owned())
}

fn ledger(report: &Report) -> Section {
    let section = Section::full("Ledger").table(tables::ledger(report));
    tables::orientation_ledger(report).into_iter().fold(section, Section::table)
}

/// Tabulates the budgets of the GUM; what holds for several is stated once.
fn uncertainty(report: &Report) -> Section {
    let mut stated: Vec<String> = Vec::new();
    let budget = |section: Section, budget: &UncertaintyBudget| {
        let mut sentences = uncertainty::uncertainty_sentences(report, budget);
        sentences.retain(|sentence| !stated.contains(sentence));
        stated.extend_from_slice(&sentences);
        let section = section
            .table(uncertainty::uncertainty_contributions(report, budget))
            .table(uncertainty::uncertainty_totals(report, budget));
        sentences.into_iter().fold(section, |section, text| section.state("uncertainty", text))
    };
    report.uncertainty_budgets().fold(Section::full("Uncertainty budget"), budget)
}

fn not_reproducible(report: &Report) -> Section {
    let notes = report.study.not_reproducible.clone();
    let title = format!("Not reproducible from {}:", report.publisher());
    Section::full("Published figures").list("not_reproducible", &title, notes)
}
