//! What `ΔX ≈ J_e ε` neglects: the repeatable sources against the exact chain.

use abbe::analysis::Row;
use abbe::{Error, Manipulator, Pose, deviation, real_pose};

/// The most configurations at which the exact chain is run.
const CHECKED: usize = 2000;

/// The largest distance between first order and the exact chain.
pub(super) struct FirstOrder<'a> {
    pub(super) manipulator: &'a dyn Manipulator,
    /// Every how many configurations is checked.
    stride: usize,
    transforms: Vec<Pose>,
    errors: Vec<[f64; 6]>,
    /// At how many configurations it was compared.
    pub(super) checked: usize,
    /// The largest difference of the tool point, in the length unit.
    pub(super) largest: f64,
}

impl<'a> FirstOrder<'a> {
    pub(super) fn new(manipulator: &'a dyn Manipulator, configurations: usize) -> Self {
        let frames = manipulator.description().frames.len();
        Self {
            manipulator,
            stride: configurations.div_ceil(CHECKED).max(1),
            transforms: vec![Pose::IDENTITY; frames + 1],
            errors: vec![[0.0; 6]; frames],
            checked: 0,
            largest: 0.0,
        }
    }

    /// Compares at a configuration. Where the exact chain cannot be had there is nothing to compare.
    pub(super) fn add(&mut self, row: &Row, u: &[f64]) {
        if row.index.is_multiple_of(self.stride)
            && let Ok(difference) = self.difference(row, u)
        {
            self.checked += 1;
            self.largest = self.largest.max(difference);
        }
    }

    fn difference(&mut self, row: &Row, u: &[f64]) -> Result<f64, Error> {
        let (q, s) = (&row.configuration.q, &row.configuration.s);
        self.manipulator.transforms(q, s, &mut self.transforms)?;
        self.manipulator.generalized_errors(q, s, u, &mut self.errors)?;
        let real = real_pose(&self.transforms, &self.errors);
        let exact = deviation(self.manipulator.description().orientation, &row.pose, &real);
        let position = exact.iter().zip(&row.repeatable).take(3);
        Ok(position.map(|(exact, first)| (exact - first).powi(2)).sum::<f64>().sqrt())
    }
}
