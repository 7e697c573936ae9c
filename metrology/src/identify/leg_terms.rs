//! Zeros of legs, which no constant errors of frames are equal to.

use abbe_codegen::graph::Graph;
use abbe_spec::{ChainNumber, Deviation, Source, Spec};

use super::chain_numbers::constant_errors;
use super::terms::{Basis, ErrorSite, Term};

/// Returns the zero of each joint that moves frames differently from configuration to
/// configuration, such as the length of a leg, unless a source of unknown magnitude has it. They
/// are always fitted. Those of other joints are among the errors of the frames.
pub(super) fn leg_terms(spec: &Spec) -> Vec<Term> {
    if spec.loops.is_empty() {
        return Vec::new();
    }
    let mut graph = Graph::with_tables(&spec.tables);
    let is_declared = |number: ChainNumber| {
        let deviates = |deviation: &Deviation| deviation.number == number;
        let has = |source: &Source| source.magnitude.is_some() && source.deviations.iter().any(deviates);
        spec.sources.iter().any(|source| source.enabled && has(source))
    };
    let mut is_free = |joint: &usize| {
        let number = ChainNumber::Joint(*joint);
        !is_declared(number) && constant_errors(&mut graph, spec, number).is_none()
    };
    let joints: Vec<usize> = (0..spec.variables.len()).filter(&mut is_free).collect();
    joints.into_iter().map(|joint| Term { site: ErrorSite::Joint(joint), basis: Basis::One }).collect()
}
