//! The machine as it was found: where its tool really is, and what stays the same of its errors.
//!
//! Most formats hold numbers that never change. What changes with the configuration is held at its mean over the
//! workspace, which is what the constant part is closest to.

use std::sync::Arc;

use abbe::analysis::{Configuration, Workspace, random_joint_samples, sampling};
use abbe::{Class, Error, Manipulator, Pose, drawn_pose, real_pose, repeatable_magnitudes};
use abbe_codegen::graph::{Graph, Node};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Symbol;
use abbe_spec::{ChainNumber, DhConvention, Spec};

use super::difference::Difference;
use super::slides::Slide;
use super::{ExportedFile, Report};
use crate::machine::Machine;
use crate::mistake;

/// A change by less than this part of an error is rounding.
const ROUNDING: f64 = 1e-12;

/// The machine with all its repeatable errors, and the configurations at which it is looked at.
pub(super) struct Found {
    pub(super) spec: Arc<Spec>,
    pub(super) manipulator: Interpreter,
    /// The same without errors of numbers of the chain: its effects are those of frames.
    of_frames: Interpreter,
    graph: Graph,
    /// What the effects of frames, then the numbers of the chain, are errors of.
    causes: Vec<Cause>,
    deviations: Vec<Node>,
    magnitudes: Vec<f64>,
    pub(super) s: Vec<f64>,
    pub(super) configurations: Vec<Configuration>,
    /// The seed of the configurations, and how many were asked for.
    seed: u64,
    samples: usize,
    /// Where the tool really is, and where it should be, at each.
    pub(super) real: Vec<Pose>,
    pub(super) ideal: Vec<Pose>,
    /// The mean of the errors.
    pub(super) mean: Errors,
    /// The sources whose errors change with the configuration.
    pub(super) changing: Vec<String>,
    /// Where a spec is named in mistakes.
    pub(super) origin: String,
}

/// What an error is one of.
#[derive(Clone, Copy, Debug)]
enum At {
    /// One of the six errors of a frame.
    Frame(usize, usize),
    Number(ChainNumber),
}

/// An error, and which of the enabled sources causes it.
#[derive(Clone, Copy, Debug)]
struct Cause {
    source: usize,
    at: At,
}

/// The errors at a configuration, or their means: of frames, joints, parameters and Denavit-Hartenberg numbers.
#[derive(Clone, Debug)]
pub(super) struct Errors {
    pub(super) frames: Vec<[f64; 6]>,
    pub(super) joints: Vec<f64>,
    pub(super) parameters: Vec<f64>,
    /// Of theta, d, a and alpha.
    pub(super) numbers: Vec<[f64; 4]>,
}

/// A frame of the real chain: `A_i` with its numbers as they are, then `E_i`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) transform: Pose,
    pub(super) error: Pose,
}

impl Found {
    /// Looks at it at so many random configurations.
    pub(super) fn new(machine: &Machine, samples: usize, seed: u64) -> Result<Self, Diagnostics> {
        let spec = machine.spec.clone();
        let manipulator = Interpreter::new(spec.clone());
        let mut frames_alone = (*spec).clone();
        frames_alone.sources.iter_mut().for_each(|source| source.deviations.clear());
        let of_frames = Interpreter::new(frames_alone);
        let mut graph = Graph::with_tables(&spec.tables);
        let (mut causes, mut deviations) = (Vec::new(), Vec::new());
        for effect in of_frames.description().effects.iter() {
            causes
                .push(Cause { source: effect.source, at: At::Frame(effect.frame, effect.component.index()) });
        }
        for (source, declared) in spec.enabled_sources().enumerate() {
            let times = graph.constant(declared.magnitude.map_or(1.0, |magnitude| magnitude.value));
            for deviation in &declared.deviations {
                let error = graph.lower(&deviation.error);
                deviations.push(graph.mul(times, error));
                causes.push(Cause { source, at: At::Number(deviation.number) });
            }
        }
        let description = manipulator.description();
        let (s, magnitudes) = (sampling::nominal_parameters(description), repeatable_magnitudes(description));
        let mistaken =
            |error: &Error| mistake::not_evaluated(&machine.origin, "a configuration", error, description);
        let configurations =
            configurations(machine, &manipulator, samples, seed).map_err(|error| mistaken(&error))?;
        let mut found = Self {
            mean: Errors::none(&spec),
            origin: machine.origin.clone(),
            changing: Vec::new(),
            real: Vec::new(),
            ideal: Vec::new(),
            configurations: Vec::new(),
            seed,
            samples,
            spec,
            manipulator,
            of_frames,
            graph,
            causes,
            deviations,
            magnitudes,
            s,
        };
        found.look(&configurations).map_err(|(place, error)| {
            let at = crate::number::variables(&configurations[place].q, &found.spec);
            mistake::not_evaluated(&found.origin, &at, &error, found.manipulator.description())
        })?;
        found.configurations = configurations;
        Ok(found)
    }

    fn look(&mut self, configurations: &[Configuration]) -> Result<(), (usize, Error)> {
        let mut sums = vec![0.0; self.causes.len()];
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.causes.len()];
        for (place, Configuration { q, u, .. }) in configurations.iter().enumerate() {
            let failed = |error| (place, error);
            self.real.push(self.real_tool(q, u).map_err(failed)?);
            self.ideal.push(self.manipulator.pose(q, &self.s).map_err(failed)?);
            for (i, value) in self.values(q, u).map_err(failed)?.into_iter().enumerate() {
                sums[i] += value;
                ranges[i] = [ranges[i][0].min(value), ranges[i][1].max(value)];
            }
        }
        let count = configurations.len().max(1) as f64;
        // The mean of equal numbers is that number.
        let mean = sums.iter().zip(&ranges).map(|(sum, [lower, upper])| (sum / count).clamp(*lower, *upper));
        self.mean = self.errors(mean);
        let names: Vec<&str> = self.spec.enabled_sources().map(|source| source.name.as_str()).collect();
        for (cause, [lower, upper]) in self.causes.iter().zip(ranges) {
            let name = names[cause.source];
            let is_known = self.changing.iter().any(|known| known == name);
            let changes = upper - lower > ROUNDING * upper.abs().max(lower.abs());
            if self.magnitudes[cause.source] != 0.0 && changes && !is_known {
                self.changing.push(name.to_owned());
            }
        }
        Ok(())
    }

    /// Where the tool really is: the exact chain with all repeatable sources.
    pub(super) fn real_tool(&self, q: &[f64], u: &[f64]) -> Result<Pose, Error> {
        drawn_pose(&self.manipulator, q, &self.s, u, &self.magnitudes)
    }

    /// The errors at a configuration.
    pub(super) fn errors_at(&self, q: &[f64], u: &[f64]) -> Result<Errors, Error> {
        Ok(self.errors(self.values(q, u)?.into_iter()))
    }

    /// Home with one variable elsewhere, and the inputs as they are.
    pub(super) fn at_home(&self, variable: usize, value: f64) -> (Vec<f64>, Vec<f64>) {
        let description = self.manipulator.description();
        let mut q = sampling::home(description);
        q[variable] = value;
        (q, sampling::nominal_inputs(description))
    }

    /// The value of every cause.
    fn values(&self, q: &[f64], u: &[f64]) -> Result<Vec<f64>, Error> {
        let mut values = vec![0.0; self.causes.len() - self.deviations.len()];
        self.of_frames.effects(q, &self.s, u, &mut values)?;
        let symbol = |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Parameter(i) => self.s[i],
            Symbol::Input(i) => u[i],
            _ => 0.0,
        };
        values.extend(self.graph.evaluate(&self.deviations, symbol));
        Ok(values)
    }

    fn errors(&self, values: impl Iterator<Item = f64>) -> Errors {
        let mut errors = Errors::none(&self.spec);
        for (cause, value) in self.causes.iter().zip(values) {
            let value = value * self.magnitudes[cause.source];
            *match cause.at {
                At::Frame(frame, component) => &mut errors.frames[frame][component],
                At::Number(ChainNumber::Joint(i)) => &mut errors.joints[i],
                At::Number(ChainNumber::Parameter(i)) => &mut errors.parameters[i],
                At::Number(ChainNumber::DenavitHartenberg { frame, number }) => {
                    &mut errors.numbers[frame][number as usize]
                }
            } += value;
        }
        errors
    }

    /// The chain at a configuration with given errors, and the tool after it.
    pub(super) fn links(&self, q: &[f64], errors: &Errors) -> Result<(Vec<Link>, Pose), Error> {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let mut transforms = vec![Pose::IDENTITY; self.spec.frames.len() + 1];
        let (q, s) = (sum(q, &errors.joints), sum(&self.s, &errors.parameters));
        self.manipulator.transforms(&q, &s, &mut transforms)?;
        let tool = transforms.pop().unwrap_or(Pose::IDENTITY);
        let link = |(i, nominal): (usize, &Pose)| {
            let [theta, d, a, alpha] = errors.numbers[i];
            let (z, x) = (about_z(theta, d), about_x(alpha, a));
            // The two numbers before the frame's own motion are added before it, the other two behind.
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

    /// Begins the report of a format: its name and files, the words for what is compared, what remains, and the sign. Whatever
    /// else there is to say is added by the format.
    pub(super) fn report(
        &self,
        format: String,
        files: Vec<ExportedFile>,
        compared: [&'static str; 2],
        remains: Difference,
        sign: String,
    ) -> Report {
        Report {
            name: self.spec.name.clone(),
            format,
            length: self.spec.length.symbol(),
            files,
            changes: Vec::new(),
            left_out: Vec::new(),
            compared,
            before: self.nominal(),
            at_nodes: None,
            remains,
            placed: None,
            turned: Vec::new(),
            configurations: self.samples,
            seed: self.seed,
            sign,
        }
    }

    /// Whether nothing repeatable is wrong with it.
    pub(super) fn is_nominal(&self) -> bool {
        self.spec.enabled_sources().all(|source| source.class != Class::Repeatable)
    }

    /// What the nominal model is wrong by.
    fn nominal(&self) -> Difference {
        Difference::new(self.ideal.iter().zip(&self.real).map(|(ideal, real)| [*ideal, *real]))
    }

    /// What a model is wrong by.
    pub(super) fn of_model(&self, model: impl Fn(&[f64]) -> Pose) -> Difference {
        let pairs = self.configurations.iter().zip(&self.real);
        Difference::new(pairs.map(|(configuration, real)| [model(&configuration.q), *real]))
    }

    /// What remains when commands are corrected: from where the tool should be to where it then really is.
    pub(super) fn of_commands(
        &self,
        corrected: impl Fn(&[f64]) -> Result<Vec<f64>, Error>,
    ) -> Result<Difference, Error> {
        let mut pairs = Vec::with_capacity(self.ideal.len());
        for (Configuration { q, u, .. }, ideal) in self.configurations.iter().zip(&self.ideal) {
            pairs.push([*ideal, self.real_tool(&corrected(q)?, u)?]);
        }
        Ok(Difference::new(pairs))
    }

    /// What a table over one axis leaves out: errors that depend on more than the axis that they are of.
    pub(super) fn beyond_own_axis(&self, slides: &[Slide]) -> Option<String> {
        const PLACES: usize = 50;
        let own = |cause: &Cause| match cause.at {
            At::Frame(frame, _) | At::Number(ChainNumber::DenavitHartenberg { frame, .. }) => {
                self.spec.frames[frame].variable
            }
            At::Number(ChainNumber::Joint(variable)) => Some(variable),
            At::Number(ChainNumber::Parameter(_)) => None,
        };
        let sources: Vec<&str> = self.spec.enabled_sources().map(|source| source.name.as_str()).collect();
        let mut names: Vec<String> = Vec::new();
        for Configuration { q, u, .. } in self.configurations.iter().take(PLACES) {
            let Ok(all) = self.values(q, u) else { continue };
            for variable in slides.iter().map(|slide| slide.variable) {
                let (at, inputs) = self.at_home(variable, q[variable]);
                let Ok(alone) = self.values(&at, &inputs) else { continue };
                for (cause, (all, alone)) in self.causes.iter().zip(all.iter().zip(&alone)) {
                    let name = format!("\"{}\"", sources[cause.source]);
                    let counts = self.magnitudes[cause.source] != 0.0 && own(cause) == Some(variable);
                    let differs = (all - alone).abs() > 1e-9 * all.abs().max(alone.abs());
                    if counts && differs && !names.contains(&name) {
                        names.push(name);
                    }
                }
            }
        }
        (!names.is_empty()).then(|| {
            format!(
                "What depends on more than the position of its own axis is taken with the other axes at home and the inputs as they are \
                 (`--set`): {}.",
                names.join(", ")
            )
        })
    }

    /// What every format of constant numbers leaves out of this machine.
    pub(super) fn held_at_mean(&self) -> Option<String> {
        let names = self.changing.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>();
        (!names.is_empty()).then(|| {
            format!(
                "What changes with the configuration is held at its mean over the workspace: {}.",
                names.join(", ")
            )
        })
    }
}

impl Errors {
    pub(super) fn none(spec: &Spec) -> Self {
        Self {
            frames: vec![[0.0; 6]; spec.frames.len()],
            joints: vec![0.0; spec.variables.len()],
            parameters: vec![0.0; spec.parameters.len()],
            numbers: vec![[0.0; 4]; spec.frames.len()],
        }
    }
}

/// Joints within their limits; inputs within their ranges, but for those that were set.
fn configurations(
    machine: &Machine,
    manipulator: &Interpreter,
    samples: usize,
    seed: u64,
) -> Result<Vec<Configuration>, Error> {
    let description = manipulator.description();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let free = |i: &usize| {
        let ends = description.inputs[*i].range;
        ends.iter().all(|end| end.is_finite()) && !machine.fixed_inputs().contains(i)
    };
    let inputs: Vec<usize> = (0..description.inputs.len()).filter(free).collect();
    let workspace = random_joint_samples(manipulator, &moved, samples, seed)?.inputs(manipulator, &inputs)?;
    Ok((0..workspace.len()).filter_map(|index| workspace.configuration(index).ok()).collect())
}

/// `Rz(angle) Tz(shift)`.
pub(super) fn about_z(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, shift]])
}

/// `Rx(angle) Tx(shift)`.
pub(super) fn about_x(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c], [shift, 0.0, 0.0]])
}
