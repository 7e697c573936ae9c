//! The identified machine, as values: what is to be added to its spec.

use abbe::Component;
use abbe::identify::{Configurations, Unknown};
use abbe_spec::expr::Symbol;
use abbe_spec::{Fitted, Spec};

use super::as_joint_errors::AsJointErrors;
use super::derived::Derived;
use super::placed::Placed;
use super::solve::Solved;
use super::terms::{Basis, ErrorSite, Term};
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
    /// Numbers of the chain that are not what the spec says: their terms are constant.
    pub numbers: Vec<FoundTerm>,
    /// The magnitudes of sources of the spec.
    pub magnitudes: Vec<FoundMagnitude>,
    /// The richer terms.
    pub terms: Vec<FoundTerm>,
    /// The inputs that are not the spec's own, behind those that are.
    pub derived: Vec<Derived>,
    /// The covariance of all this, by the places of its errors, terms and magnitudes.
    pub covariance: Vec<Vec<f64>>,
    /// The ranges of joints and inputs on which all this was fitted.
    pub fitted: Vec<Fitted>,
}

/// A constant generalized error.
#[derive(Clone, Copy, Debug)]
pub struct FoundError {
    /// Which of the six.
    pub component: Component,
    /// Which row of the covariance is its own.
    pub place: usize,
    /// Its value: the length unit, or rad.
    pub value: f64,
    /// Its standard deviation.
    pub standard_deviation: f64,
}

/// A term.
#[derive(Clone, Copy, Debug)]
pub struct FoundTerm {
    /// Which row of the covariance is its own.
    pub place: usize,
    /// The term of magnitude 1.
    pub term: Term,
    /// How large it is.
    pub magnitude: f64,
    /// The standard deviation of that.
    pub standard_deviation: f64,
}

/// The magnitude of a source of the spec.
#[derive(Clone, Copy, Debug)]
pub struct FoundMagnitude {
    /// Which row of the covariance is its own.
    pub place: usize,
    /// Which one, among all sources of the spec.
    pub source: usize,
    /// What it is multiplied with.
    pub magnitude: f64,
    /// The standard deviation of that.
    pub standard_deviation: f64,
}

impl FoundModel {
    /// In numbers of the chain as far as `joint_errors` has them; `left` is the root mean square position error of the rows that were
    /// used, and of rows left out in turn.
    pub(super) fn new(
        spec: &Spec,
        solved: &Solved,
        joint_errors: Option<&AsJointErrors>,
        data: &Data,
        pose: bool,
        left: [f64; 2],
    ) -> Self {
        let Solved { model, fit, .. } = solved;
        let deviations = fit.standard_deviations();
        let kept = &fit.identifiable.kept;
        let as_found = |(place, k): (usize, &usize)| (place, fit.x[*k], deviations[*k].unwrap_or_default());
        let values: Vec<(usize, f64, f64)> = joint_errors
            .map_or_else(|| kept.iter().enumerate().map(as_found).collect(), |one| one.others.clone());
        let placed = Placed::new(model, fit, pose);
        let mut found = Self { placed, frames: vec![Vec::new(); spec.frames.len()], ..Self::default() };
        let first = model.unknowns.len() - solved.terms.len();
        for (place, value, standard_deviation) in values {
            let error = |component| FoundError { place, component, value, standard_deviation };
            let k = kept[place];
            match model.unknowns[k] {
                Unknown::Error(frame, component) => found.frames[frame].push(error(component)),
                Unknown::Magnitude(_) => match solved.own_magnitude(k) {
                    Some(own) => found.magnitudes.push(FoundMagnitude {
                        place,
                        source: own.source,
                        magnitude: own.declared.value + value,
                        standard_deviation,
                    }),
                    None => {
                        let term = solved.terms[k - first];
                        found.terms.push(FoundTerm { place, term, magnitude: value, standard_deviation });
                    }
                },
                _ => {}
            }
        }
        for one in joint_errors.iter().flat_map(|one| &one.numbers) {
            let term = Term { place: ErrorSite::of_number(one.number), basis: Basis::One };
            let (magnitude, standard_deviation) = (one.value, one.standard_deviation);
            found.numbers.push(FoundTerm { place: one.place, term, magnitude, standard_deviation });
        }
        found.fitted = fitted(spec, data);
        let count = kept.len();
        let of_fit = || (0..count).map(|i| (0..count).map(|j| fit.covariance[(i, j)]).collect()).collect();
        found.covariance = joint_errors.map_or_else(of_fit, |one| one.covariance.clone());
        let unit = spec.length.symbol();
        found.reference = format!(
            "Identified from {} rows{} of {} by abbe {}: rms {} {unit} left, {} {unit} on rows left out in turn",
            data.observations.len(),
            match Configurations::new(&data.observations).count {
                count if count == data.observations.len() => String::new(),
                count => format!(" ({count} configurations)"),
            },
            printable_name(&data.file),
            env!("CARGO_PKG_VERSION"),
            digits(left[0], 4),
            digits(left[1], 4),
        );
        found
    }
}

/// The name of a file, as it can stand in a comment and in a string of TOML.
fn printable_name(file: &str) -> String {
    let name = std::path::Path::new(file).file_name().unwrap_or_default().to_string_lossy();
    let plain = |c: &char| matches!(c, '"' | '\\' | '\'') || c.escape_debug().count() == 1;
    name.chars().map(|c| if plain(&c) { c } else { char::REPLACEMENT_CHARACTER }).collect()
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
