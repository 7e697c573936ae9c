//! Gross errors: rows far from a fit that they cannot pull at.

use abbe::identify::{Fit, Loss, Measurement, Model, Observation, Options, fit, robust_scale};

use crate::data::Data;

/// The most rows on which gross errors are looked for.
const ROWS: usize = 400;

/// What is to be said of gross errors, if a plain fit, or that there is none, looks as if there were any.
pub(super) fn warning(model: &Model, data: &Data, plain: Option<&Fit>) -> Option<String> {
    let rows = &data.observations;
    if let Some(plain) = plain {
        let distances = model.all_distances(rows, &plain.x).ok()?;
        let mut all = distances.into_values();
        let rms = (all.iter().map(|d| d * d).sum::<f64>() / all.len().max(1) as f64).sqrt();
        // Norms of Gaussian errors: the root mean square is 1.13 / 0.6745⁻¹ times that scale, about 0.76.
        if rms < 1.6 * robust_scale(&mut all) {
            return None;
        }
    }
    let part: Vec<Observation> = rows.iter().step_by(rows.len().div_ceil(ROWS).max(1)).cloned().collect();
    let priors = model.priors(0.01).ok()?;
    let robust = fit(model, &part, &Options { loss: Loss::Tukey, priors, ..Options::default() }).ok()?;
    // Of several instruments, the one that is worst.
    let lengths = model.readings.iter().filter(|reading| !reading.gauge.is_angle());
    let length = lengths.map(|reading| reading.uncertainty).reduce(f64::max);
    let bound = 10.0 * robust.sigma * length.unwrap_or(model.uncertainty.length);
    let mut room = model.room();
    let mut wrong = Vec::new();
    for row in rows {
        let distances = model.distances(&mut room, row, &robust.x).ok()?;
        wrong.extend(distances.iter().any(|distance| *distance > bound).then_some(row.line));
    }
    let poses = rows.iter().any(|row| matches!(row.measured, Measurement::Pose(_)));
    if wrong.is_empty() || poses && wrong.len() == rows.len() {
        return None;
    }
    Some(format!(
        "{} of {} rows lie more than ten standard deviations from a fit that leaves them out (lines {}); \
         `--robust tukey` does without them",
        wrong.len(),
        rows.len(),
        shown_lines(&wrong)
    ))
}

/// The first lines of a list, and how many more there are.
pub fn shown_lines(lines: &[u64]) -> String {
    let shown = lines.iter().take(12).map(u64::to_string).collect::<Vec<_>>().join(", ");
    if lines.len() > 12 { format!("{shown} and {} more", lines.len() - 12) } else { shown }
}
