//! The results for people.

use abbe_study::analyze::{self, Report};
use abbe_study::number::{self, unbroken};

use super::{drawn, tables};
use crate::table::{listed, wrapped};

pub(super) fn text(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let mut parts = vec![heading(report)];
    if report.budget.sources.is_empty() {
        parts.push("This spec has no error source that is switched on: there is nothing to add up.\n".into());
    } else {
        parts.push(format!("Each source alone ({unit})\n{}", tables::sources(report)));
        parts.push(format!("All together ({unit})\n{}", tables::combined(report)));
        parts.push(format!("Ledger: norms of the errors ({unit})\n{}", listed(&analyze::ledger(report))));
        if let Some(allowed) = analyze::allowed(report) {
            let table = listed(&allowed);
            parts.push(format!("What the tolerance allows, and what to tighten first ({unit})\n{table}"));
        }
        if let Some(drawn) = &report.monte_carlo {
            parts.push(format!("Monte Carlo on the exact chain ({unit})\n{}", drawn::table(report, drawn)));
        }
        let paragraphs = report.conclusions().into_iter().map(|said| format!("{}\n", wrapped(&said, 0)));
        parts.push(paragraphs.collect());
    }
    if !report.study.not_reproducible.is_empty() {
        let notes = report.study.not_reproducible.iter().map(|note| format!("- {}\n", wrapped(note, 2)));
        parts.push(format!("Not reproducible from {}\n{}", report.publisher(), notes.collect::<String>()));
    }
    parts.join("\n")
}

fn heading(report: &Report) -> String {
    let Report { spec, study, budget, .. } = report;
    let unreachable = &budget.unreachable;
    let mut text = format!("{} ({})\n{}\n", spec.title, spec.name, study.title);
    text += &format!("\nWorkspace       {}\n", wrapped(&report.workspace, 16));
    let mut reached = format!("{}, {} unreachable", budget.configurations, unreachable.count);
    if unreachable.count > 0 {
        reached += &format!(": {}", analyze::summary(unreachable, spec));
    }
    text += &format!("Configurations  {}\n", wrapped(&reached, 16));
    for example in analyze::first_few(unreachable, &report.home, spec) {
        text += &format!("                - {}\n", wrapped(&example, 18));
    }
    let home = number::variables(&report.home.q, spec);
    text += &format!("Home            {}\n", wrapped(&unbroken(&home), 16));
    let inputs = report.inputs().join(", ");
    if !inputs.is_empty() {
        text += &format!("Inputs          {}\n", wrapped(&unbroken(&inputs), 16));
    }
    let errors =
        "ΔX = J_e ε of the tool point, along x, y, z of F_0; of a random source the bound, plus or minus";
    text += &format!("Errors          {}\n", wrapped(errors, 16));
    let metrics = "plain maximum; half of what it varies by; largest difference from the error at home";
    text + &format!("Metrics         {}\n", wrapped(metrics, 16))
}
