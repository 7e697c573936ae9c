//! Shows that a matrix is a rigid motion: `R Rᵀ = I` and `det R = 1`.
//!
//! The products of the rows are formed in a graph. Where they simplify to the constants they must be, that is a
//! proof; where not, they are evaluated at fixed sample points.

use super::{Matrix, Variable};
use crate::diagnostic::Diagnostic;
use crate::expr::{Scope, Symbol};
use crate::graph::{Graph, Node, Vector};

/// How far a product of rows may be from what it must be: what is left of numbers with ten digits.
pub(super) const TOLERANCE: f64 = 1e-9;

/// How many configurations are tried where there is no proof.
const SAMPLES: usize = 16;

/// One equation that the rows must fulfil.
struct Law {
    value: Node,
    expected: f64,
    broken: fn(f64) -> String,
    rows: &'static [usize],
}

/// The first law that a matrix breaks, as a mistake. Parameters are at their nominal values.
pub(super) fn check_rigid(
    matrix: &Matrix,
    scope: &Scope,
    variables: &[Variable],
    parameters: &[f64],
) -> Option<Diagnostic> {
    let mut graph = Graph::with_tables(&scope.tables);
    let laws = laws(&mut graph, matrix);
    let nodes: Vec<Node> = laws.iter().map(|law| law.value).collect();
    let proved =
        |law: &Law| graph.value(law.value).is_some_and(|value| (value - law.expected).abs() <= TOLERANCE);
    if laws.iter().all(proved) {
        return None;
    }
    for sample in 1..=SAMPLES {
        let q: Vec<f64> = variables.iter().enumerate().map(|(i, v)| sample_value(v, i, sample)).collect();
        let values = graph.evaluate(&nodes, |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Parameter(i) => parameters[i],
            Symbol::Input(_) | Symbol::Error(_) | Symbol::Magnitude(_) | Symbol::Local(_) => f64::NAN,
        });
        for (law, value) in laws.iter().zip(values) {
            let fulfilled = (value - law.expected).abs() <= TOLERANCE;
            if !fulfilled {
                return Some(mistake(matrix, law, value, &at(matrix, scope, &q)));
            }
        }
    }
    None
}

fn laws(graph: &mut Graph, matrix: &Matrix) -> Vec<Law> {
    let rows: [Vector; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| graph.lower(&matrix.rows[i][j])));
    let length = |value: f64| format!("is not of length 1: the sum of its squares is {value}");
    let mut laws = Vec::new();
    for (i, name) in [[0], [1], [2]].iter().enumerate() {
        let value = graph.dot(rows[i], rows[i]);
        laws.push(Law { value, expected: 1.0, broken: length, rows: name });
    }
    let angle = |value: f64| format!("are not perpendicular: the sum of their products is {value}");
    for pair in [&[0, 1], &[0, 2], &[1, 2]] {
        let value = graph.dot(rows[pair[0]], rows[pair[1]]);
        laws.push(Law { value, expected: 0.0, broken: angle, rows: pair });
    }
    let normal = graph.cross(rows[0], rows[1]);
    let value = graph.dot(normal, rows[2]);
    let mirror = |value: f64| format!("make a mirror image, not a rotation: their determinant is {value}");
    laws.push(Law { value, expected: 1.0, broken: mirror, rows: &[0, 1, 2] });
    laws
}

fn mistake(matrix: &Matrix, law: &Law, value: f64, at: &str) -> Diagnostic {
    let names: Vec<String> = law.rows.iter().map(|row| (row + 1).to_string()).collect();
    let rows = match &names[..] {
        [row] => format!("row {row}"),
        [first, second] => format!("rows {first} and {second}"),
        _ => "the rows".to_owned(),
    };
    // The last row at fault is marked, the others shown.
    let row = |i: usize| matrix.rows[i][0].span().start..matrix.rows[i][2].span().end;
    let (last, others) = law.rows.split_last().expect("a law is about at least one row");
    let message = format!("this matrix is not a rigid motion: {rows} {}{at}", (law.broken)(value));
    let mut mistake = Diagnostic::new(row(*last), message)
        .label(format!("row {}", last + 1))
        .help("check the signs, and that every sine has its cosine; write constants in full, as cos(45 deg)");
    for other in others {
        mistake = mistake.context(row(*other), format!("row {}", other + 1));
    }
    mistake
}

fn at(matrix: &Matrix, scope: &Scope, q: &[f64]) -> String {
    let used: Vec<Symbol> = matrix.rows.iter().flatten().flat_map(|entry| entry.symbols()).collect();
    let shown: Vec<String> = scope
        .names
        .iter()
        .filter(|(_, name)| used.contains(&name.symbol))
        .filter_map(|(name, declared)| match declared.symbol {
            Symbol::Variable(i) => Some(format!("{name} = {:.4}", q[i])),
            _ => None,
        })
        .collect();
    if shown.is_empty() { String::new() } else { format!(" at {}", shown.join(", ")) }
}

/// A value within the limits: a golden-ratio sequence, another for each variable.
fn sample_value(variable: &Variable, index: usize, sample: usize) -> f64 {
    let [lower, upper] = variable.limits.map(|limit| limit.clamp(-1e6, 1e6));
    let [lower, upper] =
        if upper - lower > 1e5 { [variable.home - 3.0, variable.home + 3.0] } else { [lower, upper] };
    let golden = 0.618_033_988_749_894_9;
    let fraction = (golden * (sample + 7 * index) as f64).fract();
    lower + (upper - lower) * fraction
}
