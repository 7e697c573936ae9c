//! Tests of `factored.rs`.

use abbe_spec::expr::Symbol;

use super::*;

const UNITS: [f64; 5] = [1.0, 1e6, 1.0, 300.0, 0.1];

/// Both solutions satisfy their equations, also where elimination without pivots would divide
/// by zero, and where rows have units that differ by a million.
#[test]
fn solutions_satisfy_the_equations() {
    let mut graph = Graph::new();
    let g = &mut graph;
    let entries: Vec<Node> = (0..25).map(|i| g.symbol(Symbol::Local(i))).collect();
    let zero = g.zero();
    let columns: Vec<Vec<Node>> = (0..5)
        .map(|j| (0..5).map(|i| if (i + j) % 4 == 0 { zero } else { entries[5 * j + i] }).collect())
        .collect();
    let right: Vec<Node> = (0..5).map(|i| g.symbol(Symbol::Parameter(i))).collect();
    let unit = |i: usize| UNITS[i % 5];
    let units = Units { equations: UNITS.to_vec(), passive: vec![1.0; 5], variables: Vec::new() };
    let factored = Factored::new(g, columns.clone(), &units);
    let (x, y) = (factored.solve(g, &right), factored.solve_row(g, &right));
    let rows: Vec<Vec<Node>> = (0..5).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
    let mut residuals: Vec<Node> = Vec::new();
    for k in 0..5 {
        let (product, row) = (g.products(&rows[k], &x), g.constant(1.0 / unit(k)));
        let residual = g.sub(product, right[k]);
        residuals.push(g.mul(row, residual));
        let product = g.products(&columns[k], &y);
        residuals.push(g.sub(product, right[k]));
    }
    let value = |symbol| match symbol {
        Symbol::Local(i) => unit(i) * (1.7 * i as f64).sin(),
        Symbol::Parameter(i) => 1.0 + i as f64,
        _ => f64::NAN,
    };
    for residual in graph.evaluate(&residuals, value) {
        assert!(residual.abs() < 1e-13, "{residual}");
    }
}

/// A block is singular where a factor of its determinant is zero, not where the determinant is
/// small: six joints that are a thousandth of their loop make it 1e-18.
#[test]
fn short_joints_are_not_singular() {
    let units = Units { equations: vec![1.0; 6], passive: vec![1.0; 6], variables: Vec::new() };
    let entry = |i: usize, j: usize| 1e-3 * (1.3 * ((i + 1) * (j + 1)) as f64).sin();
    for (last, is_singular) in [(5, false), (4, true)] {
        let mut graph = Graph::new();
        let g = &mut graph;
        let column = |g: &mut Graph, j: usize| (0..6).map(|i| g.constant(entry(i, j))).collect::<Vec<_>>();
        let columns = [0, 1, 2, 3, 4, last].map(|j| column(g, j)).to_vec();
        let factored = Factored::new(g, columns, &units);
        let nodes: Vec<Node> =
            factored.determinants().flat_map(|(_, pivots)| pivots).map(|(p, _)| *p).collect();
        let least = graph.evaluate(&nodes, |_| f64::NAN).into_iter().map(f64::abs).reduce(f64::min);
        assert_eq!(least.unwrap() < 1e-14, is_singular, "{least:?}");
    }
}
