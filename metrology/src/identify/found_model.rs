//! Identified machine as values to be added to its spec.

use abbe::Component;
use abbe::analysis::sampling::range_of;
use abbe::identify::{Configurations, Unknown};
use abbe_spec::{Fitted, Spec, expr::Symbol, visible::alters_text};

use super::found_covariance::FoundCovariance;
use super::{
    AsJointErrors, Basis, Derived, ErrorSite, FoundPlacement, InstrumentFit, JointError, JointProfile,
    Solved, Term,
};
use crate::data::Data;
use abbe_study::{number::digits, version};

/// Identified model of a machine: constant errors, and terms with their magnitudes.
#[derive(Clone, Debug, Default)]
pub struct FoundModel {
    /// Origin of the model and accuracy of the fit, in one sentence.
    pub reference: String,
    /// Placement of the machine and of what is mounted on its tool. It is not part of the spec.
    pub placed: FoundPlacement,
    /// Is true if no error of the machine was fitted: its spec remains as it is.
    pub is_placement: bool,
    /// Constant errors of every frame.
    pub frames: Vec<Vec<FoundError>>,
    /// Numbers of the chain with an error: their terms are constant.
    pub numbers: Vec<FoundTerm>,
    /// Magnitudes of sources of the spec.
    pub magnitudes: Vec<FoundMagnitude>,
    /// Richer terms.
    pub terms: Vec<FoundTerm>,
    /// Profiles of joints.
    pub(super) profiles: Vec<JointProfile>,
    /// Derived inputs; terms index them after those of the spec.
    pub derived: Vec<Derived>,
    /// Covariance of the errors of the machine.
    pub(super) covariance: FoundCovariance,
    /// Significant errors as numbers of the chain, with their alternatives.
    pub(super) joint_errors: Vec<JointError>,
    /// Standard deviation along each axis of the position errors that the model does not explain,
    /// in the length unit; 0 if it explains all.
    pub unexplained: f64,
    /// Is true if random sources of the spec explain what the instrument does not.
    pub is_random: bool,
    /// Ranges of joints and inputs covered by the fitted rows.
    pub fitted: Vec<Fitted>,
    /// Uncertainties that were estimated from the data.
    pub(super) estimated: Vec<InstrumentFit>,
}

/// Constant generalized error.
#[derive(Clone, Copy, Debug)]
pub struct FoundError {
    /// Component of the generalized error.
    pub component: Component,
    /// Value, in the length unit or rad.
    pub value: f64,
    /// Standard deviation, in the same unit.
    pub standard_deviation: f64,
}

/// Term with its magnitude.
#[derive(Clone, Copy, Debug)]
pub struct FoundTerm {
    /// Index among the kept unknowns.
    pub row: usize,
    /// Term of magnitude 1.
    pub term: Term,
    /// Identified magnitude.
    pub magnitude: f64,
    /// Standard deviation of the magnitude.
    pub standard_deviation: f64,
}

/// Identified magnitude of a source of the spec.
#[derive(Clone, Copy, Debug)]
pub struct FoundMagnitude {
    /// Index among the kept unknowns; none if another one stands for it.
    pub row: Option<usize>,
    /// Index among all sources of the spec.
    pub source: usize,
    /// Factor of the source.
    pub magnitude: f64,
    /// Standard deviation of the magnitude.
    pub standard_deviation: f64,
}

impl FoundModel {
    /// Collects the values of a fit, as numbers of the chain where `joint_errors` has them. `left`
    /// is the root mean square position error of the fitted rows and of the cross-validation, in
    /// the length unit.
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
        let as_found = |(row, k): (usize, &usize)| (row, fit.x[*k], deviations[*k].unwrap_or_default());
        let values: Vec<(usize, f64, f64)> = joint_errors
            .map_or_else(|| kept.iter().enumerate().map(as_found).collect(), |one| one.others.clone());
        let placed = FoundPlacement::new(model, fit, &data.observations, pose);
        let mut found = Self { placed, frames: vec![Vec::new(); spec.frames.len()], ..Self::default() };
        let first = model.unknowns.len() - solved.terms.len();
        for (row, value, standard_deviation) in values {
            let error = |component| FoundError { component, value, standard_deviation };
            let k = kept[row];
            match model.unknowns[k] {
                Unknown::Error(frame, component) => found.frames[frame].push(error(component)),
                Unknown::Magnitude(_) if k >= first => {
                    let term = solved.terms[k - first];
                    found.terms.push(FoundTerm { row, term, magnitude: value, standard_deviation });
                }
                _ => {}
            }
        }
        let own = solved.own.iter().enumerate().take(first);
        found.magnitudes.extend(own.filter_map(|(k, own)| {
            let (magnitude, standard_deviation) = solved.magnitude(k)?;
            let row = kept.iter().position(|one| *one == k);
            Some(FoundMagnitude { row, source: own.source, magnitude, standard_deviation })
        }));
        for one in joint_errors.iter().flat_map(|one| &one.numbers) {
            let term = Term { site: ErrorSite::from_chain_number(one.number), basis: Basis::One };
            let (magnitude, standard_deviation) = (one.value, one.standard_deviation);
            found.numbers.push(FoundTerm { row: one.index, term, magnitude, standard_deviation });
        }
        found.fitted = fitted(spec, data);
        found.profiles = solved.profiles.iter().flat_map(|profiles| profiles.joints.clone()).collect();
        let unit = spec.length.symbol();
        found.reference = format!(
            "Identified from {} rows{} of {} by abbe {}: rms {} {unit} on these rows, {} {unit} \
             in cross-validation",
            data.observations.len(),
            match Configurations::new(&data.observations).count {
                count if count == data.observations.len() => String::new(),
                count => format!(" ({count} configurations)"),
            },
            printable_name(&data.file),
            version(),
            digits(left[0], 4),
            digits(left[1], 4),
        );
        found
    }
}

/// Returns the name of a file, with every character replaced that cannot stand in a TOML comment or
/// string.
fn printable_name(file: &str) -> String {
    let name = std::path::Path::new(file).file_name().unwrap_or_default().to_string_lossy();
    name.replace(alters_text, "\u{fffd}")
}

/// Returns the ranges of joints and inputs that the rows cover.
fn fitted(spec: &Spec, data: &Data) -> Vec<Fitted> {
    let symbols = (0..spec.variables.len()).map(Symbol::Variable);
    let symbols = symbols.chain((0..spec.inputs.len()).map(Symbol::Input));
    let range = |symbol| {
        let values = data.observations.iter().map(|row| match symbol {
            Symbol::Input(i) => row.u[i],
            Symbol::Variable(i) => row.q[i],
            _ => 0.0,
        });
        range_of(values)
    };
    symbols.map(|symbol| Fitted { symbol, range: range(symbol) }).collect()
}
