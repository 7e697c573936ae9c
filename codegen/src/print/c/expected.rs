//! Results of the functions at one configuration, as the generator computes them.

use std::ops::Add;

use abbe_core::Function;
use abbe_spec::{Spec, Symbol};

use super::Real;
use crate::chain::Model;
use crate::program::{Program, Rounded, locals, results, straight_line};

/// Values of every argument, by name.
pub(super) type Given = [(&'static str, Vec<f64>); 9];

/// Length of each result, and the sum of its elements weighted 1 to 7 cyclically.
pub(super) type Sums = Vec<(usize, Rounded)>;

/// Returns the first of a few configurations at which the most functions have finite results, and
/// the sums of these; none near a singularity of Euler angles, or if a number is not finite.
pub(super) fn expected(
    spec: &Spec,
    model: &Model,
    functions: &[Function],
    real: Real,
) -> (Given, Vec<Option<Sums>>) {
    let computed: Vec<Computed> = functions.iter().map(|function| Computed::new(*function, model)).collect();
    let at = |start: usize| {
        let given = given(spec, model, start, real);
        let sums = computed.iter().map(|computed| computed.sums(&given, real.unit_roundoff()));
        let sums: Vec<_> = sums.collect();
        let missing = sums.iter().filter(|sums| sums.is_none()).count();
        (missing, given, sums)
    };
    let mut best = at(0);
    for start in 1..16 {
        if best.0 > 0 {
            let other = at(start);
            best = if other.0 < best.0 { other } else { best };
        }
    }
    (best.1, best.2)
}

/// A function, the lengths of its results, and the programs that compute them and the margin.
pub(super) struct Computed<'m> {
    function: Function,
    model: &'m Model,
    lens: Vec<usize>,
    programs: Vec<Program>,
}

impl<'m> Computed<'m> {
    pub(super) fn new(function: Function, model: &'m Model) -> Self {
        let (arrays, margin) = results(function, model);
        let lens = arrays.iter().map(Vec::len).collect();
        // The arrays of a tree of frames may read different passive variables.
        let each = arrays.into_iter().chain(margin.map(|margin| vec![margin]));
        let programs = match model.loops {
            Some(_) => each.map(|nodes| Program::new(&model.graph, &nodes)).collect(),
            None => vec![straight_line(function, model)],
        };
        Self { function, model, lens, programs }
    }

    /// Returns the numbers of the results, then the margin, with bounds of their rounding errors.
    pub(super) fn numbers(&self, given: &Given, unit: f64) -> Vec<Rounded> {
        let Self { function, model, programs, .. } = self;
        let rounded = |(array, program): (usize, &Program)| {
            // The pose of a step of the compensator is the real one, everything else is nominal.
            let function = match (*function, array) {
                (Function::CompensatorStep, 0) => Function::RealPose,
                (function, _) => function,
            };
            let value = |symbol| value_of(given, function, symbol);
            let locals = locals(function, model, value, unit);
            let symbol = |symbol| match symbol {
                Symbol::Local(i) => locals.get(i).copied().unwrap_or(Rounded::exact(f64::NAN, unit)),
                symbol => Rounded::exact(value(symbol), unit),
            };
            program.rounded(model.graph.tables(), symbol, unit)
        };
        programs.iter().enumerate().flat_map(rounded).collect()
    }

    /// Returns the sums with bounds of the rounding errors of the function and of the sum, and of
    /// those of the generator, which computes with doubles.
    fn sums(&self, given: &Given, unit: f64) -> Option<Sums> {
        let mut numbers = self.numbers(given, unit).into_iter();
        let sum = |len: &usize| {
            let weight = |k: usize| Rounded::exact((k % 7 + 1) as f64, unit);
            let weighted = numbers.by_ref().take(*len).enumerate().map(|(k, number)| weight(k) * number);
            let mut sum = weighted.fold(Rounded::exact(0.0, unit), Add::add);
            // The expected value is rounded as well.
            let own = Real::Double.unit_roundoff() / unit;
            sum.bound += own * sum.bound + unit * sum.value.abs();
            (*len, sum)
        };
        let sums: Sums = self.lens.iter().map(sum).collect();
        let is_finite = sums.iter().all(|(_, sum)| sum.value.is_finite() && sum.bound.is_finite());
        (is_finite && numbers.all(|margin| margin.value >= 0.1)).then_some(sums)
    }
}

fn value_of(given: &Given, function: Function, symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Variable(k) => given[0].1[k],
        Symbol::Parameter(k) => given[1].1[k],
        Symbol::Input(k) => given[2].1[k],
        Symbol::Error(k) if function == Function::Covariance => given[4].1[k],
        Symbol::Error(k) => given[3].1[k],
        Symbol::Magnitude(k) => given[5].1[k],
        Symbol::Target(k) => given[6].1[k],
        Symbol::Passive(_) | Symbol::Local(_) => f64::NAN,
    }
}

/// Returns values of every argument; each `start` gives different ones. The target is the pose of
/// another configuration for a machine with inverse kinematics in closed form.
fn given(spec: &Spec, model: &Model, start: usize, real: Real) -> Given {
    let share = |k: usize| 0.1 + 0.8 * ((start + k + 1) as f64 * 0.618_033_988_749_894_9).fract();
    let between = |k: usize, [lower, upper]: [f64; 2], otherwise: f64| {
        let value = lower + share(k) * (upper - lower);
        if value.is_finite() { value } else { otherwise }
    };
    let (variables, inputs) = (spec.variables.iter().enumerate(), spec.inputs.iter().enumerate());
    let q = |from: usize| -> Vec<f64> {
        variables.clone().map(|(k, variable)| between(from + k, variable.limits, variable.home)).collect()
    };
    let errors = 0..6 * spec.frames.len();
    let mut given: Given = [
        ("q", q(9)),
        ("s", spec.parameters.iter().map(|parameter| parameter.value).collect()),
        ("u", inputs.map(|(k, input)| between(k, input.range, input.value)).collect()),
        ("errors", errors.clone().map(|k| 1e-3 * (share(k) - 0.5)).collect()),
        ("variances", errors.map(|k| 1e-6 * share(k)).collect()),
        ("magnitudes", (0..spec.enabled_sources().count()).map(|k| 2.0 * share(k) - 1.0).collect()),
        ("target", vec![]),
        ("last", vec![0.0; spec.variables.len()]),
        ("rotations", vec![1.0; 3]),
    ];
    if model.solutions() > 0 {
        let pose = results(Function::Pose, model).0.concat();
        given[6].1 = model.graph.evaluate(&pose, |symbol| value_of(&given, Function::Pose, symbol));
    }
    given[0].1 = q(0);
    given.map(|(name, values)| (name, values.into_iter().map(|value| real.nearest(value)).collect()))
}
