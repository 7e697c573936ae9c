//! Describes interpretations as statements, and as questions about a map.

use abbe::{Pose, VariableKind, analysis::sampling, rotation_vector};
use abbe_spec::Spec;

use super::{Candidate, Change, Interpretation, PoseFormat};
use abbe_study::number::digits;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Describes an interpretation: units, then the differences from the spec.
pub(crate) fn interpretation(interpretation: &Interpretation, spec: &Spec) -> String {
    let mut parts = Vec::new();
    match (interpretation.joints_in_degrees, interpretation.slides_in) {
        (Some(degrees), None) => parts.push(format!("joints in {}", angle(degrees))),
        (Some(degrees), Some(unit)) => parts.push(format!("joints in {} and {unit}", angle(degrees))),
        (None, Some(unit)) => parts.push(format!("joints in {unit}")),
        (None, None) => {}
    }
    parts.push(format!("positions in {}", interpretation.lengths_in));
    parts.extend(layout(interpretation.layout));
    match &interpretation.changes[..] {
        [] => parts.push("otherwise as in the spec".to_owned()),
        changes => parts.extend(changes.iter().map(|one| change(one, spec))),
    }
    parts.join("; ")
}

/// Describes fitted places of base and tool, each as a sentence.
pub(crate) fn places(candidate: &Candidate, spec: &Spec) -> Vec<String> {
    let oriented = candidate.interpretation.layout.is_oriented();
    let place = |pose: &Pose, is_turned: bool| {
        let [x, y, z] = pose.0[3].map(|value| digits(value, 6));
        let vector = rotation_vector(pose);
        let angle = sampling::norm(vector);
        let turned = match is_turned {
            false => String::new(),
            true if angle < 1e-6 => ", not turned".to_owned(),
            true => {
                let [a, b, c] = vector.map(|value| digits(value / angle, 3));
                format!(", turned by {}° about ({a}, {b}, {c})", digits(angle.to_degrees(), 5))
            }
        };
        format!("({x}, {y}, {z}) {}{turned}", spec.length.symbol())
    };
    let base =
        candidate.base.map(|pose| format!("F_0 stands at {} in the frame of the rows", place(&pose, true)));
    let tool = candidate
        .tool
        .map(|pose| format!("that point is at {} in the frame of the tool", place(&pose, oriented)));
    base.into_iter().chain(tool).collect()
}

fn angle(degrees: bool) -> &'static str {
    if degrees { "degrees" } else { "radians" }
}

fn layout(layout: PoseFormat) -> Option<String> {
    Some(match layout {
        PoseFormat::Position => return None,
        PoseFormat::Difference { target_minus_actual: true } => "differences are target − actual".to_owned(),
        PoseFormat::Difference { target_minus_actual: false } => "differences are actual − target".to_owned(),
        PoseFormat::Euler { axes: [a, b, c], fixed, degrees } => {
            let [a, b, c] = [AXES[a], AXES[b], AXES[c]];
            match fixed {
                false => format!("angles in {} about the turning axes {a}, {b}, {c}", angle(degrees)),
                true => format!("angles in {} about the fixed axes {a}, {b}, {c}", angle(degrees)),
            }
        }
        PoseFormat::RotationVector { degrees } => format!("rotation vectors in {}", angle(degrees)),
        PoseFormat::Quaternion { scalar_first: true } => "quaternions w, x, y, z".to_owned(),
        PoseFormat::Quaternion { scalar_first: false } => "quaternions x, y, z, w".to_owned(),
        PoseFormat::Matrix { by_rows } => format!("rotation matrices {}", matrix_order(by_rows)),
        PoseFormat::Homogeneous { by_rows } => format!("homogeneous matrices {}", matrix_order(by_rows)),
    })
}

fn matrix_order(rows: bool) -> &'static str {
    if rows { "row by row" } else { "column by column" }
}

/// Describes a difference from the spec.
pub(crate) fn change(change: &Change, spec: &Spec) -> String {
    let name = |i: usize| spec.variables[i].name.as_str();
    match change {
        Change::Order(order) => {
            let moved: Vec<usize> = (0..order.len()).filter(|i| order[*i] != *i).collect();
            match moved[..] {
                [i, j] => format!("the columns of {} and {} are exchanged", name(i), name(j)),
                _ => {
                    let mut inverse = vec![0; order.len()];
                    order.iter().enumerate().for_each(|(joint, place)| inverse[*place] = joint);
                    let names: Vec<&str> = inverse.iter().map(|joint| name(*joint)).collect();
                    format!("the columns of the joints are {}", names.join(", "))
                }
            }
        }
        Change::Reversed(joints) => {
            let names: Vec<&str> = joints.iter().map(|joint| name(*joint)).collect();
            let verb = if joints.len() == 1 { "counts" } else { "count" };
            format!("{} {verb} in the opposite direction", names.join(", "))
        }
        Change::Coupled { joint, to, by } => {
            let sign = if *by > 0.0 { "+" } else { "−" };
            format!("{} is coupled: it means {} {sign} {}", name(*joint), name(*joint), name(*to))
        }
        Change::Zero { joint, offset } => {
            let amount = match spec.variables[*joint].kind {
                VariableKind::Revolute => format!("{:+.2}°", offset.to_degrees()),
                VariableKind::Prismatic => format!("{} {}", digits(*offset, 4), spec.length.symbol()),
            };
            format!("the zero of {} is offset: add {amount}", name(*joint))
        }
        Change::Convention => "the Denavit-Hartenberg numbers follow the other convention".to_owned(),
        Change::ToolInverted => "the tool transform is inverted".to_owned(),
        Change::ToolLeftOut => "the poses are those of the flange, without the tool".to_owned(),
        Change::BaseInverted => "the base transform is inverted".to_owned(),
        Change::BaseLeftOut => {
            "the poses are relative to the robot's foot, without the base of the spec".to_owned()
        }
        Change::EndsExchanged => "base and tool are exchanged".to_owned(),
        Change::PoseInverted => "the poses are inverted: the base in the frame of the tool".to_owned(),
        Change::BaseElsewhere => "the poses are in another reference frame".to_owned(),
        Change::ToolElsewhere => "the poses are those of another point of the end effector".to_owned(),
        Change::Mirrored => {
            "two of the columns x, y and z are exchanged, or one has the wrong sign".to_owned()
        }
        Change::OrientationInverted => {
            "the orientations are inverted: F_0 in the frame of the tool".to_owned()
        }
    }
}

/// Formats the differences from a map as questions that say what to change in the map; empty if
/// there are none. `names` are those of the joints.
pub(crate) fn questions(found: &Interpretation, stated: &Interpretation, names: &[&str]) -> Vec<String> {
    let mut all = Vec::new();
    if found.lengths_in != stated.lengths_in {
        let [found, stated] = [found.lengths_in, stated.lengths_in];
        all.push(format!("are the measured lengths in {found}, not {stated}? set `unit` accordingly"));
    }
    match (found.joints_in_degrees, stated.joints_in_degrees) {
        (Some(true), Some(false)) => {
            all.push("are the joint angles in deg, not rad? set `unit = \"deg\"`".to_owned());
        }
        (Some(false), Some(true)) => {
            all.push("are the joint angles in rad, not deg? set `unit = \"rad\"`".to_owned());
        }
        _ => {}
    }
    if let (Some(found), Some(stated)) = (found.slides_in, stated.slides_in)
        && found != stated
    {
        all.push(format!("are the joint travels in {found}, not {stated}? set `unit` accordingly"));
    }
    all.extend(found.changes.iter().filter_map(|change| question(change, names)));
    all.extend(questions_on_format(found.layout, stated.layout));
    all
}

/// Formats a change that concerns the map or the file as a question.
fn question(change: &Change, names: &[&str]) -> Option<String> {
    let name = |i: usize| format!("`{}`", names[i]);
    Some(match change {
        Change::Order(order) => {
            let moved: Vec<String> = (0..order.len()).filter(|i| order[*i] != *i).map(name).collect();
            format!("are the columns of {} swapped?", moved.join(" and "))
        }
        Change::Reversed(joints) => {
            let verb = if joints.len() == 1 { "does" } else { "do" };
            let names: Vec<String> = joints.iter().map(|i| name(*i)).collect();
            format!("{verb} {} count in the opposite direction? set `sign = -1` there", names.join(", "))
        }
        Change::Mirrored => {
            "are two of the measured columns x, y and z swapped, or has one the wrong sign?".to_owned()
        }
        Change::OrientationInverted => {
            "are the orientations inverted (F_0 in the frame of the tool)? invert them in the file".to_owned()
        }
        _ => return None,
    })
}

fn questions_on_format(found: PoseFormat, stated: PoseFormat) -> Vec<String> {
    let mut all = Vec::new();
    match (found, stated) {
        (PoseFormat::Quaternion { scalar_first }, PoseFormat::Quaternion { scalar_first: stated })
            if scalar_first != stated =>
        {
            let order = if scalar_first { "wxyz" } else { "xyzw" };
            all.push(format!("is the quaternion in the order `{order}`?"));
        }
        (PoseFormat::Euler { axes, fixed, .. }, stated) if !is_euler(stated, axes, fixed) => {
            let order: String = axes.iter().map(|axis| AXES[*axis]).collect();
            all.push(if fixed {
                let reversed: String = order.chars().rev().collect();
                format!(
                    "are these angles about fixed axes, `{order}`? reverse the columns, with \
                     `order = \"{reversed}\"`"
                )
            } else {
                format!("are these Euler angles in the order `{order}`?")
            });
        }
        (PoseFormat::RotationVector { .. }, PoseFormat::Euler { .. }) => all.push(
            "are these numbers a rotation vector, not Euler angles? give them as `rotation_vector`"
                .to_owned(),
        ),
        _ => {}
    }
    let degrees = |format| match format {
        PoseFormat::Euler { degrees, .. } | PoseFormat::RotationVector { degrees } => Some(degrees),
        _ => None,
    };
    match (degrees(found), degrees(stated)) {
        (Some(true), Some(false)) => {
            all.push("are the angles of the orientations in deg, not rad? set `unit = \"deg\"`".to_owned());
        }
        (Some(false), Some(true)) => {
            all.push("are the angles of the orientations in rad, not deg? set `unit = \"rad\"`".to_owned());
        }
        _ => {}
    }
    all
}

fn is_euler(format: PoseFormat, axes: [usize; 3], fixed: bool) -> bool {
    matches!(format, PoseFormat::Euler { axes: stated, fixed: of, .. } if stated == axes && of == fixed)
}
