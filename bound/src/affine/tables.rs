//! Table lookups of affine forms: piecewise polynomials, each over the part of it that is reached.

use abbe_core::LookupTable;
use abbe_spec::expr::{Extrapolation, Interpolation, Table};

use super::form::{Affine, UNIT, above};

impl<const N: usize> Affine<N> {
    /// Returns a derivative of a table; order 0 is the table itself.
    pub(crate) fn look_up(&self, table: &Table, order: u32) -> Self {
        let [first, last] = table.ends();
        // A table often ends where a joint ends: only the rounding of the enclosure, by
        // `above` and the halves of boxes, is beyond it.
        let margin = 256.0 * UNIT * (self.centre.abs() + self.radius());
        let range = self.range();
        let is_inside = range[0] >= first - margin && range[1] <= last + margin;
        let range = if is_inside { range.map(|end| end.clamp(first, last)) } else { range };
        let centre = if is_inside { self.centre.clamp(first, last) } else { self.centre };
        let is_known = table.outside == Extrapolation::Hold || is_inside;
        if !(range[0].is_finite() && range[1].is_finite() && is_known) {
            return Self::anything();
        }
        // The slope jumps at the end of a table that holds its value.
        let is_continuous =
            order == 0 || (order == 1 && table.interpolation == Interpolation::Cubic && is_inside);
        if !is_continuous {
            let [low, high] = extent(table, order, range);
            return Self::between(low, high);
        }
        let at = extent(table, order, [centre; 2]);
        let slopes = extent(table, order + 1, range);
        let value = 0.5 * at[0] + 0.5 * at[1];
        let form = self.by_slopes(value, slopes);
        Self { rest: above(form.rest + 0.5 * (at[1] - at[0])), ..form }
    }
}

/// Returns an enclosure of a derivative over an interval: the hull over all pieces that it meets.
fn extent(table: &Table, order: u32, [low, high]: [f64; 2]) -> [f64; 2] {
    let lookup = table.lookup();
    let (first, last) = (piece_of(&lookup, low), piece_of(&lookup, high));
    let ends = lookup.pieces.len() - 1;
    // Rounding may select the neighbouring piece, so one more piece is included on each side.
    let from = if low < table.ends()[0] { 0 } else { first.saturating_sub(1).max(1) };
    let to = if high > table.ends()[1] { ends } else { (last + 1).min(ends - 1) };
    let mut hull = [f64::INFINITY, f64::NEG_INFINITY];
    for k in from..=to {
        let is_beyond = k == 0 || k == ends;
        let [start, length] = if is_beyond { [0.0, 0.0] } else { place(&lookup, table, k) };
        let unit = lookup.unit();
        let far = UNIT * 16.0 * (low.abs().max(high.abs()) + start.abs()) * unit;
        let [from, to] = [(low - start) * unit - far, (high - start) * unit + far];
        let (from, to) = if is_beyond { (0.0, 0.0) } else { (from.max(-far), to.min(length + far)) };
        if from > to {
            continue;
        }
        let [least, largest] = polynomial(&lookup.pieces[k], order, [from, to], unit);
        hull = [hull[0].min(least), hull[1].max(largest)];
    }
    hull
}

fn piece_of(lookup: &LookupTable<'_>, x: f64) -> usize {
    let bucket = lookup.bucket(x);
    if lookup.starts.is_empty() {
        bucket.min(lookup.pieces.len() - 1)
    } else {
        lookup.knots.iter().skip(1).position(|knot| x <= *knot).unwrap_or(lookup.knots.len() - 1)
    }
}

/// Returns the start of a piece, and its length in units of t.
fn place(lookup: &LookupTable<'_>, table: &Table, piece: usize) -> [f64; 2] {
    if lookup.starts.is_empty() {
        return [lookup.first + (piece - 1) as f64 / lookup.scale, 1.0];
    }
    let points = &table.points;
    [points[piece - 1][0], points[piece][0] - points[piece - 1][0]]
}

/// Returns an enclosure of a derivative of a cubic between two t, by its Taylor expansion about
/// their midpoint.
fn polynomial(coefficients: &[f64; 4], order: u32, [from, to]: [f64; 2], unit: f64) -> [f64; 2] {
    let [a, b, c, d] = *coefficients;
    let [p, q, r, s] = match order {
        0 => [a, b, c, d],
        1 => [b, 2.0 * c, 3.0 * d, 0.0],
        2 => [2.0 * c, 6.0 * d, 0.0, 0.0],
        3 => [6.0 * d, 0.0, 0.0, 0.0],
        _ => [0.0; 4],
    };
    let (t, h) = (0.5 * (from + to), 0.5 * (to - from));
    let value = p + t * (q + t * (r + t * s));
    let slopes = [q + t * (2.0 * r + 3.0 * t * s), r + 3.0 * t * s, s];
    let far = slopes.iter().rev().fold(0.0, |sum, slope| h * (slope.abs() + sum));
    let size = 1.0 + t.abs() + h;
    let all = p.abs() + size * (q.abs() + size * (r.abs() + size * s.abs()));
    let factor = unit.powi(order as i32);
    let margin = above(far + 64.0 * UNIT * all) * factor * (1.0 + 16.0 * UNIT);
    let value = value * factor;
    [value - margin - 16.0 * UNIT * value.abs(), value + margin + 16.0 * UNIT * value.abs()]
}
