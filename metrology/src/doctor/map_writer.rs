//! Writes an interpretation as a map.

use abbe::{Pose, VariableKind};
use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{list, quantity, quoted};

use super::columns::Columns;
use crate::data::quaternion;
use crate::interpretations::{Candidate, Change, Interpretation, PoseFormat, words};
use abbe_study::number::digits;

/// Significant digits of a fitted zero; data determine fewer.
const DIGITS: usize = 8;

/// Returns the map, and sentences on what a map cannot express. Measurement uncertainties are
/// unknown.
pub(super) fn map(candidate: &Candidate, spec: &Spec, columns: &Columns) -> (String, Vec<String>) {
    let Candidate { interpretation, base: station, tool, .. } = candidate;
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
            // Its pose is below; `identify` fits it anew.
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
        instrument: enter that of its data sheet, or `identify` estimates it.\n";
    let angle = interpretation.layout.is_oriented().then(|| quoted("unknown"));
    let data = TableText::default().text("uncertainty", "unknown").optional("angle_uncertainty", angle);
    let joints = TableText::with_header("\n[joints]").then(joints.keys(interpretation, spec, columns));
    text += &data.text("base", base).then(joints).then(measured_table(interpretation, columns)).to_string();
    text += &station.map(|pose| placed("\n[[station]]", pose, spec)).unwrap_or_default().to_string();
    text += &placement.unwrap_or_default().to_string();
    (text, of_spec)
}

/// Order, signs and zeros of the joint columns.
struct Joints {
    order: Vec<usize>,
    signs: Vec<i32>,
    zeros: Vec<f64>,
}

impl Joints {
    fn keys(&self, interpretation: &Interpretation, spec: &Spec, columns: &Columns) -> TableText {
        let mut keys = TableText::default();
        for (i, variable) in spec.variables.iter().enumerate() {
            let unit = match variable.kind {
                VariableKind::Revolute if interpretation.joints_in_degrees == Some(true) => "deg",
                VariableKind::Revolute => "rad",
                VariableKind::Prismatic => interpretation.slides_in.unwrap_or(spec.length.symbol()),
            };
            let column = TableText::default().text("column", &columns.joint_names[self.order[i]]);
            let sign = (self.signs[i] < 0).then_some(-1);
            let column = column.text("unit", unit).optional("sign", sign);
            let column = column.optional("zero", zero(self.zeros[i], variable.kind, spec));
            keys = keys.key(&variable.name, column.inline());
        }
        let note = "# Zeros are fitted to the rows; enter the exact value if you know the convention.\n";
        if self.zeros.iter().any(|zero| *zero != 0.0) { keys.then(note) } else { keys }
    }
}

/// Returns the map's table of the measured quantity.
fn measured_table(interpretation: &Interpretation, columns: &Columns) -> TableText {
    let names = |places: &[usize]| list(places.iter().map(|place| quoted(&columns.pose_names[*place])));
    let unit = interpretation.lengths_in;
    let rotation_unit = |degrees: bool| if degrees { "deg" } else { "rad" };
    let pose = |key: &str, turn: &str| {
        let pose = TableText::with_header("\n[pose]").key("position", names(&[0, 1, 2]));
        pose.text("unit", unit).key(key, turn)
    };
    let turn = |places: &[usize]| TableText::default().key("columns", names(places));
    match interpretation.layout {
        PoseFormat::Position => {
            TableText::with_header("\n[point]").key("columns", names(&[0, 1, 2])).text("unit", unit)
        }
        PoseFormat::Difference { .. } => TableText::with_header("\n[difference]")
            .key("target", names(&[0, 1, 2]))
            .key("difference", names(&[3, 4, 5]))
            .text("unit", unit),
        PoseFormat::Euler { axes, fixed, degrees } => {
            let (mut axes, mut places) = (axes, [3, 4, 5]);
            // Rotations about fixed axes multiply in reverse order.
            if fixed {
                axes.reverse();
                places.reverse();
            }
            let order: String = axes.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
            let turn = turn(&places).text("order", &order).text("unit", rotation_unit(degrees));
            pose("euler", &turn.inline())
        }
        PoseFormat::RotationVector { degrees } => {
            pose("rotation_vector", &turn(&[3, 4, 5]).text("unit", rotation_unit(degrees)).inline())
        }
        PoseFormat::Quaternion { scalar_first } => {
            let order = if scalar_first { "wxyz" } else { "xyzw" };
            pose("quaternion", &turn(&[3, 4, 5, 6]).text("order", order).inline())
        }
        PoseFormat::Matrix { .. } | PoseFormat::Homogeneous { .. } => {
            let (position, nine) = pose_columns(interpretation.layout, columns.pose_names.len());
            let pose = TableText::with_header("\n[pose]").key("position", names(&position));
            pose.text("unit", unit).key("matrix", names(&nine))
        }
    }
}

/// Returns the zero of a joint; `None` if it is that of the spec.
fn zero(offset: f64, kind: VariableKind, spec: &Spec) -> Option<String> {
    let (value, unit) = kind.either((offset.to_degrees(), "deg"), (offset, spec.length.symbol()));
    (offset != 0.0).then(|| quantity(digits(value, DIGITS), unit))
}

/// Returns the table of a fitted tool, relative to the tool of the spec; `None` for differences.
fn tool_placement(tool: Pose, layout: PoseFormat, spec: &Spec) -> Option<TableText> {
    let point = list(tool.0[3].map(|x| quantity(digits(x, DIGITS), spec.length.symbol())));
    let table = TableText::with_header("\n[placement]");
    match layout {
        PoseFormat::Position => Some(table.key("targets", list([point]))),
        PoseFormat::Difference { .. } => None,
        _ => Some(placed("\n[placement]", tool, spec)),
    }
}

/// Returns the table of a pose.
fn placed(header: &str, pose: Pose, spec: &Spec) -> TableText {
    let [x, y, z, position] = pose.0;
    let turn = list(quaternion(&[x, y, z]).map(|x| digits(x, DIGITS)));
    let point = list(position.map(|x| quantity(digits(x, DIGITS), spec.length.symbol())));
    TableText::with_header(header).key("position", point).key("quaternion", turn)
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
