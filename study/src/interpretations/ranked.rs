//! Interpretations in order: the fewest differences first, then the smallest residual.

use super::interpretation::Interpretation;
use super::residual::{Residual, squares};
use super::search::{Candidate, Tolerance};

/// Without noise, residuals of this share of the spread are nothing.
const ROUNDING: f64 = 1e-9;

/// Number of the others that are shown.
const OTHERS: usize = 5;

/// Interpretations in order.
pub(crate) struct Ranked {
    /// Those that fit and cannot be told apart, the simplest first.
    pub(crate) found: Vec<Candidate>,
    /// The first with less in it, where that leaves little as well, but more than noise does.
    pub(crate) simpler: Option<Candidate>,
    /// The nearest of the others.
    pub(crate) others: Vec<Candidate>,
}

/// Ranks candidates; differences are counted from the spec, and from units and format that a map states.
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
    // Whoever says what may be left is content with that.
    let is_content =
        |one: &Candidate| tolerance.within.is_some() || one.residual.both <= ROUNDING * one.spread;
    let fits = |one: &Candidate| {
        one.fits(tolerance) && (is_content(one) || !best.iter().any(|best| one.residual.is_beyond(best)))
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
    // Of those that fit, what has the poses of the first stands beside it; what has others but fits as well, too.
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
    // Not the same with more and more changes.
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

/// The smallest residual by number of fitted parameters.
fn best<'a>(candidates: impl Iterator<Item = &'a Candidate>) -> Vec<Residual> {
    let mut best: Vec<Residual> = Vec::new();
    for Candidate { residual, .. } in candidates {
        match best.iter_mut().find(|best| best.freedom == residual.freedom) {
            Some(best) if best.both <= residual.both => {}
            Some(best) => *best = *residual,
            None => best.push(*residual),
        }
    }
    best
}
