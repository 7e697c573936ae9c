//! Tests of `walk.rs`.

use super::*;

#[test]
fn rotation_about_any_axis_agrees_with_the_elementary_ones() {
    let mut graph = Graph::new();
    let angle = graph.symbol(Symbol::Variable(0));
    for axis in 0..3 {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let general = about(&mut graph, unit, angle);
        let identity = graph.identity();
        let elementary = graph.turned(&identity, axis, angle).axes;
        let both: Vec<Node> = general.into_iter().chain(elementary).flatten().collect();
        let values = graph.evaluate(&both, |_| 0.7);
        for (a, b) in values[..9].iter().zip(&values[9..]) {
            assert!((a - b).abs() < 1e-15, "{values:?}");
        }
    }
}
