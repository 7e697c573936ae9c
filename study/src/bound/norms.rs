//! The norms of the position's errors alone, beside what an analysis samples.

use abbe::Class;
use abbe_bound::{Effort, Progress};
use abbe_codegen::chain::Magnitudes;
use serde::Serialize;

use crate::machine::Machine;
use crate::notes::Notes;
use crate::study_file::Study;

use super::domain::Domain;
use super::report::{Classes, Largest};

/// An analysis does not wait for more: what is certified by then holds. In operations, about: those of a box are the nodes of the
/// error and of its slopes, with a term for each name that moves.
const WORK: usize = 400_000_000;
/// Each random source has an error of its own through all frames; of more of both together the expressions become too many.
const MOST_RANDOM: usize = 2_000;

/// The largest norms ‖ΔX‖ of the position's errors over the box that contains a workspace: each at least `found`, and at most
/// `certified`.
#[derive(Clone, Debug, Serialize)]
pub struct Norms {
    /// Of the repeatable sources, with their signs; none if there are none.
    pub repeatable: Option<Largest>,
    /// Root sum of squares of the random sources at their bounds; none if there are none.
    pub random: Option<Largest>,
    /// Both, added, where there are both.
    pub radius: Option<Largest>,
    /// Whether the box holds more than the workspace.
    pub contains_more: bool,
}

impl Norms {
    /// Those of a machine and a study with all changes; none if there is no such box, nothing to bound, or too much.
    pub(crate) fn over(machine: &Machine, study: &Study, notes: &dyn Notes) -> Option<Self> {
        let domain = Domain::new(machine, study).ok()?;
        let Classes { repeatable, random } = Classes::of(&domain.spec);
        let sources =
            domain.spec.enabled_sources().filter(|source| source.class != Class::Repeatable).count();
        if !repeatable && !random || sources * domain.spec.frames.len() > MOST_RANDOM {
            return None;
        }
        let mut magnitudes = Magnitudes::new(&domain.spec);
        let norms =
            [&magnitudes.repeatable, &magnitudes.random, &magnitudes.radius].map(|five| five[0].clone());
        let moving = domain.moving();
        let boxes = WORK / (magnitudes.graph.len() * moving * moving).max(1);
        let effort = Effort { boxes: boxes.min(20_000), ..Effort::default() };
        let limits = domain.limits(&mut magnitudes.graph, &magnitudes.apart).position;
        let mut largest = |i: usize, any: bool| {
            let effort = Effort { at_most: limits[i], ..effort };
            any.then(|| {
                let mut go_on = |_: &Progress| !notes.stop();
                let bound = domain.largest(&mut magnitudes.graph, &norms[i], None, &effort, &mut go_on);
                Largest::new(&bound, &domain)
            })
        };
        Some(Self {
            repeatable: largest(0, repeatable),
            random: largest(1, random),
            radius: largest(2, repeatable && random),
            contains_more: !study.region.is_box(),
        })
    }

    /// What is known of everything together.
    pub fn together(&self) -> Option<&Largest> {
        self.radius.as_ref().or(self.repeatable.as_ref()).or(self.random.as_ref())
    }
}
