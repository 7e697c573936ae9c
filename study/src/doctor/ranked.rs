//! Readings in the order in which they are believed.

use super::change::Change;
use super::residual::squares;
use super::search::Candidate;

/// Residuals within this factor of the least are alike: what noise makes of few rows.
const ALIKE: f64 = 1.5;

/// Without noise, residuals of this share of the spread are nothing.
const ROUNDING: f64 = 1e-9;

/// So many of the others are shown.
const OTHERS: usize = 5;

/// Readings that fit and cannot be told apart, the simplest first; and the nearest of the others.
pub(super) fn ranked(
    mut candidates: Vec<Candidate>,
    within: Option<f64>,
) -> (Vec<Candidate>, Vec<Candidate>) {
    candidates.sort_by(|a, b| {
        (cost(a), a.residual.both)
            .partial_cmp(&(cost(b), b.residual.both))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let fitting = candidates.iter().filter(|one| one.fits(within));
    let least = fitting.map(|one| one.residual.both).fold(f64::INFINITY, f64::min);
    let fits =
        |one: &Candidate| one.fits(within) && one.residual.both <= ALIKE * least + ROUNDING * one.spread;
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
    others.sort_by(|a, b| a.residual.both.total_cmp(&b.residual.both));
    // Not the same with more and more changes.
    let mut shown: Vec<Candidate> = Vec::new();
    for candidate in others {
        if shown.len() < OTHERS && !found.iter().chain(&shown).any(|simpler| is_part(simpler, &candidate)) {
            shown.push(candidate);
        }
    }
    (found, shown)
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
