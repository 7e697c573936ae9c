//! Manipulator under test, with its configurations.

use abbe::Pose;
use abbe::analysis::Sweepable;
use abbe::analysis::sampling::{joint_sample, nominal_inputs, nominal_parameters};
use abbe_interpreter::Interpreter;
use abbe_manipulators::Shipped;
use abbe_spec::Spec;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};

/// Number of configurations of a batch: arguments and results stay in the caches, and the
/// interpreter evaluates as many together.
pub(crate) const COUNT: usize = 64;

pub(crate) struct Subject {
    pub(crate) name: &'static str,
    pub(crate) compiled: &'static dyn Sweepable,
    pub(crate) interpreter: Interpreter,
    /// q of each configuration, within the limits.
    pub(crate) variables: Vec<Vec<f64>>,
    pub(crate) parameters: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    /// One value per generalized error, used as ε and as σ².
    pub(crate) errors: Vec<f64>,
}

impl Subject {
    pub(crate) fn new(shipped: &Shipped) -> Self {
        // Static lifetime.
        let spec: &'static Spec =
            Box::leak(Box::new(Spec::parse(shipped.name, shipped.spec).expect("shipped specs are right")));
        let description = shipped.compiled.description();
        let moved: Vec<usize> = (0..description.variables.len()).collect();
        Self {
            name: shipped.name,
            compiled: shipped.compiled,
            interpreter: Interpreter::new(spec.clone()),
            variables: (0..COUNT).map(|index| joint_sample(description, 1.0, &moved, index)).collect(),
            parameters: nominal_parameters(description),
            inputs: nominal_inputs(description),
            errors: (0..6 * description.frames.len()).map(|k| 1e-3 / (1 + k) as f64).collect(),
        }
    }

    /// Returns the benchmark group of a path, with times per configuration.
    pub(crate) fn group<'c>(
        &self,
        criterion: &'c mut Criterion,
        function: &str,
    ) -> BenchmarkGroup<'c, WallTime> {
        let mut group = criterion.benchmark_group(format!("{}/{}", self.name, function));
        group.throughput(Throughput::Elements(COUNT as u64));
        group
    }

    /// Returns `A_1 … A_n` and the tool of each configuration.
    pub(crate) fn transforms(&self) -> Vec<Vec<[[f64; 3]; 4]>> {
        let transforms = |q: &Vec<f64>| {
            let mut transforms = vec![Pose::IDENTITY; self.errors.len() / 6 + 1];
            self.compiled.transforms(q, &self.parameters, &mut transforms).expect("within limits");
            transforms.iter().map(|pose| pose.0).collect()
        };
        self.variables.iter().map(transforms).collect()
    }
}
