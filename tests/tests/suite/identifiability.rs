//! Numbers of identifiable generalized errors: the ranks of the stacked `J_e`, compared with
//! theory.

use abbe::analysis::{
    Measurement, Parts, Workspace, identifiable, identifiable_in_parts, joint_samples, random_joint_samples,
};
use abbe::{Manipulator, Orientation};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, pps::Pps, puma560::Puma560};
use abbe_spec::Spec;
use abbe_tests::abuse::{Choices, plain_spec};
use abbe_tests::chains::{coupled_joints, general_chain, revolute_chain};
use abbe_tests::{sample_size, thorough};

/// Measurements of pose and point, without and with a base frame.
const WAYS: [(Measurement, bool); 4] = [
    (Measurement::Pose, false),
    (Measurement::Point, false),
    (Measurement::Pose, true),
    (Measurement::Point, true),
];

fn ranks(robot: &dyn Manipulator, moved: &[usize]) -> [usize; 4] {
    let workspace = joint_samples(robot, moved, 80).unwrap().reached();
    WAYS.map(|(measurement, base)| identifiable(robot, &workspace, measurement, base).unwrap().rank)
}

#[test]
fn patient_positioner() {
    // Pose, treatment point; then both with a base frame.
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

/// Checks that with poses and a base frame 4R + 2P + 6 remain, for every shipped manipulator whose
/// frames all move.
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

/// Returns the ranks from the parts of the chain, with the smallest singular value above the
/// threshold and the largest below it.
fn ranks_in_parts(spec: &Spec) -> ([usize; 4], [f64; 2]) {
    let robot = Interpreter::new(spec.clone());
    let parts = Parts::new(&spec.variables_of_transforms());
    let all: Vec<usize> = (0..spec.variables.len()).collect();
    let count = 60.max(3 * parts.longest());
    let configurations = random_joint_samples(&robot, &all, count, 1).unwrap().reached();
    let mut gap = [f64::INFINITY, 0.0];
    let ranks = WAYS.map(|(measurement, base)| {
        let found = identifiable_in_parts(&robot, &parts, &configurations, measurement, base).unwrap();
        assert_eq!(found.singular_values.len(), found.unknowns);
        assert_eq!(found.unknowns, 6 * (spec.frames.len() + usize::from(base)));
        let (kept, dropped) = found.gap();
        gap = [gap[0].min(kept.unwrap_or(f64::INFINITY)), gap[1].max(dropped.unwrap_or(0.0))];
        found.rank
    });
    (ranks, gap)
}

/// Returns the ranks from the stack of all error Jacobians, as [`ranks`] does, with their gap.
fn ranks_of_the_stack(spec: &Spec) -> ([usize; 4], [f64; 2]) {
    let robot = Interpreter::new(Spec { orientation: Orientation::RotationVector, ..spec.clone() });
    let all: Vec<usize> = (0..spec.variables.len()).collect();
    let count = 60.max(10 * spec.frames.len());
    let configurations = random_joint_samples(&robot, &all, count, 2).unwrap().reached();
    let mut gap = [f64::INFINITY, 0.0];
    let ranks = WAYS.map(|(measurement, base)| {
        let found = identifiable(&robot, &configurations, measurement, base).unwrap();
        let (kept, dropped) = found.gap();
        gap = [gap[0].min(kept.unwrap_or(f64::INFINITY)), gap[1].max(dropped.unwrap_or(0.0))];
        found.rank
    });
    (ranks, gap)
}

#[test]
fn parts_of_a_chain_have_the_rank_of_the_whole() {
    let with_tool = |text: String, tool: &str| format!("{text}[tool]\ntransform = \"{tool}\"\n");
    // A tool point on the last axis, and on the axes of the last two joints.
    let on_axes = "[manipulator]\nname = \"arm\"\nlength = \"m\"\n\
        [[frame]]\nname = \"1\"\nvariable = { name = \"a\", kind = \"revolute\" }\ntransform = \"Rz(a) Tx(0.4) Rx(0.3)\"\n\
        [[frame]]\nname = \"2\"\ntransform = \"Tz(0.3) Ry(0.2)\"\n\
        [[frame]]\nname = \"3\"\nvariable = { name = \"b\", kind = \"revolute\" }\ntransform = \"Tx(0.2) Rz(b) Tz(0.1)\"\n\
        [[frame]]\nname = \"4\"\nvariable = { name = \"c\", kind = \"revolute\" }\ntransform = \"Rz(c) Tz(0.2)\"\n\
        [[frame]]\nname = \"5\"\nvariable = { name = \"d\", kind = \"prismatic\" }\ntransform = \"Tz(d)\"\n";
    let scissors = "[manipulator]\nname = \"arm\"\nlength = \"m\"\n\
        [[frame]]\nname = \"1\"\nvariable = { name = \"a\", kind = \"revolute\" }\ntransform = \"Rz(a) Tx(0.4) Rx(0.3)\"\n\
        [[frame]]\nname = \"2\"\nvariable = { name = \"b\", kind = \"revolute\" }\ntransform = \"Rz(b - a) Tx(0.3) Rx(0.7)\"\n\
        [[frame]]\nname = \"3\"\nvariable = { name = \"c\", kind = \"revolute\" }\ntransform = \"Rz(c + sin(c)) Tx(0.3)\"\n";
    let made = [
        coupled_joints().to_owned(),
        general_chain(7),
        with_tool(general_chain(12), "Tx(0.1) Rz(0.3) Ty(0.2)"),
        revolute_chain(9),
        with_tool(revolute_chain(4), "Tx(q1*0.1 m)"),
        on_axes.to_owned(),
        with_tool(on_axes.to_owned(), "Tx(0.1)"),
        scissors.to_owned(),
    ];
    let shipped = SHIPPED.iter().map(|shipped| shipped.spec.to_owned());
    for text in shipped.chain(made) {
        let spec = Spec::parse("chain.toml", &text).unwrap_or_else(|refused| panic!("{refused}"));
        let (found, gap) = ranks_in_parts(&spec);
        assert_eq!(found, ranks_of_the_stack(&spec).0, "{}: {gap:?}\n{text}", spec.name);
        assert!(gap[0] > 1e-6 && gap[1] < 1e-12, "{}: {gap:?}", spec.name);
    }
}

#[test]
fn parts_of_random_chains_have_the_rank_of_the_whole() {
    let mut judged = 0;
    let count = sample_size(150) as u64;
    for seed in 0..count {
        let text = plain_spec(&mut Choices::seeded(seed));
        let Ok(spec) = Spec::parse("random.toml", &text) else { continue };
        let (expected, gap) = ranks_of_the_stack(&spec);
        // A stack without a clear gap is no reference.
        if gap[0] > 1e-6 && gap[1] < 1e-12 {
            let (found, gap) = ranks_in_parts(&spec);
            assert_eq!(found, expected, "{seed}: {gap:?}\n{text}");
            judged += 1;
        }
    }
    assert!(judged > count / 3, "{judged} of {count} random chains were clear");
}

/// Checks `4R + 2P + 6` with poses and a base frame, and its consequences, for long chains.
#[test]
fn long_chains_have_the_rank_of_theory() {
    let chains =
        [(general_chain(300), 150, 150), (revolute_chain(300), 300, 0), (general_chain(1001), 501, 500)];
    for (text, revolute, prismatic) in chains.into_iter().take(if thorough() { 3 } else { 2 }) {
        let spec = Spec::parse("chain.toml", &text).unwrap();
        let (found, gap) = ranks_in_parts(&spec);
        let all = 4 * revolute + 2 * prismatic + 6;
        // Without base frame: the rotation that the first joint absorbs is no error of a preceding
        // frame.
        let own = all - 4;
        assert_eq!(found, [own, own - 3, all, all - 3]);
        assert!(gap[0] > 1e-6 && gap[1] < 1e-12, "{gap:?}");
    }
}
