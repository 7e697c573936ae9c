//! The configurations where errors are largest, with names.

use std::collections::BTreeMap;

use abbe::analysis::{Budget, Configuration, Workspace};
use abbe_spec::Spec;

use crate::number::Named;

/// A configuration where errors were evaluated, and the names of what moves there.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct ErrorSite {
    /// The configuration.
    pub(in crate::analyze) configuration: Configuration,
    /// Its variables, and the inputs that the workspace moves.
    pub(super) variables: Named,
    /// The parameters that the workspace moves.
    pub(super) parameters: Named,
}

/// Home, and the configurations that a budget names by their index in the workspace.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct ErrorSites {
    pub(in crate::analyze) home: ErrorSite,
    of_index: BTreeMap<usize, ErrorSite>,
}

impl ErrorSites {
    /// Finds those of a budget; `varying` and `moving_inputs` are the indices of what the workspace moves.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        workspace: &dyn Workspace,
        spec: &Spec,
        varying: &[usize],
        moving_inputs: &[usize],
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
        let indices = indices.chain(budget.least_likely.iter().flatten().copied());
        let site = |index: usize| Some((index, named(workspace.configuration(index).ok()?)));
        Self { home: named(workspace.home().clone()), of_index: indices.filter_map(site).collect() }
    }

    /// Returns the site of an index; none of an empty workspace.
    pub(in crate::analyze) fn get(&self, index: Option<usize>) -> Option<&ErrorSite> {
        self.of_index.get(&index?)
    }

    /// Names the variables and inputs of an index.
    pub(super) fn variables(&self, index: Option<usize>) -> Named {
        self.get(index).map(|site| site.variables.clone()).unwrap_or_default()
    }

    /// Names the parameters of an index.
    pub(super) fn parameters(&self, index: Option<usize>) -> Named {
        self.get(index).map(|site| site.parameters.clone()).unwrap_or_default()
    }
}
