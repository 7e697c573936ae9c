//! The paper's patient positioning system, written by hand with loops over its frames, in mm and
//! rad. Tests of the laws use it, and the shipped `pps.toml` must agree with it.

use core::f64::consts::{FRAC_PI_2, PI};

use abbe_core::*;

use super::ByHand;

/// The patient positioning system of the paper.
pub(crate) struct Pps;

const fn variable(name: &'static str, kind: VariableKind, limits: [f64; 2], home: f64) -> Variable {
    Variable::new(name, kind, limits, home)
}

const fn frame(name: &'static str, index: usize) -> Frame {
    Frame::new(name, Some(index))
}

const fn source(name: &'static str, class: Class) -> Source {
    Source::new(name, class, "", "")
}

const fn effect(source: usize, frame: usize, component: Component) -> Effect {
    Effect { source, frame, component }
}

const TILT: f64 = 3.0 * PI / 180.0;
const PARAMETERS: [Parameter; 3] =
    [Parameter::new("x", 0.0, "mm"), Parameter::new("y", 100.0, "mm"), Parameter::new("z", 850.0, "mm")];
const RANDOM: Class = Class::Random(Distribution::Uniform);

/// Signs of the assembly errors, frame by frame.
const SIGNS: &[u8; 36] = b"++---+-+-----++--+-+---+--+-+++--+++";

/// Nine effects of the physical sources, followed by the 36 of assembly.
const EFFECTS: [Effect; 45] = {
    let mut effects = [effect(0, 0, Component::Z); 45];
    effects[1] = effect(0, 0, Component::Spin);
    effects[2] = effect(1, 3, Component::Spin);
    effects[3] = effect(2, 2, Component::Y);
    effects[4] = effect(2, 2, Component::Pitch);
    effects[5] = effect(2, 2, Component::Roll);
    effects[6] = effect(3, 0, Component::X);
    effects[7] = effect(4, 1, Component::Y);
    effects[8] = effect(5, 2, Component::Z);
    let mut i = 0;
    while i < 36 {
        effects[9 + i] = effect(6, i / 6, Component::ALL[i % 6]);
        i += 1;
    }
    effects
};

static DESCRIPTION: Description = Description {
    name: Text::Constant("pps"),
    title: Text::Constant("NPTC patient positioning system"),
    length: LengthUnit::Millimetre,
    orientation: Orientation::EulerYzx,
    frames: List::Constant(&[
        frame("lateral", 0),
        frame("vertical", 1),
        frame("longitudinal", 2),
        frame("spin", 3),
        frame("roll", 4),
        frame("pitch", 5),
    ]),
    variables: List::Constant(&[
        variable("d1", VariableKind::Prismatic, [0.0, 2256.0], 1128.0),
        variable("d2", VariableKind::Prismatic, [0.0, 560.0], 280.0),
        variable("d3", VariableKind::Prismatic, [0.0, 1473.0], 0.0),
        variable("q4", VariableKind::Revolute, [-FRAC_PI_2, FRAC_PI_2], 0.0),
        variable("q5", VariableKind::Revolute, [-TILT, TILT], 0.0),
        variable("q6", VariableKind::Revolute, [-TILT, TILT], 0.0),
    ]),
    sum_limits: List::Constant(&[]),
    parameters: List::Constant(&PARAMETERS),
    inputs: List::Constant(&[]),
    sources: List::Constant(&[
        source("base rail curvature", Class::Repeatable),
        source("spin encoder", RANDOM),
        source("arm deflection", Class::Repeatable),
        source("lateral encoder", RANDOM),
        source("vertical encoder", RANDOM),
        source("longitudinal encoder", RANDOM),
        source("assembly", Class::Repeatable),
    ]),
    effects: List::Constant(&EFFECTS),
    solutions: 0,
};

pub(super) fn translation(x: f64, y: f64, z: f64) -> Pose {
    let Pose([a, b, c, _]) = Pose::IDENTITY;
    Pose([a, b, c, [x, y, z]])
}

/// Returns the rotation by an angle about axis 0 = x, 1 = y, 2 = z.
pub(super) fn rotation(axis: usize, angle: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut pose = Pose::IDENTITY;
    pose.0[next][next] = c;
    pose.0[next][last] = s;
    pose.0[last][next] = -s;
    pose.0[last][last] = c;
    pose
}

pub(super) fn check(quantity: Quantity, values: &[f64], expected: usize) -> Result<(), Error> {
    if values.len() != expected {
        return Err(Error::Count { quantity, expected, found: values.len() });
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(Error::NotFinite { quantity, index }),
        None => Ok(()),
    }
}

/// Returns `A_1 … A_6`, `T`.
fn transforms(q: &[f64], s: &[f64]) -> Result<[Pose; 7], Error> {
    check(Quantity::Variables, q, 6)?;
    check(Quantity::Parameters, s, 3)?;
    Ok([
        translation(q[0], 0.0, 0.0),
        translation(0.0, 600.0 + q[1], 0.0),
        translation(0.0, 0.0, 718.0 + q[2]),
        rotation(1, q[3]),
        translation(0.0, 300.0, 0.0).then(&rotation(2, q[4])),
        rotation(0, q[5]).then(&translation(0.0, 346.0, 0.0)),
        translation(s[0], s[1], s[2]),
    ])
}

/// Offset before the axis of each joint variable, and the axis.
const JOINTS: [(f64, usize); 6] = [(0.0, 0), (0.0, 1), (0.0, 2), (0.0, 1), (300.0, 2), (0.0, 0)];

/// Returns `(v; 0)` along, or `(v × (p_T − p); v)` about, an axis `v` through `p`, with rows 4–6 as
/// Euler rates.
fn column(turns: bool, v: [f64; 3], p: [f64; 3], tool: &Pose) -> [f64; 6] {
    if !turns {
        return [v[0], v[1], v[2], 0.0, 0.0, 0.0];
    }
    let [x, y, z]: [f64; 3] = core::array::from_fn(|i| tool.position()[i] - p[i]);
    let lever = [v[1] * z - v[2] * y, v[2] * x - v[0] * z, v[0] * y - v[1] * x];
    // The x axis of the tool is (cos σ cos ρ, sin ρ, −sin σ cos ρ).
    let [a, sin_roll, b] = tool.0[0];
    let margin = a.hypot(b);
    // R_yᵀ(σ) v = (cos ρ π', σ' + sin ρ π', ρ').
    let turned = [(a * v[0] + b * v[2]) / margin, v[1], (a * v[2] - b * v[0]) / margin];
    let pitch = turned[0] / margin;
    [lever[0], lever[1], lever[2], turned[1] - sin_roll * pitch, turned[2], pitch]
}

fn error_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let transforms = transforms(q, s)?;
    let tool = chain(&transforms);
    for (i, columns) in columns.chunks_exact_mut(6).enumerate() {
        let prefix = chain(&transforms[..=i]);
        for (entry, component) in columns.iter_mut().zip(Component::ALL) {
            let axis = prefix.0[component.axis()];
            *entry = column(component.is_rotation(), axis, prefix.position(), &tool);
        }
    }
    checks::margin(euler_margin(Orientation::EulerYzx, &tool))?;
    Ok(tool)
}

fn joint_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let transforms = transforms(q, s)?;
    let tool = chain(&transforms);
    for (i, (entry, (offset, axis))) in columns.iter_mut().zip(JOINTS).enumerate() {
        let prefix = chain(&transforms[..i]).then(&translation(0.0, offset, 0.0));
        *entry = column(i >= 3, prefix.0[axis], prefix.position(), &tool);
    }
    checks::margin(euler_margin(Orientation::EulerYzx, &tool))?;
    Ok(tool)
}

fn parameter_jacobian(q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
    let tool = chain(&transforms(q, s)?);
    for (i, entry) in columns.iter_mut().enumerate() {
        *entry = column(false, tool.0[i], tool.position(), &tool);
    }
    Ok(tool)
}

fn effects(q: &[f64], s: &[f64], u: &[f64], into: &mut [f64]) -> Result<(), Error> {
    check(Quantity::Variables, q, 6)?;
    check(Quantity::Parameters, s, 3)?;
    check(Quantity::Inputs, u, 0)?;
    let phase = PI * q[0] / 1600.0;
    into[0] = -0.000_062 * q[0] - 0.060_706 * phase.sin();
    into[1] = 0.000_062 + 0.000_119 * phase.cos();
    into[2] = 0.000_063;
    // Cantilever of length L with a load W at its end, 700 mm from the spin axis along the
    // couch.
    let (load, lever, length) = (2806.0, 700.0, 718.0 + q[2]);
    let (bending, torsion) = (2.354e13, 3.245e13);
    let (sin, cos) = q[3].sin_cos();
    let (moment, torque) = (load * lever * cos, load * lever * sin);
    let square = length * length;
    into[3] = -(load * length * square / 3.0 + moment * square / 2.0) / bending;
    into[4] = (load * square / 2.0 + moment * length) / bending;
    into[5] = -torque * length / torsion;
    into[6..9].fill(0.04);
    for (i, &sign) in SIGNS.iter().enumerate() {
        let size = if i % 6 < 3 { 0.6586 } else { 0.6586e-3 };
        into[9 + i] = if sign == b'+' { size } else { -size };
    }
    Ok(())
}

impl Manipulator for Pps {
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

abbe_core::test_manipulator!(abbe_core::lanes::OneByOne(Pps));
