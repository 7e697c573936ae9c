//! Elastic elements: `beam` and `compliance`.

use abbe_core::Component;

use super::{BEAM_AXES, keys};
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item};
use crate::expr::{Allowed, Dimension, Entry, Expression, Scope};
use crate::manipulator::{Beam, Compliance};

/// Reads a `beam`; `positive` checks the signs of its quantities.
pub(super) fn read_beam(item: &Item<'_>, scope: &Scope) -> Option<Beam> {
    let table = item.table("`beam`", &[&keys::BEAM])?;
    let axis = table.get("axis").map_or(Some(0), |item| item.choice(&BEAM_AXES))?;
    let bending = Beam::bending_keys(axis);
    if let Some(item) =
        table.items().find(|item| item.key.starts_with("EI_") && !bending.contains(&&*item.key))
    {
        return item.document.fail(not_about_itself(axis, &item));
    }
    let quantity = |key: &str, dimension: Dimension, required: bool| -> Option<Option<Expression>> {
        let item = if required { Some(table.required(key)?) } else { table.get(key) };
        let what = format!("`{key}`");
        let entry = Entry { dimension: Some(dimension), what: &what, names: Allowed::Everything };
        item.map_or(Some(None), |item| item.expression(scope, entry).map(Some))
    };
    let stiffness = Dimension::FORCE_TIMES_AREA;
    let length = quantity("length", Dimension::LENGTH, true);
    let [first, second] = bending.map(|key| quantity(key, stiffness, true));
    let (torsion, extension) = (quantity("GJ", stiffness, false), quantity("EA", Dimension::FORCE, false));
    let mass_per_length = quantity("mass_per_length", Dimension::MASS_PER_LENGTH, false);
    Some(Beam {
        axis,
        length: length??,
        bending: [first??, second??],
        torsion: torsion?,
        extension: extension?,
        mass_per_length: mass_per_length?,
    })
}

/// Returns the mistake of a bending stiffness about the axis of the beam itself. Until version 0.3
/// `EI_y` and `EI_z` were about the next two axes, whatever the axis of the beam: every beam along
/// y or z was written with one of these keys.
fn not_about_itself(axis: usize, item: &Item<'_>) -> Diagnostic {
    let along = ["x", "y", "z"];
    let [first, second] = Beam::bending_keys(axis);
    let [about_first, about_second] = [along[(axis + 1) % 3], along[(axis + 2) % 3]];
    let renamed = match axis {
        0 => String::new(),
        _ => format!("; before 0.3 {first} was written `EI_y`, and {second} `EI_z`"),
    };
    let axis = along[axis];
    Diagnostic::new(item.key_span.clone(), format!("a beam along {axis} does not bend about {axis}")).label(
        format!("write `{first}` and `{second}`"),
    ).help(format!(
        "`{first}` resists bending about {about_first}, a deflection along {about_second}; `{second}` bending about \
         {about_second}, a deflection along {about_first}{renamed}"
    ))
}

/// Reads a `compliance`: six numbers on the diagonal, or all 36.
pub(super) fn read_compliance(item: &Item<'_>, scope: &Scope) -> Option<Compliance> {
    let table = item.table("`compliance`", &[&keys::COMPLIANCE])?;
    let entry = |row: usize, column: usize, item: &Item<'_>| {
        let what = format!("the compliance of {} per {}", Component::ALL[row].name(), WRENCH[column]);
        item.expression(scope, Entry::new(dimension(row, column), &what, Allowed::Everything))
    };
    let mut compliance = Compliance::default();
    match (table.get("diagonal"), table.get("matrix")) {
        (Some(diagonal), None) => {
            let entries: [Item<'_>; 6] = diagonal.entries("six numbers")?;
            for (i, item) in entries.iter().enumerate() {
                compliance[i][i] = Some(entry(i, i, item)?);
            }
        }
        (None, Some(matrix)) => {
            let rows: [Item<'_>; 6] = matrix.entries("six rows of six numbers")?;
            for (i, row) in rows.iter().enumerate() {
                let entries: [Item<'_>; 6] = row.entries("six rows of six numbers")?;
                for (j, item) in entries.iter().enumerate() {
                    compliance[i][j] = Some(entry(i, j, item)?);
                }
            }
            check_symmetric(&compliance, item.document)?;
        }
        _ => {
            return item.document.fail(Diagnostic::new(item.key_span.clone(), "expected either `diagonal` or `matrix`")
                    .label("exactly one of them is required")
                    .help("write { diagonal = [six] } or { matrix = [[six], …] }, in the order of e_x e_y e_z e_s e_r e_p"));
        }
    }
    Some(compliance)
}

/// Forces and moments, in the order of ε.
const WRENCH: [&str; 6] =
    ["force along x", "force along y", "force along z", "moment about y", "moment about z", "moment about x"];

fn dimension(row: usize, column: usize) -> Dimension {
    let error = if row < 3 { Dimension::LENGTH } else { Dimension::NONE };
    let wrench = if column < 3 { Dimension::FORCE } else { Dimension::MOMENT };
    // Small exponents cannot overflow.
    error.over(wrench).unwrap_or(Dimension::NONE)
}

/// Checks symmetry, which follows from reciprocity.
fn check_symmetric(compliance: &Compliance, document: &Document) -> Option<()> {
    for (i, row) in compliance.iter().enumerate() {
        for (j, entry) in row.iter().enumerate().take(i) {
            let (Some(below), Some(above)) = (entry, &compliance[j][i]) else { continue };
            let (Some(a), Some(b)) = (below.constant(), above.constant()) else { continue };
            if (a - b).abs() > 1e-9 * a.abs().max(b.abs()) {
                let message = "a compliance matrix must be symmetric";
                let help = "displacement k per unit of load l equals displacement l per unit of load k";
                let mistake = Diagnostic::new(below.span(), message).label(format!("this is {a}"));
                return document.fail(mistake.context(above.span(), format!("this is {b}")).help(help));
            }
        }
    }
    Some(())
}
