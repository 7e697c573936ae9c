//! Words about loops that do not close: which one, how far it is open, and where the path from home
//! ended.

use abbe::{Description, Error, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::{Spec, mistake};

use crate::closing::Closing;
use crate::number;

/// Smallest step of the share of the path.
const SMALLEST: f64 = 1e-6;

/// Largest change of the passive variables in a step, in rad or arm lengths.
const FARTHEST: f64 = 0.1;

/// Largest equation of loops that close, without a unit.
const CLOSED: f64 = 1e-10;

/// Returns the diagnostics of a configuration, described by `at`, that could not be evaluated. Of
/// loops that do not close they say more than the error does.
pub fn not_evaluated(
    origin: &str,
    at: &str,
    error: &Error,
    description: &Description,
    (spec, q, s): (&Spec, &[f64], &[f64]),
) -> Diagnostics {
    let further = error.is_open().then(|| open_loops(spec, q, s)).flatten();
    match further {
        Some(further) => mistake::with_help(
            origin,
            format!("at {at}: {further}"),
            "leave this configuration out, or correct the lengths of the loops or the home of the passive joints",
        ),
        None => mistake::not_evaluated(origin, at, error, description),
    }
}

/// Returns a sentence about the loops at a configuration; `None` if they close in the mode of home.
pub fn open_loops(spec: &Spec, q: &[f64], s: &[f64]) -> Option<String> {
    let home: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
    let nominal: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    if spec.loops.is_empty() || q.len() != home.len() || s.len() != nominal.len() {
        return None;
    }
    let mut closing = Closing::new(spec, &home, &nominal);
    let mut passive = closing.nearest(&closing.home());
    if !is_closed(&closing, &passive) {
        return Some(format!("the loops do not close at home: {}", open_loop(spec, &closing, &passive)));
    }
    let along = |from: &[f64], to: &[f64], share: f64| -> Vec<f64> {
        from.iter().zip(to).map(|(from, to)| from + share * (to - from)).collect()
    };
    let (mut share, mut step) = (0.0_f64, 0.25_f64);
    while share < 1.0 && step > SMALLEST {
        let next = (share + step).min(1.0);
        (closing.q, closing.s) = (along(&home, q, next), along(&nominal, s, next));
        match closed_from(&closing, &passive) {
            Some(found) => (passive, share, step) = (found, next, 1.5 * step),
            None => step /= 2.0,
        }
    }
    if share < 1.0 {
        let end = number::variables(&along(&home, q, share), spec);
        (closing.q, closing.s) = (q.to_vec(), s.to_vec());
        let nearest = closing.nearest(&passive);
        let why = match is_closed(&closing, &nearest) {
            true => "the loops close in another mode only".to_owned(),
            false => format!("the loops do not close: {}", open_loop(spec, &closing, &nearest)),
        };
        return Some(format!(
            "{why}; the path from home ends after {:.0} % of the way, at {end}",
            100.0 * share
        ));
    }
    let outside = spec.passive.iter().zip(&passive).find(|(variable, value)| {
        let [lower, upper] = variable.limits;
        !(lower..=upper).contains(*value)
    });
    outside.map(|(variable, value)| {
        let show = |value| number::of_variable(value, variable.kind, spec.length);
        let [lower, upper] = variable.limits.map(show);
        format!(
            "the passive joint {} is at {}, outside its limits {lower} … {upper}",
            variable.name,
            show(*value)
        )
    })
}

/// Returns the passive variables in the mode of those given, which are near; `None` without them.
fn closed_from(closing: &Closing<'_>, from: &[f64]) -> Option<Vec<f64>> {
    let sign = closing.derivatives(from).determinant().signum();
    let (mut passive, mut moved) = (from.to_vec(), 0.0);
    for _ in 0..8 {
        let (step, size) = closing.step(&passive)?;
        passive.iter_mut().zip(&step).for_each(|(value, step)| *value -= step);
        moved += size;
        let is_near = moved < FARTHEST;
        if !is_near {
            return None;
        }
    }
    let is_same = closing.derivatives(&passive).determinant().signum() == sign;
    (is_same && is_closed(closing, &passive)).then_some(passive)
}

fn is_closed(closing: &Closing<'_>, passive: &[f64]) -> bool {
    closing.size(passive) <= CLOSED
}

/// Names the loop that is farthest open, and says how far.
fn open_loop(spec: &Spec, closing: &Closing<'_>, passive: &[f64]) -> String {
    let (scaled, given) = (closing.scaled(passive), closing.residual(passive));
    let (mut farthest, mut text, mut first) = (-1.0, String::new(), 0);
    for closed in &spec.loops {
        let rows = first..first + closed.closure.equations();
        first = rows.end;
        let size = scaled.rows(rows.start, rows.len()).norm();
        if size > farthest {
            let norm = |is_angle: bool| {
                let own = rows.clone().filter(|row| closed.closure.is_angle(row - rows.start) == is_angle);
                own.map(|row| given[row].abs()).reduce(f64::hypot).filter(|gap| *gap > 0.0)
            };
            let gaps = [(false, VariableKind::Prismatic), (true, VariableKind::Revolute)];
            let gaps = gaps
                .into_iter()
                .filter_map(|(is_angle, kind)| Some(number::of_variable(norm(is_angle)?, kind, spec.length)));
            text =
                format!("loop \"{}\" stays open by {}", closed.name, gaps.collect::<Vec<_>>().join(" and "));
            farthest = size;
        }
    }
    text
}
