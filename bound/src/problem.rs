//! The function to maximize and its domain.

use crate::corners::Corners;
use crate::unknowns::{Buffers, Known, Unknowns};
use crate::{Affine, Tape};

/// A value to be maximized over a box.
pub(crate) struct Problem {
    /// The value; with unknowns, one or more numbers whose largest it is.
    pub(crate) value: Tape,
    /// Evaluation at control points, if the value is a norm of polynomials in the names.
    pub(crate) corners: Option<Corners>,
    /// The value and its slope along each name.
    pub(crate) all: Tape,
    /// Range of each name.
    pub(crate) domain: Vec<[f64; 2]>,
    /// Start of the search.
    pub(crate) start: Vec<f64>,
    /// Unknowns of which the value is a function; there are no slopes then.
    pub(crate) unknowns: Option<Unknowns>,
}

/// A value and the point at which it is taken.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// Lower bound of the value.
    pub(crate) value: f64,
    pub(crate) at: Vec<f64>,
}

impl Point {
    pub(crate) const NONE: Self = Self { value: f64::NEG_INFINITY, at: Vec::new() };
}

impl Problem {
    /// Returns an enclosure of the value at a point.
    pub(crate) fn value_at(&self, points: &mut Buffers<0>, at: &[f64]) -> [f64; 2] {
        self.value_within(points, at, &vec![0.0; at.len()], &mut None).range()
    }

    /// Returns an enclosure of the value within a box, of the number that is largest at most;
    /// unbounded where unknowns may not exist. Unknowns are followed from where they are `known`,
    /// which becomes the centre.
    pub(crate) fn value_within<const N: usize>(
        &self,
        buffers: &mut Buffers<N>,
        centres: &[f64],
        halves: &[f64],
        known: &mut Option<Known>,
    ) -> Affine<N> {
        let Some(unknowns) = &self.unknowns else {
            return self.value.evaluate(&mut buffers.registers, centres, halves).0[0];
        };
        let Some(inputs) = unknowns.enclose(buffers, centres, halves, known) else {
            return Affine::anything();
        };
        let values = self.value.evaluate_at(&mut buffers.registers, &inputs).0;
        let by_end = |a: &Affine<N>, b: &Affine<N>| a.range()[1].total_cmp(&b.range()[1]);
        values.into_iter().max_by(by_end).unwrap_or(Affine::anything())
    }

    /// Returns the slope of the value along each name near a point; without slopes of their own if
    /// there are unknowns.
    pub(crate) fn slopes_near<const N: usize>(
        &self,
        buffers: &mut Buffers<N>,
        at: &[f64],
        halves: &[f64],
    ) -> Vec<Affine<N>> {
        if self.unknowns.is_none() {
            return self.all.evaluate(&mut buffers.registers, at, halves).0.split_off(1);
        }
        let form = self.value_within(buffers, at, halves, &mut None);
        let slope =
            |(slope, half): (&f64, &f64)| Affine::known(if *half > 0.0 { slope / half } else { 0.0 }, 0.0);
        form.slopes.iter().zip(halves).map(slope).collect()
    }
}
