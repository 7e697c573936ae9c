//! Joint profiles: errors of joints as functions of their own values, by up to 64 cycles per turn,
//! such as the transmission errors of gears and encoders.
//!
//! [`find`] fits them beside the constants and terms of a fit, and keeps them if a paired test on
//! the folds of the cross-validation shows that they reduce the error of held-out rows.
//! [`FoundProfiles::refit`] then fits the machine that has the profiles as tables: it is the one
//! that is reported and written.

use std::time::Instant;

use abbe::identify::{
    Comparison, Distances, Failure, Folds, Observation, ProfileBasis, ProfileJoint, Profiles, Unknown,
    fit_profiles,
};
use abbe_interpreter::Interpreter;
use abbe_spec::expr::{Expression, Symbol};
use abbe_spec::{ChainNumber, Deviation, DeviationCause, Source, Spec, Variable};

use super::as_joint_errors::number_terms;
use super::profile_table::{ProfileTable, table_name};
use super::{ErrorSite, Family, FitInput, JointProfile, JointProfiles, Setup, Solved, solve};
use abbe_study::{About, Notes, Result, mistake, number::digits};

/// Significance level of the paired test.
const CHANCE: f64 = 0.01;

/// Cycles per turn of the highest harmonic, and twice its cycles over a travel.
const HIGHEST: f64 = ProfileBasis::CYCLES as f64;

/// Rows at which the standard deviation of the tool point is evaluated.
const SAMPLES: usize = 500;

/// Profiles that a paired test has shown to reduce the error of held-out rows.
pub(super) struct FoundProfiles {
    fitted: Profiles,
    comparison: Comparison,
    joints: Vec<JointProfile>,
}

/// Fits profiles if `families` include them. Notes say why there are none, and which joints do not
/// move enough. Refuses displacements if the user named the family instead of trying all.
pub(super) fn find_profiles(
    families: &[Family],
    input: &FitInput,
    fitted: (&Setup, &Solved),
    notes: &mut dyn Notes,
) -> Result<(Option<FoundProfiles>, Vec<String>)> {
    let data = input.data;
    if !families.contains(&Family::Profile) {
        return Ok((None, Vec::new()));
    }
    let is_named = !Family::ALL.iter().all(|family| families.contains(family));
    let is_displaced = data.observations.iter().any(|row| row.from().is_some());
    if is_displaced && is_named {
        let message = "profiles of joints cannot be fitted to displacements between rows";
        let help = "leave out `profile`, or read the instrument as an `indicator` with its zero";
        return Err(mistake::with_help(&data.file, message, help));
    }
    let (offered, mut why) = joints(input.spec, fitted.0, &data.observations);
    let found = match find(input, fitted.1, &offered, notes)? {
        Ok(found) => Some(found),
        Err(reason) => {
            why.push(format!("note: no profiles of joints: {reason}"));
            None
        }
    };
    Ok((found, why))
}

/// Fits profiles of these joints. Returns the reason if none are kept.
///
/// The manipulator of the setup ends with the [`number_terms`] of `spec`.
fn find(
    input: &FitInput,
    solved: &Solved,
    offered: &[ProfileJoint],
    notes: &mut dyn Notes,
) -> Result<Result<FoundProfiles, String>> {
    let FitInput { spec, data, settings, .. } = *input;
    let rows = &data.observations;
    if offered.is_empty() {
        return Ok(Err("no joint moves enough".to_owned()));
    }
    if rows.iter().any(|row| row.from().is_some()) {
        return Ok(Err("the rows are displacements".to_owned()));
    }
    let start = Instant::now();
    let stops = &*notes;
    let mut proceed = || !stops.stop() && settings.time.is_none_or(|time| start.elapsed() < time);
    let folds = Folds::new(rows, settings.folds);
    let fitted = fit_profiles(&solved.model, rows, &solved.fit, offered, &folds, &mut proceed);
    let fitted = fitted.about(&data.file)?;
    let on_time = proceed();
    notes.go_on()?;
    let reason = match on_time {
        true => "they do not reduce the cross-validation error enough",
        false => "the time limit was reached",
    };
    let Some(fitted) = fitted else { return Ok(Err(reason.to_owned())) };
    let comparison = fitted.cross_validated.compared_with(&solved.cross_validated);
    if comparison.gain <= 0.0 || comparison.p > CHANCE {
        let reason = format!(
            "the reduction of the cross-validation error is not significant (p {})",
            digits(comparison.p, 2)
        );
        return Ok(Err(reason));
    }
    let joints = fitted.profiles.iter().filter_map(|profile| {
        let (variable, range) = (profile.joint.variable, profile.joint.range);
        let values: Vec<f64> = rows.iter().map(|row| row.q[variable]).collect();
        let rms = |value: &dyn Fn(f64) -> f64| {
            let squares: f64 = values.iter().map(|q| value(*q).powi(2)).sum();
            (squares / values.len().max(1) as f64).sqrt()
        };
        let deviation = rms(&|q| profile.deviation(q));
        Some(JointProfile {
            joint: spec.variables[variable].name.clone(),
            unit: match profile.joint.basis {
                ProfileBasis::Turn => "rad",
                ProfileBasis::Travel(_) => spec.length.symbol(),
            },
            range,
            rms: rms(&|q| profile.value(q)),
            standard_deviation: deviation,
            without: profile.without / fitted.after,
            variable,
            table: ProfileTable::new(profile, &values, deviation, spec.length)?,
        })
    });
    Ok(Ok(FoundProfiles { joints: joints.collect(), comparison, fitted }))
}

/// Returns the joints that move enough for a profile, and a note for each other one that moves.
fn joints(spec: &Spec, setup: &Setup, rows: &[Observation]) -> (Vec<ProfileJoint>, Vec<String>) {
    let (mut offered, mut notes) = (Vec::new(), Vec::new());
    for variable in setup.moved(rows) {
        let Variable { name, kind, .. } = &spec.variables[variable];
        let mut values: Vec<f64> = rows.iter().map(|row| row.q[variable]).collect();
        values.sort_unstable_by(f64::total_cmp);
        let range = [values[0], values[values.len() - 1]];
        let basis = kind.either(ProfileBasis::Turn, ProfileBasis::Travel(range));
        let period = kind.either(core::f64::consts::TAU, 2.0 * (range[1] - range[0])) / HIGHEST;
        let Some(error) = joint_error(spec, setup, variable) else { continue };
        match resolved_cycles(&values, period) {
            Ok(cycles) => offered.push(ProfileJoint { variable, error, basis, range, cycles }),
            Err(reason) => notes.push(format!("note: no profile of {name}: {reason}")),
        }
    }
    (offered, notes)
}

/// Returns the number of cycles that sorted joint values resolve, at most that of the highest
/// harmonic, by its period: between values that are farther apart than half a period, such as those
/// of a grid, a harmonic acts as one of fewer cycles. Gaps between some of the values do not count.
fn resolved_cycles(values: &[f64], period: f64) -> Result<usize, String> {
    let range = values[values.len() - 1] - values[0];
    if range < period {
        return Err(format!("it turns by {}° only", digits(range.to_degrees(), 2)));
    }
    let mut last = values[0];
    let mut steps = Vec::new();
    for value in values {
        // Visits of one position.
        if value - last > period / 8.0 {
            steps.push(value - last);
            last = *value;
        }
    }
    steps.sort_unstable_by(f64::total_cmp);
    let resolved = period / (2.0 * steps[steps.len() / 2]);
    match (HIGHEST * resolved.min(1.0)) as usize {
        0 => Err(format!("its rows are at {} positions only", steps.len() + 1)),
        cycles => Ok(cycles),
    }
}

/// Returns the constant error of a joint as an unknown: one of the [`number_terms`], the last
/// sources of the manipulator.
fn joint_error(spec: &Spec, setup: &Setup, variable: usize) -> Option<Unknown> {
    let numbers = number_terms(spec);
    let first = setup.description.sources.len() - numbers.len();
    let number = numbers.iter().position(|term| term.site == ErrorSite::Joint(variable))?;
    Some(Unknown::Magnitude(first + number))
}

impl FoundProfiles {
    /// Returns the position errors of the cross-validation with the profiles.
    pub(super) fn cross_validated(&self) -> &Distances {
        &self.fitted.cross_validated
    }

    /// Returns the spec with the profiles as its last tables and sources.
    pub(super) fn added_to(&self, spec: &Spec) -> Spec {
        let mut profiled = spec.clone();
        for one in &self.joints {
            let table = one.table.table(table_name(spec, &one.joint), spec.length);
            let joint = Expression::from_symbol(Symbol::Variable(one.variable), table.dimensions[0]);
            let error = joint.looked_up(profiled.tables.len() as u16, &table);
            profiled.tables.push(table.into());
            let (number, cause) = (ChainNumber::Joint(one.variable), DeviationCause::Error(error));
            let deviations = vec![Deviation { number, cause, span: 0..0 }];
            profiled.sources.push(Source { deviations, ..Source::repeatable(one.source_name()) });
        }
        profiled
    }

    /// Fits the machine with the profiles, which is the manipulator of [`added_to`](Self::added_to)
    /// with the same sources behind them as that of the first fit.
    ///
    /// The model with base and tool alone, and the machine as delivered, stay without profiles.
    pub(super) fn refit<'a>(
        self,
        interpreter: &'a Interpreter,
        (first_setup, first): (Setup<'a>, Solved<'a>),
        input: &FitInput,
        notes: &mut dyn Notes,
    ) -> Result<(Setup<'a>, Solved<'a>)> {
        let FitInput { spec, data, settings, .. } = *input;
        let added = first_setup.description.sources.len() - first_setup.declared;
        let mut setup = input.setup(interpreter, added, false, notes)?;
        let mut solved = solve(&setup, data, &first.own, &first.terms, settings, notes)?;
        setup.delivered = first_setup.delivered;
        let sigma = self.fitted.add_uncertainty(&mut solved.fit);
        let mut joints = self.joints;
        joints.iter_mut().for_each(|joint| joint.standard_deviation *= sigma);
        let deviation = tool_point_deviation(spec, &setup, &data.observations, &joints).about(&data.file)?;
        let [before, after] = [&first.cross_validated, &self.fitted.cross_validated].map(Distances::figures);
        let profiles = JointProfiles {
            before: before.into(),
            after: after.into(),
            gain: self.comparison.into(),
            effective: self.fitted.effective(),
            standard_deviation: deviation,
            joints,
        };
        let (simple, simple_x) = (first.simple, first.simple_x);
        let cross_validated = self.fitted.cross_validated;
        Ok((setup, Solved { simple, simple_x, cross_validated, profiles: Some(profiles), ..solved }))
    }
}

/// Returns the standard deviation of the tool point by that of the profiles, root mean square over
/// some of the rows: `σ² = Σ_j |∂x/∂q_j|² σ_j²`.
fn tool_point_deviation(
    spec: &Spec,
    setup: &Setup,
    rows: &[Observation],
    joints: &[JointProfile],
) -> Result<f64, Failure> {
    let errors = joints.iter().filter_map(|joint| joint_error(spec, setup, joint.variable));
    let model = setup.ideal.with(errors.collect());
    let mut at = model.at(&vec![0.0; joints.len()]);
    let rows = rows.iter().step_by(rows.len().div_ceil(SAMPLES));
    let count = rows.len();
    let mut variance = 0.0;
    for row in rows {
        let (_, moves) = at.tool(row)?;
        for (joint, derivative) in joints.iter().zip(moves) {
            variance += derivative.map(|one| (one * joint.standard_deviation).powi(2)).iter().sum::<f64>();
        }
    }
    Ok((variance / count.max(1) as f64).sqrt())
}

#[cfg(test)]
mod tests;
