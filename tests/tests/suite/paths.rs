//! The compiled functions beside pose and Jacobians, compared with the Jacobians and the exact
//! chain.

use abbe::analysis::sampling::joint_sample;
use abbe::{Class, Error, Manipulator, Orientation, Pose, Quantity, deviation, distinct};
use abbe_manipulators::SHIPPED;
use abbe_spec::{Source, Spec};

const SAMPLES: usize = 100;

/// Returns configurations within the limits, in the order of the description.
fn configurations<const N: usize>(robot: &dyn Manipulator) -> Vec<[f64; N]> {
    let description = robot.description();
    let moved: Vec<usize> = (0..N).collect();
    (0..SAMPLES).map(|index| joint_sample(description, 1.0, &moved, index).try_into().unwrap()).collect()
}

fn assert_close(place: &str, actual: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(actual.len(), expected.len());
    for (i, (a, b)) in actual.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance, "{place}, number {i}: {a}, not {b}");
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(f64::MIN_POSITIVE, |largest, value| largest.max(value.abs()))
}

/// Returns the tolerance of the chain with ε relative to the exact one: rounding errors, or the
/// square of ε if a source is an error of a joint or located, whose ε is of first order (tested
/// separately in `exact_chain`).
fn tolerance(name: &str, errors: &[f64]) -> f64 {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot");
    let spec = Spec::parse(name, shipped.spec).unwrap();
    let first_order = |source: &Source| {
        !source.deviations.is_empty() || source.effects.iter().any(|effect| !effect.at.is_empty())
    };
    let sources = spec.enabled_sources().filter(|source| source.class == Class::Repeatable);
    if sources.into_iter().any(first_order) { 10.0 * largest(errors).powi(2) } else { 1e-12 }
}

/// Returns a column of `J_q` with rotation-vector rows by central differences of the nominal pose,
/// with the step `h = ε^{1/3}`.
fn differences(robot: &dyn Manipulator, q: &[f64], s: &[f64], variable: usize) -> [f64; 6] {
    let h = f64::EPSILON.cbrt() * q[variable].abs().max(1.0);
    let pose = |step: f64| {
        let mut q = q.to_vec();
        q[variable] += step;
        (q[variable], robot.pose(&q, s).unwrap())
    };
    let ((before, a), (after, b)) = (pose(-h), pose(h));
    deviation(Orientation::RotationVector, &a, &b).map(|difference| difference / (after - before))
}

macro_rules! tests {
    ($($module:ident: $robot:ident),+ $(,)?) => {$(mod $module {
        use super::*;
        use abbe_manipulators::$module::{
            DESCRIPTION, DISTINCT, ERRORS, FRAMES, Inputs, Parameters, VARIABLES, $robot, compensator_step,
            covariance, displacement, effects, error_jacobian, generalized_errors, predicted_displacement,
            raw, real_pose, source_displacements,
        };

        const NAME: &str = stringify!($module);

        /// Checks that the distinct numbers and their layout give the dense matrix, bit for bit.
        #[test]
        fn distinct_expanded_is_dense() {
            let s = Parameters::NOMINAL.to_array();
            for q in configurations::<VARIABLES>(&$robot) {
                let (mut pose, mut again) = ([[0.0; 3]; 4], [[1.0; 3]; 4]);
                let (mut dense, mut expanded) = ([[0.0; 6]; ERRORS], [[f64::NAN; 6]; ERRORS]);
                let mut numbers = [[[0.0; 3]; DISTINCT]; FRAMES];
                let margin = raw::error_jacobian(&q, &s, &mut pose, &mut dense);
                assert_eq!(margin, raw::error_jacobian_distinct(&q, &s, &mut again, &mut numbers));
                distinct::columns(&numbers, &mut expanded);
                assert_eq!(DISTINCT, distinct::vectors(DESCRIPTION.orientation));
                let bits = |columns: &[[f64; 6]]| -> Vec<u64> {
                    columns.as_flattened().iter().map(|value| (value + 0.0).to_bits()).collect()
                };
                assert_eq!(bits(&dense), bits(&expanded), "{NAME}");
                assert_eq!(pose, again);
            }
        }

        #[test]
        fn displacements_are_products_with_the_error_jacobian() {
            let (s, u) = (Parameters::NOMINAL, Inputs::NOMINAL);
            for (sample, q) in configurations::<VARIABLES>(&$robot).into_iter().enumerate() {
                let (_, columns) = error_jacobian(&q, &s).unwrap();
                let product = |errors: &[f64]| -> ([f64; 6], f64) {
                    let term = |row: usize| columns.iter().zip(errors).map(move |(c, e)| c[row] * e);
                    let scale: [f64; 6] = std::array::from_fn(|row| term(row).map(f64::abs).sum());
                    (std::array::from_fn(|row| term(row).sum()), largest(&scale))
                };
                let errors: [[f64; 6]; FRAMES] = std::array::from_fn(|i| {
                    std::array::from_fn(|k| ((6 * i + k) as f64 * 1.7 + sample as f64).sin())
                });
                let (expected, scale) = product(errors.as_flattened());
                let given = displacement(&q, &s, &errors).unwrap();
                assert_close(NAME, &given, &expected, 1e-13 * scale);

                let errors = generalized_errors(&q, &s, &u).unwrap();
                let (expected, scale) = product(errors.as_flattened());
                let predicted = predicted_displacement(&q, &s, &u).unwrap();
                assert_close(NAME, &predicted, &expected, 1e-13 * scale);

                let effects = effects(&q, &s, &u).unwrap();
                let by_source = source_displacements(&q, &s, &u).unwrap();
                for (source, displacement) in by_source.iter().enumerate() {
                    let mut errors = [[0.0; 6]; FRAMES];
                    for (effect, value) in DESCRIPTION.effects.iter().zip(effects) {
                        if effect.source == source {
                            errors[effect.frame][effect.component.index()] += value;
                        }
                    }
                    let (expected, scale) = product(errors.as_flattened());
                    assert_close(NAME, displacement, &expected, 1e-13 * scale);
                }

                let variances = errors.map(|six| six.map(|error| error * error));
                let covariance = covariance(&q, &s, &variances).unwrap();
                let expected: [[f64; 6]; 6] = std::array::from_fn(|j| {
                    let weighted: Vec<f64> =
                        columns.iter().zip(variances.as_flattened()).map(|(c, v)| c[j] * v).collect();
                    product(&weighted).0
                });
                let sigma: [f64; 6] = std::array::from_fn(|i| expected[i][i].sqrt());
                for (j, (column, expected)) in covariance.iter().zip(&expected).enumerate() {
                    let own = largest(&sigma[j / 3 * 3..][..3]);
                    for rows in [0..3, 3..6] {
                        let scale = own * largest(&sigma[rows.clone()]);
                        assert_close(NAME, &column[rows.clone()], &expected[rows], 1e-13 * scale);
                    }
                }
            }
        }

        #[test]
        fn the_real_pose_is_the_exact_chain_with_errors() {
            let (s, u) = (Parameters::NOMINAL, Inputs::NOMINAL);
            for q in configurations::<VARIABLES>(&$robot) {
                let mut transforms = [Pose::IDENTITY; FRAMES + 1];
                $robot.transforms(&q, &s.to_array(), &mut transforms).unwrap();
                let errors = generalized_errors(&q, &s, &u).unwrap();
                let expected = abbe::real_pose(&transforms, &errors);
                let real = real_pose(&q, &s, &u).unwrap();
                let off = tolerance(NAME, errors.as_flattened());
                assert_close(NAME, real.0[..3].as_flattened(), expected.0[..3].as_flattened(), off);
                let scale = largest(&transforms.map(|transform| largest(&transform.position())));
                assert_close(NAME, &real.position(), &expected.position(), off * scale);

                let (pose, columns) = compensator_step(&q, &s, &u).unwrap();
                assert_eq!(pose, real);
                for (variable, column) in columns.iter().enumerate() {
                    let expected = differences(&$robot, &q, &s.to_array(), variable);
                    let scale = scale.max(1.0);
                    assert_close(NAME, &column[..3], &expected[..3], 1e-8 * scale);
                    assert_close(NAME, &column[3..], &expected[3..], 1e-8 * scale);
                }
            }
        }
    })+};
}

tests! {
    general6r: General6r,
    iiwa: Iiwa,
    machine3: Machine3,
    panda: Panda,
    pps: Pps,
    puma560: Puma560,
    scara: Scara,
    stanford: Stanford,
    ur5: Ur5,
    wam: Wam,
}

#[test]
fn none_is_left_out() {
    let tested =
        ["general6r", "iiwa", "machine3", "panda", "pps", "puma560", "scara", "stanford", "ur5", "wam"];
    assert!(SHIPPED.iter().map(|shipped| shipped.name).eq(tested));
}

/// Checks that a Newton step of a compensator brings the real tool point to the ideal one, to
/// second order.
#[test]
fn a_compensator_step_compensates() {
    use abbe_manipulators::pps;
    let (s, u) = (pps::Parameters::NOMINAL, pps::Inputs::NOMINAL);
    for q in configurations::<{ pps::VARIABLES }>(&pps::Pps) {
        let target = pps::pose(&q, &s).unwrap();
        let (real, columns) = pps::compensator_step(&q, &s, &u).unwrap();
        let jacobian = abbe::jacobian_view(&columns).into_owned();
        let missing = deviation(Orientation::RotationVector, &real, &target);
        let missing_rows = nalgebra::Vector6::from(missing);
        let step = jacobian.lu().solve(&missing_rows).expect("six joints that move it in six ways");
        let moved: [f64; 6] = std::array::from_fn(|i| q[i] + step[i]);
        let after = deviation(Orientation::RotationVector, &pps::real_pose(&moved, &s, &u).unwrap(), &target);
        assert!(largest(&after[..3]) < 0.02 * largest(&missing[..3]), "{missing:?} became {after:?}");
    }
}

/// Checks the error of every invalid input.
#[test]
fn errors_are_values() {
    use abbe_manipulators::pps::{self, FRAMES, Inputs, Parameters};
    let (s, u, none) = (Parameters::NOMINAL, Inputs::NOMINAL, [[0.0; 6]; FRAMES]);
    let home = [1128.0, 280.0, 0.0, 0.0, 0.0, 0.0];
    let singular = [1128.0, 280.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0];
    let is_singular = |error: Option<Error>| matches!(error, Some(Error::EulerSingularity { .. }));
    assert!(is_singular(pps::displacement(&singular, &s, &none).err()));
    assert!(is_singular(pps::covariance(&singular, &s, &none).err()));
    assert!(is_singular(pps::predicted_displacement(&singular, &s, &u).err()));
    assert!(is_singular(pps::source_displacements(&singular, &s, &u).err()));
    assert!(pps::real_pose(&singular, &s, &u).is_ok() && pps::compensator_step(&singular, &s, &u).is_ok());

    let mut nan = home;
    nan[4] = f64::NAN;
    let expected = Some(Error::NotFinite { quantity: Quantity::Variables, index: 4 });
    assert_eq!(pps::displacement(&nan, &s, &none).err(), expected);
    assert_eq!(pps::real_pose(&nan, &s, &u).err(), expected);
    assert_eq!(pps::compensator_step(&nan, &s, &u).err(), expected);
    let mut bad = none;
    bad[2][1] = f64::INFINITY;
    let expected = Some(Error::NotFinite { quantity: Quantity::Errors, index: 13 });
    assert_eq!(pps::displacement(&home, &s, &bad).err(), expected);
    assert_eq!(pps::covariance(&home, &s, &bad).err(), expected);
    bad[2][1] = f64::MAX;
    bad[1] = [f64::MAX; 6];
    assert!(matches!(
        pps::displacement(&home, &s, &bad),
        Err(Error::NotFinite { quantity: Quantity::Displacement, .. })
    ));
    let soft = Parameters { arm_EI: 0.0, ..s };
    assert!(
        pps::predicted_displacement(&home, &soft, &u).is_err() && pps::real_pose(&home, &soft, &u).is_err()
    );
}
