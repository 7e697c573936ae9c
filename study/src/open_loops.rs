//! Words about loops that do not close: which one, how far it is open, and where the path from home
//! ended.

use abbe::{Description, Error, Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::{Diagnostics, Spec, mistake};

use crate::{Closing, number};

/// Number of halvings that find where the path ends.
const HALVINGS: i32 = 20;

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
    let mut free = spec.clone();
    free.passive.iter_mut().for_each(|variable| variable.limits = [f64::NEG_INFINITY, f64::INFINITY]);
    let machine = Interpreter::new(free);
    let mut closing = Closing::new(spec, &home, &nominal);
    let mut passive = closing.home();
    let along = |from: &[f64], to: &[f64], share: f64| -> Vec<f64> {
        from.iter().zip(to).map(|(from, to)| from + share * (to - from)).collect()
    };
    let closes = |share: f64, passive: &mut [f64]| {
        machine.passive(&along(&home, q, share), &along(&nominal, s, share), passive).is_ok()
    };
    if !closes(0.0, &mut passive) {
        let nearest = closing.nearest(&closing.home());
        return Some(match closing.closes(&nearest) {
            true => "at home the passive joints can move by themselves, or close the loops only far away"
                .to_owned(),
            false => format!("the loops do not close at home: {}", open_loop(spec, &closing, &nearest)),
        });
    }
    if let Some(share) = path_end(|share| closes(share, &mut passive)) {
        closes(share, &mut passive);
        let end = number::variables(&along(&home, q, share), spec);
        (closing.q, closing.s) = (q.to_vec(), s.to_vec());
        let nearest = closing.nearest(&passive);
        let why = match closing.closes(&nearest) {
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

/// Returns the share of the way from home at which the path ends; `None` if it does not.
pub(crate) fn path_end(mut closes: impl FnMut(f64) -> bool) -> Option<f64> {
    if closes(1.0) {
        return None;
    }
    let halvings = (1..=HALVINGS).map(|halving| 0.5_f64.powi(halving));
    Some(halvings.fold(0.0, |share, part| if closes(share + part) { share + part } else { share }))
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
