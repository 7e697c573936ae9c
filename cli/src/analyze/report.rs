//! What the report is told of an analysis.

use abbe_codegen::spec::Spec;

use super::agreement::{Agreement, of_source};
use super::{Analysis, conclusions, ledger, tables, unreachable};
use crate::report::{Compared, Subject};
use abbe_study::study_file::{Published, Subject as Of};

pub(super) fn subject<'a>(analysis: &'a Analysis<'a>, spec: &'a Spec) -> Subject<'a> {
    let Analysis { description, study, workspace, budget, first_order, .. } = analysis;
    let worst = analysis.budget.sources.iter().map(|errors| analysis.configuration(errors.worst)).collect();
    let worst_of_all = analysis.configuration(analysis.budget.combined.radius.configuration);
    let reasons = unreachable::summary(&budget.unreachable, description);
    Subject {
        spec,
        manipulator: first_order.manipulator,
        description,
        study,
        region: &analysis.region,
        home: workspace.home(),
        configurations: budget.configurations,
        unreachable: (budget.unreachable.count, reasons),
        budget: &analysis.budget,
        worst: (worst, worst_of_all),
        compared: study.published.iter().map(|published| compare(analysis, published)).collect(),
        ledger: ledger::listing(analysis),
        allowed: analysis.admissible.as_ref().map(|admissible| tables::allowed(analysis, admissible)),
        conclusions: conclusions::sentences(analysis),
        decimals: analysis.decimals(),
    }
}

fn compare(analysis: &Analysis, published: &Published) -> Option<Compared> {
    let found = match &published.subject {
        Of::Source(name, metric) => {
            let is_it = |source: usize| analysis.description.sources[source].name == name;
            let errors = analysis.budget.sources.iter().find(|errors| is_it(errors.source))?;
            of_source(errors, *metric)
        }
        Of::Combined(figure) => [0.0, 0.0, 0.0, analysis.combined(*figure).1],
    };
    let agreement = Agreement::of(found, published);
    Some(Compared { met: agreement == Agreement::Met, verdict: agreement.text(analysis) })
}
