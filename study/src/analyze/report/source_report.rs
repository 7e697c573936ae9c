//! The position errors of one source.

use abbe::Class;
use abbe::analysis::{Budget, Figures, SourceErrors};
use abbe_spec::Spec;
use serde::{Serialize, Serializer};

use super::error_sites::ErrorSites;
use crate::number::{self, Named};
use crate::study_file::Metric;

/// Position errors of one source over the workspace, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct SourceReport {
    /// Name of the source.
    pub name: String,
    /// Where in the chain it is.
    pub at: String,
    /// Repeatable or random.
    #[serde(serialize_with = "class")]
    pub class: Class,
    /// The largest error.
    pub plain_max: Figures,
    /// Half of what the error varies by.
    pub half_peak_to_peak: Figures,
    /// The largest difference from the error at home.
    pub relative_to_home: Figures,
    /// Configuration with the largest norm.
    pub worst: Named,
    /// Distribution of a random source.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distribution: Option<&'static str>,
    /// Parameters of that configuration which the workspace moves.
    pub worst_parameters: Named,
    /// The largest errors of rows 4–6, rad.
    pub orientation: [f64; 3],
    /// Index of the configuration with the largest norm.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl SourceReport {
    /// Names the sources of a budget.
    pub(in crate::analyze) fn all(budget: &Budget, spec: &Spec, sites: &ErrorSites) -> Vec<Self> {
        let errors = budget.sources.iter().zip(&budget.orientation.sources);
        let named = spec.enabled_sources().zip(errors).map(|(source, (errors, turned))| {
            let &SourceErrors { class, plain_max, half_peak_to_peak, relative_to_home, worst, .. } = errors;
            let Figures { x, y, z, .. } = turned.plain_max;
            Self {
                name: source.name.clone(),
                at: spec.place(source),
                class,
                plain_max,
                half_peak_to_peak,
                relative_to_home,
                worst: sites.variables(worst),
                distribution: number::class(class).1,
                worst_parameters: sites.parameters(worst),
                orientation: [x, y, z],
                configuration: worst,
            }
        });
        named.collect()
    }

    /// The errors in one metric.
    pub fn figures(&self, metric: Metric) -> Figures {
        match metric {
            Metric::PlainMaximum => self.plain_max,
            Metric::HalfPeakToPeak => self.half_peak_to_peak,
            Metric::RelativeToHome => self.relative_to_home,
        }
    }
}

fn class<S: Serializer>(class: &Class, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(number::class(*class).0)
}
