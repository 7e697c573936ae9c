//! What was measured against what the sources of the spec predict.

use abbe::Class;
use abbe::identify::{Failure, Figures, Unknown};
use serde::Serialize;

use super::errors::{RowError, at_single_target};
use crate::identify::Setup;

/// How far the sources of the spec go.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Explained {
    /// The mean norm of what is left when the repeatable sources are taken off, of every point that was measured.
    pub left_mean: f64,
    /// The root mean square of that.
    pub left_rms: f64,
    /// What 95 % of them do not exceed.
    pub left_p95: f64,
    /// The largest.
    pub left_max: f64,
    /// Which share of the sum of squares the repeatable sources explain; below 0 they make it worse.
    pub share: f64,
    /// Which share of the rows is within the bounds of the random sources (root sum of squares) and three standard
    /// deviations of the instrument, along all three axes.
    pub inside: f64,
    /// How many repeatable sources there are.
    pub repeatable: usize,
    /// How many random ones.
    pub random: usize,
}

pub(super) fn explained(setup: &Setup, rows: &[RowError]) -> Result<Explained, Failure> {
    let sources = setup.description.sources.iter().enumerate();
    let random: Vec<(usize, f64)> = sources
        .filter_map(|(i, source)| match source.class {
            Class::Random(distribution) => Some((i, distribution.bound())),
            Class::Repeatable => None,
        })
        .collect();
    let unknowns = random.iter().map(|(i, _)| Unknown::Magnitude(*i)).collect();
    let model = at_single_target(&setup.real).with(unknowns);
    let mut room = model.room();
    let zero = vec![0.0; random.len()];
    let (mut before, mut left, mut inside) = (Vec::new(), Vec::new(), 0);
    for row in rows {
        let (pose, moves) = model.tool(&mut room, &row.observation, &zero)?;
        let rest: [f64; 3] = std::array::from_fn(|k| row.point[k] - pose.position()[k]);
        let within = |k: usize| {
            let squares =
                moves.iter().zip(&random).map(|(moved, (_, bound))| (moved[k] * bound).powi(2)).sum::<f64>();
            rest[k].abs() <= squares.sqrt() + 3.0 * model.uncertainty.length
        };
        inside += usize::from((0..3).all(within));
        // Where it was measured: at every target.
        left.extend(setup.real.distances(&mut room, &row.observation, &[])?);
        before.extend(setup.ideal.distances(&mut room, &row.observation, &[])?);
    }
    let squares = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let share = 1.0 - squares(&left) / squares(&before).max(f64::MIN_POSITIVE);
    let figures = Figures::from_norms(left);
    Ok(Explained {
        left_mean: figures.mean,
        left_rms: figures.rms,
        left_p95: figures.p95,
        left_max: figures.max,
        share,
        inside: inside as f64 / rows.len().max(1) as f64,
        repeatable: setup.real.repeatable().len(),
        random: random.len(),
    })
}
