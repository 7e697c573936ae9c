//! What is measured at every check: the same numbers at the same configurations, in the frame `F_0`.

use abbe::identify::{Measurement, Model, Observation, Station, Unknown};
use abbe::{Manipulator, Pose, VariableKind};
use abbe_codegen::diagnostic::Diagnostics;

use super::checks::{Check, Checks};
use super::single_errors::product;
use crate::data::{Base, Map};
use crate::identify::{Setup, check_readings};
use crate::{Notes, mistake};

/// Joints within this of each other, in rad or as a share of the arm's length, are one configuration.
const SAME: f64 = 1e-3;

/// Measured minus model at every check, and how the model moves.
pub(super) struct Numbers {
    /// Whether the instrument stays where it is from check to check; else its place is unknown at each.
    pub(super) fixed_station: bool,
    /// How many configurations every check has.
    pub(super) configurations: usize,
    /// Check by check: measured minus model, in units of the instrument's uncertainty; the station taken off.
    pub(super) checks: Vec<Vec<f64>>,
    /// How many more configurations single checks have, which are not used.
    pub(super) left_out: usize,
    /// By unknown: what a unit of it does to every number.
    columns: Vec<Vec<f64>>,
    /// By configuration and unknown: how the tool point moves.
    moves: Vec<Vec<[f64; 3]>>,
    /// Orthonormal: what an unknown station does to the numbers.
    station: Vec<Vec<f64>>,
}

/// The visits of one check to every configuration.
type Visits = Vec<Vec<Observation>>;

impl Numbers {
    pub(super) fn new<'a>(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        checks: &Checks,
        notes: &mut dyn Notes,
    ) -> Result<(Self, Model<'a>), Diagnostics> {
        let mut places: Vec<Observation> = Vec::new();
        let mut visits: Vec<Visits> = Vec::new();
        let mut model = None;
        for (i, check) in checks.list.iter().enumerate() {
            let setup = Setup::new(manipulator, map, &check.data, 0)?;
            if i == 0 {
                check_readings(&setup, map, &check.data)?;
            }
            one_station(check, map)?;
            visits.push(sorted(check, &setup, &mut places));
            let real = Model { stations: vec![Station::at(Pose::IDENTITY)], ..setup.real };
            let unknowns = real.constants(setup.pose);
            model.get_or_insert_with(|| real.with(unknowns));
            notes.progress(i + 1, checks.list.len());
            notes.go_on()?;
        }
        let Some(model) = model else {
            return Err(mistake::with_help(
                "abbe monitor",
                "there is no check",
                "give the files of the checks",
            ));
        };
        let common: Vec<usize> =
            (0..places.len()).filter(|place| visits.iter().all(|check| has(check, *place))).collect();
        if common.is_empty() {
            return Err(nothing_in_common(checks, &visits));
        }
        let fixed_station = map.base == Base::Exact;
        let mut numbers = Self {
            fixed_station,
            configurations: common.len(),
            checks: Vec::new(),
            left_out: places.len() - common.len(),
            columns: vec![Vec::new(); model.unknowns.len()],
            moves: Vec::new(),
            station: Vec::new(),
        };
        for (i, (check, visits)) in checks.list.iter().zip(&visits).enumerate() {
            let measured = numbers.measured(&model, visits, &common, i == 0);
            numbers.checks.push(measured.map_err(|failure| mistake::whole(&check.data.file, &failure))?);
        }
        if !fixed_station {
            let unknowns = model.unknowns.iter().enumerate();
            let base = unknowns.filter(|(_, unknown)| matches!(unknown, Unknown::Base(..)));
            numbers.station = orthonormal(base.map(|(k, _)| numbers.columns[k].clone()));
        }
        let all = std::mem::take(&mut numbers.checks);
        numbers.checks = all.into_iter().map(|check| numbers.without_station(check)).collect();
        Ok((numbers, model))
    }

    /// The means over the visits; of the first check how everything moves, too.
    fn measured(
        &mut self,
        model: &Model,
        visits: &Visits,
        common: &[usize],
        first: bool,
    ) -> Result<Vec<f64>, abbe::identify::Failure> {
        let (mut room, x) = (model.room(), vec![0.0; model.unknowns.len()]);
        let mut all = Vec::new();
        for place in common {
            let mut mean: Vec<f64> = Vec::new();
            let share = 1.0 / visits[*place].len() as f64;
            for (i, visit) in visits[*place].iter().enumerate() {
                let rows = model.linearized(&mut room, visit, &x)?;
                mean.resize(rows.len(), 0.0);
                mean.iter_mut().zip(&rows).for_each(|(mean, (difference, _))| *mean += share * difference);
                if first && i == 0 {
                    for (k, column) in self.columns.iter_mut().enumerate() {
                        column.extend(rows.iter().map(|(_, derivatives)| derivatives[k]));
                    }
                    self.moves.push(model.tool(&mut room, visit, &x)?.1);
                }
            }
            all.extend(mean);
        }
        Ok(all)
    }

    /// What a sum of unknowns, each with its factor, does to every number.
    pub(super) fn column(&self, parts: &[(usize, f64)]) -> Vec<f64> {
        let mut sum = vec![0.0; self.columns.first().map_or(0, Vec::len)];
        for (k, factor) in parts {
            sum.iter_mut().zip(&self.columns[*k]).for_each(|(sum, value)| *sum += factor * value);
        }
        sum
    }

    /// How far it moves the tool point at most.
    pub(super) fn effect(&self, parts: &[(usize, f64)]) -> f64 {
        let moved = self.moves.iter().map(|moves| {
            let along = |axis: usize| parts.iter().map(|(k, factor)| factor * moves[*k][axis]).sum::<f64>();
            [0, 1, 2].map(along).iter().map(|v| v * v).sum::<f64>().sqrt()
        });
        moved.fold(0.0, f64::max)
    }

    /// Numbers without what an unknown station does to them.
    pub(super) fn without_station(&self, mut numbers: Vec<f64>) -> Vec<f64> {
        // Twice, for the sake of rounding.
        for direction in self.station.iter().chain(&self.station) {
            let along = product(direction, &numbers);
            numbers.iter_mut().zip(direction).for_each(|(number, unit)| *number -= along * unit);
        }
        numbers
    }

    /// How many numbers of a check are left when the station is known.
    pub(super) fn free(&self) -> usize {
        self.checks.first().map_or(0, Vec::len) - self.station.len()
    }
}

/// A station whose place is unknown is taken off as one: a check has only one of these.
fn one_station(check: &Check, map: &Map) -> Result<(), Diagnostics> {
    let rows = &check.data.observations;
    let first = rows.first().map(|row| row.station);
    if map.base == Base::Exact || rows.iter().all(|row| Some(row.station) == first) {
        return Ok(());
    }
    let help =
        "make a check of every station: a file for each, or say `base = \"exact\"` if all are known exactly";
    Err(mistake::with_help(
        &check.data.file,
        "the rows of one check were measured from several stations",
        help,
    ))
}

/// The rows of a check by configuration, in the frame `F_0`; new configurations come behind. Rows with hidden targets do not count.
fn sorted(check: &Check, setup: &Setup, places: &mut Vec<Observation>) -> Visits {
    let mut visits: Visits = vec![Vec::new(); places.len()];
    for row in &check.data.observations {
        let to_base = setup.real.stations[row.station as usize].pose.inverse();
        let whole = |points: &[Option<[f64; 3]>]| points.iter().all(Option::is_some);
        let measured = match &row.measured {
            Measurement::Points(points) if !whole(points) => continue,
            Measurement::Points(points) => Measurement::Points(
                points.iter().map(|point| point.map(|point| to_base.apply(point))).collect(),
            ),
            Measurement::Pose(pose) => Measurement::Pose(Box::new(to_base.then(pose))),
            // Fixtures stand in F_0.
            Measurement::Readings(readings) if readings.iter().any(Option::is_none) => continue,
            readings @ Measurement::Readings(_) => readings.clone(),
        };
        let row = Observation { measured, station: 0, ..row.clone() };
        let place = places.iter().position(|place| same(place, &row, setup)).unwrap_or_else(|| {
            places.push(row.clone());
            places.len() - 1
        });
        visits.resize(places.len(), Vec::new());
        visits[place].push(row);
    }
    visits
}

/// Inputs do not count: what they do is in the model.
fn same(a: &Observation, b: &Observation, setup: &Setup) -> bool {
    let mut variables = setup.description.variables.iter().zip(a.q.iter().zip(b.q.iter()));
    variables.all(|(variable, (a, b))| {
        let unit = if variable.kind == VariableKind::Revolute { 1.0 } else { setup.arm };
        (a - b).abs() <= SAME * unit
    })
}

fn has(visits: &Visits, place: usize) -> bool {
    visits.get(place).is_some_and(|rows| !rows.is_empty())
}

/// The check that shares fewest configurations with the first is to blame.
fn nothing_in_common(checks: &Checks, visits: &[Visits]) -> Diagnostics {
    let shared = |check: &Visits| {
        (0..visits[0].len()).filter(|place| has(check, *place) && has(&visits[0], *place)).count()
    };
    let least = checks.list.iter().zip(visits).min_by_key(|(_, visits)| shared(visits));
    let (check, shared) = least.map_or((&checks.list[0], 0), |(check, visits)| (check, shared(visits)));
    let message = format!(
        "no configuration is in all checks: the one of {} has {shared} of those of the first, all targets seen",
        checks.calendar.show(check.time)
    );
    let help = "every check visits the same few configurations (joints within 1 mrad): leave this file out, or begin with another";
    mistake::with_help(&check.data.file, message, help)
}

/// Gram and Schmidt; what adds nothing new is left out.
fn orthonormal(columns: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let length = product(&column, &column).sqrt();
        let mut rest = column;
        for direction in basis.iter().chain(&basis) {
            let along = product(direction, &rest);
            rest.iter_mut().zip(direction).for_each(|(value, unit)| *value -= along * unit);
        }
        let new = product(&rest, &rest).sqrt();
        if new > 1e-9 * length {
            basis.push(rest.into_iter().map(|value| value / new).collect());
        }
    }
    basis
}
