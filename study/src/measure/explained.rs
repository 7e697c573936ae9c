//! What was measured against what the sources of the spec predict.

use abbe::Class;
use abbe::identify::{Chance, Failure, Figures, Observation, Unknown, simulate};
use serde::Serialize;

use super::errors::{Errors, at_single_target, pose};
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
    /// Which share of the rows is within the region in which 95 % of the rows of a machine as the spec says are: its random
    /// sources drawn anew in every row, and the noise of the instrument.
    ///
    /// None of readings.
    pub inside: Option<f64>,
    /// Between which shares 99 % of such machines are with as many rows.
    pub likely: Option<[f64; 2]>,
    /// How many repeatable sources there are.
    pub repeatable: usize,
    /// How many random ones.
    pub random: usize,
}

/// What the region contains.
const CONTENT: f64 = 0.95;
/// So many rows are simulated to find it: its content is then within ±0.3 % (two standard deviations).
const SIMULATED: usize = 20_000;

pub(super) fn explained(setup: &Setup, rows: &[Observation]) -> Result<Explained, Failure> {
    let sources = setup.description.sources.iter().enumerate();
    let random: Vec<(usize, f64)> = sources
        .filter_map(|(i, source)| match source.class {
            Class::Random(distribution) => Some((i, 1.0 / distribution.divisor_squared())),
            Class::Repeatable => None,
        })
        .collect();
    let judge = Judge { setup, random: &random };
    let edge = judge.edge(rows)?;
    let (mut before, mut left, mut inside) = (0.0, Vec::new(), 0);
    let (mut room, mut errors) = (judge.room(), Errors::new(setup));
    for row in rows {
        let (_, point) = errors.at(row)?.unwrap_or_default();
        inside += usize::from(judge.judged(&mut room, row, point)? <= edge);
        // Where it was measured: at every target.
        let Room { room, .. } = &mut room;
        left.extend(setup.real.distances(room, row, &[])?);
        before += setup.ideal.distances(room, row, &[])?.iter().map(|v| v * v).sum::<f64>();
    }
    let share = 1.0 - left.iter().map(|v| v * v).sum::<f64>() / before.max(f64::MIN_POSITIVE);
    let figures = Figures::from_norms(left);
    Ok(Explained {
        left_mean: figures.mean,
        left_rms: figures.rms,
        left_p95: figures.p95,
        left_max: figures.max,
        share,
        inside: Some(inside as f64 / rows.len().max(1) as f64),
        likely: Some(likely(rows.len())),
        repeatable: setup.real.repeatable().len(),
        random: random.len(),
    })
}

impl Explained {
    /// Of readings, of which lengths have figures; `share` is that of the numbers by their uncertainty.
    pub(super) fn of_readings(setup: &Setup, rows: &[Observation], share: f64) -> Result<Self, Failure> {
        let figures = setup.real.figures(rows, &[])?;
        let random = setup.description.sources.iter().filter(|source| source.class != Class::Repeatable);
        Ok(Self {
            left_mean: figures.mean,
            left_rms: figures.rms,
            left_p95: figures.p95,
            left_max: figures.max,
            share,
            inside: None,
            likely: None,
            repeatable: setup.real.repeatable().len(),
            random: random.count(),
        })
    }
}

/// What is left of a row, and how far that is in units of what chance explains.
struct Judge<'a> {
    setup: &'a Setup<'a>,
    /// Random sources with the variance of their magnitudes.
    random: &'a [(usize, f64)],
}

/// The model with the magnitudes of the random sources, and room for it.
struct Room<'a> {
    model: abbe::identify::Model<'a>,
    room: abbe::identify::Room,
}

impl<'a> Judge<'a> {
    fn room(&self) -> Room<'a> {
        let magnitudes = self.random.iter().map(|(i, _)| Unknown::Magnitude(*i)).collect();
        let model = at_single_target(&self.setup.real).with(magnitudes);
        Room { room: model.room(), model }
    }

    /// `√(eᵀ C⁻¹ e)` of what is left, with `C = Σ variance · m mᵀ + σ²`, m what a source of magnitude 1 moves.
    fn judged(
        &self,
        Room { model, room }: &mut Room<'a>,
        row: &Observation,
        point: [f64; 3],
    ) -> Result<f64, Failure> {
        let (ideal, moves) = model.tool(room, row, &vec![0.0; self.random.len()])?;
        let rest: [f64; 3] = std::array::from_fn(|k| point[k] - ideal.position()[k]);
        let noise = model.uncertainty.length.powi(2) / row.weight;
        let mut covariance = [[noise, 0.0, 0.0], [0.0, noise, 0.0], [0.0, 0.0, noise]];
        for (moved, (_, variance)) in moves.iter().zip(self.random) {
            for (i, row) in covariance.iter_mut().enumerate() {
                (0..3).for_each(|j| row[j] += moved[i] * moved[j] * variance);
            }
        }
        Ok(distance(covariance, rest))
    }

    /// The distance that 95 % of the rows do not exceed where the machine is as the spec says: the same rows simulated on the
    /// exact chain, as they would be measured.
    fn edge(&self, rows: &[Observation]) -> Result<f64, Failure> {
        let step = rows.len().div_ceil(SIMULATED).max(1);
        let list: Vec<Observation> = rows.iter().step_by(step).cloned().collect();
        let mut room = self.room();
        let ideal = at_single_target(&self.setup.ideal);
        let mut ideal_room = ideal.room();
        let mut distances = Vec::new();
        for seed in 0..(SIMULATED / list.len().max(1)).max(1) as u64 {
            let noise = self.setup.real.uncertainty;
            let chance = Chance { noise, outliers: 0.0, gross: 0.0, random_sources: true, seed };
            for seen in simulate(&self.setup.real, &list, &chance)? {
                let pose_of_ideal = ideal.pose(&mut ideal_room, &seen, &[])?;
                if let Some(real) = pose(&ideal.targets, &seen.measured, &pose_of_ideal) {
                    distances.push(self.judged(&mut room, &seen, real.position())?);
                }
            }
        }
        distances.sort_by(f64::total_cmp);
        let place = (CONTENT * distances.len() as f64) as usize;
        Ok(distances.get(place).copied().unwrap_or(f64::INFINITY))
    }
}

/// `√(eᵀ C⁻¹ e)`: with the rows a, b, c of C, `det C = a · b × c`, and `C⁻¹` has the columns b × c, c × a, a × b over it.
fn distance([a, b, c]: [[f64; 3]; 3], error: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let square = (0..3).map(|i| error[i] * dot(columns[i], error)).sum::<f64>() / dot(a, columns[0]);
    square.max(0.0).sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The shares that 0.5 % of the machines are below, and 0.5 % above: quantiles of the binomial distribution.
fn likely(rows: usize) -> [f64; 2] {
    let n = rows as f64;
    if rows > 1000 {
        let half = 2.5758 * (CONTENT * (1.0 - CONTENT) / n).sqrt();
        return [CONTENT - half, CONTENT + half];
    }
    // P(k of n), from k = n down.
    let mut probability = CONTENT.powi(rows as i32);
    let (mut above, mut low, mut high) = (0.0, 0, rows);
    for k in (0..=rows).rev() {
        // So many or more.
        if above + probability < 0.005 {
            high = k.saturating_sub(1);
        }
        above += probability;
        if above <= 0.995 {
            low = k;
        }
        probability *= k as f64 / (n - k as f64 + 1.0) * (1.0 - CONTENT) / CONTENT;
    }
    [low.saturating_sub(1) as f64 / n.max(1.0), high as f64 / n.max(1.0)]
}

#[cfg(test)]
mod tests {
    use super::{distance, likely};

    /// C = diag(1, 4, 9) + 1 1ᵀ, e = (1, 2, 3): by Sherman and Morrison eᵀC⁻¹e = 3 − (11/6)²/(1 + 49/36).
    #[test]
    fn distances_are_in_units_of_the_covariance() {
        let covariance = [[2.0, 1.0, 1.0], [1.0, 5.0, 1.0], [1.0, 1.0, 10.0]];
        let expected = 3.0 - (11.0_f64 / 6.0).powi(2) / (1.0 + 49.0 / 36.0);
        assert!((distance(covariance, [1.0, 2.0, 3.0]) - expected.sqrt()).abs() < 1e-14);
    }

    /// Sums of the binomial distribution, computed apart: of 20 rows, P(≤ 15) = 0.0026 and P(≤ 16) = 0.016; P(20) = 0.36.
    #[test]
    fn likely_shares_are_those_of_the_binomial_distribution() {
        assert_eq!(likely(20), [16.0 / 20.0, 1.0]);
        let [low, high] = likely(1000);
        let [lower, higher] = likely(1001);
        assert!((low - lower).abs() < 2e-3 && (high - higher).abs() < 2e-3, "{low} {lower} {high} {higher}");
    }
}
