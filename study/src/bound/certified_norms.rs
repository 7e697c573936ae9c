//! Certified norms of the position errors, shown beside the sampled ones of an analysis.

use abbe::Class;
use abbe_bound::{Effort, Progress};
use abbe_codegen::chain::Magnitudes;
use serde::Serialize;

use crate::machine::Machine;
use crate::notes::Notes;
use crate::study_file::Study;

use super::domain::Domain;
use super::report::{Classes, ErrorBound};

/// Limit on the work of an analysis for certified norms, in approximate operations. One box takes
/// about (nodes of the graph) × (moving names)².
const WORK: usize = 400_000_000;
/// Number by which the boxes of the search for all sources together are divided.
const SHORTER: usize = 16;
/// Limit on the evaluations of elastic deflections: about a second.
const SAMPLES: usize = 20_000_000;
/// Limit on (random sources) × (frames), above which the expressions grow too large.
const MOST_RANDOM: usize = 2_000;

/// Largest norms ‖ΔX‖ of the position errors over the enclosing box of a workspace, in the length
/// unit. The true maximum lies between `found` and `certified`.
#[derive(Clone, Debug, Serialize)]
pub struct CertifiedNorms {
    /// Norm of the sum of the repeatable sources, with signs; `None` if there are none.
    pub repeatable: Option<ErrorBound>,
    /// Norm of the sum of the random sources with any values within their bounds; `None` if there
    /// are none.
    pub random: Option<ErrorBound>,
    /// Norm of the sum of all sources; `None` unless there are sources of both classes.
    pub total: Option<ErrorBound>,
    /// Indicates that the enclosing box is larger than the workspace.
    pub contains_more: bool,
}

impl CertifiedNorms {
    /// Bounds the norms for a machine and a study; changes are already applied. Returns `None` if
    /// the workspace has no enclosing box, there is no source, or the work would exceed the limits.
    pub(crate) fn certify(machine: &Machine, study: &Study, notes: &dyn Notes) -> Option<Self> {
        let domain = Domain::new(machine, study).ok()?;
        let Classes { repeatable, random } = Classes::enabled(&domain.spec);
        let sources =
            domain.spec.enabled_sources().filter(|source| source.class != Class::Repeatable).count();
        // With loops, a bound takes too long beside an analysis.
        if !domain.spec.is_serial()
            || !repeatable && !random
            || sources * domain.spec.frames.len() > MOST_RANDOM
        {
            return None;
        }
        let mut magnitudes = Magnitudes::new(&domain.spec, &[]);
        let norms =
            [&magnitudes.repeatable, &magnitudes.random, &magnitudes.total].map(|five| five[0].clone());
        let moving = domain.moving_count();
        let boxes = WORK / (magnitudes.graph.len() * moving * moving).max(1);
        let effort = Effort { boxes: boxes.min(20_000), samples: SAMPLES, ..Effort::default() };
        let limits = domain.limits(&mut magnitudes.graph, magnitudes.apart.as_ref()).position;
        let mut largest = |i: usize, any: bool, effort: Effort| {
            any.then(|| {
                let mut go_on = |_: &Progress| !notes.stop();
                let bound = domain.largest(&mut magnitudes.graph, &norms[i], &[], None, &effort, &mut go_on);
                ErrorBound::new(&bound, &domain)
            })
        };
        let [of_repeatable, of_random] = [0, 1].map(|i| Effort { at_most: limits[i], ..effort });
        let (of_both, contains_more) = (repeatable && random, !study.region.is_box(&domain.spec));
        let repeatable = largest(0, repeatable, of_repeatable);
        let random = largest(1, random, of_random);
        // The sum of both parts is close; a short search finds where they add up.
        let parts = [&repeatable, &random].map(|part| part.as_ref().and_then(|part| part.certified));
        let sum = parts[0].zip(parts[1]).map_or(f64::INFINITY, |(first, second)| (first + second).next_up());
        let of_total = Effort { at_most: limits[2].min(sum), boxes: effort.boxes / SHORTER, ..effort };
        let total = largest(2, of_both, of_total);
        Some(Self { repeatable, random, total, contains_more })
    }

    /// Returns the bound for all sources together.
    pub fn all_sources(&self) -> Option<&ErrorBound> {
        self.total.as_ref().or(self.repeatable.as_ref()).or(self.random.as_ref())
    }
}
