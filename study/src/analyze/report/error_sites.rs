//! Configurations with the largest errors, with names.

use std::collections::BTreeMap;

use abbe::analysis::{Budget, Configuration, Workspace};
use abbe_spec::Spec;

use crate::number::Named;

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
        let (all, turned) = (&budget.combined, &budget.orientation.combined);
        let extremes = [all, turned].into_iter().flat_map(|combined| {
            [
                combined.repeatable_radius,
                combined.random_radius,
                combined.radius,
                combined.standard_radius,
                combined.worst_case_radius,
            ]
        });
        let indices = budget.sources.iter().chain(&budget.orientation.sources).map(|errors| errors.worst);
        let indices = indices.chain(extremes.map(|extreme| extreme.configuration));
        let indices = indices.chain([all.ellipsoid.configuration]).flatten();
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
