//! Measured points of the first and the last check, minus the predicted ones.

use abbe::identify::{Failure, Model};

use super::visits::Visits;
use abbe_study::{Residual, Residuals};

/// Returns the mean errors of each configuration and target that all checks have, in `F_0`.
/// `common` is the number of each configuration among them; `names` are those of both checks.
pub(super) fn residuals(
    model: &Model,
    [first, last]: [&Visits; 2],
    common: &[Option<usize>],
    names: [&str; 2],
) -> Result<Option<Residuals>, Failure> {
    let (before, mut rows) = (means(model, first, common)?, means(model, last, common)?);
    let is_first = std::ptr::eq(first, last);
    for (row, before) in rows.iter_mut().zip(before) {
        row.before = (!is_first).then_some(before.after);
    }
    Ok(Residuals::new((!is_first).then_some(names[0]), names[1], &rows, Residual::clone))
}

/// Returns the mean errors in one check, as errors `after`.
fn means(model: &Model, visits: &Visits, common: &[Option<usize>]) -> Result<Vec<Residual>, Failure> {
    let mut at = model.at(&vec![0.0; model.unknowns.len()]);
    let counts = visits.counts(common.len());
    let mut means: Vec<Vec<Residual>> = vec![Vec::new(); common.iter().flatten().count()];
    for (row, configuration) in visits.rows() {
        let Some(number) = common[configuration] else { continue };
        let row = visits.in_f0(row);
        let deviations = at.deviations(&row)?;
        let mean = &mut means[number];
        if mean.is_empty() {
            let point = at.pose(&row)?.position();
            mean.resize(deviations.len(), Residual::new(&row, &row.q, point, [0.0; 3]));
        }
        // Deviations are predicted minus measured.
        let share = -1.0 / f64::from(counts[configuration]);
        for (mean, deviation) in mean.iter_mut().zip(deviations) {
            mean.after = std::array::from_fn(|axis| mean.after[axis] + share * deviation[axis]);
        }
    }
    Ok(means.concat())
}
