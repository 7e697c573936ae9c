//! Unknowns that equations define, enclosed by a parametric step of Krawczyk's method.
//!
//! With the names x = m + δ in a box and `F(x, y) = 0`, let `y₀` be the solution at the centre, C
//! close to `F_y(m, y₀)⁻¹`, and `ỹ(x)` the solution to first order. If
//!
//! ```text
//! |C F(x, ỹ(x))| + |I − C F_y(x, Y)| r < r        with Y = ỹ(x) ± r
//! ```
//!
//! for every x of the box, then there is exactly one solution in Y for each x, `F_y` is regular
//! there, and the solution is continuous in x; it lies in `ỹ − C F(x, ỹ) ± |I − C F_y| r`
//! (Neumaier, *Interval Methods for Systems of Equations*, 1990, section 5.1). Forms that are
//! affine in the names keep what `ỹ` and F have in common.
//!
//! The unknowns of loops are those that are reached from home: the straight way from there is cut
//! into pieces, each such a box of one dimension, whose solutions continue each other.

use abbe_codegen::{chain::Implicit, graph::Graph};
use abbe_spec::expr::Symbol;
use nalgebra::{DMatrix, DVector};

use crate::affine::{Affine, UNIT, above};
use crate::tape::{Tape, names};

/// Largest number of Newton's steps.
const STEPS: usize = 20;
/// Largest number of radii that are tried.
const RADII: usize = 6;
/// Shortest piece of the way from home, as a share of it.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Unknowns with the equations that determine them, and their values at home.
pub(crate) struct Unknowns {
    /// Values of the names at home.
    home: Vec<f64>,
    stages: Vec<Stage>,
    /// Number of names and unknowns.
    count: usize,
}

/// Names and unknowns at a point; those of linear equations are not followed.
pub(crate) type Known = Vec<f64>;

/// Sets of unknowns with the same derivatives.
struct Stage {
    /// Register of the first unknown; the others follow, set by set.
    first: usize,
    sets: usize,
    residual: Tape,
    columns: Tape,
    /// Derivatives of the residual by the names; `None` if it depends on earlier unknowns.
    slopes: Option<Tape>,
    home: Option<Vec<f64>>,
}

/// An enclosure of the unknowns of a stage, and the radii within which they are the only solution.
struct Enclosure<const N: usize> {
    forms: Vec<Affine<N>>,
    radii: Vec<f64>,
}

/// Registers of evaluations, which are reused.
#[derive(Default)]
pub(crate) struct Buffers<const N: usize> {
    pub(crate) registers: Vec<Affine<N>>,
    points: Vec<Affine<0>>,
    pieces: Vec<Affine<1>>,
}

impl Unknowns {
    /// Returns the unknowns on which some symbols depend, and the symbols of all names and
    /// unknowns.
    pub(crate) fn new(
        graph: &mut Graph,
        implicit: &[Implicit],
        names: &[(Symbol, f64)],
        symbols: &[Symbol],
        fixed: impl Fn(Symbol) -> f64,
    ) -> (Self, Vec<Symbol>) {
        let mut all: Vec<Symbol> = names.iter().map(|(symbol, _)| *symbol).collect();
        let mut needed = Vec::new();
        for implicit in implicit {
            let is_needed = |unknowns: &[Symbol]| unknowns.iter().any(|unknown| symbols.contains(unknown));
            let sets: Vec<_> = implicit.sets.iter().filter(|(unknowns, _)| is_needed(unknowns)).collect();
            if !sets.is_empty() {
                needed.push((all.len(), implicit, sets.clone()));
                all.extend(sets.iter().flat_map(|(unknowns, _)| unknowns));
            }
        }
        let stage = |(first, implicit, sets): (usize, &Implicit, Vec<&(Vec<Symbol>, Vec<_>)>)| {
            let residual: Vec<_> = sets.iter().flat_map(|(_, residual)| residual.iter().copied()).collect();
            let depends = graph.symbols(&residual);
            let is_first = !all[names.len()..first].iter().any(|unknown| depends.contains(unknown));
            let mut slope = |name: &(Symbol, f64)| graph.diff_all(&residual, name.0);
            let slopes: Vec<_> = names.iter().filter(|_| is_first).flat_map(&mut slope).collect();
            Stage {
                slopes: is_first.then(|| Tape::new(graph, &slopes, &all, &fixed)),
                first,
                sets: sets.len(),
                residual: Tape { slopes_jump: true, ..Tape::new(graph, &residual, &all, &fixed) },
                columns: Tape::new(graph, &implicit.columns.concat(), &all, &fixed),
                home: implicit.home.clone(),
            }
        };
        let stages = needed.into_iter().map(stage).collect();
        let home = names.iter().map(|(_, home)| *home).collect();
        (Self { home, stages, count: all.len() }, all)
    }

    /// Returns the forms of the names and of the unknowns; `None` if the unknowns may not exist
    /// within the box, or may meet other solutions there. The way to the centre begins where
    /// `known` was reached, or at home, and the centre becomes known.
    pub(crate) fn enclose<const N: usize>(
        &self,
        buffers: &mut Buffers<N>,
        centres: &[f64],
        halves: &[f64],
        known: &mut Option<Known>,
    ) -> Option<Vec<Affine<N>>> {
        let start = known.clone().unwrap_or_else(|| self.at_home());
        let reached = self.reached(buffers, &start, centres)?;
        *known = Some(reached.clone());
        let mut inputs = names(centres, halves)?;
        inputs.resize(self.count, Affine::known(0.0, 0.0));
        for stage in &self.stages {
            let start = &reached[stage.first..][..stage.count()];
            stage.enclose(&mut buffers.registers, &mut buffers.points, &mut inputs, start)?;
        }
        Some(inputs)
    }

    /// Returns the names and unknowns at home.
    fn at_home(&self) -> Known {
        let mut values = [&self.home[..], &vec![0.0; self.count - self.home.len()]].concat();
        for stage in &self.stages {
            let home = stage.home.iter().flatten();
            values[stage.first..].iter_mut().zip(home).for_each(|(value, home)| *value = *home);
        }
        values
    }

    /// Returns the names and unknowns at a point, on the straight way from where they are known.
    fn reached<const N: usize>(
        &self,
        buffers: &mut Buffers<N>,
        known: &Known,
        point: &[f64],
    ) -> Option<Known> {
        let mut values = known.clone();
        let followed: Vec<&Stage> = self.stages.iter().filter(|stage| stage.home.is_some()).collect();
        let (mut share, mut step) = (0.0, 1.0_f64);
        let at = |share: f64| -> Vec<f64> {
            let ends = known.iter().zip(point);
            ends.map(|(start, end)| if share < 1.0 { start + share * (end - start) } else { *end }).collect()
        };
        while share < 1.0 && !followed.is_empty() {
            let end = (share + step).min(1.0);
            match self.piece(buffers, &followed, &values, [at(share), at(end)]) {
                Some(found) => (values, share, step) = (found, end, 2.0 * step),
                None if step < SHORTEST => return None,
                None => step *= 0.5,
            }
        }
        values[..point.len()].copy_from_slice(point);
        Some(values)
    }

    /// Returns the names and unknowns at the end of a piece of the way, from those at its begin.
    fn piece<const N: usize>(
        &self,
        buffers: &mut Buffers<N>,
        followed: &[&Stage],
        values: &[f64],
        [from, to]: [Vec<f64>; 2],
    ) -> Option<Vec<f64>> {
        let mut inputs: Vec<Affine<1>> = vec![Affine::known(0.0, 0.0); self.count];
        let mut end: Vec<Affine<0>> = vec![Affine::known(0.0, 0.0); self.count];
        for (i, (from, to)) in from.iter().zip(&to).enumerate() {
            // The rest covers the rounding of the ends.
            let rest = above(4.0 * UNIT * (from.abs() + to.abs()));
            let half = 0.5 * (to - from);
            inputs[i] = Affine::new(from + half, [half], if half == 0.0 { 0.0 } else { rest });
            end[i] = Affine::known(*to, 0.0);
        }
        for stage in followed {
            let all = stage.first..stage.first + stage.count();
            let start = &values[all.clone()];
            let piece = stage.enclose(&mut buffers.pieces, &mut buffers.points, &mut inputs, start)?;
            let near: Vec<f64> = piece.forms.iter().map(|form| form.centre + form.slopes[0]).collect();
            let mut points = Vec::new();
            stage.enclose(&mut points, &mut buffers.points, &mut end, &near)?;
            for (i, (form, radius)) in piece.forms.iter().zip(&piece.radii).enumerate() {
                let ends = [start[i] - (form.centre - form.slopes[0]), end[all.start + i].centre - near[i]];
                if !ends.iter().all(|distance| distance.abs() <= *radius) {
                    return None;
                }
            }
        }
        Some(end.iter().map(|form| form.centre).collect())
    }
}

impl Stage {
    fn count(&self) -> usize {
        self.residual.outputs.len()
    }

    /// Encloses the unknowns and writes them to the inputs.
    fn enclose<const N: usize>(
        &self,
        registers: &mut Vec<Affine<N>>,
        points: &mut Vec<Affine<0>>,
        inputs: &mut [Affine<N>],
        start: &[f64],
    ) -> Option<Enclosure<N>> {
        let (values, inverse) = self.solve(points, inputs, start)?;
        let unknowns = self.first..self.first + self.count();
        let known = values.iter().map(|value| Affine::known(*value, 0.0));
        inputs[unknowns.clone()].iter_mut().zip(known).for_each(|(input, known)| *input = known);
        let change = times(&inverse, &self.residual.evaluate_at(registers, inputs).0);
        for ((input, value), change) in inputs[unknowns.clone()].iter_mut().zip(&values).zip(&change) {
            *input = Affine::new(value - change.centre, change.neg().slopes, 0.0);
        }
        let first: Vec<Affine<N>> = inputs[unknowns.clone()].to_vec();
        let excess = match &self.slopes {
            Some(slopes) => self.excess(slopes, registers, points, inputs, &inverse),
            None => times(&inverse, &self.residual.evaluate_at(registers, inputs).0),
        };
        let tiny = |form: &Affine<N>| 16.0 * UNIT * form.centre.abs() + f64::MIN_POSITIVE;
        let mut radii: Vec<f64> =
            first.iter().zip(&excess).map(|(form, excess)| 2.0 * upper(excess) + tiny(form)).collect();
        for _ in 0..RADII {
            let wide = first.iter().zip(&radii).map(|(form, radius)| Affine { rest: *radius, ..*form });
            inputs[unknowns.clone()].iter_mut().zip(wide).for_each(|(input, wide)| *input = wide);
            let columns = self.columns.evaluate_at(registers, inputs).0;
            let left = contraction(&inverse, &columns);
            let mut next: Vec<f64> = Vec::with_capacity(radii.len());
            for radii in radii.chunks(left.nrows()) {
                next.extend((&left * DVector::from_column_slice(radii)).iter().map(|sum| rounded_up(*sum)));
            }
            if !next.iter().all(|radius| radius.is_finite()) {
                return None;
            }
            let is_inside =
                |((next, excess), radius): ((&f64, &Affine<N>), &f64)| above(*next + upper(excess)) < *radius;
            if next.iter().zip(&excess).zip(&radii).all(is_inside) {
                // A residual that jumps has no mean value form, and perhaps no solution.
                if self.residual.evaluate_at(registers, inputs).1 {
                    return None;
                }
                let forms = first.iter().zip(&excess).zip(&next).map(|((form, excess), next)| {
                    let form = form.sub(excess);
                    Affine { rest: above(form.rest + next), ..form }
                });
                let forms: Vec<Affine<N>> = forms.collect();
                inputs[unknowns].copy_from_slice(&forms);
                return Some(Enclosure { forms, radii });
            }
            for ((radius, next), excess) in radii.iter_mut().zip(next).zip(&excess) {
                *radius = radius.max(1.5 * (next + upper(excess)));
            }
        }
        None
    }

    /// Returns `C F(x, ỹ(x))` in mean value form. With the names x and ỹ as functions of the t of
    /// affine forms,
    ///
    /// ```text
    /// C F = C F(m, y₀) + Σ_j t_j ∫₀¹ C (F_x ∂x/∂t_j + F_y ∂ỹ/∂t_j)(s t) ds
    /// ```
    ///
    /// The sums are nearly zero, and what the rows of F have in common cancels in them.
    fn excess<const N: usize>(
        &self,
        slopes: &Tape,
        registers: &mut Vec<Affine<N>>,
        points: &mut Vec<Affine<0>>,
        inputs: &[Affine<N>],
        inverse: &DMatrix<f64>,
    ) -> Vec<Affine<N>> {
        let centres: Vec<Affine<0>> = inputs.iter().map(|form| Affine::known(form.centre, 0.0)).collect();
        let mut sum: Vec<Affine<N>> = times(inverse, &self.residual.evaluate_at(points, &centres).0)
            .iter()
            .map(|form| Affine::known(form.centre, form.rest))
            .collect();
        let (count, size) = (sum.len(), inverse.nrows());
        let by_names = times(inverse, &slopes.evaluate_at(registers, inputs).0);
        let by_unknowns = times(inverse, &self.columns.evaluate_at(registers, inputs).0);
        for (row, sum) in sum.iter_mut().enumerate() {
            let (set, row_of_set) = (row / size, row % size);
            let of_names = by_names.chunks(count).map(|derivatives| &derivatives[row]);
            let of_unknowns = by_unknowns.chunks(size).map(|derivatives| &derivatives[row_of_set]);
            let unknowns = &inputs[self.first + set * size..][..size];
            let all: Vec<_> = inputs.iter().zip(of_names).chain(unknowns.iter().zip(of_unknowns)).collect();
            for j in 0..N {
                let mut slope = Affine::known(0.0, 0.0);
                for (form, derivative) in all.iter().filter(|(form, _)| form.slopes[j] != 0.0) {
                    slope = derivative.scaled(&Affine::known(form.slopes[j], 0.0)).add(&slope);
                }
                let moving = Affine::new(0.0, std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 }), 0.0);
                *sum = sum.add(&moving.mul(&slope));
            }
            for (form, derivative) in all.iter().filter(|(form, _)| form.rest > 0.0) {
                sum.rest = above(sum.rest + form.rest * upper(derivative));
            }
        }
        sum
    }

    /// Returns the solution at the centre, and the inverse of the derivatives there.
    fn solve<const N: usize>(
        &self,
        points: &mut Vec<Affine<0>>,
        inputs: &[Affine<N>],
        start: &[f64],
    ) -> Option<(Vec<f64>, DMatrix<f64>)> {
        let mut inputs: Vec<Affine<0>> = inputs.iter().map(|form| Affine::known(form.centre, 0.0)).collect();
        let (mut values, size) = (start.to_vec(), self.count() / self.sets);
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let known = values.iter().map(|value| Affine::known(*value, 0.0));
            inputs[self.first..].iter_mut().zip(known).for_each(|(input, known)| *input = known);
            let columns = self.columns.evaluate_at(points, &inputs).0;
            let centres = columns.iter().map(|form| form.centre);
            let inverse = DMatrix::from_iterator(size, size, centres).try_inverse()?;
            let step = times(&inverse, &self.residual.evaluate_at(points, &inputs).0);
            let mut largest = 0.0_f64;
            for (value, step) in values.iter_mut().zip(&step) {
                *value -= step.centre;
                largest = largest.max(step.centre.abs());
            }
            if !values.iter().all(|value| value.is_finite()) {
                return None;
            }
            // Without a better step, the rest is rounding, or there is no solution.
            if largest == 0.0 || self.home.is_none() || largest > 0.5 * before {
                return Some((values, inverse));
            }
            before = largest;
        }
        None
    }
}

/// Returns C times some vectors, one after the other.
fn times<const N: usize>(inverse: &DMatrix<f64>, vectors: &[Affine<N>]) -> Vec<Affine<N>> {
    let size = inverse.nrows();
    let mut products = vec![Affine::known(0.0, 0.0); vectors.len()];
    for (products, vector) in products.chunks_mut(size).zip(vectors.chunks(size)) {
        for (column, form) in vector.iter().enumerate() {
            if form.centre == 0.0 && form.radius() == f64::MIN_POSITIVE {
                continue;
            }
            for (row, product) in products.iter_mut().enumerate() {
                *product = product.add(&form.scaled(&Affine::known(inverse[(row, column)], 0.0)));
            }
        }
    }
    products
}

/// Returns upper bounds of `|I − C A|` from the columns of A.
fn contraction<const N: usize>(inverse: &DMatrix<f64>, columns: &[Affine<N>]) -> DMatrix<f64> {
    let size = inverse.nrows();
    let products = times(inverse, columns);
    DMatrix::from_fn(size, size, |row, column| {
        let one = Affine::known(if row == column { -1.0 } else { 0.0 }, 0.0);
        upper(&products[column * size + row].shifted(&one))
    })
}

/// Returns the largest absolute value of a form.
fn upper<const N: usize>(form: &Affine<N>) -> f64 {
    above(form.centre.abs() + form.radius())
}

/// Returns an upper bound of a sum of up to a thousand nonnegative products.
fn rounded_up(sum: f64) -> f64 {
    sum * (1.0 + 4096.0 * UNIT) + f64::MIN_POSITIVE
}
