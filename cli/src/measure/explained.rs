//! What was measured against what the sources of the spec predict.

use abbe::Class;
use abbe::identify::{Figures, Unknown};
use serde::Serialize;

use super::errors::{Errors, norm};
use crate::data::{Data, Map};
use crate::failure::Failure;
use crate::identify::Setup;

/// How far the sources of the spec go.
#[derive(Serialize)]
pub(super) struct Explained {
    /// Norms of what is left when the repeatable sources are taken off.
    pub(super) left_mean: f64,
    pub(super) left_rms: f64,
    pub(super) left_max: f64,
    /// Which share of the sum of squares the repeatable sources explain; below 0 they make it worse.
    pub(super) share: f64,
    /// Which share of the rows is within the bounds of the random sources (root sum of squares) and three standard
    /// deviations of the instrument, along all three axes.
    pub(super) inside: f64,
    pub(super) repeatable: usize,
    pub(super) random: usize,
}

pub(super) fn of(setup: &Setup, map: &Map, data: &Data, errors: &Errors) -> Result<Explained, Failure> {
    let sources = setup.description.sources.iter().enumerate();
    let random: Vec<(usize, f64)> = sources
        .filter_map(|(i, source)| match source.class {
            Class::Random(distribution) => Some((i, distribution.bound())),
            Class::Repeatable => None,
        })
        .collect();
    let model = setup.real.with(random.iter().map(|(i, _)| Unknown::Magnitude(*i)).collect());
    let mut room = model.room();
    let zero = vec![0.0; random.len()];
    let (mut left, mut inside) = (Vec::new(), 0);
    for (i, row) in data.observations.iter().enumerate() {
        let found = model.tool(&mut room, row, &zero);
        let (pose, moves) =
            found.map_err(|error| Failure::of(&data.file, format!("line {}: {error}", data.lines[i])))?;
        let rest: [f64; 3] = std::array::from_fn(|k| errors.points[i][k] - pose.position()[k]);
        let within = |k: usize| {
            let squares =
                moves.iter().zip(&random).map(|(moved, (_, bound))| (moved[k] * bound).powi(2)).sum::<f64>();
            rest[k].abs() <= squares.sqrt() + 3.0 * map.uncertainty.length
        };
        inside += usize::from((0..3).all(within));
        left.push(norm(rest));
    }
    let squares = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let share = 1.0 - squares(&left) / squares(&errors.norms()).max(f64::MIN_POSITIVE);
    let figures = Figures::of(left);
    Ok(Explained {
        left_mean: figures.mean,
        left_rms: figures.rms,
        left_max: figures.max,
        share,
        inside: inside as f64 / data.observations.len().max(1) as f64,
        repeatable: setup.real.repeatable().len(),
        random: random.len(),
    })
}
