//! The answer of a check: whether the spec is valid, and what it describes.

use abbe_spec::{Frame, Spec};
use abbe_study::check::{Identifiable, Report};
use abbe_study::number::{self, counted, quantity, short};

use super::full::check::{joint, loops, not_closed};
use super::{Answer, aligned, first};

/// Number of joints shown one by one.
const JOINTS: usize = 8;
/// Number of remarks shown.
const REMARKS: usize = 3;

pub(in crate::text) fn check(report: &Report) -> String {
    let mut answer =
        Answer::new(&format!("{} ({}): {}", report.spec.title, report.facts.spec, verdict(report)));
    if let Some(failure) = report.tree.as_ref().and_then(|tree| not_closed(tree, &report.spec)) {
        answer.block(&super::wrapped(&failure, 0));
    }
    let mut failures: Vec<&String> = report.laws.iter().filter_map(|law| law.failure.as_ref()).collect();
    failures.dedup();
    for failure in failures {
        answer.block(&super::wrapped(failure, 0));
    }
    answer.block(&joints(&report.spec));
    answer.facts(facts(report));
    answer.facts(super::some("Remark", &report.notes, REMARKS));
    answer.0
}

fn verdict(report: &Report) -> String {
    let count = report.laws.len();
    let failed: Vec<&str> = report.laws.iter().filter(|law| !law.holds).map(|law| law.law).collect();
    let remarks = match report.warnings.len() + report.notes.len() {
        0 => String::new(),
        count => format!(", {}", counted(count, "remark", "remarks")),
    };
    if report.tree.as_ref().is_some_and(|tree| !tree.closes()) {
        return format!("FAILED, the loops are not closed at home{remarks}");
    }
    match failed.as_slice() {
        [] => format!("OK, spec valid, {count} self-checks passed{remarks}"),
        failed => format!("FAILED, {} of {count} self-checks: {}{remarks}", failed.len(), failed.join(", ")),
    }
}

fn joints(spec: &Spec) -> String {
    let rows = spec.variables.iter().enumerate().map(|(i, variable)| {
        let [kind, limits, home] = joint(variable, spec.length);
        let moved = match spec.leg(i) {
            Some(leg) => format!("loop {}", leg.name),
            None => format!("frame {}", spec.frames[variable.frame].name),
        };
        [variable.name.clone(), kind, limits, format!("home {home}"), moved]
    });
    let rows: Vec<_> = rows.collect();
    let shown = if rows.len() > JOINTS { JOINTS - 1 } else { rows.len() };
    let mut text = aligned(&rows[..shown], [false; 5]);
    if shown < rows.len() {
        text += &format!("  … and {} more\n", rows.len() - shown);
    }
    text
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let spec = &report.spec;
    let moving = spec.variables.len();
    let is_fixed = |frame: &&Frame| frame.variable.is_none() && frame.passive.is_none();
    let fixed = spec.frames.iter().filter(is_fixed).count();
    let (name, tool) = match &report.tree {
        Some(tree) => ("Tree", format!("; tool on {}", tree.tool)),
        None => ("Chain", String::new()),
    };
    let mut facts = vec![(
        name,
        format!(
            "{}, {}, {} fixed{tool}; lengths in {}; orientation as {}",
            counted(spec.frames.len(), "frame", "frames"),
            counted(moving, "joint", "joints"),
            fixed,
            spec.length.symbol(),
            report.facts.orientation
        ),
    )];
    facts.extend(report.tree.iter().filter(|tree| tree.closes()).flat_map(|tree| loops(tree, spec)));
    if let Some(home) = &report.home {
        let [x, y, z] =
            [0, 1, 2].map(|i| number::trimmed(home.pose[i][3], number::error_decimals(spec.length)));
        facts.push(("Home", format!("tool point at ({x}, {y}, {z}) {} in F_0", spec.length.symbol())));
    }
    facts.push(("Sources", sources(report)));
    if !spec.parameters.is_empty() {
        let names: Vec<&str> = spec.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        facts.push((
            "Given",
            format!("{}: {}", counted(names.len(), "parameter", "parameters"), first(&names, 8)),
        ));
    }
    if !spec.inputs.is_empty() {
        let inputs: Vec<String> = spec
            .inputs
            .iter()
            .map(|input| {
                let [lower, upper] = input.range.map(short);
                format!("{} {} ({lower} … {upper})", input.name, quantity(input.value, &input.unit))
            })
            .collect();
        facts.push(("Inputs", first(&inputs, 4)));
    }
    if !report.identifiable.is_empty() {
        facts.push(("Identify", identifiable(&report.identifiable)));
    }
    facts
}

fn sources(report: &Report) -> String {
    let all = &report.facts.sources;
    let enabled = all.iter().filter(|source| source.enabled);
    let repeatable = enabled.clone().filter(|source| source.class == "repeatable").count();
    let random = enabled.count() - repeatable;
    let off = match all.len() - repeatable - random {
        0 => String::new(),
        off => format!(", {off} disabled"),
    };
    if all.is_empty() { "none".to_owned() } else { format!("{repeatable} repeatable, {random} random{off}") }
}

fn identifiable(counts: &[Identifiable]) -> String {
    let rank = |measurement: &str| {
        let found = counts.iter().find(|one| one.measurement == measurement && !one.base);
        found.map_or(String::new(), |one| match one.rank {
            Some(rank) => format!("{rank} of {}", one.unknowns),
            None => format!("an unknown number of {}", one.unknowns),
        })
    };
    format!("{} generalized errors from measured poses, {} from measured points", rank("pose"), rank("point"))
}
