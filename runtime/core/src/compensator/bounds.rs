//! Interval of each joint in one cycle: its limits, and the bounds of its correction.

use super::cycle::Cycle;
use crate::Variable;

pub(super) struct Bounds<Q> {
    /// The command, at its limits where it is beyond them.
    pub(super) command: Q,
    /// First configuration of the iterations: the command with the correction of the previous
    /// cycle.
    pub(super) begin: Q,
    lower: Q,
    upper: Q,
}

impl<Q: Clone + AsRef<[f64]> + AsMut<[f64]>> Bounds<Q> {
    pub(super) fn new(variables: &[Variable], start: &Q, cycle: &Cycle<impl AsRef<[f64]>>) -> Self {
        let entry = |list: &[f64], j: usize, missing: f64| list.get(j).copied().unwrap_or(missing);
        let [mut command, mut begin, mut lower, mut upper] = [(); 4].map(|()| start.clone());
        for (j, variable) in variables.iter().enumerate() {
            let at = clamped(start.as_ref()[j], variable.limits);
            let last = entry(cycle.last.as_ref(), j, 0.0);
            // `max` replaces NaN.
            let change = entry(cycle.change.as_ref(), j, f64::INFINITY).max(0.0);
            let largest = entry(cycle.largest.as_ref(), j, f64::INFINITY).max(0.0);
            let window = [last - change, last + change];
            let within = |correction: f64| clamped(at + clamped(correction, window), variable.limits);
            command.as_mut()[j] = at;
            lower.as_mut()[j] = within(-largest);
            upper.as_mut()[j] = within(largest);
            begin.as_mut()[j] = clamped(at + last, [lower.as_ref()[j], upper.as_ref()[j]]);
        }
        Self { command, begin, lower, upper }
    }

    pub(super) fn contain(&self, q: &[f64]) -> bool {
        q.iter().enumerate().all(|(j, value)| self.clamped(j, *value) == *value)
    }

    /// Returns `true` if a joint is at an end of its interval.
    pub(super) fn hold(&self, q: &[f64]) -> bool {
        let mut ends = q.iter().zip(self.lower.as_ref().iter().zip(self.upper.as_ref()));
        ends.any(|(value, (lower, upper))| value <= lower || value >= upper)
    }
}

impl<Q: AsRef<[f64]>> Bounds<Q> {
    pub(super) fn clamped(&self, j: usize, value: f64) -> f64 {
        clamped(value, [self.lower.as_ref()[j], self.upper.as_ref()[j]])
    }
}

/// Returns the nearest value of an interval, and its lower end for NaN.
fn clamped(value: f64, [lower, upper]: [f64; 2]) -> f64 {
    value.max(lower).min(upper)
}
