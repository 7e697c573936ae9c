//! Tests of `extended.rs`.

use abbe::{Component, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

use super::super::terms::{Basis, ErrorSite, Term};
use super::extended;

/// A mass of 1 kg at 300 mm from the axis turns a compliance of 1 µrad per N mm.
#[test]
fn the_default_load_hangs_at_the_tool_point() {
    let text = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"arm\"\nvariable = { name = \"q1\", kind = \"revolute\" }\ntransform = \"Rz(q1)\"\n[tool]\ntransform = \"Tx(300)\"\n";
    let spec = Spec::parse("arm.toml", text).unwrap();
    let term = Term { site: ErrorSite::Frame(0, Component::Spin), basis: Basis::Moment };
    let robot = Interpreter::new(extended(&spec, &[term]));
    let mut errors = [[0.0; 6]];
    robot.generalized_errors(&[0.7], &[], &[], &mut errors).unwrap();
    assert!((errors[0][Component::Spin.index()] - 1e-6 * 300.0 * 9.80665).abs() < 1e-15, "{errors:?}");
}
