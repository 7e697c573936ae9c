//! A PUMA 560 in metres with rotation-vector rows: all joints are revolute, one has no limits.

use core::f64::consts::{FRAC_PI_2, PI};

use super::pps::{check, rotation, translation};
use abbe_core::*;

use super::ByHand;

/// PUMA 560 by standard Denavit–Hartenberg parameters, with its tool off the axis of the last
/// joint.
pub(crate) struct Puma;

/// `d`, `a`, `α` of `Rz(q) Tz(d) Tx(a) Rx(α)`.
const DH: [[f64; 3]; 6] = [
    [0.6718, 0.0, FRAC_PI_2],
    [0.0, 0.4318, 0.0],
    [0.15005, 0.0203, -FRAC_PI_2],
    [0.4318, 0.0, FRAC_PI_2],
    [0.0, 0.0, -FRAC_PI_2],
    [0.0, 0.0, 0.0],
];

const fn joint(name: &'static str, limit: f64, home: f64) -> Variable {
    Variable::new(name, VariableKind::Revolute, [-limit, limit], home)
}

const VARIABLES: [Variable; 6] = [
    joint("q1", 2.79, 0.0),
    joint("q2", PI, 0.8),
    joint("q3", PI, -0.9),
    joint("q4", 1.92, 0.1),
    joint("q5", 1.74, 0.5),
    joint("q6", f64::INFINITY, 0.0),
];

const fn frame(index: usize) -> Frame {
    Frame::lower_pair("joint", Some(index))
}

const FRAMES: [Frame; 6] = [frame(0), frame(1), frame(2), frame(3), frame(4), frame(5)];

fn transforms(q: &[f64], s: &[f64]) -> Result<[Pose; 7], Error> {
    check(Quantity::Variables, q, 6)?;
    check(Quantity::Parameters, s, 2)?;
    let link = |i: usize| {
        let [d, a, alpha] = DH[i];
        rotation(2, q[i]).then(&translation(a, 0.0, d)).then(&rotation(0, alpha))
    };
    let tool = translation(s[0], 0.0, s[1]);
    Ok(core::array::from_fn(|i| if i < 6 { link(i) } else { tool }))
}

/// Returns `(v; 0)` along, or `(v × (p_T − p); v)` about, an axis of a frame.
fn column(turns: bool, axis: usize, frame: &Pose, tool: &Pose) -> [f64; 6] {
    let v = frame.0[axis];
    if !turns {
        return [v[0], v[1], v[2], 0.0, 0.0, 0.0];
    }
    let [x, y, z]: [f64; 3] = core::array::from_fn(|i| tool.position()[i] - frame.position()[i]);
    [v[1] * z - v[2] * y, v[2] * x - v[0] * z, v[0] * y - v[1] * x, v[0], v[1], v[2]]
}

static DESCRIPTION: Description = Description {
    name: Text::Constant("puma"),
    title: Text::Constant("PUMA 560"),
    length: LengthUnit::Metre,
    orientation: Orientation::RotationVector,
    frames: List::Constant(&FRAMES),
    variables: List::Constant(&VARIABLES),
    sum_limits: List::Constant(&[]),
    parameters: List::Constant(&[Parameter::new("x", 0.1, "m"), Parameter::new("z", 0.2, "m")]),
    inputs: List::Constant(&[]),
    sources: List::Constant(&[]),
    effects: List::Constant(&[]),
    solutions: 0,
};

fn error_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let transforms = transforms(q, s)?;
    let tool = chain(&transforms);
    for (i, columns) in columns.chunks_exact_mut(6).enumerate() {
        let frame = chain(&transforms[..=i]);
        for (entry, component) in columns.iter_mut().zip(Component::ALL) {
            *entry = column(component.is_rotation(), component.axis(), &frame, &tool);
        }
    }
    Ok(tool)
}

fn joint_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let transforms = transforms(q, s)?;
    let tool = chain(&transforms);
    for (i, entry) in columns.iter_mut().enumerate() {
        *entry = column(true, 2, &chain(&transforms[..i]), &tool);
    }
    Ok(tool)
}

fn parameter_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let tool = chain(&transforms(q, s)?);
    for (entry, axis) in columns.iter_mut().zip([0, 2]) {
        *entry = column(false, axis, &tool, &tool);
    }
    Ok(tool)
}

fn effects(q: &[f64], s: &[f64], u: &[f64], _: &mut [f64]) -> Result<(), Error> {
    check(Quantity::Inputs, u, 0)?;
    transforms(q, s).map(|_| ())
}

impl Manipulator for Puma {
    fn description(&self) -> &Description {
        &DESCRIPTION
    }

    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        let robot = ByHand { transforms, error_jacobian, joint_jacobian, parameter_jacobian, effects };
        robot.evaluate(self, function, arguments, results)
    }
}

abbe_core::test_manipulator!(abbe_core::lanes::OneByOne(Puma));
