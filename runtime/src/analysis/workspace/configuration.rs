//! A configuration of a manipulator.

use crate::Description;
use crate::analysis::sampling;

/// A configuration: joint variables, and the structural parameters (the tool point is one of those).
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The joint variables.
    pub q: Vec<f64>,
    /// The structural parameters.
    pub s: Vec<f64>,
}

impl Configuration {
    /// The home configuration with nominal parameters.
    pub fn home(description: &Description) -> Self {
        Self { q: sampling::home(description), s: sampling::nominal_parameters(description) }
    }

    /// `d1 = 1128, q4 = 0.5, x = 250`: its variables, and those parameters that are not nominal.
    pub fn label(&self, description: &Description) -> String {
        let variables = description.variables.iter().zip(&self.q);
        let variables = variables.map(|(variable, value)| format!("{} = {value}", variable.name));
        let parameters = description.parameters.iter().zip(&self.s);
        let parameters = parameters
            .filter(|(parameter, value)| parameter.nominal != **value)
            .map(|(parameter, value)| format!("{} = {value}", parameter.name));
        variables.chain(parameters).collect::<Vec<_>>().join(", ")
    }
}
