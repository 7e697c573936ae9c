//! Operation counts: a change of them is a line in the review, and must not be a surprise.

use std::fmt::Write;

use abbe_codegen::chain::Model;
use abbe_codegen::program::{FunctionKind, Operations, functions};
use abbe_codegen::spec::{Orientation, Spec};
use abbe_manipulators::SHIPPED;
use abbe_tests::chains::general_chain;
use expect_test::expect_file;

fn shipped(name: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    Spec::parse(name, shipped.spec).unwrap()
}

fn error_jacobian(spec: &Spec) -> Operations {
    FunctionKind::ErrorJacobian.program(&Model::new(spec)).operations()
}

#[test]
fn counts_of_every_function() {
    let mut table = String::new();
    for shipped in SHIPPED {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        writeln!(table, "{}", shipped.name).unwrap();
        for (kind, program) in functions(&Model::new(&spec)) {
            writeln!(table, "  {:<23} {}", kind.name(), program.operations()).unwrap();
        }
    }
    expect_file!["../golden/operations.txt"].assert_eq(&table);
}

/// What the best generators of others need for pose and `J_e` with rotation-vector rows.
#[test]
fn no_more_than_others_need() {
    let puma = shipped("puma560");
    assert_eq!(puma.orientation, Orientation::RotationVector);
    let count = error_jacobian(&puma);
    assert!(count.mul <= 138 && count.add <= 79 && count.sincos == 6, "{count}");
    let iiwa = error_jacobian(&shipped("iiwa"));
    assert!(iiwa.mul + iiwa.add <= 240 && iiwa.sincos == 7, "{iiwa}");
}

#[test]
fn growth_is_linear() {
    let chain = |frames: usize| Spec::parse("chain.toml", &general_chain(frames)).unwrap();
    let total = |spec: &Spec| {
        let count = error_jacobian(spec);
        (count.mul + count.add) as f64
    };
    let (six, hundred) = (total(&chain(6)), total(&chain(100)));
    println!("6 frames: {six} operations, 100 frames: {hundred}");
    assert!(hundred < 1.3 * 100.0 / 6.0 * six, "{six} at 6 frames, {hundred} at 100");
}
