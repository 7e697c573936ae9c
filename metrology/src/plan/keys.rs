//! Keys of a plan file, except those of its workspaces.

use abbe_spec::keys::Value::{Names, Table, Tables, Text, Whole};
use abbe_spec::keys::{Rule, Then, When};

use abbe_study::workspace::AXIS;

/// Largest number of measurements of a row.
pub(super) const MOST_REPEATS: u32 = 1000;

abbe_spec::tables! {
    FILE: ["the file"], [
        "plan": Table("[plan]"), "-", "required", "Title of the plan, and repetitions";
        "set": Tables("[[set]]"), "-", "required", "Configurations to measure";
        "inputs": Names("table of `INPUT = values`", &AXIS), "as the spec's", "the nominal values",
            "Values of inputs; each set is measured with each of them";
    ]
    PLAN: ["[plan]"], [
        "title": Text("text"), "-", "empty", "Title of the plan";
        "description": Text("text"), "-", "empty", "Description of the plan, for people";
        "repeat": Whole(1, Some(MOST_REPEATS)), "1", "`1`", "Number of measurements of each row";
    ]
    SET: ["[[set]]"], [
        "name": Text("text"), "-", "empty", "Name of the set";
        "workspace": Table("[workspace]"), "-", "required without `axes`", "Configurations, in any form of a workspace";
        "axes": Names("table of `VARIABLE = values`", &AXIS), "length unit or rad", "one of the two",
            "Values of one variable at a time; all others stay at home";
    ]
}

/// Returns the relations between the keys of a plan.
pub fn rules() -> Vec<Rule> {
    vec![Rule { table: "[[set]]", when: When::Lacks(vec!["axes"]), then: Then::Needs(vec!["workspace"]) }]
}
