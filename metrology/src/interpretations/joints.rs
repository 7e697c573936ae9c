//! Columns of joints: their units, configurations and joint values.

use std::f64::consts::PI;

use abbe::VariableKind;

use super::change::Change;

/// Unit of length: its symbol and its value in metres.
pub(crate) type Length = (&'static str, f64);

/// Units of length that are tried, the most usual ones first.
pub(crate) const LENGTHS: [Length; 5] =
    [("mm", 1e-3), ("m", 1.0), ("inch", 0.0254), ("cm", 1e-2), ("um", 1e-6)];

/// Units of joints, with the factors to coherent units.
#[derive(Clone, Copy)]
pub(super) struct JointUnits {
    pub(super) degrees: bool,
    pub(super) slides: &'static str,
    /// Factors of angles and of travels.
    pub(super) factors: [f64; 2],
}

impl JointUnits {
    /// Returns the plausible units of the columns. Values beyond two turns are not radians.
    /// `metres` is the length unit of the spec in metres.
    pub(super) fn all(
        kinds: &[VariableKind],
        metres: f64,
        columns: &[Vec<f64>],
        lengths: &[Length],
    ) -> Vec<Self> {
        let has = |kind: VariableKind| kinds.contains(&kind);
        let largest = columns.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        let only_turns = !has(VariableKind::Prismatic);
        let angles: &[bool] = match has(VariableKind::Revolute) {
            true if only_turns && largest > 4.0 * PI => &[true],
            true => &[true, false],
            false => &[false],
        };
        let slides = if only_turns { &lengths[..1] } else { lengths };
        let mut all = Vec::new();
        for degrees in angles {
            for (unit, in_metres) in slides {
                let factors = [angle(*degrees), in_metres / metres];
                all.push(Self { degrees: *degrees, slides: unit, factors });
            }
        }
        all
    }
}

/// Returns the value in rad of one unit of an angle.
pub(crate) fn angle(degrees: bool) -> f64 {
    if degrees { PI / 180.0 } else { 1.0 }
}

/// Computes joint values, without offsets of zeros, from the numbers of the columns. `factors` are
/// those of angles and of travels.
pub(crate) fn joint_values(
    columns: &[f64],
    kinds: &[VariableKind],
    factors: [f64; 2],
    changes: &[Change],
) -> Vec<f64> {
    let order = changes.iter().find_map(|change| match change {
        Change::Order(order) => Some(order),
        _ => None,
    });
    let column = |i: usize| order.map_or(columns[i], |order| columns[order[i]]);
    let factor = |kind: VariableKind| factors[usize::from(kind == VariableKind::Prismatic)];
    let mut q: Vec<f64> = kinds.iter().enumerate().map(|(i, kind)| column(i) * factor(*kind)).collect();
    for change in changes {
        if let Change::Reversed(joints) = change {
            joints.iter().for_each(|i| q[*i] = -q[*i]);
        }
    }
    for i in 0..q.len() {
        for change in changes {
            if let Change::Coupled { joint, to, by } = change
                && *joint == i
            {
                q[i] += by * q[*to];
            }
        }
    }
    q
}

/// Counts the distinct configurations. Two rows differ if a joint differs by more than a thousandth
/// of the largest value in its column.
pub(crate) fn configurations(rows: &[Vec<f64>]) -> usize {
    let count = rows.first().map_or(0, Vec::len);
    let largest = |joint: usize| rows.iter().fold(0.0_f64, |most, row| most.max(row[joint].abs()));
    let steps: Vec<f64> = (0..count).map(|joint| 1e-3 * largest(joint)).collect();
    let same =
        |a: &[f64], b: &[f64]| a.iter().zip(b).zip(&steps).all(|((a, b), step)| (a - b).abs() <= *step);
    (0..rows.len()).filter(|i| !rows[..*i].iter().any(|before| same(before, &rows[*i]))).count()
}
