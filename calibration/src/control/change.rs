//! Change-point estimation: time, kind and size of a change in a series.

use abbe_analysis::student_95;
use nalgebra::{Matrix3, Vector3};

/// Kind of change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Linear drift.
    Drift,
    /// Step to another level.
    Jump,
    /// Step to another level and back.
    Excursion,
}

/// Change of a level: `x = level + speed · max(0, t − since)`, or `x = level + jump` from `since`
/// on, until it is back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Kind of change.
    pub kind: Kind,
    /// Start of a drift; first number after a jump.
    pub since: f64,
    /// First number after the return of an excursion.
    pub until: Option<f64>,
    /// 95 % confidence interval of the time; an open lower end precedes the series.
    pub between: [Option<f64>; 2],
    /// Level before the change.
    pub level: f64,
    /// Speed of a drift, or size of a jump.
    pub size: f64,
    /// Standard deviation of the size, including the uncertainty of the time.
    pub standard_deviation: f64,
    /// Standard deviation of the numbers about the fit.
    pub scatter: f64,
    /// Decrease of the sum of squares relative to a constant level.
    pub explained: f64,
    /// Covariance of time and speed of a drift.
    covariance: [[f64; 2]; 2],
}

/// Candidate change point and its sum of squares.
#[derive(Clone, Copy)]
struct Fitted {
    at: f64,
    level: f64,
    size: f64,
    squares: f64,
}

/// Candidate times of a drift between consecutive numbers.
const BETWEEN: usize = 4;

impl Change {
    /// Fits a drift, a jump and an excursion to the numbers `x` at ascending times `t`, and returns
    /// the most likely one; none for fewer than six numbers, or if all are equal.
    ///
    /// Least squares over all candidate times. An excursion has a time more: its likelihood must be
    /// n times as large. The confidence interval has the times whose sum of
    /// squares exceeds the minimum by no more than `F_{1,n−3}` (95 %) times the variance.
    pub fn fit(t: &[f64], x: &[f64]) -> Option<Self> {
        let n = t.len().min(x.len());
        if n < 6 {
            return None;
        }
        let (t, x) = (&t[..n], &x[..n]);
        let mean = x.iter().sum::<f64>() / n as f64;
        let without: f64 = x.iter().map(|x| (x - mean).powi(2)).sum();
        let (drifts, jumps) = (drifts(t, x), jumps(t, x));
        let least = |all: &[Fitted]| all.iter().copied().min_by(|a, b| a.squares.total_cmp(&b.squares));
        let (drift, jump) = (least(&drifts)?, least(&jumps)?);
        let (mut kind, mut best, mut all, mut until) = match drift.squares <= jump.squares {
            true => (Kind::Drift, drift, drifts, None),
            false => (Kind::Jump, jump, jumps, None),
        };
        if let Some((back, excursion)) = excursion(t, x, mean)
            && best.squares / excursion.squares.max(1e-24 * without) > f64::powf(n as f64, 2.0 / n as f64)
        {
            (kind, best, all, until) = (Kind::Excursion, excursion, vec![excursion], Some(back));
        }
        if best.squares.is_nan() || without <= 0.0 {
            return None;
        }
        let freedom = n - 3 - usize::from(until.is_some());
        let variance = best.squares / freedom as f64;
        let bound = best.squares + variance * student_95(freedom as f64).powi(2);
        let within = |fitted: &&Fitted| fitted.squares <= bound;
        let first = all.iter().find(within).map_or(best.at, |fitted| fitted.at);
        let last = all.iter().rev().find(within).map_or(best.at, |fitted| fitted.at);
        let earliest = until.is_some() || all.first().is_none_or(|fitted| first > fitted.at);
        // A jump occurs after the preceding number.
        let first = match kind {
            Kind::Drift => first,
            _ => t.iter().copied().rev().find(|t| *t < first).unwrap_or(first),
        };
        let covariance = covariance(kind, &best, until, t, variance);
        Some(Self {
            kind,
            since: best.at,
            until,
            between: [earliest.then_some(first), Some(last)],
            level: best.level,
            size: best.size,
            standard_deviation: covariance[1][1].sqrt(),
            scatter: variance.sqrt(),
            explained: without - best.squares,
            covariance,
        })
    }

    /// Returns the time at which a drift reaches a distance from the level, and its standard
    /// deviation; none for other changes.
    pub fn reaches(&self, distance: f64) -> Option<(f64, f64)> {
        let speed = self.size.abs();
        if self.kind != Kind::Drift || speed <= 0.0 {
            return None;
        }
        // t = since + d/|v|: ∂t/∂v = −d/(v |v|).
        let by_speed = -distance / (self.size * speed);
        let [[time, both], [_, size]] = self.covariance;
        let variance = time + 2.0 * by_speed * both + by_speed * by_speed * size;
        Some((self.since + distance / speed, variance.max(0.0).sqrt()))
    }

    /// Returns the predicted change at a time, relative to the level before.
    pub fn moved(&self, at: f64) -> f64 {
        match self.kind {
            Kind::Drift => self.size * (at - self.since).max(0.0),
            _ if at >= self.since && self.until.is_none_or(|until| at < until) => self.size,
            _ => 0.0,
        }
    }
}

/// Fits `x ≈ level + size · g`.
fn fitted(at: f64, x: &[f64], g: impl Fn(usize) -> f64) -> Fitted {
    let n = x.len() as f64;
    let (mut sum_g, mut sum_x) = (0.0, 0.0);
    for (i, x) in x.iter().enumerate() {
        (sum_g, sum_x) = (sum_g + g(i), sum_x + x);
    }
    let (mean_g, mean_x) = (sum_g / n, sum_x / n);
    let (mut gg, mut gx) = (0.0, 0.0);
    for (i, x) in x.iter().enumerate() {
        let away = g(i) - mean_g;
        (gg, gx) = (gg + away * away, gx + away * (x - mean_x));
    }
    let size = if gg > 0.0 { gx / gg } else { 0.0 };
    let level = mean_x - size * mean_g;
    let squares = x.iter().enumerate().map(|(i, x)| (x - level - size * g(i)).powi(2)).sum();
    Fitted { at, level, size, squares }
}

/// Fits drifts that begin at the first number or later, with at least three numbers left.
fn drifts(t: &[f64], x: &[f64]) -> Vec<Fitted> {
    let steps = (0..t.len() - 3).flat_map(|i| (0..BETWEEN).map(move |part| (i, part)));
    let times = steps.map(|(i, part)| t[i] + (t[i + 1] - t[i]) * part as f64 / BETWEEN as f64);
    times.map(|at| fitted(at, x, |i| (t[i] - at).max(0.0))).collect()
}

/// Fits jumps between consecutive numbers, with at least one number on either side.
fn jumps(t: &[f64], x: &[f64]) -> Vec<Fitted> {
    (1..t.len()).map(|first| fitted(t[first], x, |i| f64::from(u8::from(i >= first)))).collect()
}

/// Fits the excursion that explains most, and returns the time of its return with it.
///
/// With the mean x̄ of all n numbers, m numbers of sum s elsewhere explain
/// `(s − m x̄)² / (m (1 − m/n))`.
fn excursion(t: &[f64], x: &[f64], mean: f64) -> Option<(f64, Fitted)> {
    let n = x.len();
    let mut explained: Option<(f64, usize, usize)> = None;
    for first in 1..n - 1 {
        let mut sum = 0.0;
        for (end, x) in (first + 1..n).zip(&x[first..]) {
            sum += x - mean;
            let m = (end - first) as f64;
            let here = sum * sum / (m * (1.0 - m / n as f64));
            if explained.is_none_or(|(most, ..)| here > most) {
                explained = Some((here, first, end));
            }
        }
    }
    let (_, first, end) = explained?;
    let is_away = |i: usize| f64::from(u8::from((first..end).contains(&i)));
    Some((t[end], fitted(t[first], x, is_away)))
}

/// Returns the covariance of time and size, from the derivatives of `level + size · g` with respect
/// to all three.
fn covariance(kind: Kind, best: &Fitted, until: Option<f64>, t: &[f64], variance: f64) -> [[f64; 2]; 2] {
    let mut normal = Matrix3::<f64>::zeros();
    for t in t {
        let row = match kind {
            Kind::Drift if *t > best.at => Vector3::new(1.0, -best.size, t - best.at),
            Kind::Jump | Kind::Excursion if *t >= best.at && until.is_none_or(|until| *t < until) => {
                Vector3::new(1.0, 0.0, 1.0)
            }
            _ => Vector3::new(1.0, 0.0, 0.0),
        };
        normal += row * row.transpose();
    }
    // A jump has no derivative by its time, and a drift from the first number on does not determine
    // its level.
    let from_the_first = t.iter().filter(|t| **t <= best.at).count() < 2;
    if kind != Kind::Drift || from_the_first {
        normal.fill_row(1, 0.0);
        normal.fill_column(1, 0.0);
        normal[(1, 1)] = 1e300;
    }
    let inverse = normal.try_inverse().unwrap_or(Matrix3::repeat(f64::INFINITY)) * variance;
    [[inverse[(1, 1)], inverse[(1, 2)]], [inverse[(2, 1)], inverse[(2, 2)]]]
}

#[cfg(test)]
mod tests;
