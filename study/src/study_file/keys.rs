//! Keys of a study file, except those of its workspaces.

use abbe_spec::keys::{Keys, Rule, Then, When, words};

use super::choices::{CRITERIA, CombinedFigure, KINDS, Kind, MACHINES, MEASURANDS, Metric, UP_AXES};

abbe_spec::tables! {
    "keys.txt", words { CRITERIA KINDS MACHINES MEASURANDS UP_AXES } lists {
        COMBINED: words(&CombinedFigure::ALL),
        METRICS: words(&Metric::ALL),
    }
    FILE STUDY TOLERANCE COMPENSATION ALLOCATION FIGURE GATHERED ROWS OVER UP PUBLISHED OF_A_SOURCE
    OF_ALL COMPENSATED
}

/// Returns the keys of a kind of figure.
pub(super) fn accepted(kind: Kind) -> Vec<&'static Keys> {
    match kind {
        Kind::Travel | Kind::Surface => vec![&GATHERED, &OVER, &ROWS, &FIGURE],
        Kind::Cloud | Kind::Histogram => vec![&GATHERED, &ROWS, &FIGURE],
        Kind::Manipulator => vec![&UP, &FIGURE],
        Kind::Pareto => vec![&ROWS, &FIGURE],
    }
}

/// Returns the relations between the keys of a study.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("[study.tolerance]", When::Always, Then::NeedsOne(vec!["position", "orientation"])),
        rule("[[figure]]", When::Is("kind", "travel"), Then::Needs(vec!["over"])),
        rule("[[figure]]", When::Is("kind", "surface"), Then::Needs(vec!["over"])),
        rule("[[published]]", When::Always, Then::NeedsOne(vec!["source", "combined"])),
        rule("[[published]]", When::Has("source"), Then::Needs(vec!["metric"])),
        rule("[[published]]", When::Has("source"), Then::Refuses(OF_ALL.names().collect())),
        rule("[[published]]", When::Has("combined"), Then::Refuses(OF_A_SOURCE.names().collect())),
    ];
    for (word, kind) in KINDS {
        let known = accepted(kind);
        let all =
            tables().into_iter().filter(|keys| keys.tables == FIGURE.tables).flat_map(|keys| keys.names());
        let others = all.filter(|key| !known.iter().any(|keys| keys.contain(key))).collect();
        rules.push(rule("[[figure]]", When::Is("kind", word), Then::Refuses(others)));
    }
    rules
}
