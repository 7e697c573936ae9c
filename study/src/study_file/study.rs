//! What a study says.

use std::path::PathBuf;

use abbe_spec::Spec;

use super::compensation::Compensated;
use super::figure::Figure;
use super::published::{Published, PublishedResidual};
use super::tolerance::Tolerance;
use crate::changes::Changes;
use crate::workspace::Region;

/// What to do with a manipulator.
#[derive(Clone, Debug)]
pub struct Study {
    /// What it is called.
    pub title: String,
    /// Who printed the published figures.
    pub publisher: String,
    /// How large the error of the tool point may be.
    pub tolerance: Option<f64>,
    /// How large the norm of rows 4–6 may be, rad.
    pub orientation_tolerance: Option<f64>,
    /// With which probability a tolerance must be met.
    pub probability: f64,
    /// What differs from the spec.
    pub changes: Changes,
    /// The configurations to look at.
    pub region: Region,
    /// The figures that somebody printed.
    pub published: Vec<Published>,
    /// What somebody printed of the errors after compensation.
    pub compensated: Option<PublishedResidual>,
    /// What compensation is to leave.
    pub compensation: Option<Compensated>,
    /// What cannot be reproduced of what was printed, one sentence each.
    pub not_reproducible: Vec<String>,
    /// The figures to gather and to draw.
    pub figures: Vec<Figure>,
    /// Its file and the SHA-256 of the text; none if there is no study.
    pub file: Option<(String, String)>,
    /// The files it was read from: its own, and those of paths.
    pub files: Vec<PathBuf>,
}

impl Study {
    /// Leaves out what others printed: the machine is not theirs any more. Whether there was anything.
    pub fn forget_published(&mut self) -> bool {
        let any = !self.published.is_empty() || self.compensated.is_some();
        self.published.clear();
        self.compensated = None;
        self.not_reproducible.clear();
        any
    }

    /// Keeps inputs nominal in its workspaces, whatever is said of them there; figures over them are left out.
    pub fn fix(&mut self, inputs: &[usize]) {
        self.region.fix(inputs);
        self.figures.retain(|figure| !figure.is_over(inputs));
        self.figures
            .iter_mut()
            .filter_map(|figure| figure.region.as_mut())
            .for_each(|region| region.fix(inputs));
    }

    /// That of a manipulator without one: a thousand samples of the joints with both ends of every input, and no tolerance.
    pub fn joint_samples(spec: &Spec) -> Self {
        let region = Region::samples(spec);
        Self {
            title: match region.moving_inputs().is_empty() {
                true => "No study: the limits of the joints are the workspace".to_owned(),
                false => "No study: the limits of the joints and the ranges of the inputs are the workspace"
                    .to_owned(),
            },
            publisher: String::new(),
            tolerance: None,
            orientation_tolerance: None,
            probability: Tolerance::default().probability,
            changes: Changes::default(),
            figures: Figure::defaults(&region),
            region,
            published: Vec::new(),
            compensated: None,
            compensation: None,
            not_reproducible: Vec::new(),
            file: None,
            files: Vec::new(),
        }
    }
}
