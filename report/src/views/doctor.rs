//! Diagnosis of data: the interpretation that fits, and its alternatives.

use abbe_metrology::doctor::{Finding, Report};
use abbe_spec::option::{CORRECTED_SPEC, WITHIN};
use abbe_study::number::digits;

use super::shared::some;
use crate::document::{Document, Section, first, joined};

/// Number of interpretations on the first screen.
const SHOWN: usize = 3;
/// Number of interpretations in a full report.
const LISTED: usize = 8;

/// Describes how the columns of data are meant.
pub fn doctor(report: &Report) -> Document {
    let Report { joints, seen, found, simpler, others, of_spec, length, .. } = report;
    let show = |finding: &Finding| format!("{} {length}  {}", digits(finding.residual, 3), finding.words);
    let mut facts = vec![("Joints", first(joints, 9)), ("Measured", first(seen, 9))];
    facts.extend(simpler.iter().map(|finding| ("Simpler", show(finding))));
    let alternatives = if found.len() > 1 { &found[1..] } else { &others[..] };
    let name = if found.len() > 1 { "Or" } else { "Next best" };
    facts.extend(some(name, &alternatives.iter().map(show).collect::<Vec<_>>(), SHOWN));
    facts.extend(some("In spec", of_spec, SHOWN));
    Document {
        kind: "Diagnosis of data",
        headline: conclusion(report),
        sections: vec![Section::answer().facts(facts), details(report)],
        ..Document::default()
    }
}

/// States the interpretation that fits, or the one that comes closest.
fn conclusion(report: &Report) -> String {
    let Report { found, others, length, .. } = report;
    let (first, rest) = match &found[..] {
        [] => {
            let nearest =
                others.first().map_or("no interpretation of these columns fits".to_owned(), |one| {
                    let turns = one.angle.map_or(String::new(), |angle| {
                        format!(
                            " of the positions and {}° of the orientations",
                            digits(angle.to_degrees(), 3)
                        )
                    });
                    let [left, spread, within] =
                        [one.residual, one.spread, report.within].map(|value| digits(value, 3));
                    format!(
                        "the closest leaves {left} {length}{turns} where they spread by {spread} {length}, and \
                         the limit is {within} {length}"
                    )
                });
            return format!("No interpretation fits: {nearest}. {}", advice(report));
        }
        [first, rest @ ..] => (first, rest.len()),
    };
    let (error, words) = (digits(first.residual, 3), &first.words);
    match rest {
        0 => format!("One interpretation fits, with an error of {error} {length}: {words}."),
        _ => format!(
            "{} interpretations fit these rows equally well; the simplest has an error of {error} \
             {length}: {words}.",
            rest + 1
        ),
    }
}

/// States what to check if no interpretation fits.
fn advice(report: &Report) -> String {
    let Report { still, moved, .. } = report;
    if still.is_empty() {
        return "Check that these are data of this machine, and which columns are the joints.".to_owned();
    }
    let verb = if still.len() == 1 { "does" } else { "do" };
    format!(
        "{} {verb} not move in these rows, only {}: too little to tell whether they are data of this \
         machine. Use rows in which every joint moves.",
        still.join(", "),
        moved.join(", ")
    )
}

fn details(report: &Report) -> Section {
    let Report { rows, joints, seen, found, simpler, others, of_spec, length, .. } = report;
    let columns = format!("Joint columns: {}. Measurement columns: {}.", joined(joints), joined(seen));
    let simpler = simpler.as_ref().map(|Finding { words, residual, both, .. }| {
        format!(
            "A simpler interpretation leaves {} {length}, more than noise, but possibly errors of this \
             machine: {words}. If its errors may be that large: `{WITHIN} \"{} {length}\"`.",
            digits(*residual, 3),
            digits(1.2 * both, 2)
        )
    });
    let found = if found.len() > 1 { &found[..] } else { &[] };
    Section::full("Interpretations")
        .state("columns", columns)
        .state("simpler", simpler)
        .list(
            "equally_good",
            &format!("These interpretations fit the {rows} rows equally well:"),
            listed(found, length),
        )
        .list("next_best", "Next best interpretations:", listed(others, length))
        .list(
            "in_the_spec",
            &format!(
                "A map cannot express this; change the spec (`{CORRECTED_SPEC}` does it where possible) or \
                 the file:"
            ),
            of_spec.clone(),
        )
}

fn listed(findings: &[Finding], length: &str) -> Vec<String> {
    let shown = findings.iter().take(LISTED).map(|Finding { words, residual, angle, .. }| {
        let angle = angle.map_or(String::new(), |angle| format!(", {}°", digits(angle.to_degrees(), 2)));
        format!("{} {length}{angle}: {words}", digits(*residual, 3))
    });
    let more = findings.len().saturating_sub(LISTED);
    let more = (more > 0).then(|| format!("… and {more} more"));
    shown.chain(more).collect()
}
