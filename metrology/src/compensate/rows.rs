//! Compensation of the rows of a data file.
//!
//! Measured poses expressed in `F_0`.
//!
//! Reasons for incomplete compensation, in words.
//!
//! Compensation of single commands, without a data file.

use std::{convert::Infallible, ops::ControlFlow};

use abbe::analysis::{
    Goal, Missing, Obstacle, ReachError, Target, compensated, in_order_until, inverse, mobility, obstacle,
    sampling,
};
use abbe::compensator::{Compensated, norms};
use abbe::identify::{Measurement, Observation};
use abbe::{Description, Error, Manipulator, Pose, Variable, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::number::{Named, beyond_sum_limit, length, of_variable};
use abbe_study::{About, Notes, Residual, Result, mistake};
use serde::Serialize;

use crate::data::{Data, Map, Unusable};

/// Norms of ΔX.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ErrorNorms {
    /// Norm of the tool point's error, in the spec's length unit.
    pub length: f64,
    /// Norm of the orientation error, in rad.
    pub angle: f64,
}

impl ErrorNorms {
    fn new(rows: &[f64; 6]) -> Self {
        let (length, angle) = norms(rows);
        Self { length, angle }
    }
}

/// Corrected command of a row.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Line in the file, from 1.
    pub line: u64,
    /// Corrected value of each variable, in the spec's length unit or rad.
    pub q: Named,
    /// Error with the original command.
    pub before: ErrorNorms,
    /// Error with the corrected command.
    pub after: ErrorNorms,
    /// Reason why the remaining error exceeds the tolerance; `None` if it does not.
    pub reason: Option<String>,
    /// Largest rotation of a joint, in rad: from its command, or with poses from the ideal joints
    /// for that pose.
    pub largest_turn: f64,
    /// Corrected − original value of each variable, in the length unit or rad.
    #[serde(skip)]
    pub changes: Vec<f64>,
    /// Position errors at the ideal joints of its target.
    #[serde(skip)]
    pub residual: Residual,
    /// Original row, with the corrected joints.
    #[serde(skip)]
    pub corrected: Observation,
}

/// Compensation task that is common to all rows.
pub(super) struct Task<'a> {
    manipulator: &'a dyn Manipulator,
    description: &'a Description,
    s: Vec<f64>,
    /// Targets the measured poses instead of the joints.
    poses: bool,
    /// Permitted remaining error, in the length unit.
    tolerance: f64,
    /// Length that weighs as much as 1 rad, in the length unit; `None` gives the position priority.
    weight: Option<f64>,
    /// Number of independent tool motions, from 0 to 6.
    pub(super) mobility: usize,
}

/// A corrected row, with the reason for incomplete compensation.
struct Corrected {
    found: Compensated<Vec<f64>>,
    /// Joints at which the ideal machine reaches the target.
    start: Vec<f64>,
    reason: Option<String>,
    largest_turn: f64,
}

impl<'a> Task<'a> {
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        poses: bool,
        tolerance: f64,
        weight: Option<f64>,
    ) -> Result<Self> {
        let description = manipulator.description();
        let s = sampling::nominal_parameters(description);
        let mobility = mobility(manipulator, &s).about(&description.name)?;
        Ok(Self { manipulator, description, s, poses, tolerance, weight, mobility })
    }

    /// Corrects one command. Also returns the reason for incomplete compensation.
    pub(super) fn correct(
        &self,
        q: &[f64],
        u: &[f64],
    ) -> Result<(Compensated<Vec<f64>>, Option<String>), String> {
        within_limits(self.description, q)?;
        let corrected = corrected(self, None, q, u)?;
        Ok((corrected.found, corrected.reason))
    }
}

/// Number of rows that one thread takes at a time.
const BLOCK: usize = 64;

/// Corrects all rows in file order. `take` receives each corrected row, or the reason why it cannot
/// be evaluated.
pub(super) fn correct_all<E: From<Diagnostics>>(
    task: &Task<'_>,
    data: &Data,
    base_frame: &BaseFramePoses,
    notes: &mut dyn Notes,
    mut take: impl FnMut(Result<Row, Unusable>) -> Result<(), E>,
) -> Result<(), E> {
    let observations = &data.observations;
    let blocks: Vec<&[Observation]> = observations.chunks(BLOCK).collect();
    // A failure of `take`, or an interruption, ends the remaining blocks.
    let (mut done, mut failed) = (0, None);
    let made = |block: usize| {
        let rows =
            blocks[block].iter().map(|observation| correct_row(task, base_frame.row(observation.clone())));
        Ok::<Vec<_>, Infallible>(rows.collect())
    };
    let taken = |rows: Vec<Result<Row, Unusable>>| {
        notes.progress(done, observations.len());
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
    notes.progress(observations.len(), observations.len());
    failed.map_or(Ok(()), Err)
}

fn correct_row(task: &Task<'_>, observation: Observation) -> Result<Row, Unusable> {
    let Corrected { found, start, reason, largest_turn } = correct_observation(task, &observation)
        .map_err(|reason| Unusable { line: observation.line, reason })?;
    let Compensated { q, before, after, .. } = found;
    let point = task.manipulator.pose(&start, &task.s).map_err(|error| Unusable {
        line: observation.line,
        reason: evaluation_message(task.description, &error),
    })?;
    let position = |rows: &[f64; 6]| [rows[0], rows[1], rows[2]];
    let residual = Residual::new(&observation, &start, point.position(), position(&after));
    let names = task.description.variables.iter().map(|variable| variable.name.to_string());
    Ok(Row {
        line: observation.line,
        changes: q
            .iter()
            .zip(observation.q.iter())
            .map(|(corrected, original)| corrected - original)
            .collect(),
        q: Named(names.zip(q.clone()).collect()),
        before: ErrorNorms::new(&before),
        after: ErrorNorms::new(&after),
        reason,
        largest_turn,
        residual: Residual { before: Some(position(&before)), ..residual },
        corrected: Observation { q: q.into(), ..observation },
    })
}

/// Returns the diagnostic for data of which no row could be compensated.
pub(super) fn no_row_compensated(data: &Data, unusable: &[Unusable]) -> Diagnostics {
    let why = unusable.first().map(|row| format!(": {}: {}", data.place(row.line), row.reason));
    let message = format!("no row can be compensated{}", why.unwrap_or_default());
    mistake::with_help(&data.file, message, "check the units of the map and the limits of the joints")
}

/// Corrects one row. For a pose, first solves the ideal chain for it; with fewer than six
/// independent motions, for its tool point.
fn correct_observation(task: &Task<'_>, observation: &Observation) -> Result<Corrected, String> {
    let Task { manipulator, description, ref s, .. } = *task;
    let Observation { q, u, measured, .. } = observation;
    let (target, start) = match (measured, task.poses) {
        (Measurement::Pose(wanted), true) => {
            let all: Vec<usize> = (0..q.len()).collect();
            let target = match task.mobility {
                0..6 => Target::Point(wanted.position()),
                _ => Target::Pose(**wanted),
            };
            let ideal = inverse(manipulator, s, q, &all, &target);
            (Some(&**wanted), ideal.map_err(|reason| unreachable_message(description, &reason))?)
        }
        _ => {
            within_limits(description, q)?;
            (None, q.to_vec())
        }
    };
    corrected(task, target, &start, u)
}

fn corrected(task: &Task<'_>, target: Option<&Pose>, start: &[f64], u: &[f64]) -> Result<Corrected, String> {
    let Task { manipulator, description, s, tolerance, weight, mobility, .. } = task;
    let failed = |error| evaluation_message(description, &error);
    let goal = Goal { target, weight: *weight };
    let found = compensated(*manipulator, goal, start, s, u).map_err(failed)?;
    sums_within_limits(description, &found.q)?;
    // With fewer than six independent motions only the tool point is a target.
    let angle = if *mobility < 6 { f64::INFINITY } else { tolerance * description.length.in_metres() };
    let obstacle = obstacle(*manipulator, goal, start, s, u, &found, [*tolerance, angle]).map_err(failed)?;
    let variables = description.variables.iter().zip(start.iter().zip(&found.q));
    let turns = variables.filter(|(variable, _)| variable.kind == VariableKind::Revolute);
    let largest_turn = turns.map(|(_, (from, to))| (to - from).abs()).fold(0.0, f64::max);
    let reason = obstacle.map(|obstacle| reason(description, &found.q, &obstacle));
    Ok(Corrected { found, start: start.to_vec(), reason, largest_turn })
}

/// Checks that a command is within the joint limits, which the machine would enforce.
fn within_limits(description: &Description, q: &[f64]) -> Result<(), String> {
    let outside = |(variable, value): &(&Variable, &f64)| {
        let [lower, upper] = variable.limits;
        !(lower..=upper).contains(*value)
    };
    let Some((variable, value)) = description.variables.iter().zip(q).find(outside) else {
        return sums_within_limits(description, q);
    };
    let [value, lower, upper] = [*value, variable.limits[0], variable.limits[1]]
        .map(|value| of_variable(value, variable.kind, description.length));
    Err(format!("{} is commanded to {value}, beyond its limits {lower} … {upper}", variable.name))
}

/// Checks the limits of sums of joints.
fn sums_within_limits(description: &Description, q: &[f64]) -> Result<(), String> {
    let Some(limit) = description.sum_limits.iter().find(|limit| !limit.permits(q)) else { return Ok(()) };
    Err(format!("the command has {}", beyond_sum_limit(limit, limit.value(q), description.length)))
}

fn evaluation_message(description: &Description, error: &Error) -> String {
    match error {
        Error::OutOfRange { input, value, range: [lower, upper] } => {
            let input = &description.inputs[*input];
            let shown = abbe_study::number::quantity(*value, &input.unit);
            format!("`{}` is {shown}, outside its range {lower} … {upper}", input.name)
        }
        error => error.to_string(),
    }
}

fn unreachable_message(description: &Description, reason: &ReachError) -> String {
    match reason {
        ReachError::OutsideLimits { variable, value, .. } => {
            let variable = &description.variables[*variable];
            let value = of_variable(*value, variable.kind, description.length);
            format!("unreachable for the ideal tool: needs {} = {value}", variable.name)
        }
        ReachError::OutOfReach { residual, turn } => {
            let away = length(*residual, description.length);
            let turned = if *turn > 0.0 {
                format!(" and {} turned", of_variable(*turn, VariableKind::Revolute, description.length))
            } else {
                String::new()
            };
            format!("unreachable for the ideal tool: out of reach by {away}{turned}")
        }
        ReachError::OutsideSumLimit { limit, value } => {
            let beyond = beyond_sum_limit(&description.sum_limits[*limit], *value, description.length);
            format!("unreachable for the ideal tool: needs {beyond}")
        }
        reason => format!("unreachable for the ideal tool: {reason}"),
    }
}

/// Converts measured poses to poses of the tool in `F_0`: removes the station and the mounting of
/// the target.
pub(super) struct BaseFramePoses {
    stations: Vec<Pose>,
    mountings: Vec<Pose>,
}

impl BaseFramePoses {
    pub(super) fn new(map: &Map, data: &Data) -> Self {
        let names: Vec<&str> =
            (0..data.stations.len().max(1)).map(|i| data.stations.get(i).map_or("", |name| name)).collect();
        let stands = |name: &&str| map.stations.pose(name).unwrap_or(Pose::IDENTITY).inverse();
        Self {
            stations: names.iter().map(stands).collect(),
            mountings: names.iter().map(|name| map.mounting_at(name).inverse()).collect(),
        }
    }

    pub(super) fn row(&self, mut row: Observation) -> Observation {
        if let Measurement::Pose(pose) = &mut row.measured {
            let station = row.station as usize;
            **pose = self.stations[station].then(pose).then(&self.mountings[station]);
        }
        row
    }
}

/// Describes the obstacle: joints at their limits, or a direction that no joint moves; and the
/// remaining error.
pub(super) fn reason(description: &Description, q: &[f64], obstacle: &Obstacle) -> String {
    let Description { variables, length: unit, .. } = description;
    let axis = obstacle.axis.map(|share| format!("{:.2}", share + 0.0)).join(", ");
    let held = obstacle.limits.iter().map(|j| {
        let value = of_variable(q[*j], variables[*j].kind, *unit);
        format!("{} is at its limit {value}", variables[*j].name)
    });
    let held = held.collect::<Vec<_>>().join(" and ");
    let why = match (obstacle.limits.len(), obstacle.immobile, obstacle.missing) {
        (1.., _, _) => format!("{held} and would have to exceed it"),
        (0, true, Missing::Point(_)) => format!("no joint moves the tool point along ({axis}) there"),
        (0, true, Missing::Turn(_)) => {
            format!("no joint rotates the tool about ({axis}) there with its point fixed")
        }
        (0, false, _) => "no better solution was found near the command".to_owned(),
    };
    match obstacle.missing {
        Missing::Turn(turn) => {
            format!("{why}; the tool point is reached, {turn:.3e} rad of the orientation error remain")
        }
        Missing::Point(distance) => format!("{why}; {} left", length(distance, *unit)),
    }
}

/// Corrects commands of a machine.
pub struct CommandCorrector<'a>(Task<'a>);

/// A corrected command.
#[derive(Clone, Debug)]
pub struct CorrectedCommand {
    /// Joint variables, within their limits, in the length unit or rad.
    pub q: Vec<f64>,
    /// Remaining error ΔX: rows 1–3 in the length unit, rows 4–6 in rad.
    pub remaining: [f64; 6],
    /// Reason why the remaining error exceeds the tolerance; `None` if it does not.
    pub reason: Option<String>,
}

impl<'a> CommandCorrector<'a> {
    /// Creates a corrector for a machine. `tolerance` is the permitted error of the tool point in
    /// the length unit; for angles 1 rad counts as 1 m. `weight` is the length that weighs as much
    /// as 1 rad where both cannot be reached; `None` gives the position priority.
    pub fn new(manipulator: &'a dyn Manipulator, tolerance: f64, weight: Option<f64>) -> Result<Self> {
        Task::new(manipulator, false, tolerance, weight).map(Self)
    }

    /// Returns the command that brings the real tool to the pose of the ideal tool at `q`, with the
    /// inputs `u`.
    ///
    /// # Errors
    ///
    /// Returns the reason if the command exceeds a joint limit or cannot be evaluated.
    pub fn correct(&self, q: &[f64], u: &[f64]) -> Result<CorrectedCommand, String> {
        self.0.correct(q, u).map(|(found, reason)| CorrectedCommand {
            q: found.q,
            remaining: found.after,
            reason,
        })
    }
}
