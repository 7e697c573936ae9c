//! Our figures beside published ones.

use abbe::analysis::{Figures, SourceErrors};

use super::report::Report;
use crate::number;
use crate::study_file::{CombinedFigure, Metric, Published, Subject};

/// Whether a published figure is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// To its last digit.
    Met,
    /// Not, by this difference at most, which is this share of the published figure.
    Missed {
        /// In the length unit.
        difference: f64,
        /// None where the published figure is 0.
        share: Option<f64>,
    },
}

impl Agreement {
    /// Compares those of x, y, z and norm that are published.
    fn new(found: [f64; 4], published: &Published) -> Self {
        let pairs = found.into_iter().zip(published.figures);
        let misses =
            pairs.filter_map(|(found, published)| published.map(|published| (found - published, published)));
        match misses.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())) {
            // Printed figures are decimal, ours are binary: half of the last digit may be off by a rounding.
            Some((difference, printed)) if difference.abs() > published.within * (1.0 + 1e-9) => {
                let share = (printed != 0.0).then(|| difference / printed);
                Self::Missed { difference, share }
            }
            _ => Self::Met,
        }
    }

    /// `met`, or `misses by 4 %`.
    pub fn text(self, report: &Report) -> String {
        match self {
            Self::Met => "met".to_owned(),
            Self::Missed { share: Some(share), .. } => {
                let percent = 100.0 * share.abs();
                format!("misses by {percent:.*} %", usize::from(percent < 1.0))
            }
            Self::Missed { difference, .. } => {
                format!("misses by {}", number::length(difference.abs(), report.spec.length))
            }
        }
    }
}

/// The figures of a source in one metric.
pub fn figures_of(errors: &SourceErrors, metric: Metric) -> [f64; 4] {
    let Figures { x, y, z, norm } = match metric {
        Metric::PlainMaximum => errors.plain_max,
        Metric::HalfPeakToPeak => errors.half_peak_to_peak,
        Metric::RelativeToHome => errors.relative_to_home,
    };
    [x, y, z, norm]
}

impl Report {
    /// One of the three figures of all sources together; the radius has no components.
    pub fn combined(&self, figure: CombinedFigure) -> ([Option<f64>; 3], f64) {
        let combined = &self.budget.combined;
        match figure {
            CombinedFigure::Repeatable => (combined.repeatable.map(Some), combined.repeatable_radius.value),
            CombinedFigure::Random => (combined.random.map(Some), combined.random_radius.value),
            CombinedFigure::Both => ([None; 3], combined.radius.value),
        }
    }

    /// What is published on something, and whether it is met; none of a source that is switched off.
    pub fn published(&self, subject: &Subject) -> Option<(&Published, Agreement)> {
        let published = self.study.published.iter().find(|published| published.subject == *subject)?;
        let found = match subject {
            Subject::Source(name, metric) => {
                let errors = self.budget.sources.iter().find(|alone| self.name(alone) == name)?;
                figures_of(errors, *metric)
            }
            Subject::Combined(figure) => [0.0, 0.0, 0.0, self.combined(*figure).1],
        };
        Some((published, Agreement::new(found, published)))
    }
}
