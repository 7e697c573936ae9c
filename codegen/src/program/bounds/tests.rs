//! Tests of `bounds.rs`.

use abbe_spec::expr::Symbol;

use super::*;
use crate::graph::{Graph, Node};

#[test]
fn only_what_cannot_overflow_is_finite() {
    let mut g = Graph::new();
    let [x, y] = [0, 1].map(|k| g.symbol(Symbol::Variable(k)));
    let finite = |g: &Graph, node: Node, limit: f64| {
        Program::new(g, &[node]).finite_outputs(limit, None, f64::MAX) == [true]
    };
    let square = g.mul(x, x);
    let product = g.mul(square, y);
    assert!(finite(&g, product, 1e100) && !finite(&g, product, 1e103));
    let (three, cosine) = (g.constant(3.0), g.cos(y));
    let far_from_0 = g.add(three, cosine);
    let [quotient, bounded] = [y, far_from_0].map(|divisor| g.div(x, divisor));
    assert!(!finite(&g, quotient, 1.0) && finite(&g, bounded, 1e100));
    let other = g.mul(y, y);
    let sum = g.add(square, other);
    let [root, of_any] = [sum, x].map(|node| g.call(Function::Sqrt, node));
    assert!(finite(&g, root, 1e100) && !finite(&g, of_any, 1.0));
}

/// A small result does not help if a step towards it exceeds the type.
#[test]
fn every_step_is_bounded_by_the_type() {
    let mut g = Graph::new();
    let x = g.symbol(Symbol::Variable(0));
    let square = g.mul(x, x);
    let fourth = g.mul(square, square);
    let bounded = g.sin(fourth);
    let program = Program::new(&g, &[bounded]);
    assert_eq!(program.finite_outputs(1e10, None, f64::MAX), [true]);
    assert_eq!(program.finite_outputs(1e10, None, f64::from(f32::MAX)), [false]);
}

#[test]
fn a_checked_margin_bounds_quotients() {
    let mut g = Graph::new();
    let [x, y] = [0, 1].map(|k| g.symbol(Symbol::Variable(k)));
    let cosine = g.cos(y);
    let quotient = g.div(x, cosine);
    let program = Program::new(&g, &[quotient, cosine]);
    let margin = Some((program.outputs[1], 1e-5));
    assert_eq!(program.finite_outputs(1e100, margin, f64::MAX), [true, true]);
    assert_eq!(program.finite_outputs(1e100, None, f64::MAX), [false, true]);
}
