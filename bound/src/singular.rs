//! Certified bounds of the least or the largest singular value of a matrix of nodes over a box.

use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::Symbol;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::affine::{Affine, above};
use crate::search::{Effort, MOST_MOVING, Moving, Progress, Queue, Watch, of_all, still};
use crate::search_box::centres;
use crate::{Tape, period};

/// Number of boxes bisected in a round, for any number of threads.
const ROUND: usize = 64;
/// Singular values below this fraction of the matrix norm are taken as 0.
const NOTHING: f64 = 1e-9;
/// Bound of the error of computed singular values and vectors, relative to the matrix norm:
/// thousands of roundings.
const DECOMPOSED: f64 = 1e-12;

/// The singular value to bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The least singular value of the matrix, minimized over the box.
    Least,
    /// The largest singular value of the matrix, maximized over the box.
    Largest,
}

/// Certified enclosure of a singular value: between `certified` and `found`.
#[derive(Clone, Debug, PartialEq)]
pub struct Singular {
    /// Lower bound of the least singular value (0 if none is known), or upper bound of the largest
    /// one (infinite if none is known).
    pub certified: f64,
    /// Singular value at `at`; `None` if the matrix was not finite at any examined point.
    pub found: Option<f64>,
    /// Value of each name at the found singular value.
    pub at: Vec<f64>,
    /// Number of boxes examined.
    pub boxes: usize,
    /// `true` if the gap was reached, or if `found` is negligible.
    pub complete: bool,
}

/// Bounds a singular value of a matrix with at most as many rows as columns, over the box of the
/// moving names with all other symbols `fixed`.
///
/// Within a box, let C be the centre of A as an affine form, u the left singular vector of C's
/// least singular value, `a = uᵀ A`, and B the rows of A along the other left singular vectors.
/// Then, with `‖a‖ ≥ α`, no singular value of B below β and `‖B aᵀ‖ ≤ κ`,
///
/// ```text
/// A Aᵀ has no eigenvalue below   ½ (α² + β² − √((α² − β²)² + 4 κ²))
/// ```
///
/// For C itself κ is 0, so the bound converges with the square of the box size. Where it gives
/// nothing, the least singular value of C minus ‖A − C‖ is used. With u of the largest singular
/// value, `‖a‖ ≤ α` and no singular value of B above β, no singular value exceeds `½ (α² + β² +
/// √((α² − β²)² + 4 κ²))`, nor the largest singular value of C plus ‖A − C‖.
pub fn singular_value(
    extreme: Extreme,
    graph: &Graph,
    rows: &[Vec<Node>],
    moving: &[Moving],
    fixed: &dyn Fn(Symbol) -> f64,
    effort: &Effort,
    watch: &mut Watch<'_>,
) -> Singular {
    let entries = rows.concat();
    let depends = graph.symbols(&entries);
    let is_active = |name: &Moving| depends.contains(&name.symbol) && name.range[0] < name.range[1];
    let active: Vec<Moving> = moving.iter().copied().filter(is_active).collect();
    let symbols: Vec<Symbol> = active.iter().map(|name| name.symbol).collect();
    let still = |symbol: Symbol| still(moving, fixed, symbol);
    let search = Search {
        extreme,
        matrix: Tape::new(graph, &entries, &symbols, still),
        rows: rows.len(),
        domain: active
            .iter()
            .map(|name| match entries.iter().all(|entry| period::is_angle(graph, *entry, name.symbol)) {
                true => period::once_around(name.range),
                false => name.range,
            })
            .collect(),
        effort: *effort,
    };
    let singular = match active.len() {
        0..=4 => search.run::<4>(watch),
        5..=6 => search.run::<6>(watch),
        7..=8 => search.run::<8>(watch),
        9..=16 => search.run::<16>(watch),
        _ => search.run::<MOST_MOVING>(watch),
    };
    Singular { at: of_all(moving, is_active, &singular.at), ..singular }
}

struct Search {
    extreme: Extreme,
    matrix: Tape,
    rows: usize,
    domain: Vec<[f64; 2]>,
    effort: Effort,
}

/// A box that may contain the value.
struct Candidate {
    low: Vec<f64>,
    high: Vec<f64>,
    /// Lower bound of the signed value within the box.
    least: f64,
    /// Name to bisect.
    split: usize,
}

/// Result of examining a box.
struct Look {
    /// Lower bound of the signed value within the box.
    least: f64,
    split: usize,
    /// Least signed value at a point of the box, that point, and the norm of the matrix.
    found: f64,
    at: Vec<f64>,
    size: f64,
}

impl Search {
    fn run<const N: usize>(&self, watch: &mut Watch<'_>) -> Singular {
        let [low, high] = [0, 1].map(|end| self.domain.iter().map(|range| range[end]).collect::<Vec<_>>());
        // The search minimizes the signed value.
        let (mut found, mut at, mut boxes) = (f64::INFINITY, low.clone(), 0);
        let (mut open, mut waiting) =
            (vec![Candidate { low, high, least: self.unknown(), split: 0 }], Queue::default());
        // Lower bound over boxes that cannot be bisected.
        let mut left = f64::INFINITY;
        loop {
            let looks: Vec<Look> = open
                .par_iter()
                .map_init(Vec::<Affine<N>>::new, |registers, candidate| self.look(registers, candidate))
                .collect();
            let mut size = 0.0_f64;
            for (candidate, look) in open.drain(..).zip(looks) {
                boxes += 1;
                size = size.max(look.size);
                if look.found < found {
                    (found, at) = (look.found, look.at);
                }
                let least = candidate.least.max(look.least);
                waiting.push(least, Candidate { least, split: look.split, ..candidate });
            }
            let least = waiting.first().map_or(f64::INFINITY, |candidate: &Candidate| candidate.least);
            let least = least.min(left).min(found);
            let allowed = (self.effort.gap * found.abs()).max(NOTHING * size);
            let complete = found.is_finite() && found - least <= allowed;
            let [shown, certified] = [found, least].map(|value| self.sign() * value);
            let is_enough = complete || boxes >= self.effort.boxes;
            let is_enough = is_enough || !watch(&Progress { found: shown, certified, boxes });
            while open.len() < 2 * ROUND
                && !is_enough
                && let Some(candidate) = waiting.pop()
            {
                let middle = candidate
                    .low
                    .get(candidate.split)
                    .map(|low| 0.5 * low + 0.5 * candidate.high[candidate.split]);
                match middle {
                    Some(middle)
                        if candidate.low[candidate.split] < middle
                            && middle < candidate.high[candidate.split] =>
                    {
                        open.extend(candidate.halves(middle));
                    }
                    _ => left = left.min(candidate.least),
                }
            }
            if open.is_empty() {
                let found = Some(shown).filter(|found| found.is_finite());
                return Singular { certified, found, at, boxes, complete };
            }
        }
    }

    /// Returns the sign by which singular values are multiplied, so that the search always
    /// minimizes.
    fn sign(&self) -> f64 {
        match self.extreme {
            Extreme::Least => 1.0,
            Extreme::Largest => -1.0,
        }
    }

    /// Returns the lower bound of signed values that always holds.
    fn unknown(&self) -> f64 {
        match self.extreme {
            Extreme::Least => 0.0,
            Extreme::Largest => f64::NEG_INFINITY,
        }
    }

    /// Returns the singular values, the one to bound first, and their left vectors.
    fn sorted(&self, matrix: DMatrix<f64>) -> (Vec<f64>, Vec<Vec<f64>>) {
        let svd = matrix.svd(true, false);
        let columns = svd.u.iter().flat_map(|u| {
            u.column_iter().map(|column| column.iter().copied().collect::<Vec<_>>()).collect::<Vec<_>>()
        });
        let mut both: Vec<(f64, Vec<f64>)> = svd.singular_values.iter().copied().zip(columns).collect();
        both.sort_by(|(a, _), (b, _)| (self.sign() * a).total_cmp(&(self.sign() * b)));
        both.into_iter().unzip()
    }

    /// Returns the signed value at a point; infinite if the matrix is not finite there.
    fn value_at(&self, at: &[f64]) -> f64 {
        let (forms, _) = self.matrix.evaluate::<0>(&mut Vec::new(), at, &vec![0.0; at.len()]);
        // The centre of an unbounded entry has no meaning.
        if !forms.iter().all(|form| form.centre.is_finite() && form.radius().is_finite()) {
            return f64::INFINITY;
        }
        let entries: Vec<f64> = forms.iter().map(|form| form.centre).collect();
        let matrix = DMatrix::from_row_slice(self.rows, entries.len() / self.rows, &entries);
        self.sign() * self.sorted(matrix).0[0]
    }

    fn look<const N: usize>(&self, registers: &mut Vec<Affine<N>>, candidate: &Candidate) -> Look {
        let (centres, halves) = centres(&candidate.low, &candidate.high);
        let longest = || (0..centres.len()).max_by(|i, j| halves[*i].total_cmp(&halves[*j])).unwrap_or(0);
        let (forms, _) = self.matrix.evaluate(registers, &centres, &halves);
        let count = forms.len() / self.rows;
        let entry = |i: usize, j: usize| &forms[i * count + j];
        let middle = DMatrix::from_fn(self.rows, count, |i, j| entry(i, j).centre);
        if middle.iter().any(|entry| !entry.is_finite()) {
            let least = self.unknown();
            return Look { least, split: longest(), found: f64::INFINITY, at: centres, size: 0.0 };
        }
        let size = middle.norm();
        let spread = above(forms.iter().map(|form| form.radius() * form.radius()).sum()).sqrt();
        let (values, vectors) = self.sorted(middle);
        let rows: Vec<Vec<Affine<N>>> = vectors
            .iter()
            .map(|u| (0..count).map(|j| combined(u, (0..self.rows).map(|i| entry(i, j)))).collect())
            .collect();
        let (first, others) = (&rows[0], &rows[1..]);
        let square = product(first, first);
        let mixed: Vec<f64> = others.iter().map(|row| farthest(&product(row, first))).collect();
        let mixed = above(mixed.iter().map(|size| size * size).sum());
        let least = self.least(&values, spread, square.range(), mixed, DECOMPOSED * size);

        // The slopes of a name with unbounded influence are 0.
        let moved = |k: usize| match forms.iter().map(|form| form.slopes[k] * form.slopes[k]).sum() {
            0.0 if halves[k] > 0.0 => f64::INFINITY,
            moved => moved,
        };
        let more =
            |i: &usize, j: &usize| moved(*i).total_cmp(&moved(*j)).then(halves[*i].total_cmp(&halves[*j]));
        let split = (0..centres.len()).max_by(more).unwrap_or(0);
        let corner = centres.iter().enumerate().map(|(k, centre)| match self.sign() * square.slopes[k] {
            0.0 => *centre,
            slope if slope > 0.0 => candidate.low[k],
            _ => candidate.high[k],
        });
        let corner: Vec<f64> = corner.collect();
        let [first, second] = [centres, corner].map(|at| (self.value_at(&at), at));
        let (found, at) = if second.0 < first.0 { second } else { first };
        Look { least, split, found, at, size }
    }

    /// Returns a lower bound of the signed value in a box. The arguments are the singular values of
    /// its centre, the deviation of the matrix, `‖a‖²`, `‖B aᵀ‖²`, and the error of the centre's
    /// singular values.
    fn least(&self, values: &[f64], spread: f64, square: [f64; 2], mixed: f64, rounding: f64) -> f64 {
        let next = values.get(1).copied();
        let root = |alpha: f64, beta: f64| ((alpha - beta) * (alpha - beta) + 4.0 * mixed).sqrt();
        match self.extreme {
            Extreme::Least => {
                let beta = next.map_or(f64::INFINITY, |value| value - spread - rounding).max(0.0);
                let (alpha, beta) = (square[0].max(0.0), beta * beta);
                let together = (alpha * beta - mixed) / (0.5 * (alpha + beta + root(alpha, beta)));
                let alone = values[0] - spread;
                let least = if together > 0.0 { together.sqrt().max(alone) } else { alone };
                (least * (1.0 - DECOMPOSED) - rounding).max(0.0)
            }
            Extreme::Largest => {
                let beta = next.map_or(0.0, |value| value + spread + rounding);
                let (alpha, beta) = (square[1].max(0.0), beta * beta);
                let together = 0.5 * (alpha + beta + root(alpha, beta));
                let largest = together.sqrt().min(values[0] + spread);
                let largest = largest * (1.0 + DECOMPOSED) + rounding;
                if largest.is_nan() { f64::NEG_INFINITY } else { -largest }
            }
        }
    }
}

/// Returns `Σ u_i f_i`.
fn combined<'a, const N: usize>(u: &[f64], forms: impl Iterator<Item = &'a Affine<N>>) -> Affine<N> {
    let parts = u.iter().zip(forms).map(|(factor, form)| form.scaled(&Affine::known(*factor, 0.0)));
    parts.reduce(|sum, part| sum.add(&part)).unwrap_or_else(|| Affine::known(0.0, 0.0))
}

/// Returns `Σ a_j b_j`.
fn product<const N: usize>(a: &[Affine<N>], b: &[Affine<N>]) -> Affine<N> {
    let parts = a.iter().zip(b).map(|(a, b)| a.mul(b));
    parts.reduce(|sum, part| sum.add(&part)).unwrap_or_else(|| Affine::known(0.0, 0.0))
}

fn farthest<const N: usize>(form: &Affine<N>) -> f64 {
    let [low, high] = form.range();
    low.abs().max(high.abs())
}

impl Candidate {
    /// Returns both halves along the name to bisect.
    fn halves(self, middle: f64) -> [Self; 2] {
        let (mut lower, mut upper) = (self.high.clone(), self.low.clone());
        lower[self.split] = middle;
        upper[self.split] = middle;
        let Self { low, high, least, split } = self;
        [Self { low, high: lower, least, split }, Self { low: upper, high, least, split }]
    }
}
