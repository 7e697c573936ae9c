//! Ranking of interpretations by number of differences, then by residual.

use super::pose_residual::{PoseResidual, squares};
use super::{Candidate, Interpretation, Tolerance};

/// Residual, as a share of the spread, below which data are free of noise.
const ROUNDING: f64 = 1e-9;

/// Number of other interpretations that are reported.
const OTHERS: usize = 5;

/// Ranked interpretations.
pub(crate) struct Ranked {
    /// Indistinguishable interpretations that fit, the simplest first.
    pub(crate) found: Vec<Candidate>,
    /// First simpler version of the best interpretation that is within the tolerance but worse than
    /// noise explains.
    pub(crate) simpler: Option<Candidate>,
    /// Nearest of the other interpretations.
    pub(crate) others: Vec<Candidate>,
}

/// Ranks candidates. Differences are counted from the spec, and from units and format stated by a
/// map.
pub(crate) fn ranked(
    mut candidates: Vec<Candidate>,
    tolerance: &Tolerance,
    stated: Option<&Interpretation>,
) -> Ranked {
    let cost = |candidate: &Candidate| candidate.interpretation.cost(stated);
    candidates.sort_by(|a, b| {
        (cost(a), a.residual.both)
            .partial_cmp(&(cost(b), b.residual.both))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let best = best(candidates.iter().filter(|one| one.fits(tolerance)));
    // With a tolerance given by the user, any residual within it is accepted.
    let is_content =
        |one: &Candidate| tolerance.within.is_some() || one.residual.both <= ROUNDING * one.spread;
    let fits = |one: &Candidate| {
        one.fits(tolerance) && (is_content(one) || !best.iter().any(|best| one.residual.exceeds(best)))
    };
    let mut found: Vec<Candidate> = Vec::new();
    let mut others: Vec<Candidate> = Vec::new();
    for candidate in candidates {
        if !fits(&candidate) {
            others.push(candidate);
        } else if !found.iter().any(|simpler| simpler.interpretation.is_part_of(&candidate.interpretation)) {
            found.push(candidate);
        }
    }
    // Of those that fit, keeps every one with the poses of the first, and others only if they are
    // about as simple.
    if let Some(first) = found.first().map(|first| first.predicted.clone()) {
        let rows = first.len() as f64;
        let apart = |one: &Candidate| {
            let [positions, _] = squares(&first, &one.predicted, false);
            (positions / rows).sqrt() > one.residual.position.max(ROUNDING * one.spread)
        };
        let cheapest = found.iter().map(&cost).min().unwrap_or_default();
        found.retain(|one| cost(one) <= cheapest + 1 || !apart(one));
    }
    let is_simpler = |one: &&Candidate| {
        one.fits(tolerance)
            && found.first().is_some_and(|first| {
                cost(one) < cost(first) && one.interpretation.is_part_of(&first.interpretation)
            })
    };
    let simpler = others.iter().find(is_simpler).cloned();
    others.sort_by(|a, b| a.share(tolerance).total_cmp(&b.share(tolerance)));
    // Leaves out candidates that only add changes to a listed one.
    let mut shown: Vec<Candidate> = Vec::new();
    for candidate in others {
        if shown.len() < OTHERS
            && !found
                .iter()
                .chain(&shown)
                .any(|simpler| simpler.interpretation.is_part_of(&candidate.interpretation))
        {
            shown.push(candidate);
        }
    }
    Ranked { found, simpler, others: shown }
}

/// Returns the smallest residual for each number of degrees of freedom.
fn best<'a>(candidates: impl Iterator<Item = &'a Candidate>) -> Vec<PoseResidual> {
    let mut best: Vec<PoseResidual> = Vec::new();
    for Candidate { residual, .. } in candidates {
        match best.iter_mut().find(|best| best.freedom == residual.freedom) {
            Some(best) if best.both <= residual.both => {}
            Some(best) => *best = *residual,
            None => best.push(*residual),
        }
    }
    best
}
