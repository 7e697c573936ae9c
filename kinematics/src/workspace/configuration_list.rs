//! A list of configurations.

use super::Workspace;
use crate::Configuration;
use crate::ReachError;
use crate::SumLimits;
use abbe_core::{Error, Manipulator, Quantity, checks};

/// Workspace of a list of configurations, such as a path; see [`listed`].
#[derive(Clone, Debug)]
pub struct Listed {
    home: Configuration,
    configurations: Vec<Configuration>,
    limits: Vec<[f64; 2]>,
    sums: SumLimits,
}

/// Creates the workspace of a list of configurations. Those with a variable outside its limits
/// count as unreachable.
///
/// Returns [`Error::Count`] if a configuration has a wrong number of variables, parameters or
/// inputs.
pub fn listed(manipulator: &dyn Manipulator, configurations: Vec<Configuration>) -> Result<Listed, Error> {
    let description = manipulator.description();
    let home = Configuration::home(description);
    for Configuration { q, s, u } in &configurations {
        checks::length(Quantity::Variables, [home.q.len(), 1], q.len())?;
        checks::length(Quantity::Parameters, [home.s.len(), 1], s.len())?;
        checks::length(Quantity::Inputs, [home.u.len(), 1], u.len())?;
    }
    let limits = description.variables.iter().map(|variable| variable.limits).collect();
    let sums = SumLimits::new(description, &[]);
    Ok(Listed { home, configurations, limits, sums })
}

impl Workspace for Listed {
    fn len(&self) -> usize {
        self.configurations.len()
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(self.configurations.get(index).unwrap_or(&self.home));
        let q = &configuration.q;
        let outside = |(value, [lower, upper]): (&f64, &[f64; 2])| value < lower || value > upper;
        match q.iter().zip(&self.limits).position(outside) {
            Some(variable) => {
                Err(ReachError::OutsideLimits { variable, value: q[variable], limits: self.limits[variable] })
            }
            None => self.sums.check(q),
        }
    }
}
