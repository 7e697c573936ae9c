//! The configurations that checks visit, numbered as they come first.

use std::collections::HashMap;

use abbe::VariableKind;

use crate::identify::Setup;

/// Joints within this of each other, in rad or as a share of the arm's length, are one configuration.
const SAME: f64 = 1e-3;

/// The most configurations: of each there are some hundred columns of numbers.
pub(super) const MOST: usize = 5_000;

/// There are more of them.
#[derive(Debug)]
pub(super) struct TooMany;

/// Configurations by their joints. Inputs do not count: what they do is in the model.
pub(super) struct Places {
    list: Vec<Vec<f64>>,
    /// By joint, what counts as one.
    units: Vec<f64>,
    /// By a sum of the joints, in steps that are larger than that of two which are the same can differ.
    bins: HashMap<i64, Vec<u32>>,
}

impl Places {
    pub(super) fn new(setup: &Setup) -> Self {
        let unit = |kind: VariableKind| if kind == VariableKind::Revolute { 1.0 } else { setup.arm };
        let units = setup.description.variables.iter().map(|variable| unit(variable.kind)).collect();
        Self { list: Vec::new(), units, bins: HashMap::new() }
    }

    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// The number of a configuration: that of the first one which is the same.
    pub(super) fn of(&mut self, q: &[f64]) -> Result<u32, TooMany> {
        let same = |place: &&u32| {
            let joints = self.list[**place as usize].iter().zip(q).zip(&self.units);
            joints.into_iter().all(|((a, b), unit)| (a - b).abs() <= SAME * unit)
        };
        // Each joint with a factor of its own, at most 1: so that few sums are the same by chance.
        let factors = (0..q.len()).map(|i| 1.0 / (1.0 + 0.618 * i as f64));
        let sum: f64 =
            q.iter().zip(&self.units).zip(factors).map(|((q, unit), factor)| factor * q / unit).sum();
        let bin = (sum / (1.01 * SAME * q.len() as f64)).floor() as i64;
        let near = (bin.saturating_sub(1)..=bin.saturating_add(1)).filter_map(|bin| self.bins.get(&bin));
        if let Some(known) = near.flatten().filter(same).min() {
            return Ok(*known);
        }
        if self.list.len() == MOST {
            return Err(TooMany);
        }
        let place = self.list.len() as u32;
        self.list.push(q.to_vec());
        self.bins.entry(bin).or_default().push(place);
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::{MOST, Places, SAME};

    fn places() -> Places {
        Places { list: Vec::new(), units: vec![1.0, 500.0], bins: HashMap::new() }
    }

    /// As by a look at all that are known, one after the other.
    #[test]
    fn configurations_are_told_apart() {
        let (mut found, mut known): (_, Vec<[f64; 2]>) = (places(), Vec::new());
        for i in 0..4000 {
            let q = [(f64::from(i) * 0.7).sin() * 0.02, (f64::from(i) * 1.3).cos() * 10.0 - 4.0];
            let same = |k: &[f64; 2]| (k[0] - q[0]).abs() <= SAME && (k[1] - q[1]).abs() <= 500.0 * SAME;
            let expected = known.iter().position(same).unwrap_or(known.len());
            if expected == known.len() {
                known.push(q);
            }
            assert_eq!(found.of(&q).unwrap(), expected as u32);
        }
        assert!((100..2000).contains(&found.len()), "{}", found.len());
    }

    #[test]
    fn there_are_no_more_than_fit() {
        let mut all = places();
        assert!((0..MOST).all(|i| all.of(&[0.01 * i as f64, 0.0]).is_ok()));
        assert!(all.of(&[-1.0, 0.0]).is_err());
        assert_eq!(all.of(&[0.01, 0.0]).unwrap(), 1);
    }
}
