//! Recursions along the chain equal products with `J_e`, for random ε and σ² and both kinds of
//! rows.

use abbe::{Class, Orientation};
use abbe_codegen::chain::{Jacobian, Model};
use abbe_codegen::graph::Node;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::chains::{coupled_joints, general_chain};

/// Returns a value for every symbol. Errors are between 0 and 1, so that they are valid variances
/// too.
fn values(sample: usize) -> impl Fn(Symbol) -> f64 {
    move |symbol| {
        let spread =
            |index: usize, offset: f64| ((index * 7 + sample * 13) as f64 * 0.618 + offset).sin() * 0.9;
        match symbol {
            Symbol::Variable(i) => spread(i, 0.1),
            Symbol::Parameter(i) => spread(i, 0.5) + 1.0,
            Symbol::Input(i) => spread(i, 0.9),
            Symbol::Passive(i)
            | Symbol::Error(i)
            | Symbol::Magnitude(i)
            | Symbol::Target(i)
            | Symbol::Local(i) => (i as f64 * 1.7 + sample as f64).sin().powi(2),
        }
    }
}

/// Returns the columns at a sample, and the margin.
fn evaluated(model: &Model, jacobian: &Jacobian, sample: usize) -> (Vec<[f64; 6]>, Option<f64>) {
    let numbers = model.graph.evaluate(jacobian.columns.as_flattened(), values(sample));
    let margin = jacobian.margin.map(|margin| model.graph.evaluate(&[margin], values(sample))[0]);
    (numbers.as_chunks().0.to_vec(), margin)
}

/// Checks equality to 1e-13 of the largest value of each block of three rows in `scale`.
fn assert_close(place: &str, actual: &[f64; 6], expected: &[f64; 6], scale: &[f64; 6]) {
    for rows in [0..3, 3..6] {
        let largest = scale[rows.clone()].iter().fold(0.0, |largest: f64, value| largest.max(*value));
        for i in rows {
            let (actual, expected) = (actual[i], expected[i]);
            assert!(
                (actual - expected).abs() <= 1e-13 * largest,
                "{place}, row {i}: {actual}, not {expected}"
            );
        }
    }
}

/// Returns `J_e ε`, and the sums of the magnitudes of its terms.
fn product(columns: &[[f64; 6]], errors: &[f64]) -> ([f64; 6], [f64; 6]) {
    assert_eq!(columns.len(), errors.len());
    let terms = |row: usize| columns.iter().zip(errors).map(move |(column, error)| column[row] * error);
    (std::array::from_fn(|row| terms(row).sum()), std::array::from_fn(|row| terms(row).map(f64::abs).sum()))
}

/// Checks that ΔX is `J_e ε`.
fn assert_product(place: &str, displacement: &[f64; 6], columns: &[[f64; 6]], errors: &[f64]) {
    let (expected, scale) = product(columns, errors);
    assert_close(place, displacement, &expected, &scale);
}

fn compare(spec: &Spec) {
    let model = Model::new(spec);
    let count = 6 * spec.frames.len();
    for sample in 0..5 {
        let (columns, margin) = evaluated(&model, &model.error_jacobian, sample);
        let place = format!("{}, sample {sample}", spec.name);
        let symbols: Vec<f64> = (0..count).map(|i| values(sample)(Symbol::Error(i))).collect();

        let (displacement, along) = evaluated(&model, &model.displacement, sample);
        assert_product(&place, &displacement[0], &columns, &symbols);
        assert_eq!(margin.is_some(), along.is_some());
        assert!(
            margin.zip(along).is_none_or(|(a, b)| (a - b).abs() < 1e-14),
            "{place}: {margin:?} {along:?}"
        );

        let (covariance, _) = evaluated(&model, &model.covariance, sample);
        // |C_ij| ≤ σ_i σ_j, with the largest σ of the three axes that rotations mix.
        let expected: Vec<[f64; 6]> = (0..6)
            .map(|j| {
                let weighted = columns.iter().zip(&symbols).map(|(column, variance)| column[j] * variance);
                product(&columns, &weighted.collect::<Vec<f64>>()).0
            })
            .collect();
        let deviation: [f64; 6] = std::array::from_fn(|i| expected[i][i].sqrt());
        for j in 0..6 {
            let largest = deviation[j / 3 * 3..][..3].iter().fold(0.0, |a: f64, b| a.max(*b));
            let scale = deviation.map(|deviation| deviation * largest);
            assert_close(&format!("{place}, covariance {j}"), &covariance[j], &expected[j], &scale);
        }

        let evaluate = |nodes: &[Node]| model.graph.evaluate(nodes, values(sample));
        let errors = evaluate(model.generalized_errors.as_flattened());
        for way in &model.predicted_displacement {
            assert_product(&place, &evaluated(&model, way, sample).0[0], &columns, &errors);
        }
        let effects: Vec<Node> = model.effects.iter().map(|effect| effect.value).collect();
        let effects = evaluate(&effects);
        for way in &model.source_displacements {
            let (displacements, _) = evaluated(&model, way, sample);
            assert_eq!(displacements.len(), spec.enabled_sources().count());
            for (source, displacement) in displacements.iter().enumerate() {
                let mut own = vec![0.0; count];
                for (effect, value) in model.effects.iter().zip(&effects) {
                    if effect.source == source {
                        own[6 * effect.frame + effect.component as usize] += value;
                    }
                }
                assert_product(&format!("{place}, source {source}"), displacement, &columns, &own);
            }
            // The sum of the repeatable sources is the predicted displacement.
            let mut sum = [0.0; 6];
            for (source, displacement) in spec.enabled_sources().zip(&displacements) {
                if source.class == Class::Repeatable {
                    (0..6).for_each(|row| sum[row] += displacement[row]);
                }
            }
            let predicted = evaluated(&model, &model.predicted_displacement[0], sample).0[0];
            let scale = displacements.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            for row in 0..6 {
                assert!((sum[row] - predicted[row]).abs() <= 1e-13 * scale, "{place}: {sum:?} {predicted:?}");
            }
        }
    }
}

#[test]
fn every_shipped_manipulator_with_rows_of_both_kinds() {
    for shipped in SHIPPED {
        let mut spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        for orientation in [Orientation::RotationVector, Orientation::EulerYzx, Orientation::Iec61217] {
            spec.orientation = orientation;
            compare(&spec);
        }
    }
}

/// Checks features that the shipped specs lack: variables in several frames, general matrices, and
/// axes in general direction.
#[test]
fn coupled_joints_and_a_long_chain() {
    for text in [coupled_joints().to_owned(), general_chain(30)] {
        let mut spec = Spec::parse("chain.toml", &text).unwrap();
        for orientation in [Orientation::RotationVector, Orientation::EulerYzx, Orientation::Iec61217] {
            spec.orientation = orientation;
            compare(&spec);
        }
    }
}
