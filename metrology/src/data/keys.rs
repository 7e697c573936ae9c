//! Keys of a map.

use abbe::identify::{INSTRUMENTS, InstrumentKind};
use abbe_spec::keys::Rule;
use abbe_spec::keys::Then::{Needs, NeedsOne, Refuses};
use abbe_spec::keys::When::{Always, Has, Is, Lacks};

use super::choices::{
    BASES, COMMANDS, INTRINSIC_CHOICES, JUDGED_TARGETS, MOUNTS, PLACEMENTS, QUATERNION_ORDERS, UNKNOWN,
};
use super::{target_frame::TARGET_FRAMES, turn::EULER_ORDERS};

/// Keys of an instrument that can be left out.
const OPTIONAL: [&str; 10] = [
    "target",
    "zero",
    "nominal_radius",
    "range",
    "board",
    "pitch",
    "corners",
    "center",
    "distortion",
    "intrinsics",
];

abbe_spec::tables! {
    "keys.txt", words {
        BASES COMMANDS EULER_ORDERS INTRINSIC_CHOICES JUDGED_TARGETS MOUNTS PLACEMENTS QUATERNION_ORDERS
        TARGET_FRAMES UNKNOWN
    } lists {
        INSTRUMENTS: INSTRUMENTS.map(|kind| kind.name).to_vec(),
    }
    FILE FORMS STANDS DATA SIGHT CHANNEL FROM_ROWS POINT DIFFERENCE TARGET ANY_INSTRUMENT INSTRUMENT
    BOARD EVERY_INSTRUMENT POSE TURN QUATERNION EULER ROTATION_VECTOR STATION PLACE DISTANCE ACCEPT
    RECORD PLACEMENT PLACEMENT_OF_STATION
}

/// Returns the keys that the table of an instrument of this kind must have, beside those that all
/// have.
pub fn required_keys(kind: &InstrumentKind) -> Vec<&'static str> {
    let found = |key: &&str| kind.finds_position && *key == "at";
    kind.keys.iter().copied().filter(|key| !OPTIONAL.contains(key) && !found(key)).collect()
}

/// Returns the relations between the keys of a map.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("the file", Always, NeedsOne(FORMS.names().collect())),
        rule("the file", Always, NeedsOne(vec!["joints", "command_pose"])),
        rule(
            "the file",
            Lacks(vec!["instrument"]),
            Needs(vec!["data.uncertainty", "target[].columns", "target[].unit"]),
        ),
        rule("the file", Has("instrument"), Needs(vec!["target[].name"])),
        rule("the file", Has("instrument"), Refuses(vec!["target[].columns", "target[].unit"])),
        rule("the file", Lacks(vec!["data.uncertainty"]), Needs(vec!["instrument[].uncertainty"])),
        rule(
            "the file",
            Has("pose"),
            Needs(vec![
                "data.angle_uncertainty",
                "placement.position",
                "placement.quaternion",
                "placement[].position",
                "placement[].quaternion",
            ]),
        ),
        rule("the file", Always, Needs(vec!["placement[].station"])),
        // A camera has the pose of the measured frame there, as `[pose]` has.
        rule(
            "the file",
            Lacks(vec!["pose", "instrument"]),
            Needs(vec!["placement.targets", "placement[].targets"]),
        ),
        rule("[joints.NAME]", Lacks(vec!["value"]), Needs(vec!["column", "unit"])),
        rule(
            "[inputs.NAME]",
            Lacks(vec!["value", "approach", "gravity_moment"]),
            Needs(vec!["column", "unit"]),
        ),
        rule("[pose]", Always, NeedsOne(TURN.names().collect())),
    ];
    for key in FROM_ROWS.names() {
        rules.push(rule("[inputs.NAME]", Has(key), Refuses(CHANNEL.names().collect())));
    }
    for kind in INSTRUMENTS {
        let of_kind = || Is("kind", kind.name);
        let others = INSTRUMENT.names().chain(BOARD.names()).filter(|key| !kind.has(key)).collect();
        let required = required_keys(kind);
        if !required.is_empty() {
            rules.push(rule("[[instrument]]", of_kind(), Needs(required)));
        }
        rules.push(rule("[[instrument]]", of_kind(), Refuses(others)));
    }
    rules
}
