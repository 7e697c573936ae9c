//! Variance of the fit between regions of joint space and between runs of rows, in its covariance.

use abbe::identify::{BetweenBlocks, Failure, Folds, between_blocks};

use super::{BLOCKS, Solved, diagnose};
use crate::data::Data;
use abbe_study::{Result, number::digits};

/// Largest probability by chance at which a variance between blocks is included.
const CHANCE: f64 = 0.01;

/// Includes the variance between regions, or between runs of rows, in the covariance of the fit, if
/// it is larger than that of independent configurations, with a note. The larger one counts.
pub(super) fn include_between_blocks(solved: &mut Solved, data: &Data) -> Result<()> {
    let Solved { model, fit, .. } = &*solved;
    let rows = &data.observations;
    let kinds = [
        ("of the same region of joint space", Folds::by_region(rows, BLOCKS)),
        ("that follow each other", Folds::by_order(rows, BLOCKS)),
    ];
    let found =
        kinds.into_iter().map(|(kind, blocks)| Ok((kind, between_blocks(model, rows, fit, &blocks)?)));
    let found = found.collect::<Result<Vec<_>, Failure>>().map_err(|failure| diagnose(&failure, data))?;
    let found = found.into_iter().filter_map(|(kind, between)| Some((kind, between?)));
    let larger = found.filter(|(_, between)| between.p < CHANCE && between.factor > 1.0);
    let largest = larger.max_by(|(_, a), (_, b)| a.factor.total_cmp(&b.factor));
    let Some((kind, BetweenBlocks { factor, freedom, covariance, .. })) = largest else { return Ok(()) };
    solved.fit.covariance = covariance;
    solved.fit.coverage_freedom = solved.fit.coverage_freedom.min(freedom).max(1.0);
    solved.notes.push(format!(
        "note: residuals of rows {kind} agree. Standard deviations include it: they are {} times those \
         of independent rows",
        digits(factor, 2)
    ));
    Ok(())
}
