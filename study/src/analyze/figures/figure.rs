//! A figure: the request in the study, and the gathered data.
//!
//! Histograms of errors.

use abbe::analysis::sampling::norm;
use serde::{Deserialize, Serialize, Serializer};

use super::{Bins, Envelope, Merge, Mesh, Points, Stick, listed};
use crate::study_file;

/// Figures of a study.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Figures {
    /// Figures in the order of the study.
    pub figures: Vec<Figure>,
    /// Names of sources with a figure that are switched off.
    pub left_out: Vec<String>,
}

/// Data of one figure. Lengths are in the spec's unit, along the axes of `F_0`; angles are in rad.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Request in the study.
    pub request: study_file::Figure,
    /// Shows error bounds instead of signed errors: every source that contributes is random.
    pub bounds: bool,
    /// Numbers of reached and unreachable configurations, if the figure has its own workspace.
    pub own_workspace: Option<[usize; 2]>,
    /// Data to draw.
    pub data: FigureData,
}

/// Data of a figure, by its kind.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FigureData {
    /// Errors over the travel of one variable, parameter or input.
    Travel(Envelope),
    /// Errors over two travels.
    Surface(Mesh),
    /// Errors as points in space.
    Cloud(Points),
    /// Frequencies of errors.
    Histogram(Histogram),
    /// Frames at the home configuration.
    Manipulator(Stick),
    /// Shares of the sources, which follow from the budget.
    Pareto,
}

/// Histograms of the errors in x, y, z and of their norm.
#[derive(Clone, Debug, Serialize)]
pub struct Histogram(#[serde(serialize_with = "all_listed")] pub [Bins<Count>; 4]);

fn all_listed<S: Serializer>(all: &[Bins<Count>; 4], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Listed<'a>(#[serde(serialize_with = "one_listed")] &'a Bins<Count>);

    fn one_listed<S: Serializer>(bins: &&Bins<Count>, serializer: S) -> Result<S::Ok, S::Error> {
        listed(bins, serializer)
    }

    serializer.collect_seq(all.iter().map(Listed))
}

/// Number of configurations in a bin.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Count(pub usize);

impl Merge for Count {
    fn merge(&mut self, other: Self) {
        self.0 = self.0.saturating_add(other.0);
    }
}

impl Histogram {
    /// Creates the empty bins.
    pub(super) fn bins() -> [Bins<Count>; 4] {
        // The width 2^-50 is finer than any relevant error in m or mm.
        std::array::from_fn(|_| Bins::new(-50, 1024))
    }

    /// Counts an error.
    pub(super) fn add(all: &mut [Bins<Count>; 4], error: [f64; 3]) {
        let [x, y, z] = error;
        all.iter_mut().zip([x, y, z, norm(error)]).for_each(|(bins, value)| bins.bin_mut(value).0 += 1);
    }

    /// Creates the histogram, with at most 40 bars per component.
    pub(super) fn new(mut all: [Bins<Count>; 4]) -> Self {
        all.iter_mut().for_each(|bins| bins.span_at_most(40));
        Self(all)
    }
}
