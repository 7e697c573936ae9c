//! A straight axis with labels where they are wanted.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};

/// Values from one end to the other, and those that are labelled.
#[derive(Clone)]
pub(super) struct Rule {
    pub(super) range: [f64; 2],
    pub(super) labelled: Vec<f64>,
}

impl Ranged for Rule {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (begin, end): (i32, i32)) -> i32 {
        let [from, to] = self.range;
        let share = (value - from) / (to - from);
        (f64::from(begin) + share * f64::from(end - begin)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.labelled.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.range[0]..self.range[1]
    }
}
