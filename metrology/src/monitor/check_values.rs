//! Measurements of every check: the same quantities at the same configurations, in the frame `F_0`.
//!
//! Measured points of the first and the last check, minus the predicted ones.

use abbe::identify::{Failure, Model, Station, Unknown};
use abbe::{Manipulator, Pose};
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::{About, Notes, Residual, Residuals, Result, calibration::random_sources, mistake};

use super::checks::{Check, Checks};
use super::configurations::{Configurations, Visits};
use super::vectors::{norm, product};
use crate::data::{Base, Map};
use crate::identify::{Setup, check_interpretation, check_plausibility};

/// Measured minus predicted values of every check, and their derivatives.
pub(super) struct CheckValues {
    /// Is true if the instrument stays in place between checks; otherwise its pose is unknown at
    /// each check.
    pub(super) fixed_station: bool,
    /// Number of configurations common to all checks.
    pub(super) configurations: usize,
    /// Measured minus predicted values per check, in units of the instrument's uncertainty, without
    /// the component that an unknown station can explain.
    pub(super) checks: Vec<Vec<f64>>,
    /// Residuals of the first and the last check; none for instruments that measure no points.
    pub(super) residuals: Option<Residuals>,
    /// Number of configurations that are not in all checks and therefore unused.
    pub(super) left_out: usize,
    /// Mean variance of a value by the instrument and the random sources of the spec, in units of
    /// the instrument's.
    pub(super) expected: f64,
    /// Derivative of every value by unknown.
    columns: Vec<Vec<f64>>,
    /// Derivative of the tool point by configuration and unknown.
    moves: Vec<Vec<[f64; 3]>>,
    /// Orthonormal basis of the values that an unknown station can explain.
    station: Vec<Vec<f64>>,
}

impl CheckValues {
    pub(super) fn new<'a>(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        checks: &Checks,
        notes: &mut dyn Notes,
    ) -> Result<(Self, Model<'a>)> {
        let random = random_sources(manipulator.description());
        let (mut known, mut visits) = (None, Vec::new());
        let mut model = None;
        for (i, check) in checks.list.iter().enumerate() {
            let setup = Setup::new(manipulator, map, &check.data, 0)?;
            if i == 0 {
                check_interpretation(&setup, map, &check.data)?;
                let mut near = Setup::new(manipulator, map, &check.data, 0)?;
                near.come_near(&check.data).about(&check.data.file)?;
                check_plausibility(&near, map, &check.data, notes).about(&check.data.file)?;
            }
            one_station(check, map)?;
            let known = known.get_or_insert_with(|| Configurations::new(&setup));
            visits.push(Visits::new(check, &setup, known)?);
            let real = Model { stations: vec![Station::at(Pose::IDENTITY)], ..setup.real };
            let mut unknowns = real.constants(setup.pose);
            unknowns.extend(random.iter().map(|(source, _)| Unknown::Magnitude(*source)));
            model.get_or_insert_with(|| real.with(unknowns));
            notes.progress(i + 1, checks.list.len());
            notes.go_on()?;
        }
        let Some(model) = model else {
            let help = "give the files of the checks";
            return Err(mistake::with_help("abbe monitor", "no check is given", help));
        };
        let count = known.map_or(0, |known: Configurations| known.len());
        let mut of_checks = vec![0; count];
        for check in &visits {
            let counts = check.counts(count).into_iter().zip(&mut of_checks);
            counts.for_each(|(rows, all)| *all += u32::from(rows > 0));
        }
        // Index of each configuration among those that are in all checks.
        let mut numbers = 0..;
        let in_all = |checks: &u32| *checks as usize == visits.len();
        let common: Vec<Option<usize>> =
            of_checks.iter().map(|checks| in_all(checks).then(|| numbers.next()).flatten()).collect();
        let configurations = common.iter().flatten().count();
        if configurations == 0 {
            return Err(nothing_in_common(checks, &visits, count));
        }
        let fixed_station = map.base == Base::Exact;
        let mut numbers = Self {
            fixed_station,
            configurations,
            residuals: None,
            checks: Vec::new(),
            left_out: count - configurations,
            expected: 1.0,
            columns: vec![Vec::new(); model.unknowns.len()],
            moves: Vec::new(),
            station: Vec::new(),
        };
        for (i, visits) in visits.iter().enumerate() {
            notes.progress(i, checks.list.len());
            notes.go_on()?;
            let measured = numbers.measured(&model, visits, &common, i == 0);
            numbers.checks.push(measured.about(&visits.check.data.file)?);
        }
        if let (None, [first, ..], [.., last]) = (map.instruments(), &visits[..], &visits[..]) {
            let names = [first, last].map(|visits| checks.calendar.show(visits.check.time));
            let found = residuals(&model, [first, last], &common, [&names[0], &names[1]]);
            numbers.residuals = found.about(&last.check.data.file)?;
        }
        notes.progress(checks.list.len(), checks.list.len());
        if !fixed_station {
            let unknowns = model.unknowns.iter().enumerate();
            let base = unknowns.filter(|(_, unknown)| matches!(unknown, Unknown::Base(..)));
            numbers.station = orthonormal(base.map(|(k, _)| numbers.columns[k].clone()));
        }
        let of_sources = numbers.columns[model.unknowns.len() - random.len()..].iter().zip(&random);
        let squares = of_sources.map(|(column, (_, variance))| {
            let column = numbers.without_station(column.clone());
            variance * product(&column, &column)
        });
        numbers.expected += squares.sum::<f64>() / numbers.free().max(1) as f64;
        let all = std::mem::take(&mut numbers.checks);
        numbers.checks = all.into_iter().map(|check| numbers.without_station(check)).collect();
        Ok((numbers, model))
    }

    /// Returns the mean values over the visits of each configuration. The first check also adds the
    /// derivatives.
    fn measured(
        &mut self,
        model: &Model,
        visits: &Visits,
        common: &[Option<usize>],
        first: bool,
    ) -> Result<Vec<f64>, abbe::identify::Failure> {
        let mut at = model.at(&vec![0.0; model.unknowns.len()]);
        let counts = visits.counts(common.len());
        let mut means: Vec<f64> = Vec::new();
        // The first check numbers its configurations in this order.
        let mut next = 0;
        for (row, configuration) in visits.rows() {
            let Some(number) = common[configuration] else { continue };
            let row = visits.in_f0(row);
            let is_new = first && number == next;
            let numbers = if is_new {
                let (numbers, moves) = at.linearized(&row)?.into_iter().unzip();
                let moves: Vec<Vec<f64>> = moves;
                for (k, column) in self.columns.iter_mut().enumerate() {
                    column.extend(moves.iter().map(|derivatives| derivatives[k]));
                }
                self.moves.push(at.tool(&row)?.1);
                next += 1;
                numbers
            } else {
                at.differences(&row)?
            };
            means.resize(self.configurations * numbers.len(), 0.0);
            let share = 1.0 / f64::from(counts[configuration]);
            let own = means[number * numbers.len()..].iter_mut();
            own.zip(numbers).for_each(|(mean, difference)| *mean += share * difference);
        }
        Ok(means)
    }

    /// Returns the derivative of every value by a linear combination of unknowns.
    pub(super) fn column(&self, parts: &[(usize, f64)]) -> Vec<f64> {
        let mut sum = vec![0.0; self.columns.first().map_or(0, Vec::len)];
        for (k, factor) in parts {
            sum.iter_mut().zip(&self.columns[*k]).for_each(|(sum, value)| *sum += factor * value);
        }
        sum
    }

    /// Returns the largest displacement of the tool point per unit of the combination, in the
    /// length unit.
    pub(super) fn effect(&self, parts: &[(usize, f64)]) -> f64 {
        let moved = self.moves.iter().map(|moves| {
            let along = |axis: usize| parts.iter().map(|(k, factor)| factor * moves[*k][axis]).sum::<f64>();
            [0, 1, 2].map(along).iter().map(|v| v * v).sum::<f64>().sqrt()
        });
        moved.fold(0.0, f64::max)
    }

    /// Removes the component that an unknown station can explain.
    pub(super) fn without_station(&self, numbers: Vec<f64>) -> Vec<f64> {
        beside(&self.station, numbers)
    }

    /// Returns the number of independent values per check once the station is known.
    pub(super) fn free(&self) -> usize {
        self.checks.first().map_or(0, Vec::len) - self.station.len()
    }
}

/// Returns an error if a check has several stations and their poses are unknown.
fn one_station(check: &Check, map: &Map) -> Result<()> {
    let rows = &check.data.observations;
    let first = rows.first().map(|row| row.station);
    if map.base == Base::Exact || rows.iter().all(|row| Some(row.station) == first) {
        return Ok(());
    }
    let help = "use one file for each station, or write `base = \"exact\"` if all stations are known \
         exactly";
    let message = "the rows of one check were measured from several stations";
    Err(mistake::with_help(&check.data.file, message, help))
}

/// Returns an error that names the check with the fewest configurations in common with the first.
fn nothing_in_common(checks: &Checks, visits: &[Visits], count: usize) -> Diagnostics {
    let first = visits[0].counts(count);
    let shared = |check: &Visits| {
        let both = check.counts(count).into_iter().zip(&first);
        both.filter(|(here, at_first)| *here > 0 && **at_first > 0).count()
    };
    let least = checks.list.iter().zip(visits).min_by_key(|(_, visits)| shared(visits));
    let (check, shared) = least.map_or((&checks.list[0], 0), |(check, visits)| (check, shared(visits)));
    let message = format!(
        "no configuration is common to all checks: the check {} has {shared} configurations in \
         common with the first, with all targets measured",
        checks.calendar.show(check.time)
    );
    let help = "use the same few configurations in every check (joints within 1 mrad): leave this \
        file out, or begin with another";
    mistake::with_help(&check.data.file, message, help)
}

/// Removes the component along the directions of an orthonormal basis.
fn beside(basis: &[Vec<f64>], mut numbers: Vec<f64>) -> Vec<f64> {
    // A second pass reduces the rounding error.
    for direction in basis.iter().chain(basis) {
        let along = product(direction, &numbers);
        numbers.iter_mut().zip(direction).for_each(|(number, unit)| *number -= along * unit);
    }
    numbers
}

/// Orthonormalizes the columns by Gram-Schmidt; dependent columns are left out.
fn orthonormal(columns: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let length = norm(&column);
        let rest = beside(&basis, column);
        let new = norm(&rest);
        if new > 1e-9 * length {
            basis.push(rest.into_iter().map(|value| value / new).collect());
        }
    }
    basis
}

/// Returns the mean errors of each configuration and target that all checks have, in `F_0`.
/// `common` is the number of each configuration among them; `names` are those of both checks.
pub(super) fn residuals(
    model: &Model,
    [first, last]: [&Visits; 2],
    common: &[Option<usize>],
    names: [&str; 2],
) -> Result<Option<Residuals>, Failure> {
    let (before, mut rows) = (means(model, first, common)?, means(model, last, common)?);
    let is_first = std::ptr::eq(first, last);
    for (row, before) in rows.iter_mut().zip(before) {
        row.before = (!is_first).then_some(before.after);
    }
    Ok(Residuals::new((!is_first).then_some(names[0]), names[1], &rows, Residual::clone))
}

/// Returns the mean errors in one check, as errors `after`.
fn means(model: &Model, visits: &Visits, common: &[Option<usize>]) -> Result<Vec<Residual>, Failure> {
    let mut at = model.at(&vec![0.0; model.unknowns.len()]);
    let counts = visits.counts(common.len());
    let mut means: Vec<Vec<Residual>> = vec![Vec::new(); common.iter().flatten().count()];
    for (row, configuration) in visits.rows() {
        let Some(number) = common[configuration] else { continue };
        let row = visits.in_f0(row);
        let deviations = at.deviations(&row)?;
        let mean = &mut means[number];
        if mean.is_empty() {
            mean.resize(deviations.len(), Residual::new(&row, &row.q, at.pose(&row)?.position(), [0.0; 3]));
        }
        // Deviations are predicted minus measured.
        let share = -1.0 / f64::from(counts[configuration]);
        for (mean, deviation) in mean.iter_mut().zip(deviations) {
            mean.after = std::array::from_fn(|axis| mean.after[axis] + share * deviation[axis]);
        }
    }
    Ok(means.concat())
}
