//! Angles of more than a full turn, which are probably degrees without a unit.

use std::f64::consts::TAU;

use abbe::VariableKind;
use abbe_codegen::graph::Graph;
use abbe_spec::diagnostic::Span;
use abbe_spec::expr::{Expression, Motion, Symbol, motion};
use abbe_spec::{Cause, ChainNumber, Deviation, DhNumber, Factor, Spec};
use serde::Serialize;

use crate::{closing::value_at_home, number::short};

/// A suspicious number in the spec.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    /// Line of the spec, from 1; `None` if only its name is known.
    pub line: Option<usize>,
    /// Description of the number, with a suggested correction.
    pub message: String,
}

/// Returns the warnings of a spec, in the order of the chain, then of the sources. `text` is the
/// text of its file, if any.
pub(super) fn warnings(spec: &Spec, text: Option<&str>) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut check = |what: String, value: f64, span: Option<Span>| {
        if value.abs() > TAU {
            let line = text.zip(span).and_then(|(text, span)| {
                let before = text.as_bytes().get(..span.start)?;
                Some(1 + before.iter().filter(|byte| **byte == b'\n').count())
            });
            let value = short(value);
            let message =
                format!("{what} is {value} rad, more than one revolution; write `{value}deg` for degrees");
            warnings.push(Warning { line, message });
        }
    };
    let links =
        spec.frames.iter().map(|frame| (format!("an angle of the frame \"{}\"", frame.name), &frame.factors));
    for (what, factors) in links.chain([("an angle of the tool".to_owned(), &spec.tool)]) {
        for angle in factors.iter().filter_map(rotation) {
            let (value, span) = value_without_unit(angle, spec, text);
            check(what.clone(), value, Some(span));
        }
    }
    for source in &spec.sources {
        let what = format!("an angle of the source \"{}\"", source.name);
        let errors = source.effects.iter().flat_map(|effect| match &effect.cause {
            Cause::Errors(errors) => &errors[..],
            Cause::Beam(_) | Cause::Compliance(_) => &[],
        });
        let errors = errors.filter(|(component, _)| motion(*component).0 == Motion::Rotation);
        let errors = errors.map(|(_, error)| error);
        let deviations = source.deviations.iter().filter(|deviation| is_angle(deviation.number, spec));
        for angle in errors.chain(deviations.filter_map(Deviation::error)) {
            let (value, span) = value_without_unit(angle, spec, text);
            check(what.clone(), value, Some(span));
        }
    }
    warnings
}

/// Returns the angle of a rotating factor.
fn rotation(factor: &Factor) -> Option<&Expression> {
    match factor {
        Factor::Elementary(elementary) if elementary.motion == Motion::Rotation => Some(&elementary.amount),
        Factor::About { motion: Motion::Rotation, amount, .. } => Some(amount),
        _ => None,
    }
}

/// Returns true if a number of the chain is an angle.
fn is_angle(number: ChainNumber, spec: &Spec) -> bool {
    match number {
        ChainNumber::Joint(i) => spec.variables[i].kind == VariableKind::Revolute,
        ChainNumber::Parameter(_) => false,
        ChainNumber::DenavitHartenberg { number, .. } => {
            matches!(number, DhNumber::Theta | DhNumber::Alpha)
        }
    }
}

/// Returns the value of an angle at home and its span in the text; the value is 0 for an angle with
/// an explicit unit.
fn value_without_unit(angle: &Expression, spec: &Spec, text: Option<&str>) -> (f64, Span) {
    let source = text.and_then(|text| text.get(angle.span())).unwrap_or_default();
    let has_unit = ["deg", "rad", "arc"].iter().any(|unit| source.contains(unit));
    let has_names = angle.symbols().any(|symbol| matches!(symbol, Symbol::Parameter(_) | Symbol::Input(_)));
    if has_unit && !has_names {
        return (0.0, angle.span());
    }
    let mut graph = Graph::with_tables(&spec.tables);
    let node = graph.lower(angle);
    let value = graph.evaluate(&[node], |symbol| value_at_home(symbol, spec))[0];
    (value, angle.span())
}
