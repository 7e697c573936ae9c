//! Pose and dense `J_e` per configuration: generated code, the interpreter one by one and in blocks, and beside them
//! what one would write by hand, a loop over frames on nalgebra matrices.
//!
//! `cargo bench -p abbe-tests`

use abbe::analysis::sampling::{joint_sample, nominal_inputs, nominal_parameters};
use abbe::{Manipulator, Pose};
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, iiwa, pps, puma560, ur5};
use abbe_tests::frame_loop::{self, Columns, Frame};
use criterion::{
    BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime,
};

/// How many configurations are gone through: their results stay in the cache.
const COUNT: usize = 1024;

/// The joint values that the shipped robots' limits allow, all configurations one after the other.
fn configurations(robot: &dyn Manipulator) -> Vec<Vec<f64>> {
    let description = robot.description();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    (0..COUNT).map(|index| joint_sample(&description, 1.0, &moved, index)).collect()
}

/// Generated code at every configuration, without checks.
macro_rules! generated {
    ($group:expr, $module:ident, $robot:expr) => {{
        let q: Vec<[f64; $module::VARIABLES]> = configurations(&$robot)
            .iter()
            .map(|q| q.as_slice().try_into().expect("as many as variables"))
            .collect();
        let s = $module::Parameters::NOMINAL.to_array();
        let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; $module::ERRORS]);
        $group.bench_function(concat!(stringify!($module), "/generated"), |bencher| {
            bencher.iter(|| {
                for q in &q {
                    let _ =
                        $module::raw::error_jacobian(std::hint::black_box(q), &s, &mut pose, &mut columns);
                    std::hint::black_box(&mut columns);
                }
            });
        });
    }};
}

fn interpreted(group: &mut BenchmarkGroup<'_, WallTime>, name: &str) {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot");
    let spec = Spec::parse(name, shipped.spec).expect("shipped specs are right");
    let robot = Interpreter::new(&spec);
    let description = robot.description();
    let (s, u) = (nominal_parameters(&description), nominal_inputs(&description));
    let q = configurations(&robot);
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    group.bench_function(format!("{name}/interpreter, one by one"), |bencher| {
        bencher.iter(|| q.iter().all(|q| robot.error_jacobian(q, &s, &mut columns).is_ok()));
    });
    let (all, s, u) = (q.concat(), s.repeat(COUNT), u.repeat(COUNT));
    let mut poses = vec![Pose::IDENTITY; COUNT];
    let mut columns = vec![[0.0; 6]; COUNT * 6 * description.frames.len()];
    let mut effects = vec![0.0; COUNT * description.effects.len()];
    group.bench_function(format!("{name}/interpreter, blocks with sources"), |bencher| {
        bencher.iter(|| robot.error_models(&all, &s, &u, &mut poses, &mut columns, &mut effects));
    });

    // The loop gets its A_i ready made: what they cost is left out, in its favour.
    let s = nominal_parameters(&description);
    let transforms: Vec<Vec<Columns>> = q
        .iter()
        .map(|q| {
            let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
            robot.transforms(q, &s, &mut transforms).expect("within limits");
            transforms.iter().map(|pose| pose.0).collect()
        })
        .collect();
    let mut poses = vec![Frame::default(); description.frames.len() + 1];
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    group.bench_function(format!("{name}/nalgebra loop, matrices given"), |bencher| {
        bencher.iter(|| {
            for transforms in &transforms {
                std::hint::black_box(frame_loop::error_jacobian(transforms, &mut poses, &mut columns));
                std::hint::black_box(&mut columns);
            }
        });
    });
}

fn error_jacobian(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pose and dense J_e");
    group.throughput(Throughput::Elements(COUNT as u64));
    generated!(group, puma560, puma560::Puma560);
    interpreted(&mut group, "puma560");
    generated!(group, pps, pps::Pps);
    interpreted(&mut group, "pps");
    generated!(group, iiwa, iiwa::Iiwa);
    interpreted(&mut group, "iiwa");
    generated!(group, ur5, ur5::Ur5);
    interpreted(&mut group, "ur5");
    group.finish();
}

criterion_group!(benches, error_jacobian);
criterion_main!(benches);
