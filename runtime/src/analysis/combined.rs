//! What all sources do together over the workspace.

use super::covariance::{covariance, eigenvalue_bound};
use super::enclosing::{Enclosing, Sphere};
use super::sampling::norm;
use super::single::position;
use super::{Ellipsoid, Row};
use crate::Source;

/// The largest value over the workspace, and where.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// The value, in the length unit; 0 for an empty workspace.
    pub value: f64,
    /// Index of its configuration; none for an empty workspace.
    pub configuration: Option<usize>,
}

impl Extreme {
    pub(super) fn add(&mut self, index: usize, value: f64) {
        if self.configuration.is_none() || value > self.value {
            *self = Self { value, configuration: Some(index) };
        }
    }
}

/// What all sources do together over the workspace.
///
/// | way | repeatable sources r_k | random sources with bounds b_k |
/// |---|---|---|
/// | the paper's | Σ r_k, with signs | root sum of squares of the b_k |
/// | GUM | | standard deviation: root sum of squares of b_k/√3 (uniform), b_k/3 (normal) |
/// | worst case | Σ \|r_k\| | Σ \|b_k\| |
///
/// Lengths in the length unit, all 0 for an empty workspace.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combined {
    /// max ‖Σ repeatable‖: the radius of the error sphere about zero.
    pub repeatable_radius: Extreme,
    /// max ‖RSS random‖.
    pub random_radius: Extreme,
    /// max over the configurations of ‖Σ repeatable‖ + ‖RSS random‖.
    pub radius: Extreme,
    /// The largest \|Σ repeatable\| along x, y, z of `F_0`.
    pub repeatable: [f64; 3],
    /// The largest root sum of squares along x, y, z of `F_0`.
    pub random: [f64; 3],
    /// Root mean squares over the configurations of the three norms: repeatable, random, both added.
    pub rms: [f64; 3],
    /// The largest standard deviation along x, y, z of `F_0`.
    pub standard_deviation: [f64; 3],
    /// max √(tr Σ): the standard deviation of the position.
    pub standard_radius: Extreme,
    /// The largest sum of absolute values of all sources along x, y, z of `F_0`.
    pub worst_case: [f64; 3],
    /// max Σ ‖·‖ over all sources: no draw and no signs make more.
    pub worst_case_radius: Extreme,
    /// The 95 % ellipsoid with the longest semi-axis.
    pub ellipsoid: Ellipsoid,
    /// The smallest sphere around the position errors Σ repeatable of all configurations.
    pub enclosing: Sphere,
}

/// Gathers [`Combined`] configuration by configuration.
pub(super) struct Gather<'a> {
    sources: &'a [Source<'a>],
    combined: Combined,
    /// How many configurations, and the sums of squares of the three norms.
    count: usize,
    squares: [f64; 3],
    enclosing: Enclosing,
}

impl<'a> Gather<'a> {
    /// Begins with the error sphere of some configurations from everywhere.
    pub(super) fn new(sources: &'a [Source<'a>], enclosing: Enclosing) -> Self {
        Self { sources, combined: Combined::default(), count: 0, squares: [0.0; 3], enclosing }
    }

    pub(super) fn add(&mut self, row: &Row) {
        let combined = &mut self.combined;
        let (repeatable, random) = (position(&row.repeatable), position(&row.random));
        let norms = [norm(repeatable), norm(random)];
        combined.repeatable_radius.add(row.index, norms[0]);
        combined.random_radius.add(row.index, norms[1]);
        combined.radius.add(row.index, norms[0] + norms[1]);
        self.count += 1;
        for (sum, norm) in self.squares.iter_mut().zip([norms[0], norms[1], norms[0] + norms[1]]) {
            *sum += norm * norm;
        }
        for i in 0..3 {
            combined.repeatable[i] = combined.repeatable[i].max(repeatable[i].abs());
            combined.random[i] = combined.random[i].max(random[i]);
        }

        // The sum of nothing is −0: these begin with 0.
        let absolute = |i: usize| row.sources.iter().fold(0.0, |sum, source| sum + source[i].abs());
        for i in 0..3 {
            combined.worst_case[i] = combined.worst_case[i].max(absolute(i));
        }
        let norms = row.sources.iter().fold(0.0, |sum, source| sum + norm(position(source)));
        combined.worst_case_radius.add(row.index, norms);

        let covariance = covariance(self.sources, row.sources);
        for (i, largest) in combined.standard_deviation.iter_mut().enumerate() {
            *largest = largest.max(covariance[i][i].sqrt());
        }
        let trace = (0..3).map(|i| covariance[i][i]).sum::<f64>();
        combined.standard_radius.add(row.index, trace.sqrt());
        combined.ellipsoid.or_longer(row.index, covariance);
        self.enclosing.add(repeatable);
    }

    pub(super) fn finish(self) -> (Combined, usize) {
        let mut combined = self.combined;
        combined.rms = self.squares.map(|sum| (sum / self.count.max(1) as f64).sqrt());
        if self.count > 0 {
            combined.enclosing = self.enclosing.finish();
        }
        (combined, self.count)
    }
}

impl Ellipsoid {
    /// The one with the longer semi-axis. No eigenvalues are computed where they cannot be larger.
    fn or_longer(&mut self, index: usize, covariance: [[f64; 3]; 3]) {
        let [longest, ..] = self.semi_axes;
        if super::CHI_SQUARED_95 * eigenvalue_bound(&covariance) <= longest * longest {
            return;
        }
        let other = Self::new(covariance, index);
        if other.semi_axes[0] > longest {
            *self = other;
        }
    }
}
