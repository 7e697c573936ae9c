//! Inputs that are computed from the rows: from their order, or from the pose of the machine.

use abbe::{Manipulator, Pose, identify::Observation, tool_pose};
use abbe_spec::{Spec, edit::TableText, edit::write::quoted};

/// Rule by which an input is computed from the rows. Its value is −1, 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FromRows {
    /// Direction of the last move of a joint: 1 forward, −1 backward, 0 before the first move.
    Approach(usize),
    /// Sign of the moment of a weight about a joint: 1 forward, −1 backward.
    GravityMoment {
        /// Index of the revolute joint.
        variable: usize,
        /// Frame whose origin has the weight, from 0; the number of frames stands for the tool
        /// point.
        at: usize,
    },
}

/// Relative threshold of a moment, as a share of the largest.
const NOTHING: f64 = 1e-6;

impl FromRows {
    /// Describes the rule in one sentence.
    pub fn description(&self, spec: &Spec) -> String {
        match *self {
            Self::Approach(variable) => {
                let name = &spec.variables[variable].name;
                format!("1 if the last motion of {name} was forward, -1 if backward")
            }
            Self::GravityMoment { variable, at } => {
                let name = &spec.variables[variable].name;
                let frame = spec.frames.get(at).map(|frame| format!("the origin of {}", frame.name));
                let place = frame.unwrap_or_else(|| "the tool point".to_owned());
                format!("1 if a weight at {place} turns {name} forward, -1 if backward")
            }
        }
    }

    /// Returns the keys of its entry in `[inputs]` of a map.
    pub(crate) fn keys(&self, spec: &Spec) -> TableText {
        let keys = TableText::default();
        match *self {
            Self::Approach(variable) => keys.text("approach", &spec.variables[variable].name),
            Self::GravityMoment { variable, at } => keys
                .text("gravity_moment", &spec.variables[variable].name)
                .optional("frame", spec.frames.get(at).map(|frame| quoted(&frame.name))),
        }
    }

    /// Computes the values in rows that are in order of time.
    pub(crate) fn values(&self, machine: &dyn Manipulator, spec: &Spec, rows: &[&Observation]) -> Vec<f64> {
        match *self {
            Self::Approach(variable) => approaches(rows, variable),
            Self::GravityMoment { variable, at } => moments(machine, spec, rows, variable, at),
        }
    }
}

/// Returns the indices of rows in order of time, if all have one; otherwise in their own order.
pub(crate) fn in_order(rows: &[Observation]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    if rows.iter().all(|row| row.time().is_some()) {
        let time = |i: usize| rows[i].time().unwrap_or_default();
        order.sort_by(|a, b| time(*a).total_cmp(&time(*b)));
    }
    order
}

/// Returns the rows in this order, each after the row that its readings refer to, if there is one.
pub(crate) fn with_references<'o>(rows: &'o [Observation], order: &[usize]) -> Vec<&'o Observation> {
    let with_reference = |i: &usize| rows[*i].from().into_iter().chain([&rows[*i]]);
    order.iter().flat_map(with_reference).collect()
}

/// Calls `change` with the row that the readings of a row refer to, if there is one, then with the
/// row itself.
pub(crate) fn change_with_reference(row: &mut Observation, mut change: impl FnMut(&mut Observation)) {
    if let Some(from) = row.approach.as_mut().and_then(|approach| approach.from.as_deref_mut()) {
        change(from);
    }
    change(row);
}

/// Sets an input of the rows of [`with_references`] to these values.
pub(crate) fn set_input(rows: &mut [Observation], order: &[usize], input: usize, values: Vec<f64>) {
    let mut values = values.into_iter();
    let mut set = |row: &mut Observation| {
        if let (Some(own), Some(value)) = (row.u.get_mut(input), values.next()) {
            *own = value;
        }
    };
    order.iter().for_each(|i| change_with_reference(&mut rows[*i], &mut set));
}

/// Returns the sign of the last move of a joint, row by row.
fn approaches(rows: &[&Observation], variable: usize) -> Vec<f64> {
    let mut last = 0.0;
    let mut before = rows.first().map_or(0.0, |row| row.q[variable]);
    let direction = |row: &&Observation| {
        let moved = row.q[variable] - before;
        if moved.abs() > 1e-9 * (1.0 + before.abs()) {
            last = moved.signum();
        }
        before = row.q[variable];
        last
    };
    rows.iter().map(direction).collect()
}

/// Returns the sign of the moment `z · (p − o) × g` of a weight at p about the nominal axis z
/// through o; 0 where a row cannot be evaluated or the moment is negligible.
fn moments(
    manipulator: &dyn Manipulator,
    spec: &Spec,
    rows: &[&Observation],
    variable: usize,
    at: usize,
) -> Vec<f64> {
    let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    let down = gravity(spec);
    let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
    // A rotation of the joint moves the point by `z × (p − o)`; a difference of poses gives it for
    // all kinds of frames.
    const STEP: f64 = 1e-4;
    let mut height = |row: &Observation, by: f64| {
        let mut q = row.q.to_vec();
        q[variable] += by;
        manipulator.transforms(&q, &s, &mut transforms).ok()?;
        let description = manipulator.description();
        let place = match at < spec.frames.len() {
            true => description.frame_pose(&transforms, Some(at)),
            false => tool_pose(description, &transforms, &[]),
        };
        let place = place.position();
        Some((0..3).map(|k| place[k] * down[k]).sum::<f64>())
    };
    debug_assert!(at >= spec.variables[variable].frame, "the joint moves what is behind it");
    let moments: Vec<f64> = rows
        .iter()
        .map(|&row| match (height(row, STEP), height(row, -STEP)) {
            (Some(ahead), Some(behind)) => (ahead - behind) / (2.0 * STEP),
            _ => 0.0,
        })
        .collect();
    let largest = moments.iter().fold(0.0_f64, |largest, moment| largest.max(moment.abs()));
    let least = (NOTHING * largest).max(1e-9);
    moments.iter().map(|moment| if moment.abs() > least { moment.signum() } else { 0.0 }).collect()
}

/// Returns the unit direction of gravity; against z of `F_0` by default.
fn gravity(spec: &Spec) -> [f64; 3] {
    let stated = spec.gravity.as_ref().map(|entries| {
        let value = |i: usize| entries[i].constant().unwrap_or_default();
        let length = (0..3).map(|i| value(i).powi(2)).sum::<f64>().sqrt();
        std::array::from_fn(|i| if length > 0.0 { value(i) / length } else { 0.0 })
    });
    stated.unwrap_or([0.0, 0.0, -1.0])
}
