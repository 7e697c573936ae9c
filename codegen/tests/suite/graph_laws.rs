//! Laws of the graph, one per line, including relations that must not hold; then random
//! expressions.

use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::{Function, Symbol};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const VALUES: [f64; 3] = [0.7, -1.3, 2.1];

fn value(symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Variable(i) => VALUES[i],
        _ => f64::NAN,
    }
}

/// `name: left => right` requires both to be the same node, `name: left != right` different nodes.
macro_rules! laws {
    ($($name:ident: |$g:ident, $x:ident, $y:ident| $left:expr, $relation:tt $right:expr;)+) => {$(
        #[test]
        fn $name() {
            let $g = &mut Graph::new();
            let ($x, $y) = ($g.symbol(Symbol::Variable(0)), $g.symbol(Symbol::Variable(1)));
            let _ = ($x, $y);
            let (left, right) = ($left, $right);
            laws!(@check $relation left, right);
            if laws!(@equal $relation) {
                let values = $g.evaluate(&[left, right], value);
                assert!((values[0] - values[1]).abs() < 1e-15);
            }
        }
    )+};
    (@check => $left:ident, $right:ident) => { assert_eq!($left, $right) };
    (@check != $left:ident, $right:ident) => { assert_ne!($left, $right) };
    (@equal =>) => { true };
    (@equal !=) => { false };
}

laws! {
    sums_commute: |g, x, y| g.add(x, y), => g.add(y, x);
    products_commute: |g, x, y| g.mul(x, y), => g.mul(y, x);
    differences_do_not: |g, x, y| g.sub(x, y), != g.sub(y, x);
    quotients_do_not: |g, x, y| g.div(x, y), != g.div(y, x);
    the_turned_difference_is_the_negative: |g, x, y| { let d = g.sub(x, y); g.neg(d) }, => g.sub(y, x);
    two_signs_cancel: |g, x, y| { let n = g.neg(x); g.neg(n) }, => x;
    signs_leave_products: |g, x, y| { let (a, b) = (g.neg(x), g.neg(y)); g.mul(a, b) }, => g.mul(x, y);
    signs_leave_quotients: |g, x, y| { let (a, b) = (g.neg(x), g.neg(y)); g.div(a, b) }, => g.div(x, y);
    signs_leave_sums: |g, x, y| { let (a, b) = (g.neg(x), g.neg(y)); let s = g.add(a, b); g.neg(s) }, => g.add(x, y);
    nothing_is_left_of_equals: |g, x, y| { let n = g.neg(x); g.add(x, n) }, => g.zero();
    sine_is_odd: |g, x, y| { let n = g.neg(x); let s = g.sin(n); g.neg(s) }, => g.sin(x);
    cosine_is_even: |g, x, y| { let d = g.sub(x, y); let n = g.neg(d); g.cos(n) }, => { let d = g.sub(x, y); g.cos(d) };
    a_quarter_turn_less: |g, x, y| { let q = g.constant(std::f64::consts::FRAC_PI_2); let a = g.sub(x, q); g.cos(a) }, => g.sin(x);
    a_quarter_turn_minus: |g, x, y| { let q = g.constant(std::f64::consts::FRAC_PI_2); let a = g.sub(q, x); g.sin(a) }, => g.cos(x);
    a_whole_turn: |g, x, y| { let q = g.constant(std::f64::consts::TAU); let a = g.add(x, q); g.sin(a) }, => g.sin(x);
    not_quite_a_quarter_turn: |g, x, y| { let q = g.constant(1.6); let a = g.add(x, q); g.sin(a) }, != g.cos(x);
    sine_and_cosine_of_two_angles: |g, x, y| { let (s, c) = (g.sin(x), g.cos(y)); let (s, c) = (g.mul(s, s), g.mul(c, c)); g.add(s, c) }, != g.constant(1.0);
    cubes_are_products: |g, x, y| g.power(x, 3.0), => { let s = g.mul(x, x); g.mul(x, s) };
    powers_below_one: |g, x, y| g.power(x, -1.0), => { let one = g.constant(1.0); g.div(one, x) };
    other_powers_stay: |g, x, y| g.power(x, 0.7), != x;
    zero_over_zero_is_not_zero: |g, x, y| { let z = g.zero(); g.div(z, z) }, != g.zero();
    one_over_zero_is_not_folded: |g, x, y| { let (o, z) = (g.constant(1.0), g.zero()); g.div(o, z) }, != g.constant(f64::MAX);
    sums_are_not_reassociated: |g, x, y| { let s = g.add(x, x); g.add(s, y) }, != { let s = g.add(x, y); g.add(x, s) };
}

/// An expression that can be evaluated directly and built in a graph with simplification.
#[derive(Clone, Debug)]
enum Tree {
    Constant(f64),
    Variable(usize),
    Neg(Box<Tree>),
    Binary(u8, Box<Tree>, Box<Tree>),
    Call(Function, Box<Tree>),
    Power(Box<Tree>, f64),
}

fn trees() -> impl Strategy<Value = Tree> {
    let numbers = prop::sample::select(vec![
        0.0,
        1.0,
        -1.0,
        0.5,
        2.0,
        -3.0,
        std::f64::consts::FRAC_PI_2,
        -std::f64::consts::PI,
    ]);
    let leaf = prop_oneof![numbers.prop_map(Tree::Constant), (0..3_usize).prop_map(Tree::Variable)];
    leaf.prop_recursive(5, 40, 2, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        let functions = prop::sample::select(vec![
            Function::Sin,
            Function::Cos,
            Function::Tan,
            Function::Atan,
            Function::Abs,
            Function::Sqrt,
        ]);
        let exponents = prop::sample::select(vec![0.0, 1.0, 2.0, 3.0, 0.5, -1.0, 0.7]);
        prop_oneof![
            boxed.clone().prop_map(Tree::Neg),
            (0..5_u8, boxed.clone(), boxed.clone()).prop_map(|(op, a, b)| Tree::Binary(op, a, b)),
            (functions, boxed.clone()).prop_map(|(function, a)| Tree::Call(function, a)),
            (boxed, exponents).prop_map(|(a, exponent)| Tree::Power(a, exponent)),
        ]
    })
}

impl Tree {
    fn build(&self, g: &mut Graph) -> Node {
        match self {
            Self::Constant(value) => g.constant(*value),
            Self::Variable(i) => g.symbol(Symbol::Variable(*i)),
            Self::Neg(a) => {
                let a = a.build(g);
                g.neg(a)
            }
            Self::Binary(op, a, b) => {
                let (a, b) = (a.build(g), b.build(g));
                match op {
                    0 => g.add(a, b),
                    1 => g.sub(a, b),
                    2 => g.mul(a, b),
                    3 => g.div(a, b),
                    _ => g.atan2(a, b),
                }
            }
            Self::Call(function, a) => {
                let a = a.build(g);
                g.call(*function, a)
            }
            Self::Power(a, exponent) => {
                let a = a.build(g);
                g.power(a, *exponent)
            }
        }
    }

    fn value(&self, at: &[f64; 3]) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Variable(i) => at[*i],
            Self::Neg(a) => -a.value(at),
            Self::Binary(op, a, b) => {
                let (a, b) = (a.value(at), b.value(at));
                match op {
                    0 => a + b,
                    1 => a - b,
                    2 => a * b,
                    3 => a / b,
                    _ => a.atan2(b),
                }
            }
            Self::Call(function, a) => function.evaluate(a.value(at)),
            Self::Power(a, exponent) => a.value(at).powf(*exponent),
        }
    }

    /// Largest magnitude of all intermediate values, the scale of rounding errors. Infinite where a
    /// part has no value, jumps or is steep.
    fn size(&self, at: &[f64; 3]) -> f64 {
        let own = self.value(at).abs();
        let parts = match self {
            Self::Constant(_) | Self::Variable(_) => 0.0,
            Self::Neg(a) | Self::Call(Function::Sin | Function::Cos | Function::Atan, a) => a.size(at),
            Self::Call(_, a) | Self::Power(a, _) => a.size(at).max(1.0 / a.value(at).abs()).powi(3),
            Self::Binary(0 | 1, a, b) => a.size(at).max(b.size(at)),
            Self::Binary(2, a, b) => a.size(at).max(1.0) * b.size(at).max(1.0),
            Self::Binary(_, a, b) => (a.size(at).max(1.0) * b.size(at).max(1.0))
                .max(1.0 / b.value(at).abs())
                .max(1.0 / a.value(at).abs())
                .powi(2),
        };
        if own.is_finite() && !parts.is_nan() { own.max(parts).max(1.0) } else { f64::INFINITY }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000, max_global_rejects: 20_000, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default()
    })]

    #[test]
    fn simplifying_changes_no_value(tree in trees()) {
        let size = tree.size(&VALUES);
        prop_assume!(size < 1e9);
        let mut graph = Graph::new();
        let node = tree.build(&mut graph);
        let (simplified, plain) = (graph.evaluate(&[node], value)[0], tree.value(&VALUES));
        prop_assert!((simplified - plain).abs() <= 1e-14 * size * size, "{simplified} simplified, {plain} as it stands");
    }

    #[test]
    fn derivatives_are_slopes(tree in trees(), variable in 0..3_usize) {
        let size = tree.size(&VALUES);
        prop_assume!(size < 1e2);
        let mut graph = Graph::new();
        let node = tree.build(&mut graph);
        let slope = graph.diff(node, Symbol::Variable(variable));
        let slope = graph.evaluate(&[slope], value)[0];
        let at = |offset: f64| {
            let mut at = VALUES;
            at[variable] += offset;
            tree.value(&at)
        };
        // Richardson extrapolation: the error of the central difference is of second order in the
        // step.
        let step = 1e-4;
        let central = |step: f64| (at(step) - at(-step)) / (2.0 * step);
        let (coarse, fine) = (central(2.0 * step), central(step));
        prop_assume!((coarse - fine).abs() < 1e-2 * (1.0 + fine.abs()));
        let found = (4.0 * fine - coarse) / 3.0;
        prop_assert!((slope - found).abs() <= 1e-5 * (1.0 + slope.abs()) * size, "{slope} by rule, {found} by differences");
    }
}
