//! Inverse kinematics for boxes of tool points: in reach, out of reach, and mixed. Points that are
//! reached, stopped by limits and out of reach are measured separately. Then all solutions for
//! poses within the limits.
//!
//! `cargo bench -p abbe-tests --bench reach`

use std::hint::black_box;
use std::time::Duration;

use abbe::analysis::sampling::{arm_length, grid, home, joint_sample, nominal_parameters};
use abbe::analysis::{BLOCK, BaseBox, InverseKinematics, ReachError, ToolOrientation, Workspace, base_box};
use abbe::lanes::{Evaluate, InstructionSet, Inverse, Tiles};
use abbe::{Function, Manipulator};
use abbe_manipulators::{
    general6r::General6r, iiwa::Iiwa, pps::Pps, puma560::Puma560, stanford::Stanford, ur5::Ur5,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Number of points along each side.
const SIDE: usize = 8;

/// Outcomes of a point.
const OUTCOMES: [&str; 3] = ["reached", "stopped by limits", "out of reach"];

/// Sides of a box in metres.
type Sides = [[f64; 2]; 3];

const NEAR: Sides = [[0.3, 0.5], [-0.2, 0.2], [0.3, 0.6]];
const FAR: Sides = [[1.5, 2.5], [-1.0, 1.0], [0.0, 2.0]];
const AROUND: Sides = [[-1.1, 1.1], [-1.1, 1.1], [-0.7, 1.5]];

/// Returns the outcome of each point.
fn outcomes(workspace: &impl Workspace, indices: &[usize]) -> Vec<usize> {
    let mut outcomes = Vec::with_capacity(indices.len());
    for block in indices.chunks(BLOCK) {
        workspace.fill_each(block, &mut |_, _, filled| {
            outcomes.push(match filled {
                Ok(()) => 0,
                Err(ReachError::OutsideLimits { .. }) => 1,
                Err(_) => 2,
            });
        });
    }
    outcomes
}

fn reach(criterion: &mut Criterion) {
    let pps = [
        [[0.8, 1.4], [1.4, 1.8], [1.6, 2.2]],
        [[5.0, 6.0], [1.0, 2.0], [1.0, 3.0]],
        [[-1.0, 3.2], [1.0, 2.2], [0.0, 4.0]],
    ];
    let arm = [NEAR, FAR, AROUND];
    let robots: [(&dyn Manipulator, [Sides; 3]); 5] =
        [(&Iiwa, arm), (&General6r, arm), (&Ur5, arm), (&Puma560, arm), (&Pps, pps)];
    let mut group = criterion.benchmark_group("points");
    for (robot, boxes) in robots {
        let description = robot.description();
        for (name, sides) in ["in reach", "out of reach", "around"].into_iter().zip(boxes) {
            for (turned, orientation) in [("", ToolOrientation::Free), (", turned", ToolOrientation::Home)] {
                let in_unit = |side: [f64; 2]| side.map(|x| x / description.length.in_metres());
                let region = BaseBox {
                    points: sides.map(|side| grid(in_unit(side), SIDE)),
                    orientations: vec![orientation],
                    approaches: Vec::new(),
                    solved: (0..description.variables.len()).collect(),
                };
                let workspace = base_box(robot, &region).expect("its own variables");
                let all: Vec<usize> = (0..workspace.len()).collect();
                let found = outcomes(&workspace, &all);
                for (outcome, what) in OUTCOMES.into_iter().enumerate() {
                    let indices: Vec<usize> = all.iter().copied().filter(|i| found[*i] == outcome).collect();
                    if indices.is_empty() {
                        continue;
                    }
                    group.throughput(Throughput::Elements(indices.len() as u64));
                    let id = format!("{}/{name}{turned}: {what}", description.name);
                    group.bench_function(id, |bencher| bencher.iter(|| outcomes(&workspace, &indices)));
                }
            }
        }
    }
    group.finish();
}

/// Measures all solutions for poses within the limits: by `InverseKinematics`, by the generated
/// function, and by the same in lanes.
fn solutions(criterion: &mut Criterion) {
    solutions_of(criterion, &Puma560);
    solutions_of(criterion, &Ur5);
    solutions_of(criterion, &Stanford);
    solutions_of(criterion, &Pps);
}

fn solutions_of(criterion: &mut Criterion, robot: &impl Evaluate<Inverse>) {
    let mut group = criterion.benchmark_group("all solutions");
    let description = robot.description();
    let (home, s) = (home(description), nominal_parameters(description));
    let arm = arm_length(robot, &s).expect("finite");
    let all: Vec<usize> = (0..home.len()).collect();
    let pose = |index| robot.pose(&joint_sample(description, arm, &all, index), &s).expect("finite");
    let poses: Vec<_> = (0..256).map(pose).collect();
    let kinematics = InverseKinematics::new(robot, &s).expect("its own parameters");
    group.throughput(Throughput::Elements(poses.len() as u64));
    let solve =
        || poses.iter().map(|pose| kinematics.solve(&home, pose).map_or(0, |q| q.len())).sum::<usize>();
    group.bench_function(&*description.name, |bencher| bencher.iter(solve));
    let mut solutions = vec![0.0; description.solutions * home.len()];
    let mut found = vec![0.0; description.solutions];
    group.bench_function(format!("{}, generated", description.name), |bencher| {
        bencher.iter(|| {
            poses.iter().for_each(|pose| {
                robot.inverse(&home, &s, pose, &mut solutions, &mut found).expect("finite");
                black_box((&mut solutions, &mut found));
            });
        });
    });
    let set = InstructionSet::best();
    let signature = Function::Inverse.signature();
    let mut arguments = Tiles::new(set, signature.arguments_len(description), poses.len());
    for (i, pose) in poses.iter().enumerate() {
        let given = home.iter().chain(&s).chain(pose.0.as_flattened());
        given.enumerate().for_each(|(row, value)| arguments.set_value(row, i, *value));
    }
    arguments.pad();
    let mut results = Tiles::new(set, signature.results_len(description), poses.len());
    group.bench_function(format!("{}, in lanes", description.name), |bencher| {
        bencher.iter(|| abbe::lanes::run(robot, Inverse, &arguments, &mut results).expect("its rows"));
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = reach, solutions
}
criterion_main!(benches);
