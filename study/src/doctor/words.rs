//! Readings in words.

use abbe::VariableKind;
use abbe_spec::Spec;

use super::Finding;
use super::change::Change;
use super::reading::{Layout, Reading};
use crate::number::digits;

const AXES: [&str; 3] = ["x", "y", "z"];

/// A reading: units, then what is other than in the spec.
pub(super) fn reading(reading: &Reading, spec: &Spec) -> String {
    let mut parts = Vec::new();
    match (reading.joints_in_degrees, reading.slides_in) {
        (Some(degrees), None) => parts.push(format!("joints in {}", angle(degrees))),
        (Some(degrees), Some(unit)) => parts.push(format!("joints in {} and {unit}", angle(degrees))),
        (None, Some(unit)) => parts.push(format!("joints in {unit}")),
        (None, None) => {}
    }
    parts.push(format!("positions in {}", reading.lengths_in));
    parts.extend(layout(reading.layout));
    match &reading.changes[..] {
        [] => parts.push("all else as in the spec".to_owned()),
        changes => parts.extend(changes.iter().map(|one| change(one, spec))),
    }
    parts.join("; ")
}

fn angle(degrees: bool) -> &'static str {
    if degrees { "degrees" } else { "radians" }
}

fn layout(layout: Layout) -> Option<String> {
    Some(match layout {
        Layout::Position => return None,
        Layout::Difference { target_minus_actual: true } => "differences are target − actual".to_owned(),
        Layout::Difference { target_minus_actual: false } => "differences are actual − target".to_owned(),
        Layout::Euler { axes: [a, b, c], fixed, degrees } => {
            let [a, b, c] = [AXES[a], AXES[b], AXES[c]];
            match fixed {
                false => format!("angles in {} about the turning axes {a}, {b}, {c}", angle(degrees)),
                true => format!("angles in {} about the fixed axes {a}, {b}, {c}", angle(degrees)),
            }
        }
        Layout::RotationVector { degrees } => format!("rotation vectors in {}", angle(degrees)),
        Layout::Quaternion { scalar_first: true } => "quaternions w, x, y, z".to_owned(),
        Layout::Quaternion { scalar_first: false } => "quaternions x, y, z, w".to_owned(),
        Layout::Matrix { by_rows } => format!("rotation matrices {}", by(by_rows)),
        Layout::Homogeneous { by_rows } => format!("homogeneous matrices {}", by(by_rows)),
    })
}

fn by(rows: bool) -> &'static str {
    if rows { "row by row" } else { "column by column" }
}

/// What is other than in the spec.
pub(super) fn change(change: &Change, spec: &Spec) -> String {
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
            format!("{} {verb} the other way round", names.join(", "))
        }
        Change::Coupled { joint, to, by } => {
            let sign = if *by > 0.0 { "+" } else { "−" };
            format!("{} is coupled: {} {sign} {} is meant", name(*joint), name(*joint), name(*to))
        }
        Change::Zero { joint, offset } => {
            let amount = match spec.variables[*joint].kind {
                VariableKind::Revolute => format!("{:+.2}°", offset.to_degrees()),
                VariableKind::Prismatic => format!("{} {}", digits(*offset, 4), spec.length.symbol()),
            };
            format!("the zero of {} is elsewhere: add {amount}", name(*joint))
        }
        Change::Convention => "the Denavit-Hartenberg numbers are of the other convention".to_owned(),
        Change::ToolInverted => "the tool is the other way round".to_owned(),
        Change::ToolLeftOut => "the poses are those of the flange, without the tool".to_owned(),
        Change::BaseInverted => "the base is the other way round".to_owned(),
        Change::BaseLeftOut => "the poses are seen from the foot, without the base of the spec".to_owned(),
        Change::EndsExchanged => "base and tool are exchanged".to_owned(),
        Change::PoseInverted => "the poses are those of the base as the tool sees it".to_owned(),
        Change::BaseElsewhere => "the poses are seen from another place".to_owned(),
        Change::ToolElsewhere => "the poses are those of another point of the end effector".to_owned(),
    }
}

/// What is found, in one sentence.
pub(super) fn sentence(found: &[Finding], others: &[Finding], spec: &Spec, within: f64) -> String {
    let unit = spec.length.symbol();
    match found {
        [] => {
            let nearest = match others.first() {
                None => "no reading of these columns comes near".to_owned(),
                Some(one) => {
                    let turns = one.angle.map_or(String::new(), |angle| {
                        format!(
                            " of the positions and {}° of the orientations",
                            digits(angle.to_degrees(), 3)
                        )
                    });
                    let (within, left) = (digits(within, 3), digits(one.residual, 3));
                    format!("{within} {unit} may be left, the nearest leaves {left} {unit}{turns}")
                }
            };
            format!("None fits: {nearest}. Is it another machine, or are other columns the joints?")
        }
        [only] => {
            format!("One reading fits, and leaves {} {unit}: {}.", digits(only.residual, 3), only.words)
        }
        [first, rest @ ..] => format!(
            "These rows fit {} readings that they cannot tell apart; the simplest leaves {} {unit}: {}.",
            rest.len() + 1,
            digits(first.residual, 3),
            first.words
        ),
    }
}
