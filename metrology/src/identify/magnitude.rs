//! Sources of the spec with an unknown magnitude.
//!
//! The model contains such a source as declared, `m₀` times its expression, and a copy of the
//! expression. The factor of the copy is the unknown x, the difference between the actual magnitude
//! and `m₀`. The standard deviation in the spec is the prior of x about 0.

use abbe::Class;
use abbe_spec::{Magnitude, Source, Spec};

/// Source of the spec with an unknown magnitude.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMagnitude {
    /// Index among all sources of the spec.
    pub(super) source: usize,
    /// Magnitude declared in the spec.
    pub(crate) declared: Magnitude,
}

/// Returns the enabled repeatable sources with a declared magnitude, in the order of the spec.
pub(crate) fn own_magnitudes(spec: &Spec) -> Vec<OwnMagnitude> {
    let sources = spec.sources.iter().enumerate();
    let known = sources.filter(|(_, source)| source.enabled && source.class == Class::Repeatable);
    known.filter_map(|(i, source)| Some(OwnMagnitude { source: i, declared: source.magnitude? })).collect()
}

impl OwnMagnitude {
    /// Returns the source with magnitude 1.
    pub(super) fn unit(self, spec: &Spec) -> Source {
        Source { magnitude: None, ..spec.sources[self.source].clone() }
    }
}
