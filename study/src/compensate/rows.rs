//! Row by row.

use abbe::analysis::{ReachError, Target, compensated, inverse, sampling};
use abbe::compensator::{Compensated, norms};
use abbe::identify::{Measurement, Observation};
use abbe::{Description, Error, Manipulator, Variable};
use abbe_codegen::diagnostic::Diagnostics;
use serde::Serialize;

use crate::data::Data;
use crate::mistake;
use crate::number::{Named, length, of_variable};

/// The norms of ΔX.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Norms {
    /// Of the tool point, in the spec's length unit.
    pub length: f64,
    /// Of the orientation, rad.
    pub angle: f64,
}

impl Norms {
    fn new(rows: &[f64; 6]) -> Self {
        let (length, angle) = norms(rows);
        Self { length, angle }
    }
}

/// The corrected commands of a row.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Its line in the file.
    pub line: u64,
    /// By variable, in the spec's length unit and in rad.
    pub q: Named,
    /// With the commands as they were.
    pub before: Norms,
    /// With the corrected ones.
    pub after: Norms,
    /// Why it is not compensated to the tolerance, if so.
    pub reason: Option<String>,
    /// What was asked for, with the corrected commands.
    #[serde(skip)]
    pub corrected: Observation,
}

/// All rows that can be evaluated, for their joints or for the poses that were measured; the others go to the unusable ones.
pub(super) fn rows(
    manipulator: &dyn Manipulator,
    data: &mut Data,
    poses: bool,
    tolerance: f64,
) -> Result<Vec<Row>, Diagnostics> {
    let description = manipulator.description();
    let s = sampling::nominal_parameters(description);
    let mut rows = Vec::new();
    for asked in std::mem::take(&mut data.observations) {
        match row(manipulator, description, &s, &asked, poses) {
            Ok(found) => {
                let reason = reason(description, &found, tolerance);
                let Compensated { q, before, after } = found;
                let names = description.variables.iter().map(|variable| variable.name.to_string());
                rows.push(Row {
                    line: asked.line,
                    q: Named(names.zip(q.clone()).collect()),
                    before: Norms::new(&before),
                    after: Norms::new(&after),
                    reason,
                    corrected: Observation { q, ..asked },
                });
            }
            Err(reason) => data.leave_out(asked.line, &reason),
        }
    }
    if rows.is_empty() {
        let why = data.unusable.first().map(|row| format!(": line {}: {}", row.line, row.reason));
        let message = format!("no row can be compensated{}", why.unwrap_or_default());
        return Err(mistake::whole(&data.file, message));
    }
    Ok(rows)
}

/// A pose is first brought to the ideal tool; with fewer than six joints, its point is.
fn row(
    manipulator: &dyn Manipulator,
    description: &Description,
    s: &[f64],
    asked: &Observation,
    poses: bool,
) -> Result<Compensated<Vec<f64>>, String> {
    let Observation { q, u, measured, .. } = asked;
    let evaluation = |error: Error| evaluation(description, &error);
    let (Measurement::Pose(wanted), true) = (measured, poses) else {
        within_limits(description, q)?;
        return compensated(manipulator, None, q, s, u).map_err(evaluation);
    };
    let all: Vec<usize> = (0..q.len()).collect();
    let target = match q.len() {
        0..6 => Target::Point(wanted.position()),
        _ => Target::Pose(*wanted),
    };
    let ideal =
        inverse(manipulator, s, q, &all, &target).map_err(|reason| unreached(description, &reason))?;
    compensated(manipulator, Some(wanted), &ideal, s, u).map_err(evaluation)
}

/// A command that the machine would refuse is not one to be corrected.
fn within_limits(description: &Description, q: &[f64]) -> Result<(), String> {
    let outside = |(variable, value): &(&Variable, &f64)| {
        let [lower, upper] = variable.limits;
        !(lower..=upper).contains(*value)
    };
    let Some((variable, value)) = description.variables.iter().zip(q).find(outside) else { return Ok(()) };
    let [value, lower, upper] = [*value, variable.limits[0], variable.limits[1]]
        .map(|value| of_variable(value, variable.kind, description.length));
    Err(format!("{} is commanded to {value}, beyond its limits {lower} … {upper}", variable.name))
}

fn evaluation(description: &Description, error: &Error) -> String {
    match error {
        Error::OutOfRange { input, value, range: [lower, upper] } => {
            let input = &description.inputs[*input];
            let shown = crate::number::quantity(*value, &input.unit);
            format!("`{}` is {shown}, outside its range {lower} … {upper}", input.name)
        }
        error => error.to_string(),
    }
}

fn unreached(description: &Description, reason: &ReachError) -> String {
    match reason {
        ReachError::OutsideLimits { variable, value, .. } => {
            let variable = &description.variables[*variable];
            let value = of_variable(*value, variable.kind, description.length);
            format!("not even the ideal tool gets there: {} would have to be {value}", variable.name)
        }
        reason => format!("not even the ideal tool gets there: {reason}"),
    }
}

/// Why a row is not compensated: a joint at its limit, too few joints, or a singularity. With fewer than six joints the tool point is
/// all that is asked for.
fn reason(description: &Description, found: &Compensated<Vec<f64>>, tolerance: f64) -> Option<String> {
    let Description { variables, length: unit, .. } = description;
    let after = Norms::new(&found.after);
    let few = variables.len() < 6;
    if after.length <= tolerance && (few || after.angle <= tolerance * unit.in_metres()) {
        return None;
    }
    let held = variables.iter().zip(&found.q).filter(|(v, q)| v.limits.contains(q));
    let held = held
        .map(|(v, q)| format!("{} at its limit {}", v.name, of_variable(*q, v.kind, *unit)))
        .collect::<Vec<_>>()
        .join(", ");
    let why = if !held.is_empty() {
        held
    } else if few {
        format!("{} joints cannot move it there", variables.len())
    } else {
        "close to a singularity, where a small correction takes a large turn".to_owned()
    };
    Some(match after.length <= tolerance {
        true => format!("{why}; the tool point is there, {:.3e} rad are left", after.angle),
        false => format!("{why}; {} left", length(after.length, *unit)),
    })
}
