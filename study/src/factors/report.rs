//! Report of an allocation.

use std::sync::Arc;

use abbe::analysis::Allocator;
use abbe_spec::Spec;
use abbe_spec::option::NamedOption;
use serde::Serialize;

use crate::machine::Machine;
use crate::number::{Named, decimals, rounded_down};
use crate::study_file::Study;

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
    pub(super) fn new(
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
