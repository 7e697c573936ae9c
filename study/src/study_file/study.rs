//! Content of a study.

use std::path::PathBuf;

use abbe_spec::{Diagnostics, Spec};

use super::choices::{Criterion, JudgedMachine};
use super::compensation::Compensated;
use super::figure::Figure;
use super::published::{Published, PublishedResidual};
use super::tolerance;
use crate::changes::Changes;
use crate::workspace::Region;

/// Probability and yield that are required if a study states none.
pub(super) const PROBABILITY: f64 = 0.95;

/// Analysis to perform on a manipulator.
#[derive(Clone, Debug)]
pub struct Study {
    /// Title of the study.
    pub title: String,
    /// Author of the published figures.
    pub publisher: String,
    /// Permitted position error of the tool point, in the length unit.
    pub tolerance: Option<f64>,
    /// Permitted norm of rows 4–6, in rad.
    pub orientation_tolerance: Option<f64>,
    /// Largest share of the configurations that may be unreachable if a tolerance is to be met.
    pub unreachable: f64,
    /// Criterion of the verdict.
    pub criterion: Criterion,
    /// Probability with which a tolerance must be met, if it is judged by that or by yield.
    pub probability: f64,
    /// Share of machines that must meet it, if it is judged by yield.
    pub required_yield: f64,
    /// Machine whose verdict counts.
    pub judged: JudgedMachine,
    /// Changes of the spec.
    pub changes: Changes,
    /// Workspace to analyze.
    pub region: Region,
    /// Published figures.
    pub published: Vec<Published>,
    /// Published errors after compensation.
    pub compensated: Option<PublishedResidual>,
    /// Residuals after compensation.
    pub compensation: Option<Compensated>,
    /// Costs of the factors of sources: the index of the source, the cost of its factor 1, infinite
    /// if it is fixed, and the exponent.
    pub allocation: Vec<(usize, [f64; 2])>,
    /// Published results that cannot be reproduced, one sentence each.
    pub not_reproducible: Vec<String>,
    /// Figures to compute and draw.
    pub figures: Vec<Figure>,
    /// File name and SHA-256 of the text; none without a study.
    pub file: Option<(String, String)>,
    /// Files that were read: the study itself and those of paths.
    pub files: Vec<PathBuf>,
    /// Tolerances that were given as options, as they were written.
    pub stated_tolerances: Vec<String>,
}

impl Study {
    /// Removes all published results, because the machine has changed. Returns true if there were
    /// any.
    pub fn remove_published(&mut self) -> bool {
        let any = !self.published.is_empty() || self.compensated.is_some();
        self.published.clear();
        self.compensated = None;
        self.not_reproducible.clear();
        any
    }

    /// Returns the tolerances of position, in the length unit, and orientation, in rad.
    pub fn tolerances(&self) -> [Option<f64>; 2] {
        [self.tolerance, self.orientation_tolerance]
    }

    /// Replaces the workspace by one configuration of the joints, with nominal parameters and
    /// inputs. Published results, which belong to the workspace, are removed. Returns true if there
    /// were any.
    pub fn restrict(&mut self, q: Vec<f64>) -> bool {
        self.region = Region::one(q);
        self.figures = Figure::defaults(&self.region);
        self.remove_published()
    }

    /// Replaces tolerances by those given as options: lengths for the position, angles for the
    /// orientation.
    ///
    /// # Errors
    ///
    /// Returns a mistake for a text that is no positive length or angle.
    pub fn limit(&mut self, tolerances: &[String], spec: &Spec) -> Result<(), Diagnostics> {
        for (is_angle, value) in tolerance::parse(tolerances, spec.length)? {
            let limit = if is_angle { &mut self.orientation_tolerance } else { &mut self.tolerance };
            *limit = Some(value);
        }
        self.stated_tolerances.extend_from_slice(tolerances);
        Ok(())
    }

    /// Keeps inputs nominal in all workspaces, and removes figures over them.
    pub fn fix(&mut self, inputs: &[usize]) {
        self.region.fix(inputs);
        self.figures.retain(|figure| !figure.is_over(inputs));
        self.figures
            .iter_mut()
            .filter_map(|figure| figure.region.as_mut())
            .for_each(|region| region.fix(inputs));
    }

    /// Returns the default study: a thousand joint samples with both ends of every input, and no
    /// tolerance.
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
            unreachable: 0.0,
            criterion: Criterion::WorstCase,
            probability: PROBABILITY,
            required_yield: PROBABILITY,
            judged: JudgedMachine::AsBuilt,
            changes: Changes::default(),
            figures: Figure::defaults(&region),
            region,
            published: Vec::new(),
            compensated: None,
            compensation: None,
            allocation: Vec::new(),
            not_reproducible: Vec::new(),
            file: None,
            files: Vec::new(),
            stated_tolerances: Vec::new(),
        }
    }
}
