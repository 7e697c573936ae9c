//! Tests of the corners: control points bound norms from above, and closely.

use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::{Function, Symbol};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::*;
use crate::tape::Tape;

/// Number of angles; the name after them is linear.
const ANGLES: usize = 3;
const NAMES: usize = ANGLES + 1;

fn name(i: usize) -> Symbol {
    Symbol::Variable(i)
}

/// Returns the sine and cosine of a sum of names, with signs, and a constant.
fn sin_cos(graph: &mut Graph, names: &[(usize, f64)], offset: f64) -> [Node; 2] {
    let mut sum = graph.constant(offset);
    for (i, sign) in names {
        let own = graph.symbol(name(*i));
        sum = if *sign > 0.0 { graph.add(sum, own) } else { graph.sub(sum, own) };
    }
    [Function::Sin, Function::Cos].map(|function| graph.call(function, sum))
}

fn norm(graph: &mut Graph, parts: &[Node]) -> Tape {
    let squares: Vec<Node> = parts.iter().map(|part| graph.mul(*part, *part)).collect();
    let sum = squares.into_iter().reduce(|sum, square| graph.add(sum, square)).unwrap();
    let outputs = [&[sum], parts].concat();
    let names: Vec<Symbol> = (0..NAMES).map(name).collect();
    Tape::new(graph, &outputs, &names, |_| f64::NAN)
}

/// Returns two numbers that are affine in the sine and cosine of each angle, and in the last
/// name.
fn parts(graph: &mut Graph) -> [Node; 2] {
    let [_, first] = sin_cos(graph, &[(0, 1.0)], 0.0);
    let [_, sum] = sin_cos(graph, &[(1, 1.0), (2, -1.0)], 0.4);
    let [sine, cosine] = sin_cos(graph, &[(0, -1.0), (1, 1.0)], -0.7);
    let slide = graph.symbol(name(3));
    let x = graph.mul(first, sum);
    let x = graph.add(x, slide);
    let y = graph.mul(slide, sine);
    [x, graph.sub(y, cosine)]
}

/// Returns two numbers that are quadratic in two angles and in the last name, and affine in
/// another angle.
fn quadratic_parts(graph: &mut Graph) -> [Node; 2] {
    let [x, y] = parts(graph);
    let [sine, cosine] = sin_cos(graph, &[(0, 1.0), (2, 1.0)], 0.3);
    let slide = graph.symbol(name(3));
    let square = graph.mul(slide, slide);
    let bent = graph.mul(square, sine);
    let product = graph.mul(sine, cosine);
    let [other, _] = sin_cos(graph, &[(1, 1.0)], 0.0);
    let product = graph.mul(product, other);
    // The norm depends on a part by its negative alone.
    let y = graph.sub(product, y);
    [graph.add(x, bent), graph.neg(y)]
}

#[test]
fn nothing_is_larger_than_at_the_control_points_of_affine_parts() {
    nothing_is_larger(parts, 4.7, 1e-12);
}

#[test]
fn nothing_is_larger_than_at_the_control_points_of_quadratic_parts() {
    // The bound of the rounding grows threefold with each of three quadratic names, and the
    // norm is a square.
    nothing_is_larger(quadratic_parts, 2.3, 1e-8);
}

fn nothing_is_larger(parts: fn(&mut Graph) -> [Node; 2], longest: f64, rounding: f64) {
    let mut graph = Graph::new();
    let parts = parts(&mut graph);
    let tape = norm(&mut graph, &parts);
    let corners = Corners::new(Convex::new(&tape, NAMES).unwrap()).unwrap();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let mut numbers = Buffers::default();
    for box_ in 0..500 {
        let longest = [longest, 1.0, 0.02][box_ % 3];
        let low: [f64; NAMES] = std::array::from_fn(|_| random.random_range(-4.0..4.0));
        let high = low
            .map(|low| low + if random.random_bool(0.2) { 0.0 } else { random.random_range(0.0..longest) });
        assert!((0..NAMES).all(|name| !corners.is_too_long(name, [low[name], high[name]])));
        let corner = corners.largest(&mut numbers, &low, &high).unwrap();
        for _ in 0..200 {
            let at: [f64; NAMES] = std::array::from_fn(|name| match random.random_range(0..4) {
                0 => low[name],
                1 => high[name],
                _ => random.random_range(low[name]..=high[name]),
            });
            let value = tape.evaluate::<0>(&mut Vec::new(), &at, &[0.0; NAMES]).0[0].range()[0];
            assert!(value <= corner.most, "{value} above {corner:?} of {low:?} … {high:?}");
        }
        let near = corner.nearest(&low, &high);
        assert!(near.iter().zip(low.iter().zip(&high)).all(|(at, (low, high))| low <= at && at <= high));
        // A control point within all arcs is attained, and the bound of a small box is close.
        if (0..NAMES).all(|name| !corner.is_outside(name)) {
            let value = tape.evaluate::<0>(&mut Vec::new(), &near, &[0.0; NAMES]).0[0].range()[1];
            assert!(corner.most <= value * (1.0 + rounding) + rounding, "{corner:?}, and {value}");
        }
        if longest == 0.02 {
            let value = tape.evaluate::<0>(&mut Vec::new(), &near, &[0.0; NAMES]).0[0].range()[1];
            assert!(corner.most <= value * 1.01 + 0.01, "{corner:?}, and {value}");
        }
    }
    assert!(corners.is_too_long(0, [0.0, 4.9]) && !corners.is_too_long(3, [0.0, 4.9]));
}

/// Checks the exact control points of the square of a sine: `sin²` has the largest value 1 at a
/// right angle, which is the upper end of one arc and within another.
#[test]
fn the_square_of_a_sine_is_bounded_closely() {
    let mut graph = Graph::new();
    let [sine, _] = sin_cos(&mut graph, &[(0, 1.0)], 0.0);
    let square = graph.mul(sine, sine);
    let node = graph.mul(square, square);
    let tape = Tape::new(&graph, &[node, square], &[name(0)], |_| f64::NAN);
    let corners = Corners::new(Convex::new(&tape, 1).unwrap()).unwrap();
    let most = |low: f64, high: f64| corners.largest(&mut Buffers::default(), &[low], &[high]).unwrap().most;
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!((most(0.0, quarter) - 1.0).abs() < 1e-12);
    // With h half of an arc around the right angle, `sin² = cos² t` for `|t| ≤ h` has the
    // control points cos² h, 1 and, with w, `w / cos² h + (1 − w) cos² h`.
    let half: f64 = 0.3;
    let squared = half.cos().powi(2);
    let weight = 2.0 * squared / (1.0 + 2.0 * squared);
    let inner = weight / squared + (1.0 - weight) * squared;
    assert!((most(quarter - half, quarter + half) - inner.powi(2)).abs() < 1e-12);
}

#[test]
fn what_is_not_a_norm_of_quadratic_parts_has_no_control_points() {
    let is_bounded = |parts: &dyn Fn(&mut Graph) -> Vec<Node>| {
        let mut graph = Graph::new();
        let parts = parts(&mut graph);
        let tape = norm(&mut graph, &parts);
        Convex::new(&tape, NAMES).is_some()
    };
    assert!(is_bounded(&|graph| parts(graph).to_vec()));
    assert!(is_bounded(&|graph| quadratic_parts(graph).to_vec()));
    // An angle occurs three times in a product, directly or in a sum.
    assert!(!is_bounded(&|graph| {
        let [sine, cosine] = sin_cos(graph, &[(0, 1.0)], 0.0);
        let product = graph.mul(sine, cosine);
        vec![graph.mul(product, cosine)]
    }));
    assert!(!is_bounded(&|graph| {
        let ([sine, cosine], [sum, _]) =
            (sin_cos(graph, &[(0, 1.0)], 0.0), sin_cos(graph, &[(0, 1.0), (1, 1.0)], 0.0));
        let product = graph.mul(sine, cosine);
        vec![graph.mul(product, sum)]
    }));
    // A sum contains a name twice.
    assert!(!is_bounded(&|graph| vec![sin_cos(graph, &[(0, 1.0), (0, 1.0)], 0.0)[0]]));
    // An angle also occurs linearly, or an operation is neither a sum nor a product.
    assert!(!is_bounded(&|graph| {
        let ([sine, _], own) = (sin_cos(graph, &[(0, 1.0)], 0.0), graph.symbol(name(0)));
        vec![sine, own]
    }));
    assert!(!is_bounded(&|graph| {
        let own = graph.symbol(name(0));
        vec![graph.call(Function::Exp, own)]
    }));
    // A norm depends on more than its parts.
    let mut graph = Graph::new();
    let [first, second] = parts(&mut graph);
    let mut tape = norm(&mut graph, &[first, second]);
    tape.outputs.truncate(2);
    assert!(Convex::new(&tape, NAMES).is_none());
}
