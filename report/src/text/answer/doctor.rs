//! The answer of the doctor: the convention that fits, and the alternatives.

use abbe_metrology::doctor::{Finding, Report};
use abbe_study::number::digits;

use super::{Answer, first};

/// Number of interpretations shown.
const SHOWN: usize = 3;

pub(in crate::text) fn doctor(report: &Report) -> String {
    let Report { joints, seen, found, simpler, others, of_spec, length, .. } = report;
    let mut answer = Answer::new(&report.sentence);
    let show = |finding: &Finding| format!("{} {length}  {}", digits(finding.residual, 3), finding.words);
    let mut facts = vec![("Joints", first(joints, 9)), ("Measured", first(seen, 9))];
    facts.extend(simpler.iter().map(|finding| ("Simpler", show(finding))));
    let alternatives = if found.len() > 1 { &found[1..] } else { &others[..] };
    let name = if found.len() > 1 { "Or" } else { "Next best" };
    let alternatives: Vec<String> = alternatives.iter().map(show).collect();
    facts.extend(super::some(name, &alternatives, SHOWN));
    facts.extend(super::some("In spec", of_spec, SHOWN));
    answer.facts(facts);
    answer.0
}
