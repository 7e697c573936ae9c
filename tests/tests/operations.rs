//! Operation counts: a change of them is a line in the review, and must not be a surprise.

use std::fmt::Write;

use abbe_codegen::chain::Model;
use abbe_codegen::program::{FunctionKind, Operations, functions};
use abbe_codegen::spec::{Orientation, Spec};
use abbe_manipulators::SHIPPED;
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
            writeln!(table, "  {:<18} {}", kind.name(), program.operations()).unwrap();
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

/// A chain of `frames` frames in general position, alternating revolute and prismatic.
fn general_chain(frames: usize) -> Spec {
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"m\"\n".to_owned();
    for i in 0..frames {
        let (kind, theta, d) = if i % 2 == 0 {
            ("revolute", format!("q{i} + 0.1"), "0.2".to_owned())
        } else {
            ("prismatic", "0.3".to_owned(), format!("q{i} + 0.1 m"))
        };
        let twist = 0.4 + 0.01 * i as f64;
        write!(
            text,
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\" }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = 0.{}, alpha = {twist} }}\n",
            i + 1
        )
        .unwrap();
    }
    Spec::parse("chain.toml", &text).unwrap()
}

#[test]
fn growth_is_linear() {
    let total = |spec: &Spec| {
        let count = error_jacobian(spec);
        (count.mul + count.add) as f64
    };
    let (six, hundred) = (total(&general_chain(6)), total(&general_chain(100)));
    println!("6 frames: {six} operations, 100 frames: {hundred}");
    assert!(hundred < 1.3 * 100.0 / 6.0 * six, "{six} at 6 frames, {hundred} at 100");
}
