//! Checks that a matrix is a rigid motion, `R Rᵀ = I` and `det R = 1`, at fixed sample
//! configurations.
//!
//! Sample configurations: fixed ones, so that checks are deterministic.

use super::Declarations;
use crate::diagnostic::Diagnostic;
use crate::expr::{Binary, Expression, Function, Kind, Scope, Symbol};
use crate::manipulator::{Matrix, Variable};

/// Tolerance of products of rows, for numbers with ten digits.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Rows that each condition involves: unit length of one, orthogonality of two, a right-handed
/// system of all three.
const LAWS: [&[usize]; 7] = [&[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2], &[0, 1, 2]];

/// Returns the first violated condition as a diagnostic. Parameters have their nominal values.
pub(super) fn check_rigid(matrix: &Matrix, declarations: &Declarations) -> Option<Diagnostic> {
    let scope = &declarations.scope;
    for sample in 1..=SAMPLES {
        let configuration = Sample::new(declarations, sample);
        let value = |entry: &Expression| {
            entry.value(&scope.tables, |symbol| match symbol {
                Symbol::Parameter(i) => declarations.parameters[i].value,
                symbol => configuration.value(symbol).unwrap_or(f64::NAN),
            })
        };
        let rows: [[f64; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| value(&matrix.rows[i][j])));
        for law in LAWS {
            let (value, expected) = product(law, &rows);
            let fulfilled = (value - expected).abs() <= TOLERANCE;
            if !fulfilled {
                return Some(mistake(matrix, law, value, &at(matrix, scope, &configuration)));
            }
        }
    }
    None
}

/// Returns the product of some rows and its required value: the square of one, the inner product of
/// two, the determinant of three.
fn product(law: &[usize], rows: &[[f64; 3]; 3]) -> (f64, f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    match *law {
        [i] => (dot(rows[i], rows[i]), 1.0),
        [i, j] => (dot(rows[i], rows[j]), 0.0),
        _ => {
            let ([a, b, c], [d, e, f]) = (rows[0], rows[1]);
            (dot([b * f - c * e, c * d - a * f, a * e - b * d], rows[2]), 1.0)
        }
    }
}

fn mistake(matrix: &Matrix, law: &[usize], value: f64, at: &str) -> Diagnostic {
    let broken = match *law {
        [i] => format!("row {} is not a unit vector: its sum of squares is {value}", i + 1),
        [i, j] => {
            format!("rows {} and {} are not orthogonal: their scalar product is {value}", i + 1, j + 1)
        }
        _ => format!("the rotation part is a reflection: its determinant is {value}"),
    };
    // The last row involved is marked, the others are shown.
    let row = |i: usize| matrix.rows[i][0].span().start..matrix.rows[i][2].span().end;
    let (last, others) = law.split_last().expect("a law is about at least one row");
    let message = format!("this matrix is not a rigid motion: {broken}{at}");
    let mut mistake = Diagnostic::new(row(*last), message)
        .label(format!("row {}", last + 1))
        .help("check signs, and that sines and cosines match; write constants exactly, as cos(45 deg)");
    for other in others {
        mistake = mistake.context(row(*other), format!("row {}", other + 1));
    }
    mistake
}

fn at(matrix: &Matrix, scope: &Scope, configuration: &Sample) -> String {
    let used: Vec<Symbol> = matrix.rows.iter().flatten().flat_map(|entry| entry.symbols()).collect();
    let shown: Vec<String> = scope
        .names
        .iter()
        .filter(|(_, name)| used.contains(&name.symbol))
        .filter_map(|(name, declared)| {
            configuration.value(declared.symbol).map(|value| format!("{name} = {value:.4}"))
        })
        .collect();
    if shown.is_empty() { String::new() } else { format!(" at {}", shown.join(", ")) }
}

/// Number of sample configurations.
pub(super) const SAMPLES: usize = 16;

/// Values of all variables within their limits.
pub(super) struct Sample {
    q: Vec<f64>,
    p: Vec<f64>,
}

impl Sample {
    /// Returns sample configuration 1, 2, ….
    pub(super) fn new(declarations: &Declarations, sample: usize) -> Self {
        let all = declarations.variables.iter().chain(&declarations.passive).enumerate();
        let mut q: Vec<f64> = all.map(|(i, variable)| value(variable, i, sample)).collect();
        let p = q.split_off(declarations.variables.len());
        Self { q, p }
    }

    /// Returns the value of a variable; `None` for other symbols.
    pub(super) fn value(&self, symbol: Symbol) -> Option<f64> {
        match symbol {
            Symbol::Variable(i) => Some(self.q[i]),
            Symbol::Passive(i) => Some(self.p[i]),
            _ => None,
        }
    }
}

/// Returns `true` if the value of an expression depends on a variable. In `q - q` it occurs without
/// effect.
pub(super) fn depends(expression: &Expression, own: Symbol, declarations: &Declarations) -> bool {
    if !expression.symbols().any(|symbol| symbol == own) {
        return false;
    }
    // Steps and kinks may lie between the samples.
    let smooth = expression.terms().iter().all(|term| {
        !matches!(
            term.kind,
            Kind::Lookup(..)
                | Kind::Binary(Binary::Min | Binary::Max, ..)
                | Kind::Call(Function::Abs | Function::Sign, _)
        )
    });
    let others = Sample::new(declarations, 1);
    let home = declarations.variable(own).map_or(0.0, |variable| variable.home);
    let mut values = (0..SAMPLES).map(|sample| {
        expression.value(&declarations.scope.tables, |symbol| match symbol {
            symbol if symbol == own => home + GOLDEN * sample as f64,
            Symbol::Parameter(i) => declarations.parameters[i].value,
            symbol => others.value(symbol).unwrap_or(f64::NAN),
        })
    });
    let first = values.next().unwrap_or(f64::NAN);
    !(smooth && values.all(|value| (value - first).abs() <= 1e-12 * first.abs()))
}

/// Fractional part of the golden ratio, whose multiples are evenly spread.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Returns a value within the limits, by a golden-ratio sequence that differs for each variable.
fn value(variable: &Variable, index: usize, sample: usize) -> f64 {
    let [lower, upper] = variable.limits.map(|limit| limit.clamp(-1e6, 1e6));
    let [lower, upper] =
        if upper - lower > 1e5 { [variable.home - 3.0, variable.home + 3.0] } else { [lower, upper] };
    let fraction = (GOLDEN * (sample + 7 * index) as f64).fract();
    lower + (upper - lower) * fraction
}
