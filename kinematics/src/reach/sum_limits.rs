//! Limits of sums of joint variables: variables that follow others, and what is permitted.

use abbe_core::{Description, SumLimit, Variable};

use super::ReachError;

/// Limits of sums of the variables of a manipulator, with the variables that follow from the others
/// where a sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct SumLimits {
    limits: Vec<SumLimit>,
    variables: Vec<Variable>,
    pub(crate) followers: Vec<Follower>,
}

/// Variable that is a linear function of others: `q = constant + Σ wᵢ qᵢ`.
#[derive(Clone, Debug)]
pub(crate) struct Follower {
    pub(crate) variable: usize,
    constant: f64,
    /// Weights of all variables; 0 for those that follow.
    pub(crate) weights: Vec<f64>,
}

impl SumLimits {
    /// Creates the limits of a manipulator. Of the variables in a fixed sum, the first one in
    /// `order` follows the others.
    pub(crate) fn new(description: &Description, order: &[usize]) -> Self {
        let mut followers: Vec<Follower> = Vec::new();
        for limit in description.sum_limits.iter().filter(|limit| limit.range[0] == limit.range[1]) {
            // 0 = constant + Σ wᵢ qᵢ, without the variables that already follow.
            let mut rest = vec![0.0; description.variables.len()];
            let mut constant = -limit.range[0];
            limit.terms.iter().for_each(|(i, weight)| rest[*i] += weight);
            for follower in &followers {
                constant += follower.substitute(&mut rest);
            }
            let size = limit.terms.iter().fold(0.0, |size: f64, (_, weight)| size.max(weight.abs()));
            let Some(&variable) = order.iter().find(|i| rest[**i].abs() > 1e-9 * size) else { continue };
            let pivot = -rest[variable];
            rest[variable] = 0.0;
            let weights = rest.iter().map(|weight| weight / pivot).collect();
            let follower = Follower { variable, constant: constant / pivot, weights };
            for other in &mut followers {
                other.constant += follower.substitute(&mut other.weights);
            }
            followers.push(follower);
        }
        Self { limits: description.sum_limits.to_vec(), variables: description.variables.to_vec(), followers }
    }

    /// Returns `true` if there are no limits of sums.
    pub(crate) fn is_empty(&self) -> bool {
        self.limits.is_empty()
    }

    /// Sets the variables that follow from the others.
    pub(crate) fn lead(&self, q: &mut [f64]) {
        for Follower { variable, constant, weights } in &self.followers {
            q[*variable] = constant + weights.iter().zip(&*q).map(|(weight, q)| weight * q).sum::<f64>();
        }
    }

    /// Returns the limit that joint variables exceed.
    pub(crate) fn check(&self, q: &[f64]) -> Result<(), ReachError> {
        for Follower { variable, .. } in &self.followers {
            let [lower, upper] = self.variables[*variable].limits;
            let (variable, value) = (*variable, q[*variable]);
            if !(lower..=upper).contains(&value) {
                return Err(ReachError::OutsideLimits { variable, value, limits: [lower, upper] });
            }
        }
        match self.limits.iter().position(|limit| !limit.permits(q)) {
            Some(limit) => Err(ReachError::OutsideSumLimit { limit, value: self.limits[limit].value(q) }),
            None => Ok(()),
        }
    }
}

impl Follower {
    /// Replaces the variable in a sum by what it follows, and returns what is added to its
    /// constant.
    fn substitute(&self, weights: &mut [f64]) -> f64 {
        let weight = core::mem::take(&mut weights[self.variable]);
        weights.iter_mut().zip(&self.weights).for_each(|(sum, own)| *sum += weight * own);
        weight * self.constant
    }
}
