//! Writes an interpretation as a map.

use std::fmt::Write;

use abbe::{Pose, VariableKind};
use abbe_spec::Spec;
use abbe_spec::literal::quoted;

use super::columns::Columns;
use crate::data::quaternion;
use crate::interpretations::{Candidate, Change, Interpretation, PoseFormat, words};
use abbe_study::number::digits;

/// Significant digits of a fitted zero; data determine fewer.
const DIGITS: usize = 8;

/// Returns the map, and sentences on what a map cannot express. Measurement uncertainties are
/// unknown.
pub(super) fn map(candidate: &Candidate, spec: &Spec, columns: &Columns) -> (String, Vec<String>) {
    let Candidate { interpretation, tool, .. } = candidate;
    let placement = tool.and_then(|tool| tool_placement(tool, interpretation.layout, spec));
    let count = spec.variables.len();
    let mut joints = Joints { order: (0..count).collect(), signs: vec![1; count], zeros: vec![0.0; count] };
    let coupled = interpretation.changes.iter().any(|change| matches!(change, Change::Coupled { .. }));
    let (mut base, mut of_spec) = ("known", Vec::new());
    for change in &interpretation.changes {
        match change {
            Change::Order(columns) => joints.order.clone_from(columns),
            Change::Reversed(reversed) => reversed.iter().for_each(|i| joints.signs[*i] = -1),
            // With a coupling it would be the zero of another joint value.
            Change::Zero { joint, offset } if !coupled => joints.zeros[*joint] = *offset,
            Change::BaseElsewhere => base = "unknown",
            Change::ToolElsewhere if placement.is_some() => {}
            change => of_spec.push(words::change(change, spec)),
        }
    }
    if interpretation.layout == (PoseFormat::Difference { target_minus_actual: false }) {
        let turn = "differences are actual − target, but a map needs target − actual: change \
            their signs in the file";
        of_spec.push(turn.to_owned());
    }
    let mut text = String::from("# Map written by `abbe doctor`.\n");
    if !of_spec.is_empty() {
        text += "# A map cannot express all of this interpretation. Change in the spec or in the \
            file:\n";
        of_spec.iter().for_each(|line| text += &format!("# - {line}\n"));
    }
    text += "\n[data]\ntitle = \"Interpretation by abbe doctor\"\n# Standard uncertainty of the \
        instrument: enter that of its data sheet, or `identify` estimates it.\n\
        uncertainty = \"unknown\"\n";
    if interpretation.layout.is_oriented() {
        text += "angle_uncertainty = \"unknown\"\n";
    }
    let _ = write!(text, "base = \"{base}\"\n\n[joints]\n");
    text += &joints.lines(interpretation, spec, columns);
    text += &measured_table(interpretation, columns);
    text += &placement.unwrap_or_default();
    (text, of_spec)
}

/// Order, signs and zeros of the joint columns.
struct Joints {
    order: Vec<usize>,
    signs: Vec<i32>,
    zeros: Vec<f64>,
}

impl Joints {
    fn lines(&self, interpretation: &Interpretation, spec: &Spec, columns: &Columns) -> String {
        let mut text = String::new();
        for (i, variable) in spec.variables.iter().enumerate() {
            let unit = match variable.kind {
                VariableKind::Revolute if interpretation.joints_in_degrees == Some(true) => "deg",
                VariableKind::Revolute => "rad",
                VariableKind::Prismatic => interpretation.slides_in.unwrap_or(spec.length.symbol()),
            };
            let sign = if self.signs[i] < 0 { ", sign = -1" } else { "" };
            let column = quoted(&columns.joint_names[self.order[i]]);
            let zero = zero_key(self.zeros[i], variable.kind, spec);
            let _ =
                writeln!(text, "{} = {{ column = {column}, unit = \"{unit}\"{sign}{zero} }}", variable.name);
        }
        if self.zeros.iter().any(|zero| *zero != 0.0) {
            text += "# Zeros are fitted to the rows; enter the exact value if you know the \
                convention.\n";
        }
        text
    }
}

/// Returns the map's table of the measured quantity.
fn measured_table(interpretation: &Interpretation, columns: &Columns) -> String {
    let names = |places: &[usize]| {
        let names: Vec<String> = places.iter().map(|place| quoted(&columns.pose_names[*place])).collect();
        format!("[{}]", names.join(", "))
    };
    let unit = interpretation.lengths_in;
    let angle_unit = |degrees: bool| if degrees { "deg" } else { "rad" };
    let pose = |position: &[usize], turn: String| {
        format!("\n[pose]\nposition = {}\nunit = \"{unit}\"\n{turn}\n", names(position))
    };
    match interpretation.layout {
        PoseFormat::Position => format!("\n[point]\ncolumns = {}\nunit = \"{unit}\"\n", names(&[0, 1, 2])),
        PoseFormat::Difference { .. } => format!(
            "\n[difference]\ntarget = {}\ndifference = {}\nunit = \"{unit}\"\n",
            names(&[0, 1, 2]),
            names(&[3, 4, 5])
        ),
        PoseFormat::Euler { axes, fixed, degrees } => {
            let (mut axes, mut places) = (axes, [3, 4, 5]);
            // Rotations about fixed axes multiply in reverse order.
            if fixed {
                axes.reverse();
                places.reverse();
            }
            let order: String = axes.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
            let (columns, unit) = (names(&places), angle_unit(degrees));
            let turn = format!("euler = {{ columns = {columns}, order = \"{order}\", unit = \"{unit}\" }}");
            pose(&[0, 1, 2], turn)
        }
        PoseFormat::RotationVector { degrees } => {
            let (columns, unit) = (names(&[3, 4, 5]), angle_unit(degrees));
            pose(&[0, 1, 2], format!("rotation_vector = {{ columns = {columns}, unit = \"{unit}\" }}"))
        }
        PoseFormat::Quaternion { scalar_first } => {
            let order = if scalar_first { "wxyz" } else { "xyzw" };
            let columns = names(&[3, 4, 5, 6]);
            pose(&[0, 1, 2], format!("quaternion = {{ columns = {columns}, order = \"{order}\" }}"))
        }
        PoseFormat::Matrix { .. } | PoseFormat::Homogeneous { .. } => {
            let (position, nine) = pose_columns(interpretation.layout, columns.pose_names.len());
            pose(&position, format!("matrix = {}", names(&nine)))
        }
    }
}

/// Returns the `zero` key of a joint; empty if its zero is that of the spec.
fn zero_key(offset: f64, kind: VariableKind, spec: &Spec) -> String {
    match kind {
        _ if offset == 0.0 => String::new(),
        VariableKind::Revolute => format!(", zero = \"{} deg\"", digits(offset.to_degrees(), DIGITS)),
        VariableKind::Prismatic => {
            format!(", zero = \"{} {}\"", digits(offset, DIGITS), spec.length.symbol())
        }
    }
}

/// Returns the table of a fitted tool, relative to the tool of the spec; `None` for differences.
fn tool_placement(tool: Pose, layout: PoseFormat, spec: &Spec) -> Option<String> {
    let unit = spec.length.symbol();
    let point = tool.0[3].map(|x| format!("\"{} {unit}\"", digits(x, DIGITS))).join(", ");
    match layout {
        PoseFormat::Position => Some(format!("\n[placement]\ntargets = [[{point}]]\n")),
        PoseFormat::Difference { .. } => None,
        _ => {
            let [x, y, z, _] = tool.0;
            let turn = quaternion(&[x, y, z]).map(|x| digits(x, DIGITS)).join(", ");
            Some(format!("\n[placement]\nposition = [{point}]\nquaternion = [{turn}]\n"))
        }
    }
}

/// Returns the column indices of the position, and of the rotation matrix row by row.
fn pose_columns(layout: PoseFormat, count: usize) -> (Vec<usize>, Vec<usize>) {
    let place = |i: usize, j: usize| match (layout, count) {
        (PoseFormat::Matrix { by_rows: true }, _) => 3 + 3 * i + j,
        (PoseFormat::Matrix { .. }, _) => 3 + 3 * j + i,
        (PoseFormat::Homogeneous { by_rows: true }, _) => 4 * i + j,
        (_, 16) => 4 * j + i,
        _ => 3 * j + i,
    };
    let position = match layout {
        PoseFormat::Matrix { .. } => vec![0, 1, 2],
        _ => (0..3).map(|i| place(i, 3)).collect(),
    };
    (position, (0..9).map(|k| place(k / 3, k % 3)).collect())
}
