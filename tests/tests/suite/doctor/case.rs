//! Rows of a robot with mistakes, and the interpretation that corrects them.

use std::f64::consts::PI;
use std::fmt::Write;

use abbe::analysis::sampling;
use abbe::{Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_metrology::doctor::{Change, Interpretation, PoseFormat};
use abbe_spec::Spec;
use abbe_study::Machine;
use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

const ROWS: usize = 10;

/// SplitMix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.draw() % count as u64) as usize
    }

    pub(crate) fn between(&mut self, lower: f64, upper: f64) -> f64 {
        lower + (upper - lower) * (self.draw() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a normal number by the Box–Muller method.
    pub(crate) fn normal(&mut self) -> f64 {
        (-2.0 * self.between(1e-300, 1.0).ln()).sqrt() * (2.0 * PI * self.between(0.0, 1.0)).cos()
    }
}

/// Returns the spec of a shipped robot on a pedestal, with a tool.
pub(crate) fn text(name: &str) -> String {
    // With an axis along no axis of the frame.
    let slanted = name.strip_prefix("slanted ");
    let mut text = Machine::find(slanted.unwrap_or(name)).unwrap().text().unwrap();
    if slanted.is_some() {
        text = text.replacen("axis = [0, 0, 1]", "axis = [0.48, -0.6, 0.64]", 3);
    }
    let at = text.find("[[frame]]").unwrap();
    let foot =
        "[[frame]]\nname = \"foot\"\ntransform = \"Tx(120 mm) Ty(-60 mm) Tz(400 mm) Rz(0.5) Rx(0.2)\"\n\n";
    let text = format!("{}{foot}{}", &text[..at], &text[at..]);
    match text.contains("[tool]") {
        true => text,
        false => {
            let at = text.find("\n[[source]]").map_or(text.len(), |at| at + 1);
            let tool = "[tool]\ntransform = \"Tx(30 mm) Ty(20 mm) Tz(110 mm) Ry(0.4)\"\n\n";
            format!("{}{tool}{}", &text[..at], &text[at..])
        }
    }
}

/// Mistakes in rows, or in a spec.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mistake {
    Degrees,
    Lengths,
    Convention,
    Sign,
    /// Opposite signs of two or three joints.
    Signs,
    Zero,
    Order,
    Coupled,
    Quaternion,
    Matrix,
    Euler,
    Tool,
    Base,
    Ends,
    Pose,
    Difference,
    RotationVector,
    /// No orientation: positions only.
    Position,
}

pub(crate) use Mistake::*;

pub(crate) const ALL: [Mistake; 16] = [
    Degrees,
    Lengths,
    Convention,
    Sign,
    Zero,
    Order,
    Coupled,
    Quaternion,
    Matrix,
    Euler,
    Tool,
    Base,
    Ends,
    Pose,
    Difference,
    RotationVector,
];

/// Returns whether a mistake is about the notation of poses, which excludes others.
pub(crate) fn is_layout(mistake: Mistake) -> bool {
    matches!(mistake, Quaternion | Matrix | Euler | Difference | RotationVector)
}

pub(crate) struct Case {
    pub(crate) spec: String,
    pub(crate) data: String,
    pub(crate) right: Interpretation,
}

/// Returns rows of a robot with mistakes, and the interpretation that corrects them.
pub(crate) fn case(robot: &str, mistakes: &[Mistake], random: &mut Random) -> Case {
    let mut text = text(robot);
    let spec = Spec::parse("robot.toml", &text).unwrap();
    let unit = spec.length.symbol();
    let in_mm = 1e3 * spec.length.in_metres();
    let arm = Interpreter::new(spec.clone());
    let s = sampling::nominal_parameters(arm.description());
    let variables = &spec.variables;
    let count = variables.len();
    let has = |mistake| mistakes.contains(&mistake);
    let kinds: Vec<VariableKind> = variables.iter().map(|variable| variable.kind).collect();

    let layout = if has(Quaternion) {
        PoseFormat::Quaternion { scalar_first: random.below(2) == 0 }
    } else if has(Euler) {
        let axes = loop {
            let axes = [random.below(3), random.below(3), random.below(3)];
            if axes[0] != axes[1] && axes[1] != axes[2] {
                break axes;
            }
        };
        PoseFormat::Euler { axes, fixed: random.below(2) == 0, degrees: random.below(2) == 0 }
    } else if has(Position) {
        PoseFormat::Position
    } else if has(RotationVector) {
        PoseFormat::RotationVector { degrees: random.below(2) == 0 }
    } else if has(Difference) {
        PoseFormat::Difference { target_minus_actual: random.below(2) == 0 }
    } else {
        PoseFormat::Matrix { by_rows: !has(Matrix) }
    };
    let mut changes = Vec::new();
    let mut order: Vec<usize> = (0..count).collect();
    if has(Order) {
        let (i, j) = loop {
            let (i, j) = (random.below(count), random.below(count));
            if i != j {
                break (i, j);
            }
        };
        order.swap(i, j);
        changes.push(Change::Order(order.clone()));
    }
    let mut reversed = Vec::new();
    if has(Sign) || has(Signs) {
        let wanted = if has(Sign) { 1 } else { 2 + random.below(2) };
        while reversed.len() < wanted {
            let joint = random.below(count);
            if !reversed.contains(&joint) {
                reversed.push(joint);
            }
        }
        reversed.sort_unstable();
        changes.push(Change::Reversed(reversed.clone()));
    }
    let coupled = has(Coupled).then(|| {
        loop {
            let joint = 1 + random.below(count - 1);
            if kinds[joint] == kinds[joint - 1] {
                break (joint, if random.below(2) == 0 { 1.0 } else { -1.0 });
            }
        }
    });
    changes.extend(coupled.map(|(joint, by)| Change::Coupled { joint, to: joint - 1, by }));
    let zero = has(Zero).then(|| {
        let joint = random.below(count);
        let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let offset = match (kinds[joint], random.below(2)) {
            (VariableKind::Prismatic, _) => random.between(20.0, 200.0) / in_mm,
            (_, 0) => 0.5 * PI * (1 + random.below(2)) as f64,
            _ => random.between(0.05, 3.0),
        };
        (joint, sign * offset)
    });
    changes.extend(zero.map(|(joint, offset)| Change::Zero { joint, offset }));
    if has(Convention) {
        let swapped = text.lines().map(|line| match line {
            line if line.starts_with("dh =") => line.replacen("dh =", "mdh =", 1),
            line if line.starts_with("mdh =") => line.replacen("mdh =", "dh =", 1),
            line => line.to_owned(),
        });
        text = swapped.collect::<Vec<_>>().join("\n");
        changes.push(Change::Convention);
    }
    let ends = [
        (Tool, Change::ToolInverted),
        (Base, Change::BaseInverted),
        (Ends, Change::EndsExchanged),
        (Pose, Change::PoseInverted),
    ];
    changes.extend(ends.into_iter().filter(|(mistake, _)| has(*mistake)).map(|(_, change)| change));

    // Without declared units, rows are in the units of the spec.
    let degrees = has(Degrees);
    let lengths = if has(Lengths) { if unit == "mm" { "m" } else { "mm" } } else { unit };
    let per_length = if lengths == unit {
        1.0
    } else if lengths == "m" {
        1e-3
    } else {
        1e3
    };
    let mut data: String = (0..count).map(|i| format!("j{i},")).collect::<String>() + "x,y,z";
    let more = match layout {
        PoseFormat::Quaternion { .. } => 4,
        PoseFormat::Matrix { .. } => 9,
        PoseFormat::Position => 0,
        _ => 3,
    };
    (0..more).for_each(|k| write!(data, ",r{k}").unwrap());
    data.push('\n');
    for _ in 0..ROWS {
        let q: Vec<f64> = variables
            .iter()
            .map(|variable| {
                let [lower, upper] = variable.limits;
                random.between(
                    lower.max(-PI),
                    if variable.kind == VariableKind::Revolute { upper.min(PI) } else { upper },
                )
            })
            .collect();
        let mut transforms = vec![abbe::Pose::IDENTITY; spec.frames.len() + 1];
        arm.transforms(&q, &s, &mut transforms).unwrap();
        let transforms: Vec<Isometry3<f64>> = transforms.iter().map(|pose| pose.isometry()).collect();
        let (mut base, mut tool) = (transforms[0], transforms[spec.frames.len()]);
        let chain = transforms[1..spec.frames.len()]
            .iter()
            .fold(Isometry3::identity(), |product, next| product * next);
        if has(Ends) {
            (base, tool) = (tool, base);
        }
        if has(Base) {
            base = base.inverse();
        }
        if has(Tool) {
            tool = tool.inverse();
        }
        let mut pose = base * chain * tool;
        if has(Pose) {
            pose = pose.inverse();
        }
        // Noise of 0.1 mm and 0.1 mrad.
        let mut noise = |size: f64| Vector3::from_fn(|_, _| size * random.normal());
        pose.translation.vector += noise(0.1 / in_mm);
        pose.rotation = UnitQuaternion::from_scaled_axis(noise(1e-4)) * pose.rotation;
        let off: Vector3<f64> = noise(2.0 / in_mm);

        let mut columns = q.clone();
        if let Some((joint, offset)) = zero {
            columns[joint] -= offset;
        }
        if let Some((joint, by)) = coupled {
            columns[joint] -= by * columns[joint - 1];
        }
        reversed.iter().for_each(|joint| columns[*joint] = -columns[*joint]);
        let ordered: Vec<f64> = (0..count).map(|i| columns[order[i]]).collect();
        let of_order: Vec<VariableKind> = (0..count).map(|i| kinds[order[i]]).collect();
        for (value, kind) in ordered.iter().zip(of_order) {
            let per = if degrees && kind == VariableKind::Revolute { 180.0 / PI } else { 1.0 };
            write!(data, "{},", value * per).unwrap();
        }
        let mut position = pose.translation.vector;
        let mut numbers = Vec::new();
        let r: Matrix3<f64> = *pose.rotation.to_rotation_matrix().matrix();
        match layout {
            PoseFormat::Quaternion { scalar_first } => {
                let [x, y, z, w] = pose.rotation.coords.into();
                numbers.extend(if scalar_first { [w, x, y, z] } else { [x, y, z, w] });
            }
            PoseFormat::Euler { axes, fixed, degrees } => {
                let angles = euler(&r, axes, fixed);
                numbers.extend(angles.map(|angle| if degrees { angle.to_degrees() } else { angle }));
            }
            PoseFormat::RotationVector { degrees } => {
                let vector = pose.rotation.scaled_axis();
                numbers.extend(vector.iter().map(|v| if degrees { v.to_degrees() } else { *v }));
            }
            PoseFormat::Difference { target_minus_actual } => {
                let sign = if target_minus_actual { 1.0 } else { -1.0 };
                numbers.extend((sign * off * per_length).iter());
                position += off;
            }
            PoseFormat::Matrix { by_rows } => {
                numbers.extend((0..9).map(|k| if by_rows { r[(k / 3, k % 3)] } else { r[(k % 3, k / 3)] }));
            }
            PoseFormat::Position => {}
            PoseFormat::Homogeneous { .. } => unreachable!(),
        }
        let all = position.iter().map(|x| x * per_length).chain(numbers);
        data += &all.map(|x| x.to_string()).collect::<Vec<_>>().join(",");
        data.push('\n');
    }
    let right = Interpretation {
        joints_in_degrees: kinds.contains(&VariableKind::Revolute).then_some(degrees),
        slides_in: kinds.contains(&VariableKind::Prismatic).then_some(unit),
        lengths_in: lengths,
        layout,
        changes,
    };
    Case { spec: text, data, right }
}

/// Returns Euler angles by Newton's method on the product of three rotations, independently of
/// formulas for each order.
fn euler(r: &Matrix3<f64>, axes: [usize; 3], fixed: bool) -> [f64; 3] {
    let axis = |i: usize| [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][i];
    let product = |angles: &Vector3<f64>| {
        let turn = |i: usize| Rotation3::from_axis_angle(&axis(axes[i]), angles[i]);
        let product = if fixed { turn(2) * turn(1) * turn(0) } else { turn(0) * turn(1) * turn(2) };
        product.into_inner()
    };
    let mut random = Random(7);
    for _ in 0..200 {
        let mut angles = Vector3::from_fn(|_, _| random.between(-PI, PI));
        for _ in 0..60 {
            // Half the skew part: the small remaining rotation.
            let left = |angles: &Vector3<f64>| r * product(angles).transpose();
            let off = |angles: &Vector3<f64>| {
                let m = left(angles);
                0.5 * Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)])
            };
            let now = off(&angles);
            if (left(&angles) - Matrix3::identity()).amax() < 1e-12 {
                return angles.map(|angle| (angle + PI).rem_euclid(2.0 * PI) - PI).into();
            }
            let h = 1e-6;
            let columns = [0, 1, 2].map(|i| {
                let step = Vector3::from_fn(|j, _| if i == j { h } else { 0.0 });
                (off(&(angles + step)) - off(&(angles - step))) / (2.0 * h)
            });
            let Some(inverse) = Matrix3::from_columns(&columns).try_inverse() else { break };
            angles -= inverse * now;
        }
    }
    panic!("no angles {axes:?} of {r}");
}
