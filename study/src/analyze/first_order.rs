//! What `ΔX ≈ J_e ε` neglects: first order against the exact chain.

use abbe::analysis::{Configuration, Row, Subset, Sweepable, Unevaluated, Workspace, sweep};
use abbe::{Class, Error, Pose, deviation, real_pose};

/// The most configurations at which the exact chain is run.
const CHECKED: usize = 2000;

/// The largest distance between first order and the exact chain, over 2000 configurations of a larger workspace,
/// spread evenly over it.
///
/// Compared are the repeatable sources; if there are none, the random ones at their bounds, all with the same sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrder {
    /// At how many configurations it was compared.
    pub checked: usize,
    /// The largest difference of the tool point, in the length unit.
    pub largest: f64,
}

impl FirstOrder {
    /// Compares over a workspace. Where the exact chain cannot be had there is nothing to compare.
    pub(super) fn over(manipulator: &dyn Sweepable, workspace: &dyn Workspace) -> Result<Self, Unevaluated> {
        let mut comparison = Comparison::new(manipulator);
        let mut compared = Self { checked: 0, largest: 0.0 };
        sweep(manipulator, &Subset { workspace, count: CHECKED }, &mut |row| {
            if let Ok(difference) = comparison.difference(row) {
                compared.checked += 1;
                compared.largest = compared.largest.max(difference);
            }
        })?;
        Ok(compared)
    }
}

/// The exact chain, evaluated one configuration after the other.
struct Comparison<'a> {
    manipulator: &'a dyn Sweepable,
    /// What the value of every effect is multiplied with.
    factors: Vec<f64>,
    transforms: Vec<Pose>,
    effects: Vec<f64>,
    errors: Vec<[f64; 6]>,
}

impl<'a> Comparison<'a> {
    fn new(manipulator: &'a dyn Sweepable) -> Self {
        let description = manipulator.description();
        let frames = description.frames.len();
        let repeatable = description.sources.iter().any(|source| source.class == Class::Repeatable);
        let factors =
            description.effects.iter().map(|effect| match description.sources[effect.source].class {
                Class::Repeatable => 1.0,
                Class::Random(_) if repeatable => 0.0,
                Class::Random(distribution) => distribution.bound(),
            });
        Self {
            manipulator,
            factors: factors.collect(),
            transforms: vec![Pose::IDENTITY; frames + 1],
            effects: vec![0.0; description.effects.len()],
            errors: vec![[0.0; 6]; frames],
        }
    }

    fn difference(&mut self, row: &Row) -> Result<f64, Error> {
        let Configuration { q, s, u } = row.configuration;
        let description = self.manipulator.description();
        self.manipulator.transforms(q, s, &mut self.transforms)?;
        self.manipulator.effects(q, s, u, &mut self.effects)?;
        self.errors.fill([0.0; 6]);
        for ((effect, value), factor) in description.effects.iter().zip(&self.effects).zip(&self.factors) {
            self.errors[effect.frame][effect.component.index()] += value * factor;
        }
        let real = real_pose(&self.transforms, &self.errors);
        let exact = deviation(description.orientation, &row.pose, &real);
        let repeatable = description.sources.iter().any(|source| source.class == Class::Repeatable);
        let first = |i: usize| match repeatable {
            true => row.repeatable[i],
            false => row.sources.iter().map(|source| source[i]).sum::<f64>(),
        };
        Ok((0..3).map(|i| (exact[i] - first(i)).powi(2)).sum::<f64>().sqrt())
    }
}
