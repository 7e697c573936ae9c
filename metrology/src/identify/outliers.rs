//! Gross errors: rows far from a robust fit.

use abbe::identify::{Fit, Loss, Measurement, Model, Observation, Options, fit, robust_scale};
use abbe_spec::option::ROBUST_TUKEY;

use super::priors::Prior;
use crate::data::Data;

/// Largest number of rows for the robust fit.
const ROWS: usize = 400;

/// Returns a warning of gross errors if the plain fit failed or its residuals suggest them.
pub(super) fn warning(model: &Model, data: &Data, plain: Option<&Fit>) -> Option<String> {
    let rows = &data.observations;
    if let Some(plain) = plain {
        let distances = model.all_distances(rows, &plain.x).ok()?;
        let mut all = distances.into_values();
        let rms = (all.iter().map(|d| d * d).sum::<f64>() / all.len().max(1) as f64).sqrt();
        // For norms of Gaussian errors, the root mean square is 1.13 times the median and 0.76 of
        // the robust scale.
        if rms < 1.6 * robust_scale(&mut all) {
            return None;
        }
    }
    let part: Vec<Observation> = rows.iter().step_by(rows.len().div_ceil(ROWS).max(1)).cloned().collect();
    let priors = model.priors(Prior::DEFAULT_SHARE).ok()?;
    let robust = fit(model, &part, &Options { loss: Loss::Tukey, priors, ..Options::default() }).ok()?;
    // With several instruments, the largest uncertainty counts.
    let lengths = model.observables.iter().filter(|reading| !reading.kind.is_angle && model.camera.is_none());
    let length = lengths.map(|reading| reading.uncertainty).reduce(f64::max);
    let bound = 10.0 * robust.sigma * length.unwrap_or(model.uncertainty.length);
    let mut at = model.at(&robust.x);
    let mut wrong = Vec::new();
    for row in rows {
        let distances = at.distances(row).ok()?;
        wrong.extend(distances.iter().any(|distance| *distance > bound).then_some(row.line));
    }
    let poses = rows.iter().any(|row| matches!(row.measured, Measurement::Pose(_)));
    if wrong.is_empty() || poses && wrong.len() == rows.len() {
        return None;
    }
    Some(format!(
        "{} of {} rows lie more than ten standard deviations from a fit without them (lines {}); \
         `{ROBUST_TUKEY}` rejects outliers",
        wrong.len(),
        rows.len(),
        shown_lines(&wrong)
    ))
}

/// Formats the first twelve lines of a list, and the number of further ones.
pub fn shown_lines(lines: &[u64]) -> String {
    let shown = lines.iter().take(12).map(u64::to_string).collect::<Vec<_>>().join(", ");
    if lines.len() > 12 { format!("{shown} and {} more", lines.len() - 12) } else { shown }
}
