//! Keys of a workspace.
//!
//! Words of a workspace that stand for one of a few values.

use abbe::analysis::ToolOrientation;
use abbe_spec::keys::{Rule, Then, When};

abbe_spec::tables! {
    "keys.txt", words { ORIENTATIONS } lists {}
    WORKSPACE BESIDE PRESENTED SAMPLES RANDOM BOX ORIENTATION PATH VALUES
}

/// Returns the relations between the keys of a workspace.
pub fn rules() -> Vec<Rule> {
    let one_of =
        |table, keys: Vec<&'static str>| Rule { table, when: When::Always, then: Then::NeedsOne(keys) };
    vec![
        one_of("[workspace]", WORKSPACE.names().collect()),
        one_of("[workspace.grid.NAME]", vec!["count", "step"]),
    ]
}

pub(super) const ORIENTATIONS: [(&str, ToolOrientation); 4] = [
    ("free", ToolOrientation::Free),
    ("home", ToolOrientation::Home),
    ("down", ToolOrientation::Along(2, [0.0, 0.0, -1.0])),
    ("up", ToolOrientation::Along(2, [0.0, 0.0, 1.0])),
];
