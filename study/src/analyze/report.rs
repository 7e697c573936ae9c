//! The answer: what was found over a workspace.

use std::collections::BTreeMap;
use std::sync::Arc;

use abbe::analysis::{Admissible, Budget, Configuration, Measurand, MonteCarlo, SourceErrors, Workspace};
use abbe_spec::{Source, Spec};

use super::figures::Figures;
use super::first_order::FirstOrder;
use super::judged::Judged;
use super::stated::Stated;
use crate::bound::Norms;
use crate::notes::Notes;
use crate::number::{self, Named};
use crate::study_file::Study;

/// What the sources do over a workspace. Lengths in the spec's unit and along the axes of `F_0`, angles in rad.
///
/// Serialized it is what `abbe analyze --json` prints.
#[derive(Clone, Debug)]
pub struct Report {
    /// The manipulator, with all changes.
    pub spec: Arc<Spec>,
    /// The study that was asked for.
    pub study: Study,
    /// The workspace in a sentence.
    pub workspace: String,
    /// The home configuration, with which those of the workspace are compared.
    pub home: Configuration,
    /// Indices of the parameters that the workspace moves.
    pub varying: Vec<usize>,
    /// Indices of the inputs that the workspace moves; the others are nominal.
    pub moving_inputs: Vec<usize>,
    /// Every source alone, and all together. Sources are counted among those that are switched on: see
    /// [`source`](Self::source).
    pub budget: Budget,
    /// What first order neglects.
    pub first_order: FirstOrder,
    /// What the norms of all errors are at most; none if the workspace has no box, or too many names move.
    pub certified: Option<Norms>,
    /// What the tolerance of the study allows.
    pub admissible: Option<Admissible>,
    /// What its tolerance of the orientation allows.
    pub admissible_orientation: Option<Admissible>,
    /// The verdict on each tolerance of the study.
    pub judged: Vec<Judged>,
    /// The uncertainty budgets, of position first; none of what no random source changes.
    pub stated: Vec<Stated>,
    /// What was drawn, if it was asked for.
    pub monte_carlo: Option<Drawn>,
    /// What the figures of the study show, if it was asked for.
    pub figures: Option<Figures>,
    pub(super) places: Places,
}

/// What was drawn at the worst configuration and at home.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The seed of the draws.
    pub seed: u64,
    /// Where the radius of all errors is largest.
    pub worst: MonteCarlo,
    /// At home.
    pub home: MonteCarlo,
}

impl Drawn {
    /// Both places, with their names.
    pub fn places(&self) -> [(&'static str, &MonteCarlo); 2] {
        [("worst", &self.worst), ("home", &self.home)]
    }
}

/// The configurations that the figures of a budget name by their index in the workspace.
#[derive(Clone, Debug)]
pub(super) struct Places(BTreeMap<usize, Configuration>);

impl Places {
    pub(super) fn new(budget: &Budget, judged: &[Judged], workspace: &dyn Workspace) -> Self {
        let combined = &budget.combined;
        let radii =
            [combined.repeatable_radius, combined.random_radius, combined.radius, combined.worst_case_radius];
        let turned = &budget.orientation.combined;
        let turns = [turned.repeatable_radius, turned.random_radius, turned.radius, turned.standard_radius];
        let radii = radii.into_iter().chain(turns).chain([combined.standard_radius]);
        let named = budget.sources.iter().chain(&budget.orientation.sources).map(|alone| alone.worst);
        let named = named.chain(radii.map(|radius| radius.configuration));
        let named = named.chain(judged.iter().map(|judged| judged.configuration));
        let named = named.chain([combined.ellipsoid.configuration]).flatten();
        Self(named.filter_map(|index| Some((index, workspace.configuration(index).ok()?))).collect())
    }
}

impl Report {
    /// The configuration where a source, or everything, is worst.
    pub fn configuration(&self, index: Option<usize>) -> Option<&Configuration> {
        self.places.0.get(&index?)
    }

    /// A source of the budget, by its index there.
    pub fn source(&self, index: usize) -> &Source {
        self.sources()[index]
    }

    /// The tolerance of a measurand.
    pub fn tolerance(&self, measurand: Measurand) -> Option<f64> {
        match measurand {
            Measurand::Position => self.study.tolerance,
            Measurand::Orientation => self.study.orientation_tolerance,
        }
    }

    /// What it allows.
    pub fn admissible(&self, measurand: Measurand) -> Option<&Admissible> {
        match measurand {
            Measurand::Position => self.admissible.as_ref(),
            Measurand::Orientation => self.admissible_orientation.as_ref(),
        }
    }

    /// The name of a source of the budget.
    pub fn name(&self, errors: &SourceErrors) -> &str {
        &self.source(errors.source).name
    }

    /// The sources of the budget: those that are switched on.
    pub fn sources(&self) -> Vec<&Source> {
        self.spec.enabled_sources().collect()
    }

    /// The variables of a configuration and those inputs that the workspace moves, by their names.
    pub(super) fn variables(&self, configuration: Option<&Configuration>) -> Named {
        let Some(Configuration { q, u, .. }) = configuration else { return Named(Vec::new()) };
        let variables = self.spec.variables.iter().zip(q);
        let variables = variables.map(|(variable, value)| (variable.name.clone(), value + 0.0));
        let inputs = self.moving_inputs.iter().map(|&i| (self.spec.inputs[i].name.clone(), u[i] + 0.0));
        Named(variables.chain(inputs).collect())
    }

    /// The inputs in words: `payload within 0 kg … 5 kg (0 kg at home)`, or `payload = 0 kg` of one that does not move.
    pub fn inputs(&self) -> Vec<String> {
        let inputs = self.spec.inputs.iter().enumerate();
        let inputs = inputs.map(|(i, input)| {
            let [home, lower, upper] = [input.value, input.range[0], input.range[1]]
                .map(|value| number::quantity(value, &input.unit));
            match self.moving_inputs.contains(&i) {
                true => format!("{} within {lower} … {upper} ({home} at home)", input.name),
                false => format!("{} = {home}", input.name),
            }
        });
        inputs.collect()
    }

    /// Those parameters of a configuration that the workspace moves, by their names.
    pub(super) fn parameters(&self, configuration: Option<&Configuration>) -> Named {
        let named = self.varying.iter().filter_map(|&i| {
            let name = self.spec.parameters[i].name.clone();
            configuration.map(|configuration| (name, configuration.s[i] + 0.0))
        });
        Named(named.collect())
    }

    /// Who printed the published figures.
    pub fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }

    /// What is not at home at a configuration.
    pub fn label(&self, configuration: &Configuration) -> String {
        number::configuration(configuration, &self.home, &self.spec)
    }

    /// Warns if first order is not good enough for the tolerance.
    pub(super) fn warn_of_first_order(&self, notes: &mut dyn Notes) {
        let length = |value| number::length(value, self.spec.length);
        let neglected = self.first_order.largest;
        if let Some(tolerance) = self.study.tolerance.filter(|tolerance| neglected > tolerance / 10.0) {
            notes.warn(&format!(
                "first order is off by up to {}, more than a tenth of the tolerance of {}; look at --monte-carlo",
                length(neglected),
                length(tolerance),
            ));
        }
    }
}
