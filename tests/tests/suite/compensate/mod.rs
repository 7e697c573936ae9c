//! The compensator on the true model: compensated commands put the real tool where the ideal one
//! is.

mod bounded;
mod corners;
pub(crate) mod cycles;

use abbe::analysis::{
    Axis, Goal, Missing, Presentation, Workspace, compensated, mobility, obstacle, presented_volume, sampling,
};
use abbe::compensator::{Cycle, Status, norms};
use abbe::{
    Error, Manipulator, Orientation, Quantity, VariableKind, deviation, drawn_pose, repeatable_magnitudes,
};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, iiwa, pps};
use abbe_spec::Spec;

use bounded::hard_rows;

/// Returns the paper's treatment volume, 27 points presented at the isocenter at every spin angle.
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

/// Checks the figures for the PPS in the module documentation of `abbe::compensator`.
#[test]
fn the_treatment_volume_is_compensated_within_limits() {
    let (volume, u) = (treatment_volume(), pps::Inputs::NOMINAL);
    let (mut before, mut after, mut turned) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut held, mut turned_at_limit) = (0, 0.0_f64);
    for index in 0..volume.len() {
        let place = volume.configuration(index).unwrap();
        let q: [f64; pps::VARIABLES] = place.q.try_into().unwrap();
        let s = place.s;
        let tool = |name| s[pps::DESCRIPTION.parameters.iter().position(|p| p.name == name).unwrap()];
        let s = pps::Parameters { x: tool("x"), y: tool("y"), z: tool("z"), ..pps::Parameters::NOMINAL };
        let command = pps::compensated(&q, &s, &u, &Cycle::UNBOUNDED).unwrap();
        assert!(within(&pps::Pps, &command.q), "{:?}", command.q);
        // On the exact chain, frame by frame, independently of the compensator.
        let (mut transforms, errors) =
            ([abbe::Pose::IDENTITY; pps::FRAMES + 1], pps::generalized_errors(&command.q, &s, &u).unwrap());
        pps::Pps.transforms(&command.q, &s.to_array(), &mut transforms).unwrap();
        let real = abbe::real_pose(&transforms, &errors);
        let left = deviation(Orientation::RotationVector, &pps::pose(&q, &s).unwrap(), &real);
        assert!(left.iter().all(|number| number.is_finite()), "{left:?}");
        before = before.max(norms(&command.before).0);
        after = after.max(norms(&left).0);
        // A limit affects the orientation, not the tool point.
        let at_limit = pps::DESCRIPTION.variables.iter().zip(&command.q).any(|(v, q)| v.limits.contains(q));
        held += usize::from(at_limit);
        let turn = if at_limit { &mut turned_at_limit } else { &mut turned };
        *turn = turn.max(norms(&left).1);
    }
    println!("pps: {before} mm down to {after} mm, {turned} rad; {held} at a limit, {turned_at_limit} rad");
    assert!((5.3..5.6).contains(&before));
    assert!(after < 1e-5 && turned < 1e-9 && turned_at_limit < 3e-3, "{after} mm, {turned} rad");
    assert!(held < volume.len() / 10, "{held}");
}

/// Returns a shipped spec with additional errors of half a millimetre and a milliradian.
fn with_errors(shipped: &str) -> Spec {
    with_errors_in(SHIPPED.iter().find(|s| s.name == shipped).unwrap().spec)
}

/// Returns a spec with additional errors of half a millimetre and a milliradian.
fn with_errors_in(text: &str) -> Spec {
    let nominal = Spec::parse("nominal", text).unwrap();
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
        "{text}\n[[source]]\nname = \"for the compensator\"\nclass = \"repeatable\"\n{}",
        effects.collect::<String>()
    );
    Spec::parse("with errors", &text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false)))
}

/// Returns joint samples away from limits: half the range about its center.
fn samples(robot: &dyn Manipulator, count: usize) -> Vec<Vec<f64>> {
    let description = robot.description();
    let all: Vec<usize> = (0..description.variables.len()).collect();
    let sample = |i| sampling::joint_sample(description, 1.0, &all, i);
    let inner = |q: Vec<f64>| {
        let each = q.into_iter().zip(&description.variables);
        each.map(|(q, v)| 0.5 * q + 0.25 * (v.limits[0] + v.limits[1])).collect()
    };
    (0..count).map(sample).map(inner).collect()
}

/// Returns the smallest singular value of the nominal `J_q`, in metres and rad.
fn least_singular_value(robot: &dyn Manipulator, q: &[f64], s: &[f64]) -> f64 {
    let description = robot.description();
    let metre = 1.0 / description.length.in_metres();
    let column = |j: usize| {
        let unit = match description.variables[j].kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => metre,
        };
        // Central differences: rotation vectors, regardless of the rows of its Jacobians.
        let h = 1e-6 * unit;
        let pose = |step: f64| {
            let mut q = q.to_vec();
            q[j] += step;
            robot.pose(&q, s).unwrap()
        };
        let rows = deviation(Orientation::RotationVector, &pose(-h), &pose(h));
        let scale = |i: usize| if i < 3 { metre } else { 1.0 };
        nalgebra::Vector6::from_fn(|i, _| rows[i] / scale(i) * unit / (2.0 * h))
    };
    let columns: Vec<_> = (0..q.len()).map(column).collect();
    let jacobian = nalgebra::Matrix6xX::from_columns(&columns);
    let rows = if q.len() < 6 { 3 } else { 6 };
    jacobian.rows(0, rows).singular_values().iter().copied().fold(f64::INFINITY, f64::min)
}

/// Checks the documented residuals far from singularities, and that compensation never increases
/// the error.
fn compensates(name: &str, whole: bool, regular_above: f64) {
    let spec = with_errors(name);
    let robot = Interpreter::new(spec.clone());
    let description = robot.description();
    let metre = description.length.in_metres();
    let (s, u) = (sampling::nominal_parameters(description), sampling::nominal_inputs(description));
    let (mut regular, mut before, mut after, mut turned) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
    for q in samples(&robot, 300) {
        let command = compensated(&robot, Goal::default(), &q, &s, &u).unwrap();
        assert!(within(&robot, &command.q));
        let (was, is) = (norms(&command.before), norms(&command.after));
        assert!(is.0 <= was.0, "{name} at {q:?}: {was:?} {is:?}");
        if least_singular_value(&robot, &q, &s) > regular_above {
            regular += 1;
            before = before.max(was.0 * metre);
            after = after.max(is.0 * metre);
            turned = turned.max(is.1);
        }
    }
    println!("{name}: {before:.1e} m down to {after:.1e} m and {turned:.1e} rad, {regular} of 300 regular");
    assert!(before > 5e-4 && regular > 30, "{name}: {before}, {regular}");
    assert!(after < 1e-6, "{name}: {after} m");
    assert!(!whole || turned < 1e-6, "{name}: {turned} rad");
}

#[test]
fn six_and_seven_joints_bring_the_tool_there() {
    for name in ["pps", "puma560", "ur5", "stanford", "general6r", "iiwa", "panda", "wam"] {
        compensates(name, true, 0.1);
    }
}

/// Checks three and four joints: the tool point is on target, its orientation remains.
#[test]
fn fewer_joints_bring_the_tool_point_there() {
    compensates("machine3", false, 0.1);
    compensates("scara", false, 0.03);
}

/// Checks seven joints: no equivalent commands are closer, to first order, since `d` has no
/// component in the null space of `J`.
#[test]
fn a_redundant_arm_stays_near_the_nominal() {
    let (s, u) = (iiwa::Parameters::NOMINAL, iiwa::Inputs::NOMINAL);
    let spec = with_errors("iiwa");
    let robot = Interpreter::new(spec.clone());
    let mut judged = 0;
    for q in samples(&robot, 100) {
        if least_singular_value(&robot, &q, &s.to_array()) < 0.1 {
            continue;
        }
        let command = compensated(&robot, Goal::default(), &q, &s.to_array(), &u.to_array()).unwrap();
        let q: [f64; 7] = q.try_into().unwrap();
        let (_, columns) = iiwa::joint_jacobian(&q, &s).unwrap();
        let jacobian = abbe::jacobian_view(&columns).into_owned();
        let d = nalgebra::SVector::<f64, 7>::from_fn(|j, _| command.q[j] - q[j]);
        let shortest = jacobian.pseudo_inverse(1e-9).unwrap() * (jacobian * d);
        assert!((d - shortest).norm() < 0.1 * d.norm(), "{d} but {shortest}");
        judged += 1;
    }
    assert!(judged > 10);
}

/// Checks that targets beyond limits are reported, and that the tool point has priority.
#[test]
fn limits_hold() {
    let (s, u) = (pps::Parameters::NOMINAL, pps::Inputs::NOMINAL);
    let [_, q4] = pps::DESCRIPTION.variables[3].limits;
    let mut held = 0;
    for d1 in [300.0, 1128.0, 2000.0] {
        for sign in [-1.0, 1.0] {
            let command =
                pps::compensated(&[d1, 280.0, 300.0, sign * q4, 0.0, 0.0], &s, &u, &Cycle::UNBOUNDED)
                    .unwrap();
            assert!(within(&pps::Pps, &command.q));
            assert!(norms(&command.after).0 < 1e-6);
            held += usize::from(norms(&command.after).1 > 1e-4 && command.q[3] == sign * q4);
        }
    }
    assert!(held > 0, "a spin at its limit cannot be turned further");
    // Commands beyond a limit are clamped, and the remaining error is reported.
    let command = pps::compensated(&[-5.0, 280.0, 300.0, 0.0, 0.0, 0.0], &s, &u, &Cycle::UNBOUNDED).unwrap();
    assert!(command.q[0] == 0.0 && norms(&command.after).1 > 1e-3);
    assert_eq!(command.status, Status::OutsideLimits);
}

#[test]
fn bad_input_is_an_error() {
    let (s, u) = (pps::Parameters::NOMINAL, pps::Inputs::NOMINAL);
    let nan = pps::compensated(&[f64::NAN, 280.0, 300.0, 0.0, 0.0, 0.0], &s, &u, &Cycle::UNBOUNDED);
    assert_eq!(nan.err(), Some(Error::NotFinite { quantity: Quantity::Variables, index: 0 }));
    let home = [1128.0, 280.0, 300.0, 0.0, 0.0, 0.0];
    let far = abbe::Pose([[f64::INFINITY; 3]; 4]);
    let far = pps::compensated_to(&far, &home, &s, &u, &Cycle::UNBOUNDED);
    assert_eq!(far.err(), Some(Error::NotFinite { quantity: Quantity::Pose, index: 0 }));
}

/// Returns the interpreter of a chain with errors.
fn small_arm(frames: &str, errors: &str) -> Interpreter {
    let text = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n{frames}\n[[source]]\nname = \"e\"\nclass = \"repeatable\"\n{errors}"
    );
    Interpreter::new(
        Spec::parse("arm", &text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false))),
    )
}

/// Checks the obstacles: a stretched arm that is too short and cannot move further; a limit is
/// named only if it is the obstacle.
#[test]
fn obstacles_are_the_true_ones() {
    let revolute = |name: &str, rest: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"revolute\", {rest} }}\ntransform = \"Rz({name}) Tx(400 mm)\"\n"
        )
    };
    let planar = format!("{}{}", revolute("q1", "limits = [-1, 1]"), revolute("q2", "limits = [-1, 1]"));
    let short = small_arm(&planar, "frame = \"q2\"\ne_x = \"-0.5 mm\"\n");
    let at = |robot: &Interpreter, q: &[f64]| {
        let found = compensated(robot, Goal::default(), q, &[], &[]).unwrap();
        obstacle(robot, Goal::default(), q, &[], &[], &found, [1e-3, f64::INFINITY]).unwrap()
    };
    let stretched = at(&short, &[0.3, 0.0]).unwrap();
    assert!(matches!(stretched.missing, Missing::Point(left) if (left - 0.5).abs() < 1e-3), "{stretched:?}");
    let along = stretched.axis[0] * 0.3_f64.cos() + stretched.axis[1] * 0.3_f64.sin();
    assert!(stretched.immobile && stretched.limits.is_empty() && (along.abs() - 1.0).abs() < 1e-3);
    // Behind the upper arm, where the elbow could compensate.
    let turned = small_arm(&planar, "frame = \"q1\"\ne_r = \"-2 mrad\"\n");
    let held = at(&turned, &[0.5, 1.0]).unwrap();
    assert_eq!((held.limits, held.immobile), (vec![1], false));
    assert_eq!((at(&turned, &[0.0, 0.5]), at(&turned, &[1.0, 0.5])), (None, None));
    assert_eq!(mobility(&turned, &[]).unwrap(), 2, "in the plane, the turn being that of the point");
}

/// Checks six variables that move the tool in five ways only.
#[test]
fn a_five_axis_machine_is_not_singular() {
    let slide = |name: &str, axis: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"prismatic\", limits = [\"-1 m\", \"1 m\"] }}\ntransform = \"T{axis}({name})\"\n"
        )
    };
    let turn = |name: &str, axis: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"revolute\", limits = [-2, 2] }}\ntransform = \"R{axis}({name})\"\n"
        )
    };
    let frames =
        [slide("x", "x"), slide("y", "y"), slide("z", "z"), slide("w", "z"), turn("b", "y"), turn("c", "x")];
    let frames = frames.concat() + "[tool]\ntransform = \"Tz(-100 mm)\"\n";
    let robot = small_arm(&frames, "frame = \"z\"\ne_r = \"1 mrad\"\ne_x = \"0.2 mm\"\n");
    assert_eq!(mobility(&robot, &[]).unwrap(), 5);
    let q = [0.0, 0.0, 0.0, 0.0, 0.4, 0.3];
    let found = compensated(&robot, Goal::default(), &q, &[], &[]).unwrap();
    assert!(
        found.status == Status::NotReached && norms(&found.after).0 < 1e-7 && norms(&found.after).1 > 1e-4
    );
    let obstacle = obstacle(&robot, Goal::default(), &q, &[], &[], &found, [1e-3, 1e-6]).unwrap().unwrap();
    assert!(obstacle.immobile && matches!(obstacle.missing, Missing::Turn(_)), "{obstacle:?}");
}

/// Checks the convergence flag of the compensator of fixed cost.
#[test]
fn whether_the_steps_were_enough_is_said() {
    let (s, u) = (pps::Parameters::NOMINAL, pps::Inputs::NOMINAL);
    let command =
        pps::compensated(&[1128.0, 280.0, 300.0, 0.3, 0.0, 0.0], &s, &u, &Cycle::UNBOUNDED).unwrap();
    assert!(command.status == Status::Reached && norms(&command.after).0 < 1e-6);
    // More steps than necessary change nothing; fewer are reported: near singular poses some rows
    // need more.
    let robot = Interpreter::new(with_errors("puma560"));
    let s = sampling::nominal_parameters(robot.description());
    let mut more = 0;
    for q in hard_rows(&robot, &s, 60) {
        let fixed = fixed_cost(&robot, &q, &s);
        let best = compensated(&robot, Goal::default(), &q, &s, &[]).unwrap();
        more += usize::from(
            fixed.status == Status::NotConverged && norms(&best.after).0 < norms(&fixed.after).0 - 1e-6,
        );
        assert!(norms(&best.after).0 <= norms(&fixed.after).0 + 1e-9);
    }
    assert!(more > 0);
}

/// Runs the steps of the generated compensator.
fn fixed_cost(robot: &Interpreter, q: &[f64], s: &[f64]) -> abbe::compensator::Compensated<Vec<f64>> {
    let magnitudes = repeatable_magnitudes(robot.description());
    let target = robot.pose(q, s).unwrap();
    let room = vec![[0.0; 6]; q.len()];
    abbe::compensator::compensate(
        robot.description(),
        &target,
        &q.to_vec(),
        &Cycle::<[f64; 0]>::UNBOUNDED,
        room,
        |q, columns| {
            robot.joint_jacobian(q, s, columns)?;
            drawn_pose(robot, q, s, &[], &magnitudes)
        },
    )
    .unwrap()
}
