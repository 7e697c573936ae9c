//! Machine with its repeatable errors, at random configurations.
//!
//! Most formats hold constant numbers. Errors that vary with the configuration are replaced by
//! their mean over the workspace, to which the constant part is closest.

use std::sync::Arc;

use abbe::analysis::{Configuration, Workspace, random_joint_samples, sampling};
use abbe::{Class, Error, Manipulator, Pose, drawn_pose, real_pose};
use abbe_interpreter::Interpreter;
use abbe_spec::{DhConvention, Diagnostics, Dimension, Spec, mistake, number, option::SET};

use super::{Cause, ChainErrors, ErrorModel, Link, PoseDifference, about_x, about_z};

/// Relative change of an error below which it is rounding.
const ROUNDING: f64 = 1e-12;

/// Configurations at which [`RealMachine::errors_beyond_own_axis`] compares errors.
const COMPARED: usize = 50;

/// Machine with all its repeatable errors, evaluated at random configurations.
pub struct RealMachine {
    /// Spec whose tables are held at their ends: a correction may exceed a limit by a micrometre.
    pub(crate) spec: Arc<Spec>,
    /// Functions of the spec.
    pub(crate) manipulator: Interpreter,
    errors: ErrorModel,
    /// Nominal structural parameters.
    pub(crate) s: Vec<f64>,
    pub(crate) configurations: Vec<Configuration>,
    /// Number of configurations that were requested.
    pub(super) samples: usize,
    /// Seed of the configurations.
    pub(super) seed: u64,
    /// Real pose of the tool at each configuration.
    pub(crate) real: Vec<Pose>,
    /// Nominal pose of the tool at each configuration.
    pub(crate) ideal: Vec<Pose>,
    /// Mean errors over the configurations.
    pub(crate) mean: ChainErrors,
    /// Names of the sources whose errors vary with the configuration.
    varying: Vec<String>,
    /// Inputs with a value of the caller.
    fixed_inputs: Vec<usize>,
    /// Name of the spec in mistakes.
    pub(crate) origin: String,
}

impl RealMachine {
    /// Evaluates a machine at random configurations.
    ///
    /// Joints are drawn within their limits and inputs within their ranges; the inputs with indices
    /// in `fixed_inputs` keep their nominal values. `origin` is the name of the spec in mistakes.
    ///
    /// # Errors
    ///
    /// A configuration cannot be evaluated.
    pub fn new(
        spec: &Spec,
        fixed_inputs: &[usize],
        samples: usize,
        seed: u64,
        origin: &str,
    ) -> Result<Self, Diagnostics> {
        let spec = Arc::new(spec.with_held_tables());
        let manipulator = Interpreter::new(spec.clone());
        let errors = ErrorModel::new(&spec, &manipulator);
        let description = manipulator.description();
        let s = sampling::nominal_parameters(description);
        let configurations = configurations(&manipulator, fixed_inputs, samples, seed)
            .map_err(|error| mistake::not_evaluated(origin, "a configuration", &error, description))?;
        let mut machine = Self {
            mean: ChainErrors::none(&spec),
            origin: origin.to_owned(),
            varying: Vec::new(),
            real: Vec::new(),
            ideal: Vec::new(),
            configurations: Vec::new(),
            samples,
            seed,
            spec,
            manipulator,
            errors,
            s,
            fixed_inputs: fixed_inputs.to_vec(),
        };
        machine.evaluate(&configurations).map_err(|(i, error)| {
            let at = number::variables(&configurations[i].q, &machine.spec);
            mistake::not_evaluated(origin, &at, &error, machine.manipulator.description())
        })?;
        machine.configurations = configurations;
        Ok(machine)
    }

    /// Fills in poses, mean errors and varying sources; an error comes with the index of its
    /// configuration.
    fn evaluate(&mut self, configurations: &[Configuration]) -> Result<(), (usize, Error)> {
        let count = self.errors.causes.len();
        let mut sums = vec![0.0; count];
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; count];
        for (place, Configuration { q, u, .. }) in configurations.iter().enumerate() {
            let failed = |error| (place, error);
            self.real.push(self.real_tool(q, u).map_err(failed)?);
            self.ideal.push(self.manipulator.pose(q, &self.s).map_err(failed)?);
            for (i, value) in self.errors.values(q, &self.s, u).map_err(failed)?.into_iter().enumerate() {
                sums[i] += value;
                ranges[i] = [ranges[i][0].min(value), ranges[i][1].max(value)];
            }
        }
        let count = configurations.len().max(1) as f64;
        // Rounding must not move the mean of equal numbers off that number.
        let mean = sums.iter().zip(&ranges).map(|(sum, [lower, upper])| (sum / count).clamp(*lower, *upper));
        self.mean = self.errors.errors(&self.spec, mean);
        let names: Vec<&str> = self.spec.enabled_sources().map(|source| source.name.as_str()).collect();
        for (cause, [lower, upper]) in self.errors.causes.iter().zip(ranges) {
            let name = names[cause.source];
            let is_new = self.varying.iter().all(|other| other != name);
            let varies = upper - lower > ROUNDING * upper.abs().max(lower.abs());
            if self.errors.magnitudes[cause.source] != 0.0 && varies && is_new {
                self.varying.push(name.to_owned());
            }
        }
        Ok(())
    }

    /// Returns whether no enabled source is repeatable.
    pub fn is_nominal(&self) -> bool {
        self.spec.enabled_sources().all(|source| source.class != Class::Repeatable)
    }

    /// Returns the real pose of the tool: the exact chain with all repeatable sources.
    pub(crate) fn real_tool(&self, q: &[f64], u: &[f64]) -> Result<Pose, Error> {
        drawn_pose(&self.manipulator, q, &self.s, u, &self.errors.magnitudes)
    }

    /// Returns the errors at a configuration.
    pub(crate) fn errors_at(&self, q: &[f64], u: &[f64]) -> Result<ChainErrors, Error> {
        Ok(self.errors.errors(&self.spec, self.errors.values(q, &self.s, u)?.into_iter()))
    }

    /// Returns the home configuration with one variable at `value`, and the nominal inputs.
    pub(crate) fn at_home(&self, variable: usize, value: f64) -> (Vec<f64>, Vec<f64>) {
        let description = self.manipulator.description();
        let mut q = sampling::home(description);
        q[variable] = value;
        (q, sampling::nominal_inputs(description))
    }

    /// Returns the inputs that give the direction from which a variable approached its position: 1
    /// from below, -1 from above.
    ///
    /// These are pure numbers from -1 to 1 on which errors of the variable or of its frame depend,
    /// and which are not set.
    pub(crate) fn directions(&self, variable: usize) -> Vec<usize> {
        let is_direction =
            |input: &abbe_spec::Input| input.range == [-1.0, 1.0] && input.dimension == Dimension::NONE;
        let named = self.spec.inputs.iter().enumerate().filter(|(_, input)| is_direction(input));
        let free = named.map(|(i, _)| i).filter(|i| !self.fixed_inputs.contains(i));
        let own: Vec<usize> = (0..self.errors.causes.len())
            .filter(|cause| self.errors.causes[*cause].variable(&self.spec) == Some(variable))
            .collect();
        let changes = |input: &usize| {
            self.configurations.iter().take(COMPARED).any(|Configuration { q, u, .. }| {
                let values = [-1.0, 1.0].map(|side| {
                    let mut u = u.clone();
                    u[*input] = side;
                    self.errors.values(q, &self.s, &u).unwrap_or_default()
                });
                own.iter().any(|cause| {
                    let magnitude = self.errors.magnitudes[self.errors.causes[*cause].source];
                    let [below, above] = [0, 1].map(|side| values[side].get(*cause).copied().unwrap_or(0.0));
                    magnitude * (above - below) != 0.0
                })
            })
        };
        free.filter(changes).collect()
    }

    /// Replaces the values of inputs that are directions of approach by the nearer one of -1 and 1,
    /// and compares again.
    pub(crate) fn approached(&mut self, directions: &[usize]) -> Result<(), Error> {
        for (i, Configuration { q, u, .. }) in self.configurations.iter_mut().enumerate() {
            directions.iter().for_each(|input| u[*input] = if u[*input] < 0.0 { -1.0 } else { 1.0 });
            self.real[i] = drawn_pose(&self.manipulator, q, &self.s, u, &self.errors.magnitudes)?;
        }
        Ok(())
    }

    /// Returns the frames of the chain with given errors, and the tool after the last.
    pub(crate) fn links(&self, q: &[f64], errors: &ChainErrors) -> Result<(Vec<Link>, Pose), Error> {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let mut transforms = vec![Pose::IDENTITY; self.spec.frames.len() + 1];
        let (q, s) = (sum(q, &errors.joints), sum(&self.s, &errors.parameters));
        self.manipulator.transforms(&q, &s, &mut transforms)?;
        let tool = transforms.pop().unwrap_or(Pose::IDENTITY);
        let link = |(i, nominal): (usize, &Pose)| {
            let [theta, d, a, alpha] = errors.dh_numbers[i];
            let (z, x) = (about_z(theta, d), about_x(alpha, a));
            // The errors of two numbers come before the nominal transform of the row, those of the
            // other two after it.
            let transform = match self.spec.frames[i].convention {
                Some(DhConvention::Standard) => z.then(nominal).then(&x),
                Some(DhConvention::Modified) => x.then(nominal).then(&z),
                None => *nominal,
            };
            let error = real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &errors.frames[i..=i]);
            Link { transform, error }
        };
        Ok((transforms.iter().enumerate().map(link).collect(), tool))
    }

    /// Compares the poses of a model with the real ones.
    pub(crate) fn model_difference(&self, model: impl Fn(&[f64]) -> Pose) -> PoseDifference {
        let pairs = self.configurations.iter().zip(&self.real);
        PoseDifference::new(pairs.map(|(configuration, real)| [model(&configuration.q), *real]))
    }

    /// Compares the nominal poses with the real ones at corrected commands.
    pub(crate) fn command_difference(
        &self,
        corrected: impl Fn(&[f64], &[f64]) -> Result<Vec<f64>, Error>,
    ) -> Result<PoseDifference, Error> {
        let mut pairs = Vec::with_capacity(self.ideal.len());
        for (Configuration { q, u, .. }, ideal) in self.configurations.iter().zip(&self.ideal) {
            pairs.push([*ideal, self.real_tool(&corrected(q, u)?, u)?]);
        }
        Ok(PoseDifference::new(pairs))
    }

    /// Returns a sentence about errors of these variables that depend on more than the variable
    /// itself, if there are any.
    ///
    /// The inputs `followed` are known to the format.
    pub(super) fn errors_beyond_own_axis(&self, variables: &[usize], followed: &[usize]) -> Option<String> {
        let sources: Vec<&str> = self.spec.enabled_sources().map(|source| source.name.as_str()).collect();
        let has_magnitude = |cause: &Cause| self.errors.magnitudes[cause.source] != 0.0;
        let mut names: Vec<String> = Vec::new();
        for Configuration { q, u, .. } in self.configurations.iter().take(COMPARED) {
            let Ok(all) = self.errors.values(q, &self.s, u) else { continue };
            for variable in variables {
                let (at, mut inputs) = self.at_home(*variable, q[*variable]);
                followed.iter().for_each(|input| inputs[*input] = u[*input]);
                let Ok(alone) = self.errors.values(&at, &self.s, &inputs) else { continue };
                for (cause, (all, alone)) in self.errors.causes.iter().zip(all.iter().zip(&alone)) {
                    let name = format!("\"{}\"", sources[cause.source]);
                    let counts = has_magnitude(cause) && cause.variable(&self.spec) == Some(*variable);
                    let differs = (all - alone).abs() > 1e-9 * all.abs().max(alone.abs());
                    if counts && differs && !names.contains(&name) {
                        names.push(name);
                    }
                }
            }
        }
        (!names.is_empty()).then(|| {
            format!(
                "These sources depend on more than the position of their own axis; they are \
                 evaluated with the other axes at home and the inputs at their values (`{SET}`): \
                 {}.",
                names.join(", ")
            )
        })
    }

    /// Returns a sentence about the varying errors, of which constant numbers hold the mean, if
    /// there are any.
    pub(crate) fn held_at_mean(&self) -> Option<String> {
        let names = self.varying.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>();
        (!names.is_empty()).then(|| {
            format!(
                "These sources vary with the configuration; the file holds their means over the \
                 workspace: {}.",
                names.join(", ")
            )
        })
    }
}

/// Draws joints within their limits, and inputs within their ranges unless they are fixed.
fn configurations(
    manipulator: &Interpreter,
    fixed_inputs: &[usize],
    samples: usize,
    seed: u64,
) -> Result<Vec<Configuration>, Error> {
    let description = manipulator.description();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let free = |i: &usize| {
        description.inputs[*i].range.iter().all(|end| end.is_finite()) && !fixed_inputs.contains(i)
    };
    let inputs: Vec<usize> = (0..description.inputs.len()).filter(free).collect();
    let workspace = random_joint_samples(manipulator, &moved, samples, seed)?.inputs(manipulator, &inputs)?;
    Ok((0..workspace.len()).filter_map(|index| workspace.configuration(index).ok()).collect())
}
