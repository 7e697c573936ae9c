//! Readings in the order in which they are believed.

use super::change::Change;
use super::residual::{Residual, squares};
use super::search::Candidate;

/// Without noise, residuals of this share of the spread are nothing.
const ROUNDING: f64 = 1e-9;

/// So many of the others are shown.
const OTHERS: usize = 5;

/// Readings in order.
pub(super) struct Ranked {
    /// Those that fit and cannot be told apart, the simplest first.
    pub(super) found: Vec<Candidate>,
    /// The first with less in it, where that leaves little as well, but more than noise does.
    pub(super) simpler: Option<Candidate>,
    /// The nearest of the others.
    pub(super) others: Vec<Candidate>,
}

pub(super) fn ranked(mut candidates: Vec<Candidate>, within: Option<f64>) -> Ranked {
    candidates.sort_by(|a, b| {
        (cost(a), a.residual.both)
            .partial_cmp(&(cost(b), b.residual.both))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let best = best(candidates.iter().filter(|one| one.fits(within)));
    // Whoever says what may be left is content with that.
    let is_content = |one: &Candidate| within.is_some() || one.residual.both <= ROUNDING * one.spread;
    let fits = |one: &Candidate| {
        one.fits(within) && (is_content(one) || !best.iter().any(|best| one.residual.is_beyond(best)))
    };
    let mut found: Vec<Candidate> = Vec::new();
    let mut others: Vec<Candidate> = Vec::new();
    for candidate in candidates {
        if !fits(&candidate) {
            others.push(candidate);
        } else if !found.iter().any(|simpler| is_part(simpler, &candidate)) {
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
        let cheapest = found.iter().map(cost).min().unwrap_or_default();
        found.retain(|one| cost(one) <= cheapest + 1 || !apart(one));
    }
    let is_simpler = |one: &&Candidate| {
        one.fits(within) && found.first().is_some_and(|first| cost(one) < cost(first) && is_part(one, first))
    };
    let simpler = others.iter().find(is_simpler).cloned();
    others.sort_by(|a, b| a.share(within).total_cmp(&b.share(within)));
    // Not the same with more and more changes.
    let mut shown: Vec<Candidate> = Vec::new();
    for candidate in others {
        if shown.len() < OTHERS && !found.iter().chain(&shown).any(|simpler| is_part(simpler, &candidate)) {
            shown.push(candidate);
        }
    }
    Ranked { found, simpler, others: shown }
}

/// Of as many fitted numbers, what leaves least.
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

fn cost(candidate: &Candidate) -> usize {
    candidate.reading.changes.iter().map(Change::cost).sum()
}

/// Whether a reading is another one with something left out.
fn is_part(simpler: &Candidate, whole: &Candidate) -> bool {
    let (a, b) = (&simpler.reading, &whole.reading);
    let same = a.joints_in_degrees == b.joints_in_degrees
        && a.slides_in == b.slides_in
        && a.lengths_in == b.lengths_in
        && a.layout == b.layout;
    same && a.changes.iter().all(|change| b.changes.iter().any(|other| change.is_like(other)))
}
