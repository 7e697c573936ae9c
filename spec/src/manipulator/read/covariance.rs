//! `[covariance]`: the covariance of the errors of an identified machine.
//!
//! `[fitted]`: ranges of joints and inputs over which the errors of an identified machine were
//! fitted.

use abbe_core::{Component, VariableKind};

use super::{COVARIANCE, COVARIANCE_OF, Declarations};
use crate::diagnostic::Diagnostic;
use crate::document::{Item, Section};
use crate::expr::{Dimension, Scope, Symbol};
use crate::manipulator::{Cause, ChainNumber, Covariance, Fitted, Frame, Identified, Source};
use crate::option::IDENTIFY_OUT;
use crate::value::{find_name, read_name};

/// Reads the table; the covariance is empty without one.
pub(super) fn read_covariance(
    root: &Section<'_>,
    frames: &[Frame],
    sources: &[Source],
    scope: &Scope,
) -> Option<Covariance> {
    let Some(item) = root.get("covariance") else { return Some(Covariance::default()) };
    let section = item.table("[covariance]", &[&COVARIANCE])?;
    let (of, rows) = (section.required("of"), section.required("rows"));
    let (of, rows_item) = (of?, rows?);
    let all = of.array("an array of tables `{ source = \"…\" }`")?;
    let all = all.iter().map(|item| identified(item, frames, sources, scope));
    let all = all.collect::<Option<Vec<_>>>()?;
    let rows = numbers(&rows_item, scope)?;
    let count = all.len();
    let square = rows.len() == count && rows.iter().all(|row| row.len() == count);
    let message = if !square {
        format!("this covariance must have {count} rows of {count} numbers")
    } else if (0..count).any(|i| rows[i][i] < 0.0) {
        "a variance cannot be negative".to_owned()
    } else if (0..count).any(|i| (0..i).any(|j| rows[i][j] != rows[j][i])) {
        "a covariance matrix must be symmetric".to_owned()
    } else {
        return Some(Covariance { of: all, rows });
    };
    let help = format!("`{IDENTIFY_OUT}` writes this table; remove it if the covariance is unknown");
    rows_item.refuse(message, help)
}

/// Reads rows of numbers.
fn numbers(item: &Item<'_>, scope: &Scope) -> Option<Vec<Vec<f64>>> {
    let number = |item: &Item<'_>| item.amount(scope, Dimension::NONE, "a covariance");
    let numbers = |row: &Item<'_>| row.array("numbers")?.iter().map(number).collect();
    item.array("rows of numbers")?.iter().map(numbers).collect()
}

fn identified(item: &Item<'_>, frames: &[Frame], sources: &[Source], scope: &Scope) -> Option<Identified> {
    let section = item.table("this entry of [covariance]", &[&COVARIANCE_OF])?;
    let component =
        |error: &Item<'_>| error.choice(&Component::ALL.map(|component| (component.name(), component)));
    let Some(name) = section.get("source") else {
        let component = component(&section.required("error")?)?;
        let Some(frame) = section.get("frame") else { return Some(Identified::Base(component)) };
        let frame = read_name(&frame, frames.iter().map(|frame| frame.name.as_str()), "frame")?;
        return Some(Identified::Error(frame, component));
    };
    let source = read_name(&name, sources.iter().map(|source| source.name.as_str()), "source")?;
    if let Some(joint) = section.get("joint") {
        return of_joint(&section, &joint, &sources[source], scope);
    }
    let Some(error) = section.get("error") else { return Some(Identified::Magnitude(source)) };
    let component = component(&error)?;
    let has = |cause: &Cause| match cause {
        Cause::Errors(errors) => errors.iter().any(|(own, _)| *own == component),
        _ => false,
    };
    let effect = sources[source].effects.iter().find(|effect| effect.at.is_empty() && has(&effect.cause));
    if effect.is_none() {
        let message = format!("`{}` has no {} of a frame", sources[source].name, component.name());
        let help = "name an error of the source, or omit `error` to refer to the magnitude of the source";
        item.document.mistake(Diagnostic::new(error.span(), message).help(help));
    }
    effect.map(|effect| Identified::Error(effect.frame, component))
}

/// Reads `joint`: the source has an error of this joint.
fn of_joint(section: &Section<'_>, item: &Item<'_>, source: &Source, scope: &Scope) -> Option<Identified> {
    if let Some(error) = section.get("error") {
        let help = "`error` names an error of a frame; remove one of them";
        return error.refuse_key("`error` and `joint` cannot be combined", help);
    }
    let name = item.string()?;
    let joint = source.deviations.iter().find_map(|deviation| match deviation.number {
        ChainNumber::Joint(joint) => {
            let is_named =
                scope.names.get(&name).is_some_and(|known| known.symbol == Symbol::Variable(joint));
            is_named.then_some(joint)
        }
        _ => None,
    });
    if joint.is_none() {
        let message = format!("`{}` has no error of a joint `{name}`", source.name);
        let help = "name the joint of the source, or omit `joint` to refer to the magnitude of the source";
        section.document.mistake(Diagnostic::new(item.span(), message).help(help));
    }
    joint.map(Identified::Joint)
}

/// Reads the table, if there is one.
pub(super) fn read_fitted(root: &Section<'_>, declarations: &Declarations) -> Vec<Fitted> {
    let section = root.get("fitted").and_then(|item| item.section());
    let dimension = |kind: VariableKind| kind.either(Dimension::NONE, Dimension::LENGTH);
    let variables = declarations.variables.iter();
    let variables = variables.map(|variable| (variable.name.as_str(), dimension(variable.kind)));
    let inputs = declarations.inputs.iter().map(|input| (input.name.as_str(), input.dimension));
    let (names, dimensions): (Vec<&str>, Vec<Dimension>) = variables.chain(inputs).unzip();
    let mut fitted = Vec::new();
    for item in section.iter().flat_map(Section::items) {
        let place = item.key_span.clone();
        let Some(found) = find_name(root.document, place, &item.key, &names, "variable or input") else {
            continue;
        };
        let Some(range) = declarations.interval(&item, dimensions[found]) else { continue };
        let symbol = match found.checked_sub(declarations.variables.len()) {
            None => Symbol::Variable(found),
            Some(input) => Symbol::Input(input),
        };
        fitted.push(Fitted { symbol, range });
    }
    fitted
}
