//! Operation counts: a change of them is a line in the review.

use std::fmt::Write;

use abbe::{Class, Function, Orientation};
use abbe_codegen::chain::Model;
use abbe_codegen::program::{Operations, Routines, straight_line};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::general_chain;
use expect_test::expect_file;

fn shipped(name: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    Spec::parse(name, shipped.spec).unwrap()
}

fn operations(spec: &Spec, kind: Function) -> Operations {
    straight_line(kind, &Model::new(spec)).operations()
}

/// Returns the sum of multiplications and additions.
fn total(count: Operations) -> usize {
    count.mul + count.add
}

#[test]
fn counts_of_every_function() {
    let mut table = String::new();
    for shipped in SHIPPED {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        writeln!(table, "{}", shipped.name).unwrap();
        for routine in Routines::new(&spec, &Model::new(&spec)).list {
            writeln!(table, "  {:<23} {}", routine.name, routine.operations).unwrap();
        }
    }
    expect_file!["../../golden/operations.txt"].assert_eq(&table);
}

/// Compares with the best other generators for pose and `J_e` with rotation-vector rows: 206 (PUMA
/// 560), 91 (PPPRRR) and 227 (iiwa). Distinct numbers need no more than the dense matrix.
#[test]
fn fewer_than_others_need() {
    let gantry = Spec::parse("ppprrr.toml", include_str!("../../specs/ppprrr.toml")).unwrap();
    for (spec, most, revolute) in [(shipped("puma560"), 170, 6), (gantry, 91, 3), (shipped("iiwa"), 227, 7)] {
        assert_eq!(spec.orientation, Orientation::RotationVector);
        for kind in [Function::ErrorJacobian, Function::ErrorJacobianDistinct] {
            let count = operations(&spec, kind);
            println!("{} {}: {count}", spec.name, kind.name());
            assert!(total(count) <= most && count.sincos == revolute, "{}: {count}", spec.name);
        }
    }
}

/// Checks the cost of Euler rows: rows 4–6 of a rotation are `B ω`, 5 multiplications and 3
/// additions for each of three rotations per frame.
#[test]
fn what_euler_rows_cost() {
    for shipped in SHIPPED {
        let mut spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        let mut count = |orientation| {
            spec.orientation = orientation;
            operations(&spec, Function::ErrorJacobian)
        };
        let (plain, euler) = (count(Orientation::RotationVector), count(Orientation::EulerYzx));
        let frames = spec.frames.len();
        let (mul, add) = (euler.mul - plain.mul, euler.add - plain.add);
        assert!(mul <= 15 * frames && add <= 10 * frames, "{}: {mul} mul, {add} add more", spec.name);
        assert!(euler.div <= plain.div + 1 && euler.sqrt <= plain.sqrt + 1, "{}: {euler}", spec.name);
    }
}

/// Checks the counts of a derivation by hand: PUMA 560 needs 170 for `ΔX` without `J_e`, and 745
/// for the covariance.
#[test]
fn accumulated_along_the_chain() {
    let puma = shipped("puma560");
    let displacement = operations(&puma, Function::Displacement);
    assert!(total(displacement) <= 170 && displacement.sincos == 6, "{displacement}");
    let covariance = operations(&puma, Function::Covariance);
    assert!(total(covariance) <= 745 && covariance.sincos == 6, "{covariance}");
}

/// Checks that errors without sources cost nothing, and that the chosen alternative is the cheaper
/// one.
#[test]
fn sources_of_the_spec_itself() {
    let mut without = 0;
    for shipped in SHIPPED {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        let none = spec.enabled_sources().all(|source| source.class != Class::Repeatable);
        let predicted = operations(&spec, Function::PredictedDisplacement);
        let [real, ideal] = [Function::RealPose, Function::Pose].map(|kind| operations(&spec, kind));
        if none && spec.orientation == Orientation::RotationVector {
            assert_eq!((predicted, real), (Operations::default(), ideal), "{}", spec.name);
            without += 1;
        }
        let any = operations(&spec, Function::Displacement);
        let errors = operations(&spec, Function::GeneralizedErrors);
        assert!(total(predicted) <= total(any) + total(errors), "{}: {predicted}", spec.name);
    }
    assert!(without > 0, "every shipped manipulator has repeatable sources");
}

#[test]
fn growth_is_linear() {
    let chain = |frames: usize| Model::new(&Spec::parse("chain.toml", &general_chain(frames)).unwrap());
    let models = [20, 60, 100].map(chain);
    for kind in Function::ALL {
        let counts = models.each_ref().map(|model| total(straight_line(kind, model).operations()));
        println!("{}: {counts:?} at 20, 60, 100 frames", kind.name());
        let [few, some, many] = counts;
        assert!(100 * (many - some) <= 101 * (some - few), "{}: {counts:?}", kind.name());
    }
}
