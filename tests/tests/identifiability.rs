//! How many generalized errors can be known: the ranks of the stacked `J_e`, as theory has them.

use abbe::Manipulator;
use abbe::analysis::{Measurement, Workspace, identifiable, joint_samples};
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, pps::Pps, puma560::Puma560};

fn ranks(robot: &dyn Manipulator, moved: &[usize]) -> [usize; 4] {
    let workspace = joint_samples(robot, moved, 80).unwrap().reached();
    [
        (Measurement::Pose, false),
        (Measurement::Point, false),
        (Measurement::Pose, true),
        (Measurement::Point, true),
    ]
    .map(|(measurement, base)| identifiable(robot, &workspace, measurement, base).unwrap().rank)
}

#[test]
fn patient_positioner() {
    // pose, treatment point; then both with a base frame.
    assert_eq!(ranks(&Pps, &[0, 1, 2, 3, 4, 5]), [22, 19, 24, 21]);
    // The paper's measurements: roll and pitch at rest.
    assert_eq!(ranks(&Pps, &[0, 1, 2, 3]), [14, 11, 16, 13]);
}

#[test]
fn six_revolute_joints() {
    assert_eq!(ranks(&Puma560, &[0, 1, 2, 3, 4, 5])[0], 26);
    assert_eq!(ranks(&Puma560, &[0, 1, 2, 3, 4, 5])[2], 30);
    // With the tool point off the last axis.
    let puma = SHIPPED.iter().find(|shipped| shipped.name == "puma560").unwrap();
    let text = format!("{}\n[tool]\ntransform = \"Tx(0.1) Ty(0.05) Tz(0.2)\"\n", puma.spec);
    let spec = Spec::parse("puma560.toml", &text).unwrap();
    assert_eq!(ranks(&Interpreter::new(spec.clone()), &[0, 1, 2, 3, 4, 5]), [26, 23, 30, 27]);
}

/// With poses and a base frame, 4R + 2P + 6 remain: for every shipped manipulator whose frames all move.
#[test]
fn four_per_revolute_and_two_per_prismatic_joint() {
    let mut judged = 0;
    for shipped in SHIPPED {
        let description = shipped.compiled.description();
        if description.frames.iter().any(|frame| frame.variable.is_none()) {
            continue;
        }
        let prismatic =
            description.variables.iter().filter(|v| v.kind == abbe::VariableKind::Prismatic).count();
        let revolute = description.variables.len() - prismatic;
        let all: Vec<usize> = (0..description.variables.len()).collect();
        let rank = ranks(shipped.compiled, &all)[2];
        assert_eq!(rank, 4 * revolute + 2 * prismatic + 6, "{}", shipped.name);
        judged += 1;
    }
    assert!(judged > 5, "{judged} of the shipped manipulators");
}
