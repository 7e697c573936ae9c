//! Forms of an `A_i`, all of which are converted to a product of [`Factor`]s.

use abbe_core::VariableKind;

use super::{keys, rigid};
use crate::degrees::check_angle;
use crate::diagnostic::Diagnostic;
use crate::document::{Item, Section};
use crate::expr::{
    Allowed, Dimension, Elementary, Entry, Expression, Motion, Scope, Symbol, parse_transform,
};
use crate::manipulator::{DhConvention, Factor, Matrix};

/// The frame's own variable and its kind, for `origin` and `axis`.
pub(super) type OwnVariable = Option<(Symbol, VariableKind)>;

/// Reads the transform of a frame or tool, and records angles that are probably in degrees.
pub(super) fn read_factors(section: &Section<'_>, own: OwnVariable, scope: &Scope) -> Option<Vec<Factor>> {
    let factors = read_form(section, own, scope)?;
    for factor in &factors {
        if let Factor::Elementary(Elementary { motion: R, amount, .. }) = factor {
            check_angle(amount, section.document);
        }
    }
    Some(factors)
}

fn read_form(section: &Section<'_>, own: OwnVariable, scope: &Scope) -> Option<Vec<Factor>> {
    // The forms exclude each other; `axis` belongs to `origin`.
    let forms = keys::TRANSFORM.names().filter(|key| *key != "axis");
    let forms: Vec<Item<'_>> = forms.filter_map(|form| section.get(form)).collect();
    let axis = section.get("axis");
    if let [first, second, ..] = &forms[..] {
        let message = format!("{} has both `{}` and `{}`", section.name, first.key, second.key);
        let help = "keep one of them";
        let mistake = Diagnostic::new(second.key_span.clone(), message).label("one too many");
        return section.document.fail(mistake.context(first.key_span.clone(), "the first one").help(help));
    }
    if let (Some(axis), Some(form)) = (&axis, forms.first().filter(|form| form.key != "origin")) {
        let message = format!("`axis` belongs to `origin`, not to `{}`", form.key);
        return axis.refuse_key(message, "leave `axis` out");
    }
    let Some(form) = forms.first() else {
        if axis.is_some() {
            return about_axis(axis.as_ref(), section, own, scope);
        }
        let help = "give one of `transform`, `matrix`, `dh`, `mdh`, `origin`";
        let mistake = Diagnostic::new(section.span.clone(), format!("{} has no transform", section.name));
        return section.document.fail(mistake.label("no transform from the previous frame").help(help));
    };
    match form.key.as_str() {
        "transform" => {
            let text = form.located_text()?;
            let factors = parse_transform(&text, scope, &mut section.document.found.borrow_mut())?;
            if factors.is_empty() {
                let label = "expected a product of Tx, Ty, Tz, Rx, Ry, Rz";
                let mistake = Diagnostic::new(form.span(), "this transform is empty");
                return section.document.fail(mistake.label(label).help("write `Tx(0)` for the identity"));
            }
            Some(factors.into_iter().map(Factor::Elementary).collect())
        }
        "matrix" => read_matrix(form, scope).map(|matrix| vec![Factor::Matrix(Box::new(matrix))]),
        "dh" => denavit_hartenberg(form, scope, DhConvention::Standard),
        "mdh" => denavit_hartenberg(form, scope, DhConvention::Modified),
        _ => {
            let mut factors = origin(form, scope);
            let motion = about_axis(axis.as_ref(), section, own, scope);
            factors.as_mut()?.extend(motion?);
            factors
        }
    }
}

/// Returns the Denavit-Hartenberg convention of a frame, if it has one.
pub(super) fn convention(section: &Section<'_>) -> Option<DhConvention> {
    let forms = [("dh", DhConvention::Standard), ("mdh", DhConvention::Modified)];
    forms.into_iter().find(|(key, _)| section.get(key).is_some()).map(|(_, convention)| convention)
}

const T: Motion = Motion::Translation;
const R: Motion = Motion::Rotation;

pub(super) fn motion_dimension(motion: Motion) -> Dimension {
    match motion {
        Motion::Translation => Dimension::LENGTH,
        Motion::Rotation => Dimension::NONE,
    }
}

fn read_matrix(item: &Item<'_>, scope: &Scope) -> Option<Matrix> {
    let rows: [Item<'_>; 4] = item.entries("four rows of four entries")?;
    let mut read = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let Some(entries) = row.entries::<4>("four rows of four entries") else {
            read.push(None);
            continue;
        };
        for (j, entry) in entries.iter().enumerate() {
            let (dimension, what) = match (i, j) {
                (3, _) => (Dimension::NONE, "an entry of the last row"),
                (_, 3) => (Dimension::LENGTH, "an entry of the position column"),
                _ => (Dimension::NONE, "an entry of the rotation"),
            };
            let expected = Entry { dimension: Some(dimension), what, names: Allowed::Geometry };
            read.push(entry.expression(scope, expected));
        }
    }
    let mut read = read.into_iter().collect::<Option<Vec<Expression>>>()?;
    for (j, entry) in read.split_off(12).iter().enumerate() {
        let expected = if j == 3 { 1.0 } else { 0.0 };
        if entry.constant() != Some(expected) {
            let help = "the upper left 3×3 block is the rotation, the last column is the position";
            let mistake = Diagnostic::new(entry.span(), "the last row of a rigid motion is 0 0 0 1");
            return item.document.fail(mistake.label(format!("expected {expected}")).help(help));
        }
    }
    let mut rows = read.chunks_exact(4).map(|row| row.to_vec().try_into().ok());
    let rows = [rows.next()??, rows.next()??, rows.next()??];
    Some(Matrix { rows, span: item.span() })
}

fn denavit_hartenberg(item: &Item<'_>, scope: &Scope, convention: DhConvention) -> Option<Vec<Factor>> {
    let section = item.table(format!("`{}`", item.key), &[&keys::DENAVIT_HARTENBERG])?;
    let factors = convention.order().map(|number| {
        let (key, (motion, axis)) = (number.name(), number.motion());
        let what = format!("`{key}`");
        let expected = Entry::new(motion_dimension(motion), &what, Allowed::Geometry);
        let amount = section.required(key)?.expression(scope, expected)?;
        Some(Factor::Elementary(Elementary { motion, axis, amount }))
    });
    factors.into_iter().collect()
}

/// Reads a URDF origin: `T(xyz) Rz(y) Ry(p) Rx(r)`.
fn origin(item: &Item<'_>, scope: &Scope) -> Option<Vec<Factor>> {
    let section = item.table("`origin`", &[&keys::ORIGIN])?;
    let three = |key: &str, motion: Motion| -> Option<Vec<Factor>> {
        let Some(item) = section.get(key) else { return Some(Vec::new()) };
        let entries: [Item<'_>; 3] = item.entries("three numbers")?;
        let what = format!("an entry of `{key}`");
        let expected = Entry::new(motion_dimension(motion), &what, Allowed::Geometry);
        let amounts = entries.map(|entry| entry.expression(scope, expected));
        let factor = |(axis, amount): (usize, Option<Expression>)| {
            Some(Factor::Elementary(Elementary { motion, axis, amount: amount? }))
        };
        amounts.into_iter().enumerate().map(factor).collect()
    };
    let (translations, rotations) = (three("xyz", T), three("rpy", R));
    let mut factors = translations?;
    factors.extend(rotations?.into_iter().rev());
    Some(factors)
}

/// Reads the motion of the frame's own variable along or about its axis.
fn about_axis(
    item: Option<&Item<'_>>,
    section: &Section<'_>,
    own: OwnVariable,
    scope: &Scope,
) -> Option<Vec<Factor>> {
    let Some((variable, kind)) = own else {
        if let Some(item) = item {
            let message = format!("{} has an axis but no variable", section.name);
            let help = "add `variable = { … }`, or leave `axis` out";
            let mistake = Diagnostic::new(item.key_span.clone(), message);
            return section.document.fail(mistake.label("no variable to move along or about it").help(help));
        }
        return Some(Vec::new());
    };
    let (motion, dimension) = kind.either((R, Dimension::NONE), (T, Dimension::LENGTH));
    let mut axis = [1.0, 0.0, 0.0];
    if let Some(item) = item {
        let entries: [Item<'_>; 3] = item.entries("three numbers")?;
        let read = entries.map(|entry| entry.amount(scope, Dimension::NONE, "an entry of `axis`"));
        let [Some(x), Some(y), Some(z)] = read else { return None };
        axis = [x, y, z];
        let length = (x * x + y * y + z * z).sqrt();
        if (length - 1.0).abs() > rigid::TOLERANCE {
            let help = if length > 0.0 {
                format!("write [{}, {}, {}]", x / length, y / length, z / length)
            } else {
                "an axis is a unit vector such as [0, 0, 1]".to_owned()
            };
            let mistake = Diagnostic::new(item.span(), "`axis` must be a unit vector");
            return section.document.fail(mistake.label(format!("its length is {length}")).help(help));
        }
    }
    let span = item.map_or(section.span.clone(), Item::span);
    let amount = Expression::symbol(variable, Some(dimension), span);
    let principal =
        (0..3).find(|&i| axis[i].abs() == 1.0 && axis[(i + 1) % 3] == 0.0 && axis[(i + 2) % 3] == 0.0);
    Some(vec![match principal {
        Some(i) if axis[i] > 0.0 => Factor::Elementary(Elementary { motion, axis: i, amount }),
        Some(i) => Factor::Elementary(Elementary { motion, axis: i, amount: amount.negated() }),
        None => Factor::About { motion, axis, amount },
    }])
}
