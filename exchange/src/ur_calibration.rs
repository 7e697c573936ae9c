//! Calibration of an arm of Universal Robots in YAML (`kinematics:`), as the robot description for
//! ROS reads it.
//!
//! It holds the origin of each of six joints in the previous link, `T(x, y, z) Rz(yaw) Ry(pitch)
//! Rx(roll)`; the joint turns about z after it. The nominal frames are those of Craig: z along the
//! joint, x along the common normal with the previous joint, and `d` of a row within its joint.

use std::{f64::consts::FRAC_PI_2, fmt::Write};

use abbe::analysis::sampling::JointAxis;
use abbe::analysis::sampling::vectors::{cross, dot, scale, subtract, unit};
use abbe::{Manipulator, Pose};
use abbe_spec::{DhConvention, Diagnostics, mistake, number::digits, option::TO_URDF};

use crate::dh::DhTable;
use crate::export::origins::{Joint, origins};
use crate::export::report::{DECIMALS, UNCHANGED, nominal_sign, rounded, unreadable};
use crate::export::{ExportReport, ExportedFile, RealMachine, about_x, about_z};
use crate::placement::{placed, roll_pitch_yaw};

/// Names of the joints, and the angle from the previous axis about x in quarter turns.
const JOINTS: [(&str, f64); 6] = [
    ("shoulder", 0.0),
    ("upper_arm", 1.0),
    ("forearm", 0.0),
    ("wrist_1", 0.0),
    ("wrist_2", 1.0),
    ("wrist_3", -1.0),
];

/// Smallest cosine of directions that are nearly parallel.
const PARALLEL: f64 = 0.99;

/// Keys of a joint.
const KEYS: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// Writes the calibration.
///
/// # Errors
///
/// The chain is not that of an arm of Universal Robots.
pub fn write(machine: &RealMachine) -> Result<ExportReport, Diagnostics> {
    let refused = |message: String| {
        let help = format!(
            "this format is for arms of Universal Robots, whose chain begins at `base` \
            (F_0); use `{TO_URDF}` for other robots"
        );
        mistake::with_help(&machine.origin, message, help)
    };
    let table = DhTable::nominal(machine)?;
    let frames = near_each_other(frames(&table));
    let turning =
        table.rows.iter().filter(|row| row.variable.is_some() && !row.prismatic && !row.reversed).count();
    if turning != JOINTS.len() || table.rows.len() != JOINTS.len() {
        return Err(refused(format!("this machine has {turning} revolute joints, not the six of a UR arm")));
    }
    let mut joints = Vec::new();
    let mut before = Pose::IDENTITY;
    for ((name, quarters), (frame, i)) in JOINTS.iter().zip(frames.iter().zip(0..)) {
        let origin = before.inverse().then(frame);
        let expected = about_x(quarters * FRAC_PI_2, 0.0);
        let is_parallel =
            |k: usize| (0..3).map(|i| origin.0[k][i] * expected.0[k][i]).sum::<f64>() > PARALLEL;
        if !(0..3).all(is_parallel) {
            return Err(refused(format!("the axes of the joint {name} are not placed as in a UR arm")));
        }
        let frame = machine.spec.frames.iter().position(|frame| frame.variable == table.rows[i].variable);
        joints.push(Joint { origin, axis: Some([0.0, 0.0, 1.0]), at_zero: Pose::IDENTITY, frame });
        before = *frames.get(i).unwrap_or(&before);
    }
    let zero = vec![0.0; JOINTS.len()];
    let evaluated = |error: abbe::Error| mistake::whole(&machine.origin, &error);
    let tool = before.inverse().then(&machine.manipulator.pose(&zero, &machine.s).map_err(evaluated)?);
    let new = origins(machine, &joints, &tool).map_err(evaluated)?;
    let metres = machine.spec.length.in_metres();
    let text = text(machine, &new, metres);
    let read = read(&text, metres).ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let variables: Vec<usize> = table.rows.iter().filter_map(|row| row.variable).collect();
    let model = |q: &[f64]| {
        let joints = read.iter().zip(&variables);
        joints
            .fold(Pose::IDENTITY, |pose, (origin, i)| pose.then(origin).then(&about_z(q[*i], 0.0)))
            .then(&tool)
    };
    let mut left_out: Vec<String> = machine.held_at_mean().into_iter().collect();
    left_out.push(
        "The file has no origin after the last joint: of the errors there it holds the rotation \
         about the joint axis and the translation along it. The others belong to the tool set in \
         the controller."
            .to_owned(),
    );
    left_out.push(
        "The hash is computed from this spec. The driver compares it with the hash of the robot's \
         own calibration and warns if they differ."
            .to_owned(),
    );
    let format = "calibration of a Universal Robots arm (YAML)".to_owned();
    let files = vec![ExportedFile { name: format!("{}.calibration.yaml", machine.spec.name), text }];
    let sign = sign(&joints, &new, metres);
    Ok(ExportReport { left_out, sign, ..ExportReport::for_model(machine, format, files, model) })
}

/// Returns the frames of the joints in `F_0`, with all variables 0.
fn frames(table: &DhTable) -> Vec<Pose> {
    let zero = vec![0.0; table.rows.len()];
    let mut pose = table.base;
    let mut frames = Vec::new();
    for row in &table.rows {
        let [theta, d, a, alpha] = row.numbers;
        let after = pose.then(&row.pose(table.convention, &zero));
        frames.push(match table.convention {
            DhConvention::Standard => pose.then(&about_z(theta, d)),
            DhConvention::Modified => pose.then(&about_x(alpha, a)).then(&about_z(theta, d)),
        });
        pose = after;
    }
    frames
}

/// Takes the frame of a joint whose next axis is nearly parallel near the frame before: its origin
/// in the plane through that one, and its x axis along that expected.
///
/// The common normal of such axes may be far away, in any direction; about and along its axis the
/// frame of a joint may be anywhere.
fn near_each_other(mut frames: Vec<Pose>) -> Vec<Pose> {
    let mut before = Pose::IDENTITY;
    for i in 0..frames.len() {
        let Pose([_, _, z, p]) = frames[i];
        let is_parallel = frames.get(i + 1).is_some_and(|next| dot(next.0[2], z).abs() > PARALLEL);
        if is_parallel && let Some((_, quarters)) = JOINTS.get(i) {
            let [x, ..] = before.then(&about_x(quarters * FRAC_PI_2, 0.0)).0;
            let x = unit(subtract(x, scale(z, dot(z, x))));
            let axis = JointAxis { direction: z, point: Some(p) };
            frames[i] = Pose([x, cross(z, x), z, axis.nearest(before.position())]);
        }
        before = frames[i];
    }
    frames
}

/// Writes the text; `metres` is the unit of length of the spec in m.
fn text(machine: &RealMachine, origins: &[Pose], metres: f64) -> String {
    let mut text = format!("# {}. In m and rad.\nkinematics:\n", machine.spec.name);
    for ((name, _), origin) in JOINTS.iter().zip(origins) {
        let _ = writeln!(text, "  {name}:");
        for (key, value) in KEYS.iter().zip(numbers(origin, metres)) {
            let _ = writeln!(text, "    {key}: {value}");
        }
    }
    let hash = u64::from_str_radix(machine.spec.hash.get(..15).unwrap_or_default(), 16).unwrap_or_default();
    text + &format!("  hash: calib_{hash}\n")
}

/// Returns the values of [`KEYS`] for an origin, in m and rad.
fn numbers(origin: &Pose, metres: f64) -> [f64; 6] {
    let ([x, y, z], [roll, pitch, yaw]) = (origin.position().map(|v| v * metres), roll_pitch_yaw(origin));
    [x, y, z, roll, pitch, yaw].map(|number| rounded(number, DECIMALS))
}

/// Reads the origins of a text of [`text`].
fn read(text: &str, metres: f64) -> Option<Vec<Pose>> {
    let mut values = text.lines().filter(|line| line.starts_with("    ")).map(|line| {
        let (key, value) = line.trim().split_once(": ")?;
        Some((key, value.parse::<f64>().ok()?))
    });
    let mut origins = Vec::new();
    for _ in JOINTS {
        let mut numbers = [0.0; 6];
        for (number, expected) in numbers.iter_mut().zip(KEYS) {
            let (key, value) = values.next()??;
            *number = (key == expected).then_some(value)?;
        }
        let [x, y, z, roll, pitch, yaw] = numbers;
        origins.push(placed([x, y, z].map(|v| v / metres), [roll, pitch, yaw]));
    }
    Some(origins)
}

/// Returns the sentence about the sign: that of the number that changes most, angles with a lever
/// of 1 m.
fn sign(joints: &[Joint], new: &[Pose], metres: f64) -> String {
    let mut most = (UNCHANGED, String::new());
    for ((name, _), (joint, new)) in JOINTS.iter().zip(joints.iter().zip(new)) {
        for (i, (old, new)) in
            numbers(&joint.origin, metres).into_iter().zip(numbers(new, metres)).enumerate()
        {
            let change = (new - old).abs();
            if change > most.0 && change < 1.0 {
                let (key, unit) = (KEYS[i], if i < 3 { "m" } else { "rad" });
                let text = format!(
                    "The file holds the numbers of the real arm, which replace the nominal ones: \
                     {key} of {name} is {} {unit}; in the spec it is {} {unit}. Do not subtract \
                     anything from it.",
                    digits(new, 8),
                    digits(old, 8)
                );
                most = (change, text);
            }
        }
    }
    if most.1.is_empty() { nominal_sign() } else { most.1 }
}
