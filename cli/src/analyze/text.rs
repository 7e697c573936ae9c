//! The results for people.

use super::{Analysis, conclusions, drawn, ledger, tables, unreachable};
use crate::table::{unbroken, wrapped};
use abbe_study::number;

pub(super) fn of(analysis: &Analysis) -> String {
    let unit = analysis.description.length.symbol();
    let mut parts = vec![heading(analysis)];
    if analysis.budget.sources.is_empty() {
        parts.push("This spec has no error source that is switched on: there is nothing to add up.\n".into());
    } else {
        parts.push(format!("Each source alone ({unit})\n{}", tables::sources(analysis)));
        parts.push(format!("All together ({unit})\n{}", tables::combined(analysis)));
        parts.push(format!("Ledger: norms of the errors ({unit})\n{}", ledger::listing(analysis)));
        if let Some(admissible) = &analysis.admissible {
            let table = tables::allowed(analysis, admissible);
            parts.push(format!("What the tolerance allows, and what to tighten first ({unit})\n{table}"));
        }
        if let Some(drawn) = &analysis.drawn {
            parts.push(format!("Monte Carlo on the exact chain ({unit})\n{}", drawn::table(analysis, drawn)));
        }
        parts.push(conclusions::of(analysis));
    }
    if !analysis.study.not_reproducible.is_empty() {
        let notes = analysis.study.not_reproducible.iter().map(|note| format!("- {}\n", wrapped(note, 2)));
        parts.push(format!("Not reproducible from {}\n{}", analysis.publisher(), notes.collect::<String>()));
    }
    parts.join("\n")
}

fn heading(analysis: &Analysis) -> String {
    let Analysis { description, study, workspace, region, budget, .. } = analysis;
    let unreachable = &budget.unreachable;
    let mut text = format!("{} ({})\n{}\n", description.title, description.name, study.title);
    text += &format!("\nWorkspace       {}\n", wrapped(region, 16));
    let mut reached = format!("{}, {} unreachable", budget.configurations, unreachable.count);
    if unreachable.count > 0 {
        reached += &format!(": {}", unreachable::summary(unreachable, description));
    }
    text += &format!("Configurations  {}\n", wrapped(&reached, 16));
    for example in unreachable::first_few(unreachable, workspace.home(), description) {
        text += &format!("                - {}\n", wrapped(&example, 18));
    }
    let home = number::variables(&workspace.home().q, description);
    text += &format!("Home            {}\n", wrapped(&unbroken(&home), 16));
    let inputs = description.inputs.iter();
    let inputs =
        inputs.map(|input| format!("{} = {}", input.name, number::quantity(input.nominal, &input.unit)));
    let inputs = inputs.collect::<Vec<_>>().join(", ");
    if !inputs.is_empty() {
        text += &format!("Inputs          {}\n", wrapped(&unbroken(&inputs), 16));
    }
    let errors =
        "ΔX = J_e ε of the tool point, along x, y, z of F_0; of a random source the bound, plus or minus";
    text += &format!("Errors          {}\n", wrapped(errors, 16));
    let metrics = "plain maximum; half of what it varies by; largest difference from the error at home";
    text + &format!("Metrics         {}\n", wrapped(metrics, 16))
}

impl Analysis<'_> {
    /// Who printed the published figures.
    pub(super) fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }
}
