//! Factors of the error sources with which a study keeps its tolerance at least cost, by the worst
//! case or the root sum of squares.

use std::sync::Arc;

use abbe::analysis::{
    AllocationCriterion, Allocator, ErrorParts, ErrorRow, Measurand, Row, ScalableSource, Sweepable,
    Workspace, sweep,
};
use abbe::{Class, analysis::sampling::norm};
use abbe_spec::option::{NamedOption, option};
use abbe_spec::{Source, Spec};
use serde::Serialize;

use crate::machine::{Machine, followed_source};
use crate::number::{Named, decimals, percent, rounded_down};
use crate::study_file::{Criterion, JudgedMachine, Study};
use crate::{Notes, Result, finite, mistake, number};

/// Largest number of exceeding configurations that are added after a sweep.
const ADDED: usize = 1000;
/// Largest residual of an optimum.
const CONVERGED: f64 = 1e-8;
/// Smallest factor.
const LEAST: f64 = 0.001;
/// Largest factor of sources that may be worse than they are.
const MOST: f64 = 1000.0;

/// Search for the factors that cost least.
pub(crate) struct Factors<'a> {
    pub(crate) machine: &'a Machine,
    /// The study, whose changes are made.
    pub(crate) study: &'a Study,
    /// Allows factors above 1.
    pub(crate) loosen: bool,
}

impl Factors<'_> {
    /// Optimizes the factors over the configurations that exceed the tolerance the most, and adds
    /// those that exceed it with the found factors until there are none.
    pub(crate) fn over(
        &self,
        manipulator: &dyn Sweepable,
        workspace: &dyn Workspace,
        notes: &mut dyn Notes,
    ) -> Result<Report> {
        let Self { machine, study, .. } = *self;
        let spec = &machine.spec;
        let refused = |message: &str, help: &str| mistake::with_help(&machine.origin, message, help);
        let tolerances = study.tolerances();
        if tolerances == [None; 2] {
            let help = format!("write `tolerance` into the study, or `{}`", option("tolerance", "0.5 mm"));
            return Err(refused("there is no tolerance to keep", &help));
        } else if study.judged == JudgedMachine::Compensated {
            let message = "the study judges the compensated machine, but factors are of the machine as built";
            return Err(refused(message, "write `machine = \"as-built\"` into `tolerance` of the study"));
        }
        let criterion = match study.criterion {
            Criterion::WorstCase => AllocationCriterion::WorstCase,
            _ => AllocationCriterion::RootSumOfSquares,
        };
        let parts = ErrorParts::new(manipulator.description());
        let mut allocator = Allocator::new(criterion, self.sources(&parts));
        loop {
            notes.go_on()?;
            let allocation = allocator.solve().map_err(|values| {
                let [fixed, least] = values.map(|value| percent(value, 1.0));
                let message = format!(
                    "no factors keep the tolerance: the fixed sources alone take {fixed} of it, with all \
                     others at {LEAST} {least}"
                );
                refused(&message, "allow a larger tolerance, improve the fixed sources, or remove `fixed`")
            })?;
            let mut largest = vec![[0.0_f64; 2]; allocator.sources.len()];
            let mut exceeding: Vec<(f64, ErrorRow)> = Vec::new();
            let mut configurations = 0;
            let swept = sweep(manipulator, workspace, &mut |row: &Row| {
                configurations += 1;
                for (measurand, tolerance) in Measurand::ALL.into_iter().zip(tolerances) {
                    let tolerance = tolerance.filter(|_| row.oriented || measurand == Measurand::Position);
                    let Some(tolerance) = tolerance else { continue };
                    let errors = row.sources.iter().map(|error| measurand.rows(error).map(|e| e / tolerance));
                    let mut errors: Vec<[f64; 3]> = errors.collect();
                    for own in parts.with_parts() {
                        let (_, norm) = parts.largest(own[0], row.sources, measurand);
                        own.iter().for_each(|part| errors[*part] = [0.0; 3]);
                        errors[own[0]][0] = norm / tolerance;
                    }
                    for (largest, error) in largest.iter_mut().zip(&errors) {
                        let largest = &mut largest[measurand as usize];
                        *largest = largest.max(norm(*error));
                    }
                    let value = allocator.value(&errors, &allocation.factors, 1.0);
                    let row = ErrorRow { configuration: row.index, measurand, errors };
                    exceeding.extend((value > 1.0).then_some((value, row)));
                }
                if exceeding.len() > 2 * ADDED {
                    exceeding.sort_by(|a, b| b.0.total_cmp(&a.0));
                    exceeding.truncate(ADDED);
                }
            });
            let unreachable = swept
                .map_err(|error| machine.not_evaluated(workspace, &error, manipulator.description()))?
                .count;
            if configurations == 0 {
                let help = "move or shrink the workspace of the study, or widen the limits of the joints";
                return Err(refused("no configuration of the workspace is reachable", help));
            }
            if unreachable as f64 > study.unreachable * (configurations + unreachable) as f64 {
                let all = configurations + unreachable;
                let message = format!(
                    "{unreachable} of {all} configurations cannot be reached: no factors keep the tolerance there"
                );
                let help = "shrink the workspace of the study, or permit a share with `unreachable` in its tolerance";
                return Err(refused(&message, help));
            }
            if allocation.residual > CONVERGED {
                let help = "write costs and exponents into [allocation] that differ less";
                return Err(refused("the optimization of the factors does not converge", help));
            }
            if !exceeding.is_empty() {
                allocator.rows.extend(exceeding.into_iter().map(|(_, row)| row));
                continue;
            }
            let active = allocation.active.iter().filter_map(|(row, multiplier)| {
                let ErrorRow { configuration, measurand, .. } = &allocator.rows[*row];
                let at = workspace.configuration(*configuration).ok()?;
                let at = number::configuration(&at, workspace.home(), spec);
                Some((format!("{at}{}", ["", ", orientation"][*measurand as usize]), *multiplier))
            });
            let active = number::Named(active.collect());
            let reach = [configurations, unreachable];
            let report = Report::new(machine, study, &allocator, (allocation.factors, largest), reach);
            return finite(&machine.origin, Report { active, residual: allocation.residual, ..report });
        }
    }

    /// Returns the enabled sources. Parts of a calibration are fixed, and so is the uncertainty of
    /// an input, which depends on the factors of other sources.
    fn sources(&self, parts: &ErrorParts) -> Vec<ScalableSource> {
        let spec = &self.machine.spec;
        let enabled = spec.sources.iter().enumerate().filter(|(_, source)| source.enabled);
        let scalable = |(own, (index, source)): (usize, (usize, &Source))| {
            let stated = self.study.allocation.iter().find(|(of, _)| *of == index);
            let [cost, exponent] = stated.map_or([1.0; 2], |(_, cost)| *cost);
            let is_fixed = cost.is_infinite() || !source.propagated.is_empty();
            let limits = if is_fixed { [1.0; 2] } else { [LEAST, if self.loosen { MOST } else { 1.0 }] };
            let is_repeatable = source.class == Class::Repeatable;
            let followed = followed_source(spec, index).and_then(|index| spec.enabled_index(index));
            let (follows, has_parts) = (followed.unwrap_or(own), parts.parts_of(own).len() > 1);
            ScalableSource { is_repeatable, has_parts, follows, cost, exponent, limits }
        };
        enabled.enumerate().map(scalable).collect()
    }
}

/// Factors of the error sources with which the study keeps its tolerances at least cost, and with
/// all smaller factors, too. Lengths are in the spec's unit, angles in rad.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the manipulator.
    pub manipulator: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Tolerance of the position error, in the length unit; `None` if the study has none.
    pub tolerance: Option<f64>,
    /// Tolerance of the orientation error, in rad; `None` if the study has none.
    pub orientation_tolerance: Option<f64>,
    /// Number of reached configurations, at all of which the tolerances are kept.
    pub configurations: usize,
    /// Number of unreachable configurations.
    pub unreachable: usize,
    /// Enabled sources of the spec, in its order.
    pub sources: Vec<AllocatedSource>,
    /// Sum of the costs of all factors that are not fixed.
    pub cost: f64,
    /// Factor of all these sources if they have the same one; with the root sum of squares of the
    /// others where draws decide.
    pub one_factor: f64,
    /// Cost with this factor.
    pub one_factor_cost: f64,
    /// Configurations at which a tolerance is reached, by their differences from home, each with
    /// its multiplier λ, without a unit: the cost falls by λ/100 if the errors there fall by 1 %.
    /// The largest is first.
    pub active: Named,
    /// Largest relative residual of the conditions for the optimum (Karush, Kuhn and Tucker),
    /// without a unit.
    pub residual: f64,
    /// The study.
    #[serde(skip)]
    pub study: Study,
    /// Spec of the manipulator.
    #[serde(skip)]
    pub spec: Arc<Spec>,
    /// Changes of the spec by options, in their order.
    #[serde(skip)]
    pub changes: Vec<NamedOption>,
}

/// Error source and its factor.
#[derive(Clone, Debug, Serialize)]
pub struct AllocatedSource {
    /// Name of the source.
    pub source: String,
    /// Factor of its errors.
    pub factor: f64,
    /// Indicates that the factor is fixed.
    pub fixed: bool,
    /// Largest norm of its error without its factor, in the length unit or rad: of the position; or
    /// of the orientation if the study has no tolerance of the position.
    pub largest: f64,
}

/// Returns a factor with three digits, rounded down: if it is obeyed as printed, the tolerance is
/// kept.
pub fn printed(factor: f64) -> f64 {
    rounded_down(factor, decimals(factor, 3)).parse().unwrap_or(factor)
}

impl Report {
    /// Creates the report for factors of the enabled sources and their largest errors, as shares of
    /// the tolerances. `reach` has the numbers of reached and of unreachable configurations.
    fn new(
        machine: &Machine,
        study: &Study,
        allocator: &Allocator,
        (factors, largest): (Vec<f64>, Vec<[f64; 2]>),
        [configurations, unreachable]: [usize; 2],
    ) -> Self {
        let spec = Arc::clone(&machine.spec);
        let own = spec.enabled_sources().zip(&allocator.sources).enumerate();
        let own = own.filter(|(k, (source, own))| own.follows == *k && !source.is_calibration_error());
        let sources = own.map(|(k, (source, scalable))| AllocatedSource {
            source: source.name.clone(),
            factor: factors[k],
            fixed: scalable.is_fixed(),
            largest: match (study.tolerance, study.orientation_tolerance) {
                (Some(tolerance), _) => tolerance * largest[k][0],
                (None, tolerance) => tolerance.unwrap_or_default() * largest[k][1],
            },
        });
        let one = allocator.with_one_factor().solve().map_or(factors.clone(), |one| one.factors);
        let free = allocator.sources.iter().position(|source| !source.is_fixed());
        Self {
            manipulator: spec.name.clone(),
            length: spec.length.symbol(),
            tolerance: study.tolerance,
            orientation_tolerance: study.orientation_tolerance,
            configurations,
            unreachable,
            sources: sources.collect(),
            cost: allocator.cost(&factors),
            one_factor: free.map_or(1.0, |free| one[free]),
            one_factor_cost: allocator.cost(&one),
            active: Named::default(),
            residual: 0.0,
            study: study.clone(),
            spec,
            changes: machine.stated_changes().collect(),
        }
    }

    /// Returns the factors that are not 1 as they are printed, in the form of `--scale`.
    pub fn scales(&self) -> Vec<String> {
        let changed = self.sources.iter().filter(|source| !source.fixed && source.factor != 1.0);
        changed.map(|source| format!("{}={}", source.source, printed(source.factor))).collect()
    }
}
