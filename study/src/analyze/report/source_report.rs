//! Position errors of one source.
//!
//! Value of a random source, as stated in the spec.
//!
//! Configurations with the largest errors, with names.

use std::collections::BTreeMap;

use abbe::analysis::{Budget, Combined, Configuration, Contribution, Figures, SourceErrors, Workspace};
use abbe::{Class, Component};
use abbe_spec::{ChainNumber, DhNumber, Source, Spec, Uncertain, expr::Expression};
use serde::{Serialize, Serializer};

use crate::number::{self, Named};
use crate::study_file::Metric;

/// Position errors of one source alone over the workspace: along x, y, z of `F_0` and their norm,
/// in the length unit. Random sources count at their bounds.
#[derive(Clone, Debug, Serialize)]
pub struct SourceReport {
    /// Name of the source.
    pub name: String,
    /// Element of the chain that the source acts on.
    pub at: String,
    /// Class of the source: `repeatable`, `tolerance` or `random`.
    #[serde(serialize_with = "class")]
    pub class: Class,
    /// Largest absolute error.
    pub plain_max: Figures,
    /// Half of the peak-to-peak variation; of the norm, the norm of these halves. For a
    /// random source, its largest bound.
    pub half_peak_to_peak: Figures,
    /// Largest difference from the error at home. For a random source, the largest difference of
    /// two draws.
    pub relative_to_home: Figures,
    /// Configuration with the largest norm: joint variables and varying inputs.
    pub worst: Named,
    /// Distribution of a random source; `None` for a repeatable one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distribution: Option<&'static str>,
    /// Parameters of that configuration that vary over the workspace.
    pub worst_parameters: Named,
    /// Largest absolute orientation errors, rows 4–6, in rad.
    pub orientation: [f64; 3],
    /// Index of the configuration with the largest norm.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl SourceReport {
    /// Creates the reports of all sources in a budget.
    pub(in crate::analyze) fn all(budget: &Budget, spec: &Spec, sites: &ErrorSites) -> Vec<Self> {
        let errors = budget.sources.iter().zip(&budget.orientation.sources);
        let named = spec.whole_sources().zip(errors).map(|(source, (errors, turned))| {
            let &SourceErrors { class, plain_max, half_peak_to_peak, relative_to_home, worst, .. } = errors;
            let Figures { x, y, z, .. } = turned.plain_max;
            Self {
                name: source.name.clone(),
                at: spec.place(source),
                class,
                plain_max,
                half_peak_to_peak,
                relative_to_home,
                worst: sites.variables(worst),
                distribution: number::class(class).1,
                worst_parameters: sites.parameters(worst),
                orientation: [x, y, z],
                configuration: worst,
            }
        });
        named.collect()
    }

    /// Returns the errors in one metric.
    pub fn figures(&self, metric: Metric) -> Figures {
        match metric {
            Metric::PlainMaximum => self.plain_max,
            Metric::HalfPeakToPeak => self.half_peak_to_peak,
            Metric::RelativeToHome => self.relative_to_home,
        }
    }
}

fn class<S: Serializer>(class: &Class, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(number::class(*class).0)
}

/// Value of a source in the spec's coherent units, and its quantity.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SourceValue {
    /// Value of the source; 1 if it causes several errors.
    pub(super) value: f64,
    pub(super) quantity: Quantity,
}

/// Quantity of a source's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// Factor of the errors in the spec.
    Multiple,
    /// Length, in the length unit.
    Length,
    /// Angle, in rad.
    Angle,
    /// Parameter or input in this unit, or a plain number if the unit is empty.
    Parameter(String),
}

impl SourceValue {
    /// Determines the value of a source: the standard deviation of a magnitude; or the uncertainty
    /// of an input; or the deviation of a joint or parameter, if it is the only one and constant;
    /// or the only generalized error at the configuration.
    pub(super) fn new(spec: &Spec, source: &Source, one: &Contribution) -> Self {
        if source.magnitude.is_some() {
            return Self { value: source.factor(), quantity: Quantity::Parameter(String::new()) };
        }
        if let [(Uncertain::Input(input), uncertainty)] = source.propagated[..] {
            return Self {
                value: source.scale * uncertainty,
                quantity: Quantity::Parameter(spec.inputs[input].unit.clone()),
            };
        }
        if let ([], [deviation]) = (&source.effects[..], &source.deviations[..])
            && let Some(value) =
                deviation.error().and_then(Expression::constant).filter(|value| *value != 0.0)
        {
            return Self { value: source.scale * value.abs(), quantity: quantity(spec, deviation.number) };
        }
        match one.value {
            None => Self { value: 1.0, quantity: Quantity::Multiple },
            Some((Component::X | Component::Y | Component::Z, value)) => {
                Self { value, quantity: Quantity::Length }
            }
            Some((_, value)) => Self { value, quantity: Quantity::Angle },
        }
    }
}

fn quantity(spec: &Spec, number: ChainNumber) -> Quantity {
    match number {
        ChainNumber::Joint(joint) => spec.variables[joint].kind.either(Quantity::Angle, Quantity::Length),
        ChainNumber::Parameter(parameter) => Quantity::Parameter(spec.parameters[parameter].unit.clone()),
        ChainNumber::DenavitHartenberg { number: DhNumber::Theta | DhNumber::Alpha, .. } => Quantity::Angle,
        ChainNumber::DenavitHartenberg { number: DhNumber::D | DhNumber::A, .. } => Quantity::Length,
    }
}

/// A configuration where errors were evaluated, with the names of the variables, inputs and
/// parameters that vary.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct ErrorSite {
    /// The configuration.
    pub(in crate::analyze) configuration: Configuration,
    /// Joint variables, and the inputs that vary over the workspace.
    pub(super) variables: Named,
    /// Parameters that vary over the workspace.
    pub(super) parameters: Named,
}

/// Home, and the configurations that a budget refers to by their index in the workspace.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct ErrorSites {
    pub(in crate::analyze) home: ErrorSite,
    by_index: BTreeMap<usize, ErrorSite>,
}

impl ErrorSites {
    /// Collects the sites of a budget. `varying` and `moving_inputs` are the indices of the
    /// parameters and inputs that vary over the workspace, `others` those of further
    /// configurations.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        workspace: &dyn Workspace,
        spec: &Spec,
        varying: &[usize],
        moving_inputs: &[usize],
        others: impl IntoIterator<Item = usize>,
    ) -> Self {
        let named = |configuration: Configuration| {
            let Configuration { q, s, u } = &configuration;
            let variables = spec.variables.iter().zip(q);
            let variables = variables.map(|(variable, value)| (variable.name.clone(), value + 0.0));
            let inputs = moving_inputs.iter().map(|&i| (spec.inputs[i].name.clone(), u[i] + 0.0));
            let parameters = varying.iter().map(|&i| (spec.parameters[i].name.clone(), s[i] + 0.0));
            let [variables, parameters] =
                [variables.chain(inputs).collect(), parameters.collect()].map(Named);
            ErrorSite { configuration, variables, parameters }
        };
        let alone = budget.sources.iter().chain(&budget.orientation.sources);
        let together =
            [&budget.combined, &budget.orientation.combined].into_iter().flat_map(Combined::indices);
        let indices = alone.filter_map(|errors| errors.worst).chain(together);
        let indices = indices.chain(budget.least_likely.iter().flatten().copied()).chain(others);
        let site = |index: usize| Some((index, named(workspace.configuration(index).ok()?)));
        Self { home: named(workspace.home().clone()), by_index: indices.filter_map(site).collect() }
    }

    /// Returns the site of a workspace index; `None` for an empty workspace.
    pub(in crate::analyze) fn get(&self, index: Option<usize>) -> Option<&ErrorSite> {
        self.by_index.get(&index?)
    }

    /// Returns the variables and inputs of a workspace index.
    pub(super) fn variables(&self, index: Option<usize>) -> Named {
        self.get(index).map(|site| site.variables.clone()).unwrap_or_default()
    }

    /// Returns the parameters of a workspace index.
    pub(super) fn parameters(&self, index: Option<usize>) -> Named {
        self.get(index).map(|site| site.parameters.clone()).unwrap_or_default()
    }
}
