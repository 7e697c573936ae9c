//! Orientations of the tool in a box of points.

use abbe::analysis::ToolOrientation;
use abbe_spec::{Diagnostic, Item, expr::Dimension};
use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::{constant, keys, keys::ORIENTATIONS};
use crate::number;

/// Smallest angle between two axes of the tool that are not perpendicular, in rad.
const PERPENDICULAR: f64 = 1e-3;

/// Reads one orientation, or a list of them.
pub(super) fn orientations(item: &Item<'_>) -> Option<Vec<ToolOrientation>> {
    if !item.is_list() {
        return orientation(item).map(|one| vec![one]);
    }
    let items = item.list();
    let read: Vec<ToolOrientation> = items.iter().filter_map(|item| orientation(item)).collect();
    if items.is_empty() {
        return item.refuse("no orientation is given", "give at least one, such as \"down\"");
    }
    (read.len() == items.len()).then_some(read)
}

fn orientation(item: &Item<'_>) -> Option<ToolOrientation> {
    if !item.is_table() {
        return item.choice(&ORIENTATIONS);
    }
    let section = item.table("the orientation", &[&keys::ORIENTATION])?;
    let given: Vec<Item<'_>> = section.items().collect();
    if let Some(item) = section.get("quaternion").filter(|_| given.len() == 1) {
        let [w, x, y, z] = vector(&item)?;
        let quaternion = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        return Some(ToolOrientation::Axes(axes(quaternion.to_rotation_matrix())));
    }
    let mut directions = Vec::new();
    for (axis, key) in ["x", "y", "z"].into_iter().enumerate() {
        if let Some(item) = section.get(key) {
            directions.push((axis, Vector3::from(vector::<3>(&item)?)));
        }
    }
    match (&directions[..], section.get("quaternion")) {
        ([(axis, direction)], None) => Some(ToolOrientation::Along(*axis, (*direction).into())),
        ([(first, a), (second, b)], None) => {
            if a.dot(b).abs() > PERPENDICULAR {
                let mistake = Diagnostic::new(item.span(), "these axes of the tool are not perpendicular");
                let help = "give one axis alone, about which the tool may turn";
                return item.document.fail(mistake.help(help));
            }
            let mut columns = [Vector3::zeros(); 3];
            columns[*first] = *a;
            columns[*second] = (b - a * a.dot(b)).normalize();
            let third = 3 - first - second;
            columns[third] = columns[(third + 1) % 3].cross(&columns[(third + 2) % 3]);
            Some(ToolOrientation::Axes(columns.map(Into::into)))
        }
        _ => {
            let help = "give one or two of `x`, `y` and `z`, or a `quaternion`";
            item.refuse("an orientation needs one or two axes, or a quaternion", help)
        }
    }
}

/// Reads numbers, scaled to a vector of length 1.
fn vector<const N: usize>(item: &Item<'_>) -> Option<[f64; N]> {
    let entries: [Item<'_>; N] = item.entries(&format!("{N} numbers"))?;
    let read = entries.map(|entry| constant(&entry, Dimension::NONE, "a component of the vector"));
    let mut vector = [0.0; N];
    for (value, read) in vector.iter_mut().zip(read) {
        *value = read?;
    }
    let norm = vector.iter().fold(0.0, |norm: f64, value| norm.hypot(*value));
    if norm == 0.0 {
        let mistake = Diagnostic::new(item.span(), format!("`{}` has no direction", item.key));
        return item.document.fail(mistake.label("all are 0").help("give at least one number other than 0"));
    }
    Some(vector.map(|value| value / norm))
}

fn axes(rotation: Rotation3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|axis| rotation.matrix().column(axis).into())
}

/// Describes the orientations, such as `with z of the tool along (0, 0, -1)`.
pub(super) fn describe(orientations: &[ToolOrientation]) -> String {
    match orientations {
        [ToolOrientation::Free] => "in any orientation".to_owned(),
        [ToolOrientation::Home] => "in the home orientation".to_owned(),
        [ToolOrientation::Axes(_)] => "in one orientation".to_owned(),
        [ToolOrientation::Along(axis, direction)] => {
            let [x, y, z] = direction.map(number::short);
            format!("with {} of the tool along ({x}, {y}, {z})", ["x", "y", "z"][*axis])
        }
        several => format!("in {} orientations", several.len()),
    }
}
