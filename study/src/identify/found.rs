//! The identified machine, as values: what is to be added to its spec.

use abbe::Component;
use abbe::identify::Unknown;
use abbe_codegen::expr::Symbol;
use abbe_codegen::spec::{Fitted, Spec};

use super::placed::Placed;
use super::solve::Solved;
use super::terms::Term;
use crate::data::Data;
use crate::number::digits;

/// What was found of a machine: constant errors, and terms of a magnitude.
#[derive(Clone, Debug, Default)]
pub struct FoundModel {
    /// From what it was found, and how well it fits.
    pub reference: String,
    /// Where the machine stands and what is mounted on its tool: no part of its spec.
    pub placed: Placed,
    /// The errors of every frame.
    pub frames: Vec<Vec<FoundError>>,
    /// The richer terms.
    pub terms: Vec<FoundTerm>,
    /// The ranges of joints and inputs on which all this was fitted.
    pub fitted: Vec<Fitted>,
}

/// A constant generalized error.
#[derive(Clone, Copy, Debug)]
pub struct FoundError {
    /// Which of the six.
    pub component: Component,
    /// Its value: the length unit, or rad.
    pub value: f64,
    /// Its standard deviation.
    pub standard_deviation: f64,
}

/// A term.
#[derive(Clone, Copy, Debug)]
pub struct FoundTerm {
    /// The term of magnitude 1.
    pub term: Term,
    /// How large it is.
    pub magnitude: f64,
    /// The standard deviation of that.
    pub standard_deviation: f64,
}

impl FoundModel {
    /// `left` is the root mean square position error of the rows that were used.
    pub(super) fn new(spec: &Spec, solved: &Solved, data: &Data, pose: bool, left: f64) -> Self {
        let Solved { model, fit, .. } = solved;
        let deviations = fit.standard_deviations();
        let placed = Placed::new(model, fit, pose);
        let mut found = Self { placed, frames: vec![Vec::new(); spec.frames.len()], ..Self::default() };
        for k in &fit.identifiable.kept {
            let (list, component) = match model.unknowns[*k] {
                Unknown::Error(frame, component) => (&mut found.frames[frame], component),
                _ => continue,
            };
            let standard_deviation = deviations[*k].unwrap_or_default();
            list.push(FoundError { component, value: fit.x[*k], standard_deviation });
        }
        let first = model.unknowns.len() - solved.terms.len();
        found.terms = solved
            .terms
            .iter()
            .zip(first..)
            .filter_map(|(term, k)| {
                Some(FoundTerm { term: *term, magnitude: fit.x[k], standard_deviation: deviations[k]? })
            })
            .collect();
        found.fitted = fitted(spec, data);
        let (unit, file) = (spec.length.symbol(), std::path::Path::new(&data.file));
        found.reference = format!(
            "Identified from {} rows of {} by abbe {}: rms {} {unit} left, {} {unit} on rows left out in turn",
            data.observations.len(),
            file.file_name().unwrap_or_default().to_string_lossy(),
            env!("CARGO_PKG_VERSION"),
            digits(left, 4),
            digits(solved.crossed.rms, 4),
        );
        found
    }
}

/// The ranges that the rows cover.
fn fitted(spec: &Spec, data: &Data) -> Vec<Fitted> {
    let symbols = (0..spec.variables.len()).map(Symbol::Variable);
    let symbols = symbols.chain((0..spec.inputs.len()).map(Symbol::Input));
    let range = |symbol| {
        let values = data.observations.iter().map(|row| match symbol {
            Symbol::Input(i) => row.u[i],
            Symbol::Variable(i) => row.q[i],
            _ => 0.0,
        });
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], value| {
            [least.min(value), largest.max(value)]
        })
    };
    symbols.map(|symbol| Fitted { symbol, range: range(symbol) }).collect()
}
