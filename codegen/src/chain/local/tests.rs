//! Tests of `local.rs`.

use super::*;
use abbe_spec::expr::Symbol;

/// The matrix of an elbow, `Rz(q) Tz(d) Tx(a) Rx(-π/2)`, becomes one rotation by q and constant
/// translations.
#[test]
fn a_matrix_is_taken_apart() {
    let mut graph = Graph::new();
    let g = &mut graph;
    let (angle, a, d) = (g.symbol(Symbol::Variable(0)), g.constant(0.5), g.constant(0.3));
    let (sine, cosine, zero, one) = (g.sin(angle), g.cos(angle), g.zero(), g.constant(1.0));
    let (minus_sine, minus_one) = (g.neg(sine), g.neg(one));
    let position = [g.mul(a, cosine), g.mul(a, sine), d];
    let axes = [[cosine, sine, zero], [zero, zero, minus_one], [minus_sine, cosine, zero]];
    let mut motions = Vec::new();
    taken_apart(g, &Frame { axes, position }, &mut motions);
    let [Local::Shift(before), turn, exchange, Local::Shift(after)] = &motions[..] else {
        panic!("a shift, a turn, an exchange, a shift");
    };
    assert!(matches!(turn, Local::Turn { axis: 2, .. }));
    assert_eq!((before, after), (&[zero, zero, d], &[a, zero, zero]));
    let symbols = [0, 1, 2].map(|i| g.symbol(Symbol::Parameter(i)));
    let exchanged = exchange.direction(g, symbols);
    let direction = turn.direction(g, exchanged);
    let expected = g.turn(&axes, symbols);
    let both: Vec<Node> = direction.into_iter().chain(expected).collect();
    let values = g.evaluate(&both, |symbol| match symbol {
        Symbol::Parameter(i) => 1.0 + 0.3 * i as f64,
        _ => 0.7,
    });
    assert_eq!(values[..3], values[3..]);
}
