//! The least singular value of a matrix of nodes over a box, with a proof.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use abbe_codegen::expr::Symbol;
use abbe_codegen::graph::{Graph, Node};
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::form::{Form, above};
use super::tape::Tape;
use super::{Effort, MOST_MOVING, Moving, Progress, period};

/// How many boxes are halved in a round, whatever the number of threads.
const ROUND: usize = 64;
/// What is less than this share of the whole matrix is nothing.
const NOTHING: f64 = 1e-9;
/// By which share of the whole matrix its singular values and vectors may be off: thousands of roundings.
const DECOMPOSED: f64 = 1e-12;

/// What is proved of the least singular value: it is no less than `certified`, and no more than `found`.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// What no singular value is below; 0 if nothing is known.
    pub certified: f64,
    /// The least singular value at `at`.
    pub found: f64,
    /// The value of each name where `found` is.
    pub at: Vec<f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether the gap was reached, or `found` is next to nothing.
    pub complete: bool,
}

/// That of a matrix of no more rows than columns over the box in which some names move, all others being as `fixed` says.
///
/// In a box let C be the centre of A as an affine form, u the left singular vector of the least singular value of C, `a = uᵀ A` and B the rows of A along the other
/// left singular vectors. Then, with `‖a‖ ≥ α`, no singular value of B below β and `‖B aᵀ‖ ≤ κ`,
///
/// ```text
/// A Aᵀ has no eigenvalue below   ½ (α² + β² − √((α² − β²)² + 4 κ²))
/// ```
///
/// κ is 0 of C, so that what is certified is as close as the square of the box is small. Where that says nothing, the least singular
/// value of C less ‖A − C‖ does.
pub fn least_singular_value(
    graph: &Graph,
    rows: &[Vec<Node>],
    moving: &[Moving],
    fixed: impl Fn(Symbol) -> f64,
    effort: &Effort,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Least {
    let entries = rows.concat();
    let depends = graph.symbols(&entries);
    let is_active = |name: &&Moving| depends.contains(&name.symbol) && name.range[0] < name.range[1];
    let active: Vec<Moving> = moving.iter().filter(is_active).copied().collect();
    let symbols: Vec<Symbol> = active.iter().map(|name| name.symbol).collect();
    let still = |symbol: Symbol| {
        let name = moving.iter().find(|name| name.symbol == symbol);
        name.map_or_else(|| fixed(symbol), |name| name.home.clamp(name.range[0], name.range[1]))
    };
    let search = Search {
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
    let least = match active.len() {
        0..=4 => search.run::<4>(watch),
        5..=6 => search.run::<6>(watch),
        7..=8 => search.run::<8>(watch),
        9..=16 => search.run::<16>(watch),
        _ => search.run::<MOST_MOVING>(watch),
    };
    let mut found = least.at.iter();
    let at = moving.iter().map(|name| {
        let own = if is_active(&name) { found.next().copied() } else { None };
        own.unwrap_or_else(|| still(name.symbol))
    });
    Least { at: at.collect(), ..least }
}

struct Search {
    matrix: Tape,
    rows: usize,
    domain: Vec<[f64; 2]>,
    effort: Effort,
}

/// A box that may hold the least value.
struct Cell {
    low: Vec<f64>,
    high: Vec<f64>,
    /// What no value within is below.
    least: f64,
    /// The name that is to be halved.
    split: usize,
    number: usize,
}

/// What is seen of a box.
struct Look {
    least: f64,
    split: usize,
    /// The least value at a point of it, that point, and the size of the matrix.
    found: f64,
    at: Vec<f64>,
    size: f64,
}

impl Search {
    fn run<const N: usize>(&self, watch: &mut dyn FnMut(&Progress) -> bool) -> Least {
        let [low, high] = [0, 1].map(|end| self.domain.iter().map(|range| range[end]).collect::<Vec<_>>());
        let mut best =
            Least { certified: 0.0, found: f64::INFINITY, at: low.clone(), boxes: 0, complete: false };
        let (mut open, mut waiting) =
            (vec![Cell { low, high, least: 0.0, split: 0, number: 0 }], BinaryHeap::new());
        // Boxes that cannot be halved.
        let mut left = f64::INFINITY;
        loop {
            let looks: Vec<Look> = open
                .par_iter()
                .map_init(Vec::<Form<N>>::new, |registers, cell| self.look(registers, cell))
                .collect();
            let mut size = 0.0_f64;
            for (cell, look) in open.drain(..).zip(looks) {
                best.boxes += 1;
                size = size.max(look.size);
                if look.found < best.found {
                    (best.found, best.at) = (look.found, look.at);
                }
                let least = cell.least.max(look.least);
                waiting.push(Cell { least, split: look.split, number: best.boxes, ..cell });
            }
            let least = waiting.peek().map_or(f64::INFINITY, |cell: &Cell| cell.least);
            best.certified = least.min(left).min(best.found);
            let nothing = NOTHING * size;
            best.complete = best.found - best.certified <= (self.effort.gap * best.found).max(nothing);
            let progress = Progress { found: best.found, certified: best.certified, boxes: best.boxes };
            if best.complete || best.boxes >= self.effort.boxes || !watch(&progress) {
                return best;
            }
            while open.len() < 2 * ROUND
                && let Some(cell) = waiting.pop()
            {
                let middle = cell.low.get(cell.split).map(|low| 0.5 * low + 0.5 * cell.high[cell.split]);
                match middle {
                    Some(middle) if cell.low[cell.split] < middle && middle < cell.high[cell.split] => {
                        open.extend(cell.halves(middle));
                    }
                    _ => left = left.min(cell.least),
                }
            }
            if open.is_empty() {
                return best;
            }
        }
    }

    /// The least singular value at a point.
    fn value_at(&self, at: &[f64]) -> f64 {
        let (forms, _) = self.matrix.evaluate::<0>(&mut Vec::new(), at, &vec![0.0; at.len()]);
        let entries: Vec<f64> = forms.iter().map(|form| form.centre).collect();
        let matrix = DMatrix::from_row_slice(self.rows, entries.len() / self.rows, &entries);
        if matrix.iter().all(|entry| entry.is_finite()) { sorted(matrix).0[0] } else { f64::INFINITY }
    }

    fn look<const N: usize>(&self, registers: &mut Vec<Form<N>>, cell: &Cell) -> Look {
        let centres: Vec<f64> = cell.low.iter().zip(&cell.high).map(|(a, b)| 0.5 * a + 0.5 * b).collect();
        let halves = cell.low.iter().zip(&cell.high).zip(&centres).map(|((low, high), centre)| {
            if low == high { 0.0 } else { (high - centre).max(centre - low).next_up() }
        });
        let halves: Vec<f64> = halves.collect();
        let longest = || (0..centres.len()).max_by(|i, j| halves[*i].total_cmp(&halves[*j])).unwrap_or(0);
        let (forms, _) = self.matrix.evaluate(registers, &centres, &halves);
        let count = forms.len() / self.rows;
        let entry = |i: usize, j: usize| &forms[i * count + j];
        let middle = DMatrix::from_fn(self.rows, count, |i, j| entry(i, j).centre);
        if middle.iter().any(|entry| !entry.is_finite()) {
            return Look { least: 0.0, split: longest(), found: f64::INFINITY, at: centres, size: 0.0 };
        }
        let size = middle.norm();
        let spread = above(forms.iter().map(|form| form.radius() * form.radius()).sum()).sqrt();
        let (values, vectors) = sorted(middle);
        let rows: Vec<Vec<Form<N>>> = vectors
            .iter()
            .map(|u| (0..count).map(|j| combined(u, (0..self.rows).map(|i| entry(i, j)))).collect())
            .collect();
        let (first, others) = (&rows[0], &rows[1..]);
        let square = product(first, first);
        let mixed: Vec<f64> = others.iter().map(|row| farthest(&product(row, first))).collect();
        let mixed = above(mixed.iter().map(|size| size * size).sum());
        let beta = values.get(1).map_or(f64::INFINITY, |value| value - spread - DECOMPOSED * size).max(0.0);
        let (alpha, beta) = (square.range()[0].max(0.0), beta * beta);
        let root = ((alpha - beta) * (alpha - beta) + 4.0 * mixed).sqrt();
        let together = (alpha * beta - mixed) / (0.5 * (alpha + beta + root));
        let alone = values[0] - spread;
        let least = if together > 0.0 { together.sqrt().max(alone) } else { alone } * (1.0 - DECOMPOSED);

        // A name that moves nothing by its slopes moves it too much for them.
        let moved = |k: usize| match forms.iter().map(|form| form.slopes[k] * form.slopes[k]).sum() {
            0.0 if halves[k] > 0.0 => f64::INFINITY,
            moved => moved,
        };
        let more =
            |i: &usize, j: &usize| moved(*i).total_cmp(&moved(*j)).then(halves[*i].total_cmp(&halves[*j]));
        let split = (0..centres.len()).max_by(more).unwrap_or(0);
        let corner = centres.iter().enumerate().map(|(k, centre)| match square.slopes[k] {
            0.0 => *centre,
            slope if slope > 0.0 => cell.low[k],
            _ => cell.high[k],
        });
        let corner: Vec<f64> = corner.collect();
        let [first, second] = [centres, corner].map(|at| (self.value_at(&at), at));
        let (found, at) = if second.0 < first.0 { second } else { first };
        Look { least: (least - DECOMPOSED * size).max(0.0), split, found, at, size }
    }
}

/// Singular values, the least first, and their left vectors.
fn sorted(matrix: DMatrix<f64>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let svd = matrix.svd(true, false);
    let columns = svd.u.iter().flat_map(|u| {
        u.column_iter().map(|column| column.iter().copied().collect::<Vec<_>>()).collect::<Vec<_>>()
    });
    let mut both: Vec<(f64, Vec<f64>)> = svd.singular_values.iter().copied().zip(columns).collect();
    both.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    both.into_iter().unzip()
}

/// `Σ u_i f_i`.
fn combined<'a, const N: usize>(u: &[f64], forms: impl Iterator<Item = &'a Form<N>>) -> Form<N> {
    let parts = u.iter().zip(forms).map(|(factor, form)| form.scaled(&Form::known(*factor, 0.0)));
    parts.reduce(|sum, part| sum.add(&part)).unwrap_or_else(|| Form::known(0.0, 0.0))
}

/// `Σ a_j b_j`.
fn product<const N: usize>(a: &[Form<N>], b: &[Form<N>]) -> Form<N> {
    let parts = a.iter().zip(b).map(|(a, b)| a.mul(b));
    parts.reduce(|sum, part| sum.add(&part)).unwrap_or_else(|| Form::known(0.0, 0.0))
}

fn farthest<const N: usize>(form: &Form<N>) -> f64 {
    let [low, high] = form.range();
    low.abs().max(high.abs())
}

impl Cell {
    /// Both halves along the name that is to be halved.
    fn halves(self, middle: f64) -> [Self; 2] {
        let (mut lower, mut upper) = (self.high.clone(), self.low.clone());
        lower[self.split] = middle;
        upper[self.split] = middle;
        let Self { low, high, least, split, number } = self;
        [Self { low, high: lower, least, split, number }, Self { low: upper, high, least, split, number }]
    }
}

impl Ord for Cell {
    /// The one that may hold the least comes first, of equals that which was made first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}
