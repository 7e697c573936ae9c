//! What a report is about.

use abbe::Description;
use abbe::analysis::{Budget, Configuration, Sweepable};
use abbe_codegen::spec::Spec;

use crate::table::Listing;
use abbe_study::number;
use abbe_study::study_file::{self, Published, Study};

/// What was analyzed, and what was found.
pub(crate) struct Subject<'a> {
    pub(crate) spec: &'a Spec,
    pub(crate) manipulator: &'a dyn Sweepable,
    pub(crate) description: &'a Description,
    pub(crate) study: &'a Study,
    /// The workspace in a sentence.
    pub(crate) region: &'a str,
    pub(crate) home: &'a Configuration,
    /// How many configurations were reached, and how many were not, with the reasons.
    pub(crate) configurations: usize,
    pub(crate) unreachable: (usize, String),
    pub(crate) budget: &'a Budget,
    /// Where each source is worst, and where everything is.
    pub(crate) worst: (Vec<Option<Configuration>>, Option<Configuration>),
    /// What was found beside each published figure of the study; none where its source is switched off.
    pub(crate) compared: Vec<Option<Compared>>,
    /// The sources in rows, their sums in the last ones.
    pub(crate) ledger: Listing,
    /// What the tolerance allows each source, if there is one.
    pub(crate) allowed: Option<Listing>,
    /// The results in sentences.
    pub(crate) conclusions: Vec<String>,
    /// How many decimals errors have.
    pub(crate) decimals: usize,
}

/// Whether a published figure is met.
pub(crate) struct Compared {
    pub(crate) met: bool,
    pub(crate) verdict: String,
}

impl Subject<'_> {
    /// What differs from home at a configuration.
    pub(super) fn label(&self, configuration: &Configuration) -> String {
        number::configuration(configuration, self.home, self.description)
    }

    /// An error, with the decimals of the tables.
    pub(super) fn error(&self, value: f64) -> String {
        number::fixed(value, self.decimals)
    }

    /// What is published on something, with the verdict.
    pub(super) fn published(&self, of: &study_file::Subject) -> Option<(&Published, &Compared)> {
        let mut both = self.study.published.iter().zip(&self.compared);
        both.find_map(|(published, compared)| {
            Some((published, compared.as_ref()?)).filter(|(p, _)| p.subject == *of)
        })
    }

    /// Who printed the published figures.
    pub(super) fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }
}
