//! Workspace of a study.

use abbe::analysis::{
    Axis, BaseBox, Configuration, JointSamples, Legs, Presentation, Workspace, base_box, joint_grid,
    joint_samples, listed, platform_grid, presented_volume, random_joint_samples, with_inputs,
};
use abbe::{Error, Manipulator, analysis::sampling::range_of};
use abbe_spec::{Input, Spec, option::shard_command};

use super::{orientation::describe, path::Path};
use crate::{mistake, number};

/// Default number of joint samples.
const SAMPLES: usize = 1000;

/// Largest number of configurations of a workspace, and of those that one run sweeps.
pub(super) const LARGEST: usize = if usize::BITS < 64 { ONE_RUN } else { 10_usize.pow(13) };
const ONE_RUN: usize = 1_000_000_000;

/// Refuses to sweep more configurations than one run can; `origin` is the machine.
///
/// # Errors
///
/// There are more than 10⁹.
pub(crate) fn in_one_run(count: usize, origin: &str) -> crate::Result<()> {
    if count <= ONE_RUN {
        return Ok(());
    }
    let message = format!("{count} configurations are more than one run sweeps, {ONE_RUN}");
    let parts = count.div_ceil(ONE_RUN);
    let first = shard_command(origin, 1, parts.try_into().unwrap_or(u32::MAX));
    let help = format!("use fewer, or sweep them in parts, the first by `{first}`, and merge these");
    Err(mistake::with_help(origin, message, help))
}

/// Largest number of inputs for which every combination of their ends is the default; more inputs
/// are sampled.
const COMBINED: usize = 6;

/// Set of configurations.
#[derive(Clone, Debug)]
pub struct Region {
    /// Configurations of joints and parameters.
    pub form: Form,
    /// Inputs with their own values: every configuration is combined with every combination of
    /// them.
    pub inputs: Vec<Axis>,
    /// Inputs sampled together with the joints, within their ranges; used by forms with samples
    /// only.
    pub sampled_inputs: Vec<usize>,
}

/// Set of configurations of joints and parameters.
#[derive(Clone, Debug)]
pub enum Form {
    /// Volume of tool points, each presented at one point in space.
    Presented(Presentation),
    /// Every combination of values of some variables.
    Grid(Vec<Axis>),
    /// Every combination of values of some passive variables, with the joint variables as their
    /// function.
    Platform(Vec<Axis>, Legs),
    /// Samples of some variables within their limits: random with a seed, a low-discrepancy
    /// sequence without.
    Samples {
        /// Indices of the variables that move.
        moved: Vec<usize>,
        /// Number of samples.
        count: usize,
        /// Seed of random samples.
        seed: Option<u64>,
    },
    /// Box of points in the base frame.
    Box(BaseBox),
    /// Configurations from a file.
    Path(Path),
    /// One configuration of the joints.
    One(Vec<f64>),
}

impl Region {
    /// Returns one configuration of the joints, with nominal parameters and inputs.
    pub fn one(q: Vec<f64>) -> Self {
        Self::new(Form::One(q))
    }

    /// Returns configurations of the joints, with nominal parameters and inputs.
    pub fn listed(rows: Vec<Vec<f64>>) -> Self {
        Self::new(Form::Path(Path::of_joints(rows)))
    }

    /// Returns a form with nominal inputs.
    pub(super) fn new(form: Form) -> Self {
        Self { form, inputs: Vec::new(), sampled_inputs: Vec::new() }
    }

    /// Returns samples of all variables, with every combination of both ends of the inputs' ranges.
    pub fn samples(spec: &Spec) -> Self {
        let moved = (0..spec.variables.len()).collect();
        let mut region = Self::new(Form::Samples { moved, count: SAMPLES, seed: None });
        if spec.inputs.iter().filter(|input| has_range(input)).count() <= COMBINED {
            region.inputs = (0..spec.inputs.len()).filter_map(|i| ends(i, spec)).collect();
        }
        region.over_ranges(spec);
        region
    }

    /// Varies every input that has a range and is not mentioned: sampled in forms with samples, at
    /// both ends in others.
    pub fn over_ranges(&mut self, spec: &Spec) {
        let named = self.moving_inputs();
        for i in (0..spec.inputs.len()).filter(|i| !named.contains(i)) {
            let Some(ends) = ends(i, spec) else { continue };
            match self.form {
                Form::Samples { .. } => self.sampled_inputs.push(i),
                _ => self.inputs.push(ends),
            }
        }
    }

    /// Keeps inputs nominal, regardless of the definition.
    pub fn fix(&mut self, inputs: &[usize]) {
        self.inputs.retain(|axis| !inputs.contains(&axis.index));
        self.sampled_inputs.retain(|i| !inputs.contains(i));
        if let Form::Path(path) = &mut self.form {
            inputs.iter().for_each(|input| path.remove_input(*input));
        }
    }

    /// Returns the indices of the inputs that are not constant at their nominal value.
    pub fn moving_inputs(&self) -> Vec<usize> {
        let own = self.inputs.iter().map(|axis| axis.index).chain(self.sampled_inputs.iter().copied());
        let mut moving: Vec<usize> = match &self.form {
            Form::Path(path) => own.chain(path.inputs()).collect(),
            _ => own.collect(),
        };
        moving.sort_unstable();
        moving
    }

    /// Returns the number of configurations, or none if there are too many.
    pub(super) fn count(&self) -> Option<usize> {
        let sizes: Vec<usize> = match &self.form {
            Form::Presented(Presentation { tool_points, approaches, .. }) => {
                tool_points.iter().chain(approaches).map(|axis| axis.values.len()).collect()
            }
            Form::Grid(axes) | Form::Platform(axes, _) => axes.iter().map(|axis| axis.values.len()).collect(),
            Form::Box(BaseBox { points, orientations, approaches, .. }) => {
                let held = approaches.iter().map(|axis| axis.values.len());
                points.iter().map(Vec::len).chain([orientations.len()]).chain(held).collect()
            }
            Form::Samples { count, .. } => vec![*count],
            Form::Path(path) => vec![path.configurations.len()],
            Form::One(_) => Vec::new(),
        };
        let sizes = sizes.into_iter().chain(self.inputs.iter().map(|axis| axis.values.len()));
        sizes.into_iter().try_fold(1, usize::checked_mul).filter(|count| *count <= LARGEST)
    }

    /// Returns the configurations. `seed` replaces the seed of the study.
    pub fn workspace<'a>(
        &self,
        manipulator: &'a dyn Manipulator,
        seed: Option<u64>,
    ) -> Result<Box<dyn Workspace + 'a>, Error> {
        let sampled = |samples: JointSamples| samples.inputs(manipulator, &self.sampled_inputs);
        let workspace: Box<dyn Workspace + 'a> = match &self.form {
            Form::Presented(presentation) => Box::new(presented_volume(manipulator, presentation)?),
            Form::Grid(axes) => Box::new(joint_grid(manipulator, axes)?),
            Form::Platform(axes, legs) => Box::new(platform_grid(manipulator, axes, legs.clone())?),
            Form::Samples { moved, count, seed: None } => {
                Box::new(sampled(joint_samples(manipulator, moved, *count)?)?)
            }
            Form::Samples { moved, count, seed: Some(own) } => {
                Box::new(sampled(random_joint_samples(manipulator, moved, *count, seed.unwrap_or(*own))?)?)
            }
            Form::Box(region) => Box::new(base_box(manipulator, region)?),
            Form::Path(path) => Box::new(listed(manipulator, path.configurations(manipulator))?),
            Form::One(q) => {
                let home = Configuration::home(manipulator.description());
                Box::new(listed(manipulator, vec![Configuration { q: q.clone(), ..home }])?)
            }
        };
        Ok(match &self.inputs[..] {
            [] => workspace,
            inputs => Box::new(with_inputs(manipulator, workspace, inputs.to_vec())?),
        })
    }

    /// Returns the indices of the parameters that are not constant at their nominal value.
    pub fn varying(&self, spec: &Spec) -> Vec<usize> {
        let mut varying = match &self.form {
            Form::Presented(Presentation { tool_points, .. }) => {
                let nominal = |axis: &Axis| spec.parameters[axis.index].value;
                let varies = |axis: &&Axis| axis.values.iter().any(|value| *value != nominal(axis));
                tool_points.iter().filter(varies).map(|axis| axis.index).collect()
            }
            Form::Path(path) => path.parameters().collect(),
            _ => Vec::new(),
        };
        varying.sort_unstable();
        varying
    }

    /// Describes the workspace in one sentence.
    pub fn describe(&self, spec: &Spec) -> String {
        let sentence = self.describe_form(spec);
        if self.inputs.is_empty() {
            return sentence;
        }
        let each = self.inputs.iter().map(|axis| describe_input(axis, spec)).collect::<Vec<_>>().join(", ");
        let combinations: usize = self.inputs.iter().map(|axis| axis.values.len()).product();
        let single = self.count().unwrap_or_default() / combinations.max(1);
        format!("{sentence}, each with {each}: {combinations} × {single} configurations")
    }

    fn describe_form(&self, spec: &Spec) -> String {
        let variable = |i: &usize| spec.variables[*i].name.as_str();
        match &self.form {
            Form::Presented(Presentation { point, tool_points, approaches, solved }) => {
                let sizes = |axes: &[Axis]| axes.iter().map(|axis| axis.values.len()).product::<usize>();
                let parameters = tool_points.iter().map(|axis| spec.parameters[axis.index].name.as_str());
                let held = approaches.iter().map(|axis| variable(&axis.index));
                let [x, y, z] = point.map(number::short);
                format!(
                    "{} tool points ({}) in {} approaches ({}), each moved to ({x}, {y}, {z}) {} \
                     by {}",
                    sizes(tool_points),
                    names(parameters),
                    sizes(approaches),
                    names(held),
                    spec.length.symbol(),
                    names(solved.iter().map(variable)),
                )
            }
            Form::Grid(axes) => {
                let axes =
                    axes.iter().map(|axis| format!("{} × {}", axis.values.len(), variable(&axis.index)));
                format!("grid of {}", names(axes))
            }
            Form::Platform(axes, _) => {
                let passive = |axis: &Axis| &spec.passive[axis.index].name;
                let axes = axes.iter().map(|axis| format!("{} × {}", axis.values.len(), passive(axis)));
                let legs = names(spec.variables.iter().map(|variable| variable.name.as_str()));
                format!("grid of {}, each reached by {legs}", names(axes))
            }
            Form::Samples { moved, count, seed } => {
                let random = if seed.is_some() { "random " } else { "" };
                let inputs = self.sampled_inputs.iter().map(|i| spec.inputs[*i].name.as_str());
                let moved = names(moved.iter().map(variable).chain(inputs));
                format!("{count} {random}samples of {moved} within their limits")
            }
            Form::Box(BaseBox { points, orientations, approaches, solved }) => {
                let [x, y, z] = points.each_ref().map(Vec::len);
                let (turned, solved) = (describe(orientations), names(solved.iter().map(variable)));
                let held = approaches
                    .iter()
                    .map(|axis| format!(" at each of {} {}", axis.values.len(), variable(&axis.index)));
                let held: String = held.collect();
                format!("box of {x} × {y} × {z} points in F_0, each reached {turned}{held} by {solved}")
            }
            Form::Path(path) => {
                format!("{} configurations from {}", path.configurations.len(), path.file)
            }
            Form::One(q) => format!("one configuration, {}", number::variables(q, spec)),
        }
    }
}

/// Returns true if an input has a range of non-zero width.
pub fn has_range(input: &Input) -> bool {
    let [lower, upper] = input.range;
    lower.is_finite() && upper.is_finite() && lower < upper
}

/// Returns the levels of an input, or both ends of its range, as an axis, if it has any.
fn ends(index: usize, spec: &Spec) -> Option<Axis> {
    let input = &spec.inputs[index];
    let values = if input.levels.is_empty() { input.range.to_vec() } else { input.levels.clone() };
    has_range(input).then_some(Axis { index, values })
}

/// Formats an axis as `payload = 0 kg and 5 kg`, or `payload = 0 kg … 5 kg (11 values)`.
fn describe_input(axis: &Axis, spec: &Spec) -> String {
    let Input { name, unit, .. } = &spec.inputs[axis.index];
    let show = |value: &f64| number::quantity(*value, unit);
    match &axis.values[..] {
        values @ ([_] | [_, _] | [_, _, _]) => {
            format!("{name} = {}", values.iter().map(show).collect::<Vec<_>>().join(" and "))
        }
        values => {
            let [least, largest] = range_of(values.iter().copied());
            format!("{name} = {} … {} ({} values)", show(&least), show(&largest), values.len())
        }
    }
}

fn names(names: impl Iterator<Item = impl Into<String>>) -> String {
    let names = names.map(Into::into).collect::<Vec<_>>();
    if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
}
