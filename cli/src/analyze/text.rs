//! The results for people.

use super::{Analysis, tables, unreachable};
use crate::number::{self, percent, short};
use crate::table::{unbroken, wrapped};

pub(super) fn of(analysis: &Analysis) -> String {
    let unit = analysis.description.length.symbol();
    let mut parts = vec![heading(analysis)];
    if analysis.budget.sources.is_empty() {
        parts.push("This spec has no error source that is switched on: there is nothing to add up.\n".into());
    } else {
        parts.push(format!("Each source alone ({unit})\n{}", tables::sources(analysis)));
        parts.push(format!("Where each is worst\n{}", tables::worst(analysis)));
        parts.push(format!("All together ({unit})\n{}", tables::combined(analysis)));
        parts.push(conclusions(analysis));
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
        inputs.map(|input| format!("{} = {}", input.name, number::quantity(input.nominal, input.unit)));
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

/// Tolerance, what compensation leaves, and what first order neglects.
fn conclusions(analysis: &Analysis) -> String {
    let unit = analysis.description.length.symbol();
    let show = |value| format!("{} {unit}", number::trimmed(value, analysis.decimals()));
    let combined = &analysis.budget.combined;
    let mut text = String::new();
    let mut line = |sentence: String| text += &format!("{}\n", wrapped(&sentence, 0));
    if let Some(tolerance) = analysis.study.tolerance {
        let share = percent(combined.radius.value, tolerance);
        line(format!("Tolerance: {}; the radius is {share} of it.", show(tolerance)));
    }
    if let Some(published) = &analysis.study.compensated {
        let random = combined.random_radius.value;
        let total = published.residual + random;
        let share = analysis
            .study
            .tolerance
            .map(|tolerance| format!(", {} of the tolerance", percent(total, tolerance)));
        line(format!(
            "After compensation: {} repeatable residual + {} random = {}{}; {} prints {} + {} = {} ({}).",
            show(published.residual),
            show(random),
            show(total),
            share.unwrap_or_default(),
            analysis.publisher(),
            short(published.residual),
            short(published.random),
            show(published.total),
            published.reference,
        ));
    }
    let first_order = &analysis.first_order;
    if combined.repeatable_radius.value == 0.0 {
        return text;
    }
    line(format!(
        "First order: J_e ε of the repeatable sources differs from the exact chain A_1 E_1 … A_n E_n T by at most \
         {}, at {} configurations.",
        show(first_order.largest),
        first_order.checked,
    ));
    text
}

impl Analysis<'_> {
    /// Who printed the published figures.
    pub(super) fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }
}
