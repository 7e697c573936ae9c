//! Inputs that are computed from the row order or from a pose instead of being read from a column.

use std::borrow::Cow;

use abbe::{Component, Manipulator, VariableKind, identify::Observation};
use abbe_spec::{Input, Spec, edit::write::free_name, expr::Dimension};

use super::{Basis, ErrorSite, Family, Term};
use crate::data::{
    Channel, Data, FromRows, Map, change_with_reference, in_order, set_input, with_references,
};

/// Derived input.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// Name, different from every symbol of the spec.
    pub name: String,
    /// Rule that computes its values.
    pub kind: DerivedKind,
}

/// Rule that computes the values of a derived input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DerivedKind {
    /// Rule that applies to the rows of any file. A map can contain it.
    FromRows(FromRows),
    /// `exp(−n/N)` in the n-th row of the fitted data, with N given. It is 0 for rows of any other
    /// file, where the machine counts as settled.
    Settling(f64),
    /// Linear from −1 in the first row of the fitted data to 0 in the last; 0 for rows of any other
    /// file.
    Drift,
}

/// Time constants that are tried for settling, in rows.
const SETTLING: [f64; 7] = [5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 320.0];

/// Returns the inputs that the families need in addition to those of the map, for these rows of the
/// fit.
///
/// With several stations there is none for drift: along the file, time and station cannot be
/// distinguished.
pub(super) fn derived(spec: &Spec, map: &Map, families: &[Family], data: &Data) -> Vec<Derived> {
    let rows = data.observations.len();
    let moved: Vec<usize> = map.moved().collect();
    let mut all = Vec::new();
    let mut add = |name: String, kind| {
        let taken = |name: &str| {
            spec.inputs.iter().any(|input| input.name == name)
                || spec.variables.iter().any(|variable| variable.name == name)
                || spec.parameters.iter().any(|parameter| parameter.name == name)
        };
        all.push(Derived { name: free_name(&name, |i| format!("{name}_{i}"), taken), kind });
    };
    if families.contains(&Family::Backlash) {
        let mut add = |name: String, follows: FromRows| {
            let has = |channel: &Channel| matches!(channel, Channel::FromRows(has) if *has == follows);
            if !map.inputs.iter().any(has) {
                add(name, DerivedKind::FromRows(follows));
            }
        };
        for joint in &moved {
            add(format!("{}_direction", spec.variables[*joint].name), FromRows::Approach(*joint));
        }
        let turning = moved.iter().filter(|joint| spec.variables[**joint].kind == VariableKind::Revolute);
        for joint in turning {
            for at in spec.variables[*joint].frame..=spec.frames.len() {
                let name = format!("{}_pull_{}", spec.variables[*joint].name, at + 1);
                add(name, FromRows::GravityMoment { variable: *joint, at });
            }
        }
    }
    if families.contains(&Family::Drift) && has_one_station(data) {
        // A time constant longer than half of the rows cannot be distinguished from a drift.
        for after in SETTLING.into_iter().filter(|after| *after <= rows as f64 / 2.0) {
            add(format!("settling_{after}"), DerivedKind::Settling(after));
        }
        add("drift".to_owned(), DerivedKind::Drift);
    }
    all
}

/// Returns true if all rows were measured at the same station.
pub(super) fn has_one_station(data: &Data) -> bool {
    data.observations.windows(2).all(|pair| pair[0].station == pair[1].station)
}

/// Returns the spec with the derived inputs after its own.
pub(super) fn with_inputs(spec: &Spec, derived: &[Derived]) -> Spec {
    let input = |one: &Derived| Input {
        name: one.name.clone(),
        value: 0.0,
        dimension: Dimension::NONE,
        unit: String::new(),
        range: [-1.0, 1.0],
        levels: Vec::new(),
        uncertainty: 0.0,
        description: one.description(spec),
        line: 0,
    };
    Spec { inputs: spec.inputs.iter().cloned().chain(derived.iter().map(input)).collect(), ..spec.clone() }
}

/// Returns the rows with the values of the derived inputs. `fitted` is true for the rows used for
/// the fit.
pub(super) fn with_columns<'d>(
    manipulator: &dyn Manipulator,
    spec: &Spec,
    derived: &[Derived],
    data: Cow<'d, Data>,
    fitted: bool,
) -> Cow<'d, Data> {
    if derived.is_empty() {
        return data;
    }
    let mut data = data.into_owned();
    let count = data.observations.len();
    let order = in_order(&data.observations);
    let declared = spec.inputs.len() - derived.len();
    let with_zeros = |row: &mut Observation| {
        row.u = row.u.iter().copied().chain(derived.iter().map(|_| 0.0)).collect::<Vec<f64>>().into();
    };
    data.observations.iter_mut().for_each(|row| change_with_reference(row, with_zeros));
    // One column at a time, so that a million rows need memory for one column only.
    for (k, one) in derived.iter().enumerate() {
        // The row that another refers to is the one before it.
        let by_number = |value: &dyn Fn(f64) -> f64| {
            let of_row = |(n, i): (usize, &usize)| {
                let from = data.observations[*i].from().map(|_| value(n.saturating_sub(1) as f64));
                from.into_iter().chain([value(n as f64)])
            };
            order.iter().enumerate().flat_map(of_row).collect::<Vec<f64>>()
        };
        let values = match one.kind {
            DerivedKind::FromRows(follows) => {
                follows.values(manipulator, spec, &with_references(&data.observations, &order))
            }
            DerivedKind::Settling(_) | DerivedKind::Drift if !fitted => continue,
            DerivedKind::Settling(after) => by_number(&|n| (-n / after).exp()),
            DerivedKind::Drift => by_number(&|n| (n + 1.0) / count.max(1) as f64 - 1.0),
        };
        set_input(&mut data.observations, &order, declared + k, values);
    }
    Cow::Owned(data)
}

impl Derived {
    /// Returns a description in one sentence.
    pub fn description(&self, spec: &Spec) -> String {
        match self.kind {
            DerivedKind::FromRows(follows) => follows.description(spec),
            DerivedKind::Settling(after) => format!("exp(-n/{after}) in the n-th row of the file"),
            DerivedKind::Drift => "From -1 in the first row of the file to 0 in the last".to_owned(),
        }
    }

    /// Returns the rule that computes the input from the rows of any file; none for rules that hold
    /// for one file only.
    pub fn from_rows(&self) -> Option<FromRows> {
        match self.kind {
            DerivedKind::FromRows(follows) => Some(follows),
            DerivedKind::Settling(_) | DerivedKind::Drift => None,
        }
    }

    /// Returns the groups of terms that have this input as their basis.
    pub(super) fn groups(&self, spec: &Spec, input: usize) -> Vec<Vec<Term>> {
        let group = |site| vec![Term { site, basis: Basis::Input(input) }];
        match self.kind {
            DerivedKind::FromRows(
                FromRows::Approach(variable) | FromRows::GravityMoment { variable, .. },
            ) => vec![group(ErrorSite::Joint(variable))],
            DerivedKind::Settling(_) | DerivedKind::Drift => {
                let frames = 0..spec.frames.len();
                let frames = frames.flat_map(|frame| Component::ALL.map(|c| ErrorSite::Frame(frame, c)));
                frames.map(group).collect()
            }
        }
    }
}
