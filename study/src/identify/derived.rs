//! Numbers that follow from the order of the rows, or from a pose: inputs that no column has.

use abbe::identify::Observation;
use abbe::{Component, Manipulator, Pose, VariableKind};
use abbe_codegen::expr::Dimension;
use abbe_codegen::spec::{Input, Spec};

use super::candidates::Family;
use super::terms::{Basis, Place, Term};
use crate::data::Data;

/// Such an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// What it is called: a name that no symbol of the spec has.
    pub name: String,
    /// How it follows.
    pub kind: DerivedKind,
}

/// How an input follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DerivedKind {
    /// 1 where a joint came from smaller values in its last move, −1 from larger ones, 0 before it was moved.
    Direction(usize),
    /// 1 where a weight at the origin of a frame, or at the tool point behind the last, turns a joint forward, −1 where back.
    Pull {
        /// The revolute joint.
        variable: usize,
        /// The frame, from 0; as many as there are frames stands for the tool point.
        at: usize,
    },
    /// `exp(−n/N)` in the n-th row; 0 for rows of any other file, which find the machine settled.
    Settling(f64),
    /// From −1 in the first row to 0 in the last, and for rows of any other file.
    Drift,
}

/// After how many rows a machine may have settled.
const SETTLING: [f64; 7] = [5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 320.0];

/// Of the forces on a joint: below this share of the largest there is none.
const NOTHING: f64 = 1e-6;

/// Those that some families need, for rows that move these variables.
pub(super) fn derived(spec: &Spec, families: &[Family], moved: &[usize], rows: usize) -> Vec<Derived> {
    let mut all = Vec::new();
    let mut add = |name: String, kind| {
        let taken = |name: &str| {
            spec.inputs.iter().any(|input| input.name == name)
                || spec.variables.iter().any(|variable| variable.name == name)
                || spec.parameters.iter().any(|parameter| parameter.name == name)
        };
        let names = std::iter::once(name.clone()).chain((2..).map(|i| format!("{name}_{i}")));
        let name = names.into_iter().find(|name| !taken(name)).unwrap_or(name);
        all.push(Derived { name, kind });
    };
    if families.contains(&Family::Backlash) {
        for joint in moved {
            add(format!("{}_direction", spec.variables[*joint].name), DerivedKind::Direction(*joint));
        }
        let turning = moved.iter().filter(|joint| spec.variables[**joint].kind == VariableKind::Revolute);
        for joint in turning {
            for at in spec.variables[*joint].frame..=spec.frames.len() {
                let name = format!("{}_pull_{}", spec.variables[*joint].name, at + 1);
                add(name, DerivedKind::Pull { variable: *joint, at });
            }
        }
    }
    if families.contains(&Family::Drift) {
        // What settles later than in half of the rows is a drift.
        for after in SETTLING.into_iter().filter(|after| *after <= rows as f64 / 2.0) {
            add(format!("settling_{after}"), DerivedKind::Settling(after));
        }
        add("drift".to_owned(), DerivedKind::Drift);
    }
    all
}

/// The spec with these inputs behind its own.
pub(super) fn with_inputs(spec: &Spec, derived: &[Derived]) -> Spec {
    let input = |one: &Derived| Input {
        name: one.name.clone(),
        value: 0.0,
        dimension: Dimension::NONE,
        unit: String::new(),
        range: [-1.0, 1.0],
        description: one.description(spec),
    };
    Spec { inputs: spec.inputs.iter().cloned().chain(derived.iter().map(input)).collect(), ..spec.clone() }
}

/// The same rows with these inputs; `fitted` are those that the machine is identified by.
pub(super) fn with_columns(
    manipulator: &dyn Manipulator,
    spec: &Spec,
    derived: &[Derived],
    data: &Data,
    fitted: bool,
) -> Data {
    let mut data = data.clone();
    let count = data.observations.len();
    // In the order of time, if it is known.
    let mut order: Vec<usize> = (0..count).collect();
    let time = |i: usize| data.observations[i].time;
    if (0..count).all(|i| time(i).is_some()) {
        order.sort_by(|a, b| time(*a).unwrap_or_default().total_cmp(&time(*b).unwrap_or_default()));
    }
    let rows: Vec<&Observation> = order.iter().map(|i| &data.observations[*i]).collect();
    let columns: Vec<Vec<f64>> = derived
        .iter()
        .map(|one| match one.kind {
            DerivedKind::Direction(variable) => directions(&rows, variable),
            DerivedKind::Pull { variable, at } => pulls(manipulator, spec, &rows, variable, at),
            DerivedKind::Settling(_) | DerivedKind::Drift if !fitted => vec![0.0; count],
            DerivedKind::Settling(after) => (0..count).map(|n| (-(n as f64) / after).exp()).collect(),
            DerivedKind::Drift => (0..count).map(|n| (n + 1) as f64 / count.max(1) as f64 - 1.0).collect(),
        })
        .collect();
    for (n, i) in order.into_iter().enumerate() {
        data.observations[i].u.extend(columns.iter().map(|column| column[n]));
    }
    data
}

/// The sign of the last move of a joint, row by row.
fn directions(rows: &[&Observation], variable: usize) -> Vec<f64> {
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

/// The sign of the moment `z · (p − o) × g` of a weight at p about a joint's axis z through o, nominally; 0 where a
/// row cannot be evaluated, or where there is no moment worth its sign.
fn pulls(
    manipulator: &dyn Manipulator,
    spec: &Spec,
    rows: &[&Observation],
    variable: usize,
    at: usize,
) -> Vec<f64> {
    let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    let down = gravity(spec);
    let frame = spec.variables[variable].frame;
    let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
    // A turn of the joint moves the point by `z × (p − o)`: a difference of poses says the same for all kinds of frames.
    const STEP: f64 = 1e-4;
    let mut height = |row: &Observation, by: f64| {
        let mut q = row.q.clone();
        q[variable] += by;
        manipulator.transforms(&q, &s, &mut transforms).ok()?;
        let place = transforms[..=at].iter().fold(Pose::IDENTITY, |before, one| before.then(one)).position();
        Some((0..3).map(|k| place[k] * down[k]).sum::<f64>())
    };
    debug_assert!(at >= frame);
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

/// The direction of gravity: against z of `F_0` if the spec does not say.
fn gravity(spec: &Spec) -> [f64; 3] {
    let stated = spec.gravity.as_ref().map(|entries| {
        let value = |i: usize| entries[i].constant().unwrap_or_default();
        let length = (0..3).map(|i| value(i).powi(2)).sum::<f64>().sqrt();
        std::array::from_fn(|i| if length > 0.0 { value(i) / length } else { 0.0 })
    });
    stated.unwrap_or([0.0, 0.0, -1.0])
}

impl Derived {
    /// What it is, in one sentence.
    pub fn description(&self, spec: &Spec) -> String {
        match self.kind {
            DerivedKind::Direction(variable) => {
                let name = &spec.variables[variable].name;
                format!("1 where the last move of {name} was forward, -1 where it was back")
            }
            DerivedKind::Pull { variable, at } => {
                let (name, place) = (&spec.variables[variable].name, place(spec, at));
                format!("1 where a weight at {place} turns {name} forward, -1 where it turns it back")
            }
            DerivedKind::Settling(after) => format!("exp(-n/{after}) in the n-th row of the file"),
            DerivedKind::Drift => "From -1 in the first row of the file to 0 in the last".to_owned(),
        }
    }

    /// Whether it says something of the machine, and not of the rows of a file.
    pub fn is_of_the_machine(&self) -> bool {
        matches!(self.kind, DerivedKind::Direction(_) | DerivedKind::Pull { .. })
    }

    /// The groups of terms that it is the basis of.
    pub(super) fn groups(&self, spec: &Spec, input: usize) -> Vec<Vec<Term>> {
        let group = |place| vec![Term { place, basis: Basis::Input(input) }];
        match self.kind {
            DerivedKind::Direction(variable) | DerivedKind::Pull { variable, .. } => {
                vec![group(Place::Joint(variable))]
            }
            DerivedKind::Settling(_) | DerivedKind::Drift => {
                let frames = 0..spec.frames.len();
                let frames = frames.flat_map(|frame| Component::ALL.map(|c| Place::Frame(frame, c)));
                frames.map(group).collect()
            }
        }
    }
}

fn place(spec: &Spec, at: usize) -> String {
    spec.frames.get(at).map_or("the tool point".to_owned(), |frame| format!("the origin of {}", frame.name))
}
