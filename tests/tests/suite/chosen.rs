//! Alternative programs for a function are equal, and the chosen one needs no more operations than
//! the first.

use abbe::{Function, Orientation};
use abbe_codegen::chain::Model;
use abbe_codegen::graph::Node;
use abbe_codegen::program::{Operations, Rounded, results, straight_line};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::chains::{coupled_joints, general_chain, random_arm};

/// Returns a value for every symbol.
fn values(sample: usize) -> impl Fn(Symbol) -> f64 + Copy {
    move |symbol| {
        let spread =
            |index: usize, offset: f64| ((index * 7 + sample * 13) as f64 * 0.618 + offset).sin() * 0.9;
        match symbol {
            Symbol::Variable(i) => spread(i, 0.1),
            Symbol::Parameter(i) => spread(i, 0.5) + 1.0,
            Symbol::Input(i) => spread(i, 0.9),
            Symbol::Error(i) => spread(i, 1.3),
            Symbol::Magnitude(i) => spread(i, 1.7),
            Symbol::Target(i) => spread(i, 1.9),
            Symbol::Passive(_) | Symbol::Local(_) => f64::NAN,
        }
    }
}

fn specs() -> Vec<Spec> {
    let shipped = SHIPPED.iter().map(|shipped| Spec::parse(shipped.name, shipped.spec).unwrap());
    let random = (0..40).map(|index| Spec::parse(&format!("arm {index}"), &random_arm(index)).unwrap());
    let others = [coupled_joints().to_owned(), general_chain(12)];
    let others = others.into_iter().map(|text| Spec::parse("chain", &text).unwrap());
    let euler = random_arm(7).replace("length = \"m\"", "length = \"m\"\norientation = \"euler-yzx\"");
    shipped.chain(random).chain(others).chain([Spec::parse("euler", &euler).unwrap()]).collect()
}

fn close(place: &str, a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len(), "{place}");
    let largest = a.iter().fold(1.0, |largest: f64, value| largest.max(value.abs()));
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        let both_undefined = a.is_nan() && b.is_nan();
        assert!(both_undefined || (a - b).abs() <= 1e-12 * largest, "{place}, number {k}: {a}, {b}");
    }
}

#[test]
fn what_is_stated_to_be_equal_is() {
    for spec in specs() {
        let model = Model::new(&spec);
        let graph = &model.graph;
        let pairs: Vec<(Node, Node, f64)> = graph
            .classes()
            .flat_map(|first| {
                graph
                    .equal(first)
                    .map(move |other| (first, other.node, if other.negative { -1.0 } else { 1.0 }))
            })
            .collect();
        assert!(pairs.len() > spec.frames.len(), "{}: {} pairs", spec.file, pairs.len());
        let (first, other): (Vec<Node>, Vec<Node>) = pairs.iter().map(|pair| (pair.0, pair.1)).unzip();
        for sample in 0..3 {
            let first = graph.evaluate(&first, values(sample));
            let other = graph.evaluate(&other, values(sample));
            let other: Vec<f64> = other.iter().zip(&pairs).map(|(value, pair)| value * pair.2).collect();
            close(&spec.file, &first, &other);
        }
    }
}

#[test]
fn programs_give_what_was_made_first() {
    for spec in specs() {
        let model = Model::new(&spec);
        for function in Function::ALL {
            let program = straight_line(function, &model);
            let (results, margin) = results(function, &model);
            let nodes: Vec<Node> = results.into_iter().flatten().chain(margin).collect();
            for sample in 0..3 {
                let made = model.graph.evaluate(&nodes, values(sample));
                let chosen = program.rounded(
                    model.graph.tables(),
                    |symbol| Rounded::exact(values(sample)(symbol), f64::EPSILON / 2.0),
                    f64::EPSILON / 2.0,
                );
                let chosen: Vec<f64> = chosen.into_iter().map(|number| number.value).collect();
                close(&format!("{}: {}", spec.file, function.name()), &made, &chosen);
            }
        }
    }
}

/// Returns the sum of multiplications, additions and divisions.
fn total(count: Operations) -> usize {
    count.mul + count.add + count.div
}

#[test]
fn no_function_takes_more_than_what_was_made_first() {
    let (mut before, mut after) = (0, 0);
    for mut spec in specs() {
        for orientation in [Orientation::RotationVector, Orientation::EulerYzx, Orientation::Iec61217] {
            spec.orientation = orientation;
            let model = Model::new(&spec);
            let mut plain = model.clone();
            plain.graph.forget_equal();
            for function in Function::ALL {
                let [made, chosen] =
                    [&plain, &model].map(|model| straight_line(function, model).operations());
                let place = format!("{}: {}, {made} before, {chosen}", spec.file, function.name());
                assert!(total(chosen) <= total(made), "{place}");
                assert!(chosen.sincos <= made.sincos && chosen.sqrt <= made.sqrt, "{place}");
                assert!(chosen.other <= made.other && chosen.div <= made.div, "{place}");
                if function == Function::ErrorJacobian {
                    before += total(made);
                    after += total(chosen);
                }
            }
        }
    }
    println!("J_e of all together: {before} operations as made first, {after} as chosen");
    assert!(20 * after < 19 * before, "{before}, then {after}");
}
