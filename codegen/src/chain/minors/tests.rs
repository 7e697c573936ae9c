//! Tests of `minors.rs`.

use super::*;

#[test]
fn equations_are_solved() {
    let mut graph = Graph::new();
    let numbers = |row: usize, column: usize| {
        ((3 * row * row + 5 * row * column + column * column + 1) as f64 * 1.3).sin()
    };
    for count in 1..=6 {
        let rows: Vec<Vec<Node>> =
            (0..count).map(|i| (0..count).map(|j| graph.constant(numbers(i, j))).collect()).collect();
        let b: Vec<Node> = (0..count).map(|i| graph.constant(i as f64 - 1.5)).collect();
        let x = solve(&mut graph, &rows, &b);
        let x = graph.evaluate(&x, |_| f64::NAN);
        for i in 0..count {
            let left: f64 = (0..count).map(|j| numbers(i, j) * x[j]).sum();
            let size: f64 = x.iter().map(|x| x.abs()).sum();
            assert!((left - (i as f64 - 1.5)).abs() < 1e-12 * (1.0 + size), "{count}: {x:?}");
        }
    }
}
