//! The compensator on the true model: corrected commands put the real tool where the ideal one is.

use abbe::analysis::{Axis, Presentation, Workspace, corrected, presented_volume, sampling};
use abbe::compensator::{Compensated, norms};
use abbe::{Error, Manipulator, Orientation, Quantity, deviation};
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, iiwa, pps};

/// The paper's treatment volume, 27 points presented at the isocentre in every angle of spin.
fn treatment_volume() -> impl Workspace {
    let indices = |names: [&str; 3]| {
        names.map(|name| pps::DESCRIPTION.parameters.iter().position(|p| p.name == name).unwrap())
    };
    let [x, y, z] = indices(["x", "y", "z"]);
    let presentation = Presentation {
        point: [1128.0, 1626.0, 1846.0],
        tool_points: vec![
            Axis { index: x, values: vec![-250.0, 0.0, 250.0] },
            Axis { index: y, values: vec![-100.0, 100.0, 300.0] },
            Axis { index: z, values: vec![600.0, 850.0, 1100.0] },
        ],
        approaches: vec![Axis {
            index: 3,
            values: (-18..=18).map(|i| f64::from(5 * i).to_radians()).collect(),
        }],
        solved: vec![0, 1, 2],
    };
    presented_volume(&pps::Pps, &presentation).unwrap()
}

fn within(robot: &dyn Manipulator, q: &[f64]) -> bool {
    robot.description().variables.iter().zip(q).all(|(v, q)| (v.limits[0]..=v.limits[1]).contains(q))
}

/// What the module documentation of `abbe::compensator` says of the PPS.
#[test]
fn the_treatment_volume_is_compensated_within_limits() {
    let (volume, u) = (treatment_volume(), pps::Inputs::NOMINAL);
    let (mut before, mut after, mut turned) = (0.0_f64, 0.0_f64, 0.0_f64);
    for index in 0..volume.len() {
        let (mut q, mut s) = ([0.0; pps::VARIABLES], pps::Parameters::NOMINAL.to_array());
        volume.fill(index, &mut q, &mut s).unwrap();
        let tool = |name| s[pps::DESCRIPTION.parameters.iter().position(|p| p.name == name).unwrap()];
        let s = pps::Parameters { x: tool("x"), y: tool("y"), z: tool("z"), ..pps::Parameters::NOMINAL };
        let found = pps::compensated(&q, &s, &u).unwrap();
        assert!(within(&pps::Pps, &found.q), "{:?}", found.q);
        // On the exact chain, frame by frame: nothing that the compensator itself computes.
        let (mut transforms, errors) =
            ([abbe::Pose::IDENTITY; pps::FRAMES + 1], pps::generalized_errors(&found.q, &s, &u).unwrap());
        pps::Pps.transforms(&found.q, &s.to_array(), &mut transforms).unwrap();
        let real = abbe::real_pose(&transforms, &errors);
        let left = deviation(Orientation::RotationVector, &pps::pose(&q, &s).unwrap(), &real);
        before = before.max(norms(&found.before).0);
        after = after.max(norms(&left).0);
        turned = turned.max(norms(&left).1);
    }
    println!("pps: {before} mm down to {after} mm and {turned} rad, {} configurations", volume.len());
    assert!((5.3..5.6).contains(&before));
    assert!(after < 1e-6 && turned < 1e-9, "{after} mm, {turned} rad");
}

/// A spec with errors beside its own: half a millimetre and a milliradian here and there.
fn with_errors(shipped: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|s| s.name == shipped).unwrap();
    let nominal = Spec::parse("nominal", shipped.spec).unwrap();
    let effects = nominal.frames.iter().enumerate().map(|(i, frame)| {
        let size = |k: usize| ((6 * i + k) as f64 * 1.7).sin();
        format!(
            "[[source.effect]]\nframe = \"{}\"\ne_x = \"{} mm\"\ne_y = \"{} mm\"\ne_s = \"{} mrad\"\ne_r = \"{} mrad\"\ne_p = \"{} mrad\"\n",
            frame.name,
            0.5 * size(0),
            0.5 * size(1),
            size(3),
            size(4),
            size(5)
        )
    });
    let text = format!(
        "{}\n[[source]]\nname = \"for the compensator\"\nclass = \"repeatable\"\n{}",
        shipped.spec,
        effects.collect::<String>()
    );
    Spec::parse("with errors", &text).unwrap_or_else(|found| panic!("{}", found.render(false)))
}

/// Joint samples, those next to limits aside: half the range about its middle.
fn samples(robot: &dyn Manipulator, count: usize) -> Vec<Vec<f64>> {
    let description = robot.description();
    let all: Vec<usize> = (0..description.variables.len()).collect();
    let sample = |i| sampling::joint_sample(&description, 1.0, &all, i);
    let inner = |q: Vec<f64>| {
        let each = q.into_iter().zip(description.variables);
        each.map(|(q, v)| 0.5 * q + 0.25 * (v.limits[0] + v.limits[1])).collect()
    };
    (0..count).map(sample).map(inner).collect()
}

struct Judged {
    q: Vec<f64>,
    found: Compensated<Vec<f64>>,
    before: (f64, f64),
    after: (f64, f64),
}

fn judged(robot: &dyn Manipulator) -> Vec<Judged> {
    let description = robot.description();
    let (s, u) = (sampling::nominal_parameters(&description), sampling::nominal_inputs(&description));
    let each = samples(robot, 400).into_iter().map(|q| {
        let found = corrected(robot, None, &q, &s, &u).unwrap();
        let (before, after) = (norms(&found.before), norms(&found.after));
        assert!(within(robot, &found.q));
        Judged { q, found, before, after }
    });
    each.collect()
}

/// The share of configurations with less than this left, and that nothing became worse.
fn compensated(name: &str, angle: bool) -> f64 {
    let spec = with_errors(name);
    let robot = Interpreter::new(&spec);
    let judged = judged(&robot);
    let unit = robot.description().length.in_metres();
    let done = |j: &&Judged| j.after.0 * unit < 1e-9 && (!angle || j.after.1 < 1e-9);
    let done = judged.iter().filter(done).count() as f64 / judged.len() as f64;
    let worst = |norm: fn(&Judged) -> f64| judged.iter().map(norm).fold(0.0, f64::max);
    println!(
        "{name}: {:e} down to {:e} {}, {:e} down to {:e} rad, {done} to a nanometre",
        worst(|j| j.before.0),
        worst(|j| j.after.0),
        robot.description().length.symbol(),
        worst(|j| j.before.1),
        worst(|j| j.after.1)
    );
    done
}

#[test]
fn six_joints_are_exact_but_near_singularities() {
    for name in ["pps", "puma560", "ur5", "stanford", "general6r"] {
        assert!(compensated(name, true) > 0.95, "{name}");
    }
}
#[test]
fn seven_joints_are_exact_but_near_singularities() {
    for name in ["iiwa", "panda", "wam"] {
        assert!(compensated(name, true) > 0.97, "{name}");
    }
}

/// Three and four joints: the tool point is right, turns stay.
#[test]
fn few_joints_bring_the_tool_point_there() {
    assert!(compensated("machine3", false) == 1.0);
    assert!(compensated("scara", false) > 0.97);
}
