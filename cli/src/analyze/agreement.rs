//! Our figures beside published ones.

use abbe::analysis::{Figures, SourceErrors};

use super::Analysis;
use abbe_study::number;
use abbe_study::study_file::{CombinedFigure, Metric, Published, Subject};

/// Whether a published figure is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Agreement {
    /// To its last digit.
    Met,
    /// Not, by this difference at most, which is this share of the published figure.
    Missed { difference: f64, share: Option<f64> },
}

impl Agreement {
    /// Compares those of x, y, z and norm that are published.
    pub(super) fn of(found: [f64; 4], published: &Published) -> Self {
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
    pub(super) fn text(self, analysis: &Analysis) -> String {
        match self {
            Self::Met => "met".to_owned(),
            Self::Missed { share: Some(share), .. } => {
                let percent = 100.0 * share.abs();
                format!("misses by {percent:.*} %", usize::from(percent < 1.0))
            }
            Self::Missed { difference, .. } => {
                format!("misses by {}", number::length(difference.abs(), analysis.description.length))
            }
        }
    }
}

/// The figures of a source in one metric.
pub(super) fn of_source(errors: &SourceErrors, metric: Metric) -> [f64; 4] {
    let Figures { x, y, z, norm } = match metric {
        Metric::PlainMaximum => errors.plain_max,
        Metric::HalfPeakToPeak => errors.half_peak_to_peak,
        Metric::RelativeToHome => errors.relative_to_home,
    };
    [x, y, z, norm]
}

impl Analysis<'_> {
    /// One of the three figures of all sources together; the radius has no components.
    pub(super) fn combined(&self, figure: CombinedFigure) -> ([Option<f64>; 3], f64) {
        let combined = &self.budget.combined;
        match figure {
            CombinedFigure::Repeatable => (combined.repeatable.map(Some), combined.repeatable_radius.value),
            CombinedFigure::Random => (combined.random.map(Some), combined.random_radius.value),
            CombinedFigure::Both => ([None; 3], combined.radius.value),
        }
    }

    /// What is published on a source in a metric, if anything.
    pub(super) fn published_of(&self, source: &str, metric: Metric) -> Option<&Published> {
        let of = |published: &&Published| matches!(&published.subject, Subject::Source(name, of) if name == source && *of == metric);
        self.study.published.iter().find(of)
    }

    /// What is published on all sources together.
    pub(super) fn published_combined(&self, figure: CombinedFigure) -> Option<&Published> {
        self.study.published.iter().find(|published| published.subject == Subject::Combined(figure))
    }
}
