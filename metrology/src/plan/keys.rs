//! Keys of a plan file, except those of its workspaces.

use abbe_spec::keys::{Rule, Then, When};

/// Largest number of measurements of a row.
pub(super) const MOST_REPEATS: u32 = 1000;

abbe_spec::tables! {
    "keys.txt", words {} lists {} FILE PLAN SET
}

/// Returns the relations between the keys of a plan.
pub fn rules() -> Vec<Rule> {
    vec![Rule { table: "[[set]]", when: When::Lacks(vec!["axes"]), then: Then::Needs(vec!["workspace"]) }]
}
