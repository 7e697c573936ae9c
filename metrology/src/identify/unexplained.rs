//! Position errors that an identified model does not explain, as random sources of its spec.

use abbe::identify::{Failure, Observation, Unknown};
use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{number, quantity};

use super::{FoundModel, Setup, Solved, spec_writer::DIGITS};
use crate::acceptance::ONE_SIDED_95;
use abbe_study::calibration::random_sources;

/// Largest number of rows at which the random sources are evaluated.
const EVALUATED: usize = 500;

/// Returns the standard deviation along each axis of the position errors that neither the model,
/// nor the instrument, nor the random sources of the spec explain, and whether these sources
/// explain what the instrument does not. Returns 0 if all is explained with 95 % confidence, or if
/// no positions were measured.
///
/// ```text
/// s² = rms²/3 · n/(n − p) − σ² − Σ_k |u_k|²/3
/// ```
///
/// with the root mean square `rms` of the position residuals, n numbers, p fitted parameters, the
/// uncertainty σ of a coordinate, and the displacements u_k of the tool point by one standard
/// deviation of the random sources. The last two are means over the rows.
pub(super) fn unexplained(
    setup: &Setup,
    Solved { model, fit, .. }: &Solved,
    rows: &[Observation],
    rms: f64,
) -> Result<(f64, bool), Failure> {
    let kept: Vec<&Observation> = fit.kept(rows).collect();
    let numbers = kept.iter().map(|row| row.count()).sum::<usize>();
    let freedom = numbers.saturating_sub(fit.identifiable.rank) as f64;
    if !model.observables.is_empty() || freedom == 0.0 {
        return Ok((0.0, false));
    }
    let left = rms * rms / 3.0 * numbers as f64 / freedom;
    let inverse_weights = kept.iter().map(|row| 1.0 / row.weight).sum::<f64>() / kept.len() as f64;
    let instrument = model.uncertainty.length.powi(2) * inverse_weights;
    let known = instrument + random_variance(setup, &kept)? / 3.0;
    // The mean of ν squares of normal numbers has the standard deviation √(2/ν).
    let is_beyond = |known: f64| left > known * (1.0 + ONE_SIDED_95 * (2.0 / freedom).sqrt());
    Ok(if is_beyond(known) { ((left - known).sqrt(), false) } else { (0.0, is_beyond(instrument)) })
}

/// Returns the mean variance of the tool point caused by the random sources.
fn random_variance(setup: &Setup, rows: &[&Observation]) -> Result<f64, Failure> {
    // The fit has found the values of tolerances.
    let random = random_sources(setup.description);
    let model = setup.real.with(random.iter().map(|(source, _)| Unknown::Magnitude(*source)).collect());
    let mut at = model.at(&vec![0.0; random.len()]);
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for row in rows.iter().step_by(rows.len().div_ceil(EVALUATED).max(1)) {
        let (_, moves) = at.tool(row)?;
        let variances = moves.iter().zip(&random);
        sum += variances
            .map(|(moved, (_, variance))| variance * moved.iter().map(|row| row * row).sum::<f64>())
            .sum::<f64>();
        count += 1.0;
    }
    Ok(sum / count.max(1.0))
}

/// Returns the indices of the sources whose values are unknown, random ones and tolerances, with
/// the variances of their magnitudes.
pub(crate) fn unknown_sources(setup: &Setup) -> Vec<(usize, f64)> {
    let sources = setup.description.sources.iter().enumerate();
    sources
        .filter_map(|(i, source)| Some((i, 1.0 / source.class.distribution()?.divisor_squared())))
        .collect()
}

impl FoundModel {
    /// Returns the random sources of the errors that the model does not explain, one along each
    /// axis; empty if it explains all.
    pub(super) fn unexplained_sources(&self, spec: &Spec) -> String {
        if self.unexplained == 0.0 {
            return String::new();
        }
        let frame = spec.frames.get(spec.tool_frame).map_or("", |frame| frame.name.as_str());
        let size = quantity(number(self.unexplained, DIGITS), spec.length.symbol());
        let source = |axis: &str| {
            let keys = TableText::default().text("class", "random").text("distribution", "normal");
            let keys = keys.text("frame", frame).key(&format!("e_{axis}"), &size);
            let what = "Position errors of the fitted rows beyond the instrument and the random sources";
            self.source(spec, &format!("not identified, {axis}"), what, keys).to_string()
        };
        ["x", "y", "z"].map(source).concat()
    }
}
