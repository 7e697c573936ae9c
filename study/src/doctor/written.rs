//! A reading as a map.

use std::fmt::Write;

use abbe::VariableKind;
use abbe_codegen::spec::Spec;

use super::change::Change;
use super::columns::Columns;
use super::reading::{Layout, Reading};
use super::words;
use crate::number::digits;
use crate::toml_text::quoted;

/// The map, and in words what it cannot hold.
pub(super) fn map(reading: &Reading, spec: &Spec, columns: &Columns, within: f64) -> (String, Vec<String>) {
    let mut of_spec = Vec::new();
    let (mut order, mut signs) =
        ((0..spec.variables.len()).collect::<Vec<_>>(), vec![1; spec.variables.len()]);
    let mut base = "known";
    for change in &reading.changes {
        match change {
            Change::Order(columns) => order.clone_from(columns),
            Change::Reversed(joints) => joints.iter().for_each(|i| signs[*i] = -1),
            Change::BaseElsewhere => base = "unknown",
            change => of_spec.push(words::change(change, spec)),
        }
    }
    let mut text = String::from("# A map by `abbe doctor`.\n");
    if !of_spec.is_empty() {
        text += "# It cannot hold all of the reading. To be changed in the spec, or in the file:\n";
        of_spec.iter().for_each(|line| text += &format!("# - {line}\n"));
    }
    let _ = write!(
        text,
        "\n[data]\ntitle = \"As abbe doctor reads it\"\nuncertainty = \"{} {}\"        # not known: state that of the instrument\nbase = \"{base}\"\n\n[joints]\n",
        digits(0.05 * within, 2),
        spec.length.symbol(),
    );
    for (i, variable) in spec.variables.iter().enumerate() {
        let unit = match variable.kind {
            VariableKind::Revolute if reading.joints_in_degrees == Some(true) => "deg",
            VariableKind::Revolute => "rad",
            VariableKind::Prismatic => reading.slides_in.unwrap_or(spec.length.symbol()),
        };
        let sign = if signs[i] < 0 { ", sign = -1" } else { "" };
        let column = quoted(&columns.joint_names[order[i]]);
        let _ = writeln!(text, "{} = {{ column = {column}, unit = \"{unit}\"{sign} }}", variable.name);
    }
    let name = |range: std::ops::Range<usize>| {
        let names: Vec<String> = columns.pose_names[range].iter().map(|name| quoted(name)).collect();
        format!("[{}]", names.join(", "))
    };
    let unit = reading.lengths_in;
    text += &match reading.layout {
        Layout::Difference { target_minus_actual } => {
            if !target_minus_actual {
                of_spec.push("differences are actual − target, a map has target − actual: turn their signs in the file".to_owned());
            }
            format!(
                "\n[difference]\ntarget = {}\ndifference = {}\nunit = \"{unit}\"\n",
                name(0..3),
                name(3..6)
            )
        }
        Layout::Euler { axes, fixed, degrees } if axes[0] != axes[2] => {
            // About fixed axes the last turn stands first in the product.
            let axes = if fixed { [axes[2], axes[1], axes[0]] } else { axes };
            let order: String = axes.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
            let mut names: Vec<String> = columns.pose_names[3..6].iter().map(|name| quoted(name)).collect();
            if fixed {
                names.reverse();
            }
            let unit_of_angle = if degrees { "deg" } else { "rad" };
            format!(
                "\n[pose]\nposition = {}\nunit = \"{unit}\"\neuler = {{ columns = [{}], order = \"{order}\", unit = \"{unit_of_angle}\" }}\n",
                name(0..3),
                names.join(", ")
            )
        }
        Layout::Quaternion { scalar_first } => {
            let order = if scalar_first { "wxyz" } else { "xyzw" };
            format!(
                "\n[pose]\nposition = {}\nunit = \"{unit}\"\nquaternion = {{ columns = {}, order = \"{order}\" }}\n",
                name(0..3),
                name(3..7)
            )
        }
        Layout::Matrix { .. } | Layout::Homogeneous { .. } => {
            let (position, nine) = matrix(reading.layout, columns.pose_names.len());
            let names = |places: &[usize]| {
                let names: Vec<String> =
                    places.iter().map(|place| quoted(&columns.pose_names[*place])).collect();
                format!("[{}]", names.join(", "))
            };
            format!(
                "\n[pose]\nposition = {}\nunit = \"{unit}\"\nmatrix = {}\n",
                names(&position),
                names(&nine)
            )
        }
        Layout::Position => format!("\n[point]\ncolumns = {}\nunit = \"{unit}\"\n", name(0..3)),
        Layout::Euler { .. } | Layout::RotationVector { .. } => {
            of_spec.push("a map has no such orientations: it takes the positions alone".to_owned());
            format!("\n[point]\ncolumns = {}\nunit = \"{unit}\"\n", name(0..3))
        }
    };
    (text, of_spec)
}

/// The places of the position, and of the matrix row by row.
fn matrix(layout: Layout, count: usize) -> (Vec<usize>, Vec<usize>) {
    let place = |i: usize, j: usize| match (layout, count) {
        (Layout::Matrix { by_rows: true }, _) => 3 + 3 * i + j,
        (Layout::Matrix { .. }, _) => 3 + 3 * j + i,
        (Layout::Homogeneous { by_rows: true }, _) => 4 * i + j,
        (_, 16) => 4 * j + i,
        _ => 3 * j + i,
    };
    let position = match layout {
        Layout::Matrix { .. } => vec![0, 1, 2],
        _ => (0..3).map(|i| place(i, 3)).collect(),
    };
    (position, (0..9).map(|k| place(k / 3, k % 3)).collect())
}
