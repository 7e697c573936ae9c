//! Errors of joints, structural parameters and DH parameters, compared with differences of the
//! nominal pose by the parameter itself.

use abbe::{Class, Manipulator, Orientation, Pose};
use abbe_codegen::chain::Model;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::expr::{Dimension, Expression, Symbol};
use abbe_spec::{ChainNumber, Deviation, DeviationCause, DhConvention, DhNumber, Source, Spec};
use abbe_tests::chains::{coupled_joints, general_chain, long_chain};

/// Returns some value for every symbol.
fn value(symbol: Symbol) -> f64 {
    let spread = |index: usize, offset: f64| ((index * 7) as f64 * 0.618 + offset).sin() * 0.9;
    match symbol {
        Symbol::Variable(i) => spread(i, 0.1),
        Symbol::Parameter(i) => spread(i, 0.5) + 1.0,
        Symbol::Input(i) => spread(i, 0.9),
        Symbol::Passive(_)
        | Symbol::Error(_)
        | Symbol::Local(_)
        | Symbol::Magnitude(_)
        | Symbol::Target(_) => 0.0,
    }
}

fn values(count: usize, symbol: impl Fn(usize) -> Symbol) -> Vec<f64> {
    (0..count).map(|i| value(symbol(i))).collect()
}

/// Returns the velocity of the tool point and the angular velocity in `F_0` per unit, by central
/// differences of the nominal pose, whose error is quadratic in the step: extrapolated once.
fn difference(pose: impl Fn(f64) -> Pose) -> [f64; 6] {
    let central = |h: f64| -> [f64; 6] {
        let (after, before) = (pose(h), pose(-h));
        let (axes, earlier, later) = (pose(0.0).0, before.0, after.0);
        let slope = |column: usize, row: usize| (later[column][row] - earlier[column][row]) / (2.0 * h);
        std::array::from_fn(|i| match i {
            0..3 => slope(3, i),
            // vee(Ṙ Rᵀ): entry (k, j) for axis i.
            _ => (0..3).map(|c| slope(c, (i + 2) % 3) * axes[c][(i + 1) % 3]).sum(),
        })
    };
    let (coarse, fine) = (central(2e-3), central(1e-3));
    std::array::from_fn(|i| fine[i] + (fine[i] - coarse[i]) / 3.0)
}

fn assert_close(place: &str, found: [f64; 6], expected: [f64; 6], tolerance: f64) {
    for rows in [0..3, 3..6] {
        let largest = expected[rows.clone()].iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        for i in rows {
            let (found, expected) = (found[i], expected[i]);
            let room = tolerance * largest.max(1e-3);
            assert!((found - expected).abs() <= room, "{place}, row {i}: {found}, not {expected}");
        }
    }
}

fn repeatable(name: String, number: ChainNumber, error: f64) -> Source {
    let error = Expression::from_number(error, Dimension::NONE);
    Source {
        name,
        class: Class::Repeatable,
        degrees_of_freedom: f64::INFINITY,
        enabled: true,
        description: String::new(),
        reference: String::new(),
        magnitude: None,
        scale: 1.0,
        tuned_by: None,
        effects: Vec::new(),
        deviations: vec![Deviation { number, cause: DeviationCause::Error(error), span: 0..0 }],
        propagated: Vec::new(),
    }
}

/// Returns the effect of a unit error of a parameter of the chain on the tool, by ε and `J_e`, as a
/// twist in `F_0`.
fn predicted(spec: &Spec, number: ChainNumber) -> [f64; 6] {
    let mut spec = spec.clone();
    spec.orientation = Orientation::RotationVector;
    spec.sources = vec![repeatable("one".to_owned(), number, 1.0)];
    let model = Model::new(&spec);
    let column = |jacobian: &abbe_codegen::chain::Jacobian| -> [f64; 6] {
        model.graph.evaluate(&jacobian.columns[0], value).try_into().unwrap()
    };
    // Along the chain and from the columns of J_e.
    let [along, product] = [0, 1].map(|way| column(&model.predicted_displacement[way]));
    assert_close(&format!("{}, {number:?}, two ways", spec.name), along, product, 1e-12);
    along
}

/// Compares every joint and parameter of a spec.
fn compare(spec: &Spec) {
    let robot = Interpreter::new(spec.clone());
    let q = values(spec.variables.len(), Symbol::Variable);
    let s = values(spec.parameters.len(), Symbol::Parameter);
    let changed = |values: &[f64], i: usize, h: f64| {
        let mut values = values.to_vec();
        values[i] += h;
        values
    };
    for (i, variable) in spec.variables.iter().enumerate() {
        let expected = difference(|h| robot.pose(&changed(&q, i, h), &s).unwrap());
        let found = predicted(spec, ChainNumber::Joint(i));
        assert_close(&format!("{}, {}", spec.name, variable.name), found, expected, 1e-9);
    }
    for (i, parameter) in spec.parameters.iter().enumerate() {
        let expected = difference(|h| robot.pose(&q, &changed(&s, i, h)).unwrap());
        let found = predicted(spec, ChainNumber::Parameter(i));
        assert_close(&format!("{}, {}", spec.name, parameter.name), found, expected, 1e-9);
    }
}

fn parse(text: &str) -> Spec {
    Spec::parse("test.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn joints_and_parameters_in_every_form() {
    compare(&parse(coupled_joints()));
    compare(&parse(&general_chain(6)));
    compare(&parse(&general_chain(5).replace("dh =", "mdh =")));
    compare(&parse(&long_chain()));
    for shipped in SHIPPED {
        let (name, text) = (shipped.name, shipped.spec);
        let mut spec = Spec::parse(name, text).unwrap();
        spec.name = (*name).to_owned();
        compare(&spec);
    }
}

/// Checks that the parameter of a frame and the same value as an additional structural parameter
/// agree.
#[test]
fn denavit_hartenberg_numbers_of_both_conventions() {
    for convention in ["dh", "mdh"] {
        let text = general_chain(4).replace("dh =", &format!("{convention} ="));
        let spec = parse(&text);
        assert_eq!(
            spec.frames[2].convention,
            Some(if convention == "dh" { DhConvention::Standard } else { DhConvention::Modified })
        );
        let robot = Interpreter::new(spec.clone());
        let q = values(4, Symbol::Variable);
        for frame in 0..4 {
            for number in DhNumber::ALL {
                let expected = difference(|h| {
                    let mut changed = spec.clone();
                    let order = spec.frames[frame].convention.unwrap().order();
                    let place = order.iter().position(|&other| other == number).unwrap();
                    let factor = changed.frames[frame].factors[place].clone();
                    let abbe_spec::Factor::Elementary(mut more) = factor else { panic!("elementary") };
                    more.amount = Expression::from_number(h, Dimension::NONE);
                    changed.frames[frame].factors.insert(place, abbe_spec::Factor::Elementary(more));
                    changed.frames[frame].convention = None;
                    Interpreter::new(changed).pose(&q, &[]).unwrap()
                });
                let found = predicted(&spec, ChainNumber::DenavitHartenberg { frame, number });
                assert_close(&format!("{convention} {frame} {number:?}"), found, expected, 1e-9);
            }
        }
        assert!(robot.pose(&q, &[]).is_ok());
    }
}

/// Checks that a joint error of a shipped spec equals the effect of the perturbed joint, at home
/// and elsewhere.
#[test]
fn shipped_encoders_are_their_perturbed_joints() {
    let mut encoders = 0;
    for shipped in SHIPPED {
        let (name, text) = (shipped.name, shipped.spec);
        let mut spec = Spec::parse(name, text).unwrap();
        spec.orientation = Orientation::RotationVector;
        for source in spec.sources.clone() {
            let at_joint = |deviation: &Deviation| matches!(deviation.number, ChainNumber::Joint(_));
            let named = ["encoder", "potentiometer", " scale"].iter().any(|word| source.name.contains(word));
            assert!(!named || source.deviations.iter().any(at_joint), "{name}: {}", source.name);
            if !source.deviations.iter().any(at_joint) {
                continue;
            }
            encoders += 1;
            let mut only = spec.clone();
            only.sources = vec![Source { class: Class::Repeatable, ..source.clone() }];
            let robot = Interpreter::new(only.clone());
            let home: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
            let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
            let u: Vec<f64> =
                spec.inputs.iter().map(|input| 0.5 * (input.range[0] + input.range[1])).collect();
            for away in [0.0, 0.03] {
                let q: Vec<f64> = home.iter().map(|home| home + away).collect();
                let mut errors = vec![[0.0; 6]; spec.frames.len()];
                robot.generalized_errors(&q, &s, &u, &mut errors).unwrap();
                let mut columns = vec![[0.0; 6]; 6 * spec.frames.len()];
                robot.error_jacobian(&q, &s, &mut columns).unwrap();
                let found: [f64; 6] = std::array::from_fn(|row| {
                    columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[row] * error).sum()
                });
                // δq by itself, from the expression of the spec.
                let mut graph = abbe_codegen::graph::Graph::new();
                let deltas: Vec<(usize, f64)> = source
                    .deviations
                    .iter()
                    .map(|deviation| {
                        let ChainNumber::Joint(joint) = deviation.number else {
                            panic!("{name}: {}", source.name)
                        };
                        let node = graph.lower(deviation.error().unwrap());
                        let delta = graph.evaluate(&[node], |symbol| match symbol {
                            Symbol::Variable(i) => q[i],
                            Symbol::Parameter(i) => s[i],
                            Symbol::Input(i) => u[i],
                            _ => f64::NAN,
                        });
                        (joint, delta[0])
                    })
                    .collect();
                let expected = difference(|h| {
                    let mut q = q.clone();
                    deltas.iter().for_each(|(joint, delta)| q[*joint] += h * delta * 1e3);
                    robot.pose(&q, &s).unwrap()
                })
                .map(|value| value * 1e-3);
                let place = format!("{name}: {}", source.name);
                let scale = expected.iter().chain(&found).fold(0.0_f64, |l, v| l.max(v.abs()));
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).abs() <= 1e-6 * scale, "{place}: {found}, not {expected}");
                }
            }
        }
    }
    assert!(encoders >= 35, "{encoders}");
}
