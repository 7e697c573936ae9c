//! Which source to make smaller first.

use super::Row;
use super::sampling::norm;
use super::single::position;
use crate::{Class, Source};

/// By how much a source is made smaller.
const PERCENT: f64 = 0.01;

/// The radius that remains of every source made smaller by one percent, gathered configuration by configuration.
///
/// `ρ_k = max_q ‖Σ r − r_k/100‖ + ‖RSS‖` for a repeatable source, and for a random one the root sum of squares with
/// `0.99 b_k`. The maximum is looked for again, because it may move.
pub(super) struct Tightening<'a> {
    sources: &'a [Source<'a>],
    remaining: Vec<f64>,
}

impl<'a> Tightening<'a> {
    pub(super) fn new(sources: &'a [Source<'a>]) -> Self {
        Self { sources, remaining: vec![0.0; sources.len()] }
    }

    pub(super) fn add(&mut self, row: &Row) {
        let (repeatable, random) = (position(&row.repeatable), position(&row.random));
        let (repeatable_norm, random_norm) = (norm(repeatable), norm(random));
        for ((source, deviation), remaining) in self.sources.iter().zip(row.sources).zip(&mut self.remaining)
        {
            let deviation = position(deviation);
            let radius = match source.class {
                Class::Repeatable => {
                    norm(core::array::from_fn(|i| repeatable[i] - PERCENT * deviation[i])) + random_norm
                }
                // The square of the norm of a root sum of squares is the sum of the squares of all norms.
                Class::Random(_) => {
                    let less = 1.0 - (1.0 - PERCENT) * (1.0 - PERCENT);
                    let square = deviation.iter().map(|b| b * b).sum::<f64>();
                    repeatable_norm + (random_norm * random_norm - less * square).max(0.0).sqrt()
                }
            };
            *remaining = remaining.max(radius);
        }
    }

    /// By how much the radius shrinks for each source; less than nothing where it counteracts the others.
    pub(super) fn gains(self, radius: f64) -> Vec<f64> {
        self.remaining.into_iter().map(|remaining| radius - remaining).collect()
    }
}
