//! The description of the corrected command, executed statement by statement, has the bits of
//! `abbe_core::compensator` at every configuration. Variables hold NaN before they are assigned, so
//! that no call depends on what was there before.

use std::collections::HashMap;

use abbe_codegen::chain::Model;
use abbe_codegen::procedure::{
    Binary, Condition, Index, Kind, Precision, Procedure, Statement, Unary, Value, Whole, clamped,
    compensated, least_and_greatest, look_up, side, sign,
};
use abbe_codegen::program::{Routines, results};
use abbe_core::compensator::{Compensated, Cycle, Status, compensate};
use abbe_core::{Function, Pose, Scalar};
use abbe_spec::Spec;
use abbe_spec::expr::{Dimension, Extrapolation, Interpolation, Symbol, Table};

use crate::readable_rust::shipped;

/// A machine with the procedures of its corrected command.
struct Machine {
    spec: Spec,
    model: Model,
    procedures: Vec<Procedure>,
}

/// Variables of a call: the numbers of each, one for those that are no arrays.
type Variables = HashMap<&'static str, Vec<f64>>;

/// End of the statements of a loop.
#[derive(PartialEq)]
enum Flow {
    Next,
    Leave,
}

impl Machine {
    /// Creates a machine for procedures that call no functions.
    fn with(procedures: Vec<Procedure>) -> Self {
        let (file, text) = shipped().into_iter().next().unwrap();
        let spec = Spec::parse(&file, &text).unwrap();
        Self { model: Model::new(&spec), spec, procedures }
    }

    /// Evaluates a generated function at joint variables and nominal parameters and inputs.
    fn evaluate(&self, function: Function, q: &[f64]) -> Vec<Vec<f64>> {
        let (arrays, _) = results(function, &self.model);
        let value = |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Parameter(i) => self.spec.parameters[i].value,
            Symbol::Input(i) => self.spec.inputs[i].value,
            _ => f64::NAN,
        };
        arrays.iter().map(|nodes| self.model.graph.evaluate(nodes, value)).collect()
    }

    /// Calls a procedure, and returns its results in order.
    fn call(&self, name: &str, given: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let procedure = self.procedures.iter().find(|procedure| procedure.name == name).unwrap();
        let unset = |kind| vec![f64::NAN; if let Kind::Array(len) = kind { len } else { 1 }];
        let own = procedure.results.iter().chain(&procedure.locals);
        let mut variables: Variables = own.map(|variable| (variable.name, unset(variable.kind))).collect();
        variables.extend(procedure.constants.iter().cloned());
        variables.extend(procedure.arguments.iter().map(|argument| argument.name).zip(given.iter().cloned()));
        self.run(&procedure.body, &mut variables);
        procedure.results.iter().map(|result| variables[result.name].clone()).collect()
    }

    fn run(&self, statements: &[Statement], variables: &mut Variables) -> Flow {
        for statement in statements {
            match statement {
                Statement::Comment(_) => {}
                Statement::Set(place, result) => {
                    let result = value(result, variables);
                    let (name, at) = match place {
                        Value::Name(name) => (name, 0),
                        Value::Element(name, index) => (name, index_of(index, variables)),
                        other => panic!("{other:?} is no variable"),
                    };
                    variables.get_mut(name).unwrap()[at] = result;
                }
                Statement::SetFlag(name, flag) => drop(variables.insert(name, vec![f64::from(*flag)])),
                Statement::SetWhole(name, whole) => {
                    let number = match whole {
                        Whole::Index(index) => sum_of(index, variables) as f64,
                        Whole::Nearest(number) => value(number, variables).round_ties_even(),
                        Whole::Status(status) => f64::from(status.code()),
                    };
                    variables.insert(name, vec![number]);
                }
                Statement::Copy { to, from, .. } => drop(variables.insert(to, variables[from].clone())),
                Statement::For { counter, range, is_descending, body } => {
                    let [from, to] = range.each_ref().map(|end| index_of(end, variables));
                    for k in from..to {
                        let k = if *is_descending { to - 1 - (k - from) } else { k };
                        variables.insert(counter.name(), vec![k as f64]);
                        if self.run(body, variables) == Flow::Leave {
                            break;
                        }
                    }
                }
                Statement::If { condition, body } => {
                    if holds(condition, variables) && self.run(body, variables) == Flow::Leave {
                        return Flow::Leave;
                    }
                }
                Statement::Leave(condition) if holds(condition, variables) => return Flow::Leave,
                Statement::Leave(_) => {}
                Statement::Call { procedure, arguments, result } => {
                    assert!(!arguments.contains(&result.name), "{procedure} overwrites {}", result.name);
                    let given: Vec<Vec<f64>> = arguments.iter().map(|name| variables[name].clone()).collect();
                    variables.insert(result.name, self.call(procedure, &given).remove(0));
                }
                Statement::Evaluate { function, q, results } => {
                    let function = Function::ALL.into_iter().find(|one| one.name() == *function).unwrap();
                    let found = self.evaluate(function, &variables[q]);
                    variables.extend(results.iter().copied().zip(found));
                }
            }
        }
        Flow::Next
    }

    /// Returns the corrected command by the compensator.
    fn expected(
        &self,
        description: &abbe_core::Description,
        q: &[f64],
        cycle: &Cycle<Vec<f64>>,
    ) -> Compensated<Vec<f64>> {
        let pose = |numbers: &[f64]| {
            let entries: [f64; 12] = numbers.try_into().unwrap();
            Pose(entries.as_chunks::<3>().0.try_into().unwrap())
        };
        let target = pose(&self.evaluate(Function::Pose, q)[0]);
        let columns = vec![[0.0; 6]; q.len()];
        let step = |q: &Vec<f64>, columns: &mut Vec<[f64; 6]>| {
            let found = self.evaluate(Function::CompensatorStep, q);
            columns.copy_from_slice(found[1].as_chunks::<6>().0);
            Ok(pose(&found[0]))
        };
        compensate(description, &target, &q.to_vec(), cycle, columns, step).unwrap()
    }
}

fn sum_of(index: &Index, variables: &Variables) -> i64 {
    index.value(|counter| variables[counter.name()][0] as i64)
}

fn index_of(index: &Index, variables: &Variables) -> usize {
    usize::try_from(sum_of(index, variables)).unwrap()
}

fn value(expression: &Value, variables: &Variables) -> f64 {
    let value = |expression: &Value| value(expression, variables);
    match expression {
        Value::Number(number) => *number,
        Value::Name(name) => variables[name][0],
        Value::Whole(index) => sum_of(index, variables) as f64,
        Value::Element(name, index) => variables[name][index_of(index, variables)],
        Value::Unary(Unary::Negative, operand) => -value(operand),
        Value::Unary(Unary::Absolute, operand) => value(operand).abs(),
        Value::Unary(Unary::Root, operand) => value(operand).sqrt(),
        Value::Binary(operator, operands) => {
            let [a, b] = operands.each_ref().map(value);
            match operator {
                Binary::Add => a + b,
                Binary::Sub => a - b,
                Binary::Mul => a * b,
                Binary::Div => a / b,
                Binary::Arctangent => a.atan2(b),
            }
        }
        Value::Clamped(operands) => {
            let [number, lower, upper] = operands.each_ref().map(value);
            number.max(lower).min(upper)
        }
        Value::Dot { .. } => panic!("sums are loops"),
    }
}

fn holds(condition: &Condition, variables: &Variables) -> bool {
    let number = |expression: &Value| value(expression, variables);
    match condition {
        Condition::Greater(a, b) => number(a) > number(b),
        Condition::AtLeast(a, b) => number(a) >= number(b),
        Condition::Is(name, index) => variables[name] == [sum_of(index, variables) as f64],
        Condition::Flag(name) => match variables[name][0] {
            flag if flag.is_nan() => panic!("{name} is not assigned"),
            flag => flag > 0.0,
        },
        Condition::And(both) => holds(&both[0], variables) && holds(&both[1], variables),
        Condition::Or(both) => holds(&both[0], variables) || holds(&both[1], variables),
    }
}

/// Returns numbers in [0, 1) that fill it evenly.
fn share(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9).fract()
}

/// Compares the results at some configurations, a third of them beyond the limits, with bounds and
/// without. Returns the statuses.
fn check(spec: Spec, count: usize) -> Vec<Status> {
    let model = Model::new(&spec);
    let description = Routines::new(&spec, &model).description;
    let procedures = compensated(&spec, Precision::Double).into_iter().map(Procedure::with_loops).collect();
    let machine = Machine { spec, model, procedures };
    let variables = &machine.spec.variables;
    let one = |index: usize| {
        let reach = if index % 3 == 2 { 1.1 } else { 1.0 };
        let joints = variables.iter().enumerate();
        let mut q: Vec<f64> = joints
            .map(|(j, variable)| {
                let [lower, upper] = variable.limits.map(|end| end.clamp(-3.0e3, 3.0e3));
                lower + (upper - lower) * (0.5 + reach * (share(7 * index + j + 1) - 0.5))
            })
            .collect();
        if index % 5 == 3 && q.len() > 5 {
            // A wrist is singular where its second joint is 0.
            q[4] = 0.01 * share(index);
        }
        let first = Cycle::<[f64; 7]>::first(&description);
        let bounded = |bounds: [f64; 7]| bounds[..q.len()].to_vec();
        let mut cycle = Cycle {
            last: bounded(first.change)
                .iter()
                .enumerate()
                .map(|(j, most)| most * (share(index + j) - 0.5))
                .collect(),
            change: bounded(first.change),
            largest: bounded(first.largest),
            rotations: if index % 4 == 1 { [1.0, 1.0, 0.0] } else { [1.0; 3] },
        };
        if index.is_multiple_of(2) {
            cycle.last.fill(0.0);
            cycle.change.fill(f64::INFINITY);
            cycle.largest.fill(f64::INFINITY);
        }
        let expected = machine.expected(&description, &q, &cycle);
        let rotations = cycle.rotations.to_vec();
        let found = machine.call("compensated", &[q, cycle.last, cycle.change, cycle.largest, rotations]);
        let status = vec![f64::from(expected.status.code())];
        let results =
            [expected.q, expected.correction, expected.before.to_vec(), expected.after.to_vec(), status];
        assert_eq!(found, results, "{}, {index}", description.name);
        expected.status
    };
    (0..count).map(one).collect()
}

#[test]
fn functions_of_numbers_have_the_bits_of_scalars() {
    let machine =
        Machine::with(least_and_greatest().into_iter().chain([sign(), side(), clamped()]).collect());
    let numbers = [-f64::INFINITY, -2.5, -1e-310, -0.0, 0.0, 3e-320, 1.0, 7.5, f64::INFINITY, f64::NAN];
    let check = |name: &str, given: &[f64], expected: f64| {
        let given: Vec<Vec<f64>> = given.iter().map(|number| vec![*number]).collect();
        let found = machine.call(name, &given)[0][0];
        let is_same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
        assert!(is_same, "{name} of {given:?}: {found}, {expected}");
    };
    for a in numbers {
        check("sign", &[a], Scalar::sign(a));
        check("side", &[a], Scalar::side(a));
        for b in numbers {
            check("least", &[a, b], Scalar::min(a, b));
            check("greatest", &[a, b], Scalar::max(a, b));
            // The sign of 0 at an end that is 0 is left open.
            for c in numbers.into_iter().filter(|c| b < *c && b != 0.0 && *c != 0.0) {
                check("clamped", &[a, b, c], a.max(b).min(c));
            }
        }
    }
}

/// Tables of equidistant and of other points, with and without values beyond their ends.
#[test]
fn lookups_have_the_bits_of_tables() {
    let mut compared = 0;
    let points = |x: [f64; 7]| x.iter().enumerate().map(|(k, x)| [*x, share(k)]).collect::<Vec<_>>();
    let all = [[-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0], [-2.0, -1.9, 0.0, 0.1, 0.15, 4.0, 9.0]];
    for (x, interpolation, outside) in all.iter().flat_map(|x| {
        let kinds = [Interpolation::Linear, Interpolation::Cubic];
        kinds.into_iter().flat_map(move |kind| {
            [Extrapolation::Nothing, Extrapolation::Hold].map(|outside| (*x, kind, outside))
        })
    }) {
        let dimensions = [Dimension::NONE; 2];
        let table = Table::new(String::new(), String::new(), dimensions, points(x), interpolation, outside);
        let lookup = table.lookup();
        let machine = Machine::with(vec![look_up(&lookup, lookup.scale, String::new())]);
        let span = 1.2 * (x[6] - x[0]);
        let between = (0..400).map(|k| x[0] - 0.1 * span + span * share(k));
        for x in between.chain(x).chain([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]) {
            for order in 0..4 {
                let found = machine.call("look_up", &[vec![f64::from(order)], vec![x]])[0][0];
                let expected = table.derivative(order, x);
                let is_same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
                assert!(is_same, "derivative {order} at {x}: {found}, {expected}");
                compared += 1;
            }
        }
    }
    assert!(compared > 10_000);
}

#[test]
fn the_description_has_the_bits_of_the_compensator() {
    let mut statuses = Vec::new();
    for (file, text) in shipped() {
        let spec = Spec::parse(&file, &text).unwrap();
        // Machines with closed loops find their passive variables by iterations.
        if spec.passive.is_empty() {
            statuses.extend(check(spec, 40));
        }
    }
    for status in [Status::Reached, Status::Held, Status::OutsideLimits, Status::NotReached] {
        assert!(statuses.contains(&status), "{status:?} does not occur");
    }
}

/// Keywords of C99, JavaScript, Python, Matlab, Rust and Structured Text, in lower case.
const KEYWORDS: &str = "abstract and any array as assert async at auto await become bool boolean box break by byte case catch char class \
    classdef const constant continue crate debugger default def del delete do double dyn elif else elseif elsif end enum eval except exit \
    export extends extern false final finally float fn for from function global goto if impl import in inline instanceof int interface is \
    lambda let long loop macro match method mod mut namespace new none nonlocal not null of or otherwise override package parfor pass \
    persistent priv private program protected pub public raise ref register repeat restrict return self short signed sizeof spmd static \
    struct super switch then this throw to trait true try type typedef typeof union unsafe unsigned unsized until use using var virtual \
    void volatile where while with xor yield";

/// No name of the corrected command is a keyword of a language, or a name that its files have.
#[test]
fn no_name_is_a_keyword() {
    let helpers = "given least greatest sign side clamped look_up description batch";
    for (name, text) in shipped() {
        let spec = Spec::parse(&name, &text).unwrap();
        for procedure in
            [Precision::Double, Precision::Single].iter().flat_map(|one| compensated(&spec, *one))
        {
            for name in procedure.names() {
                let is_taken =
                    |words: &str| words.split_whitespace().any(|word| word.eq_ignore_ascii_case(name));
                assert!(!is_taken(KEYWORDS) && !is_taken(helpers), "{name} in {}", procedure.name);
            }
        }
    }
}
