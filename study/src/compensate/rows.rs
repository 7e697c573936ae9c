//! Row by row.

use std::convert::Infallible;
use std::ops::ControlFlow;

use abbe::analysis::{
    ReachError, Target, compensated, in_order_until, inverse, mobility, obstacle, sampling,
};
use abbe::compensator::{Compensated, norms};
use abbe::identify::{Measurement, Observation};
use abbe::{Description, Error, Manipulator, Pose, Variable, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use super::in_f0::InF0;
use super::reason::reason;
use crate::data::{Data, Unusable};
use crate::number::{Named, length, of_variable};
use crate::{Notes, mistake};

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
#[derive(Clone, Debug, Serialize)]
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
    /// How far the joint that turns most is turned from the command (with poses: from where the ideal tool is there), rad.
    pub largest_turn: f64,
    /// By variable: corrected minus what the row has; the length unit, or rad.
    #[serde(skip)]
    pub changes: Vec<f64>,
    /// What was asked for, with the corrected commands.
    #[serde(skip)]
    pub corrected: Observation,
}

/// What is asked of every row.
pub(super) struct Task<'a> {
    manipulator: &'a dyn Manipulator,
    description: &'a Description,
    s: Vec<f64>,
    /// Whether poses are asked for, not joints.
    poses: bool,
    /// What may be left, in the length unit.
    tolerance: f64,
    /// In how many ways the machine can move its tool.
    pub(super) mobility: usize,
}

/// A corrected row, and why it does not arrive.
struct Corrected {
    found: Compensated<Vec<f64>>,
    reason: Option<String>,
    largest_turn: f64,
}

impl<'a> Task<'a> {
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        poses: bool,
        tolerance: f64,
    ) -> Result<Self, Diagnostics> {
        let description = manipulator.description();
        let s = sampling::nominal_parameters(description);
        let mobility = mobility(manipulator, &s);
        let mobility = mobility.map_err(|error| mistake::whole(&description.name, &error))?;
        Ok(Self { manipulator, description, s, poses, tolerance, mobility })
    }

    /// One command for the joints, and why it does not arrive.
    pub(super) fn correct(
        &self,
        q: &[f64],
        u: &[f64],
    ) -> Result<(Compensated<Vec<f64>>, Option<String>), String> {
        within_limits(self.description, q)?;
        let corrected = corrected(self, None, q, u).map_err(|error| evaluation(self.description, &error))?;
        Ok((corrected.found, corrected.reason))
    }
}

/// Rows that one thread takes at a time.
const BLOCK: usize = 64;

/// Every row that can be evaluated, for its joints or for the pose that was measured; or why it cannot.
pub(super) fn rows<E: From<Diagnostics>>(
    task: &Task<'_>,
    data: &Data,
    in_f0: &InF0,
    notes: &mut dyn Notes,
    mut take: impl FnMut(Result<Row, Unusable>) -> Result<(), E>,
) -> Result<(), E> {
    let asked = &data.observations;
    let blocks: Vec<&[Observation]> = asked.chunks(BLOCK).collect();
    // A failure of `take`, and a stop, end the blocks as one of their own does.
    let (mut done, mut failed) = (0, None);
    let made = |block: usize| {
        let rows = blocks[block].iter().map(|asked| one(task, in_f0.row(asked.clone())));
        Ok::<Vec<_>, Infallible>(rows.collect())
    };
    let taken = |rows: Vec<Result<Row, Unusable>>| {
        notes.progress(done, asked.len());
        done += rows.len();
        let all = notes.go_on().map_err(E::from);
        match all.and_then(|()| rows.into_iter().try_for_each(&mut take)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failed = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    let Ok(()) = in_order_until(blocks.len(), made, taken);
    notes.progress(asked.len(), asked.len());
    failed.map_or(Ok(()), Err)
}

fn one(task: &Task<'_>, asked: Observation) -> Result<Row, Unusable> {
    let Corrected { found, reason, largest_turn } =
        row(task, &asked).map_err(|reason| Unusable { line: asked.line, reason })?;
    let Compensated { q, before, after, .. } = found;
    let names = task.description.variables.iter().map(|variable| variable.name.to_string());
    Ok(Row {
        line: asked.line,
        changes: q.iter().zip(asked.q.iter()).map(|(corrected, asked)| corrected - asked).collect(),
        q: Named(names.zip(q.clone()).collect()),
        before: Norms::new(&before),
        after: Norms::new(&after),
        reason,
        largest_turn,
        corrected: Observation { q: q.into(), ..asked },
    })
}

/// No row could be compensated.
pub(super) fn nothing(data: &Data, unusable: &[Unusable]) -> Diagnostics {
    let why = unusable.first().map(|row| format!(": {}: {}", data.place(row.line), row.reason));
    let message = format!("no row can be compensated{}", why.unwrap_or_default());
    mistake::with_help(&data.file, message, "are the units of the map and the limits of the joints right?")
}

/// A pose is first brought to the ideal tool; of a machine that moves it in fewer than six ways, its point is.
fn row(task: &Task<'_>, asked: &Observation) -> Result<Corrected, String> {
    let Task { manipulator, description, ref s, .. } = *task;
    let Observation { q, u, measured, .. } = asked;
    let (target, start) = match (measured, task.poses) {
        (Measurement::Pose(wanted), true) => {
            let all: Vec<usize> = (0..q.len()).collect();
            let target = match task.mobility {
                0..6 => Target::Point(wanted.position()),
                _ => Target::Pose(**wanted),
            };
            let ideal = inverse(manipulator, s, q, &all, &target);
            (Some(&**wanted), ideal.map_err(|reason| unreached(description, &reason))?)
        }
        _ => {
            within_limits(description, q)?;
            (None, q.to_vec())
        }
    };
    corrected(task, target, &start, u).map_err(|error| evaluation(description, &error))
}

fn corrected(task: &Task<'_>, target: Option<&Pose>, start: &[f64], u: &[f64]) -> Result<Corrected, Error> {
    let Task { manipulator, description, s, tolerance, mobility, .. } = task;
    let found = compensated(*manipulator, target, start, s, u)?;
    // Of a machine that moves its tool in fewer than six ways the tool point is all that is asked for.
    let angle = if *mobility < 6 { f64::INFINITY } else { tolerance * description.length.in_metres() };
    let obstacle = obstacle(*manipulator, target, start, s, u, &found, [*tolerance, angle])?;
    let variables = description.variables.iter().zip(start.iter().zip(&found.q));
    let turns = variables.filter(|(variable, _)| variable.kind == VariableKind::Revolute);
    let largest_turn = turns.map(|(_, (from, to))| (to - from).abs()).fold(0.0, f64::max);
    let reason = obstacle.map(|obstacle| reason(description, &found.q, &obstacle));
    Ok(Corrected { found, reason, largest_turn })
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
        ReachError::OutOfReach { residual, turn } => {
            let away = length(*residual, description.length);
            let turned = if *turn > 0.0 {
                format!(" and {} turned", of_variable(*turn, VariableKind::Revolute, description.length))
            } else {
                String::new()
            };
            format!("not even the ideal tool gets there: out of reach, at best {away} away{turned}")
        }
        reason => format!("not even the ideal tool gets there: {reason}"),
    }
}
