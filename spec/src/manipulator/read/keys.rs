//! Keys of a spec file.
//!
//! Words of a spec file that stand for one of a few values.

use abbe_core::{Class, Component, Distribution, LengthUnit, Orientation, VariableKind};

use crate::expr::{Extrapolation, Interpolation};
use crate::keys::{Rule, Then, When};
use crate::manipulator::{Axes, Beam, Closure};

crate::tables! {
    "keys.txt", words {
        BEAM_AXES CLASSES CLOSURES INTERPOLATIONS JOINT_KINDS LENGTHS LOAD_AXES ORIENTATIONS OUTSIDE TOOL
    } lists {
        COMPONENTS: Component::ALL.map(Component::name).to_vec(),
        COORDINATES: Closure::COORDINATES.to_vec(),
        DISTRIBUTIONS: Distribution::ALL.map(Distribution::name).to_vec(),
    }
    FILE MANIPULATOR PARAMETER INPUT LOOKUP AXIS FRAME TOOL_FRAME DESCRIBED TRANSFORM VARIABLE
    FRAME_VARIABLE LIMIT LOOP DENAVIT_HARTENBERG ORIGIN SOURCE PLACE CAUSE DEVIATION NUMBERS
    MAGNITUDE BEAM COMPLIANCE COVARIANCE COVARIANCE_OF LOAD
}

/// Returns the relations between the keys of a spec file.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("[tables.NAME]", When::Has("file"), Then::Needs(vec!["x.column", "y.column"])),
        rule("[[frame]]", When::Always, Then::NeedsOne(TRANSFORM.names().collect())),
        rule("[tool]", When::Always, Then::NeedsOne(TRANSFORM.names().collect())),
        rule("[[loop]]", When::Is("closes", "distance"), Then::Needs(vec!["length"])),
        rule("[[source]]", When::Is("class", "random"), Then::Needs(vec!["distribution"])),
        rule("[[source]]", When::Lacks(vec!["joint", "parameter", "effect"]), Then::Needs(vec!["frame"])),
        rule("[[source.effect]]", When::Lacks(vec!["joint", "parameter"]), Then::Needs(vec!["frame"])),
        rule("[[load]]", When::Always, Then::NeedsOne(vec!["mass", "force", "moment"])),
    ];
    for table in ["[[source]]", "[[source.effect]]"] {
        rules.extend([
            rule(table, When::Has("parameter"), Then::Needs(vec!["error"])),
            rule(table, When::Has("joint"), Then::NeedsOne(vec!["error", "stiffness"])),
            rule(table, When::Has("moment"), Then::Needs(vec!["stiffness"])),
        ]);
    }
    for table in &BEAM.tables {
        for (word, axis) in BEAM_AXES {
            let whens = [Some(When::Is("axis", word)), (axis == 0).then(|| When::Lacks(vec!["axis"]))];
            for when in whens.into_iter().flatten() {
                let [first, second] = Beam::bending_keys(axis);
                rules.push(rule(table, when.clone(), Then::Needs(vec![first, second])));
                rules.push(rule(table, when, Then::Refuses(vec![["EI_x", "EI_y", "EI_z"][axis]])));
            }
        }
    }
    for table in &COMPLIANCE.tables {
        rules.push(rule(table, When::Always, Then::NeedsOne(COMPLIANCE.names().collect())));
    }
    rules
}

pub(super) const LENGTHS: [(&str, LengthUnit); 2] =
    [("mm", LengthUnit::Millimetre), ("m", LengthUnit::Metre)];

pub(super) const ORIENTATIONS: [(&str, Orientation); 3] = [
    ("rotation-vector", Orientation::RotationVector),
    ("euler-yzx", Orientation::EulerYzx),
    ("iec-61217", Orientation::Iec61217),
];

pub(super) const JOINT_KINDS: [(&str, VariableKind); 2] =
    [("revolute", VariableKind::Revolute), ("prismatic", VariableKind::Prismatic)];

pub(super) const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("cubic", Interpolation::Cubic)];

pub(super) const OUTSIDE: [(&str, Extrapolation); 1] = [("hold", Extrapolation::Hold)];

/// Closures of a loop, each with its coordinates; a distance has none.
pub(super) const CLOSURES: [(&str, &[usize]); 3] =
    [("point", &[0, 1, 2]), ("pose", &[0, 1, 2, 3, 4, 5]), ("distance", &[])];

/// Classes of a source, with a distribution that stands for any.
pub(super) const CLASSES: [(&str, Class); 3] = [
    ("repeatable", Class::Repeatable),
    ("tolerance", Class::Tolerance(Distribution::Uniform)),
    ("random", Class::Random(Distribution::Uniform)),
];

pub(super) const BEAM_AXES: [(&str, usize); 3] = [("x", 0), ("y", 1), ("z", 2)];

pub(super) const LOAD_AXES: [(&str, Axes); 2] = [("frame", Axes::Frame), ("base", Axes::Base)];

pub(super) const TOOL: [(&str, ()); 1] = [("tool", ())];
