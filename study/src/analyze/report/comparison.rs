//! Comparison with published figures.

use abbe::analysis::{Combined, Figures};
use serde::{Serialize, Serializer};

use super::source_report::SourceReport;
use crate::study_file::{CombinedFigure, Metric, Published, Subject};

/// A published figure, of one source in one metric or of all sources together.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Name of the source, or `combined`.
    pub figure: String,
    /// Name of the metric, or of the combined figure.
    pub metric: &'static str,
    /// Published values for x, y, z and norm, in the length unit; `None` where nothing is printed.
    #[serde(flatten, serialize_with = "by_axis")]
    pub figures: [Option<f64>; 4],
    /// Largest difference that counts as agreement, in the length unit: half a unit of the last
    /// printed digit.
    pub within: f64,
    /// True if the computed figure agrees.
    #[serde(rename = "met", serialize_with = "is_met")]
    pub agreement: Agreement,
    /// Table or page where it is printed.
    pub reference: String,
    /// Source and metric, or combined figure.
    #[serde(skip)]
    pub subject: Subject,
}

/// Agreement with a published figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// Agrees to its last digit.
    Met,
    /// Differs from it.
    Missed {
        /// Computed − published, for the component with the largest difference, in the length unit.
        difference: f64,
        /// Difference divided by the published value; `None` if that is 0.
        share: Option<f64>,
    },
}

impl Agreement {
    /// Compares the published figures among x, y, z and norm.
    fn new(found: [f64; 4], published: &Published) -> Self {
        let pairs = found.into_iter().zip(published.figures);
        let misses =
            pairs.filter_map(|(found, published)| published.map(|published| (found - published, published)));
        match misses.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())) {
            // Printed figures are decimal, computed ones binary: half of the last digit may be off
            // by rounding.
            Some((difference, printed)) if difference.abs() > published.within * (1.0 + 1e-9) => {
                let share = (printed != 0.0).then(|| difference / printed);
                Self::Missed { difference, share }
            }
            _ => Self::Met,
        }
    }
}

impl Comparison {
    /// Compares all published figures. Leaves out those of disabled sources.
    pub(in crate::analyze) fn all(
        published: &[Published],
        sources: &[SourceReport],
        combined: &Combined,
    ) -> Vec<Self> {
        let alone = sources.iter().flat_map(|source| {
            Metric::ALL.map(|(name, metric)| {
                let Figures { x, y, z, norm } = source.figures(metric);
                (source.name.as_str(), name, Subject::Source(source.name.clone(), metric), [x, y, z, norm])
            })
        });
        let together = CombinedFigure::ALL.map(|(name, figure)| {
            let norm = match figure {
                CombinedFigure::Repeatable => combined.repeatable_radius,
                CombinedFigure::Random => combined.random_radius,
                CombinedFigure::Both => combined.radius,
            };
            ("combined", name, Subject::Combined(figure), [0.0, 0.0, 0.0, norm.value])
        });
        let compared = alone.chain(together).filter_map(|(figure, metric, subject, found)| {
            let published = published.iter().find(|published| published.subject == subject)?;
            Some(Self {
                figure: figure.to_owned(),
                metric,
                figures: published.figures,
                within: published.within,
                agreement: Agreement::new(found, published),
                reference: published.reference.clone(),
                subject,
            })
        });
        compared.collect()
    }
}

fn by_axis<S: Serializer>(figures: &[Option<f64>; 4], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(["x", "y", "z", "norm"].into_iter().zip(figures))
}

fn is_met<S: Serializer>(agreement: &Agreement, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bool(*agreement == Agreement::Met)
}
