//! Sources of the spec whose magnitude is to be found.
//!
//! Such a source is there as the spec has it, `m₀` times its expression; beside it stands the expression once more, and
//! the unknown x that this is multiplied with is what the magnitude is more than `m₀`. The spec's standard deviation is the
//! prior of x about 0.

use abbe::Class;
use abbe_spec::{Magnitude, Source, Spec};

/// A source of the spec whose magnitude is to be found.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnMagnitude {
    /// Which one, among all sources of the spec.
    pub(super) source: usize,
    /// What the spec says of its magnitude.
    pub(super) declared: Magnitude,
}

/// Those of a spec that take part, in its order.
pub(super) fn own_magnitudes(spec: &Spec) -> Vec<OwnMagnitude> {
    let sources = spec.sources.iter().enumerate();
    let known = sources.filter(|(_, source)| source.enabled && source.class == Class::Repeatable);
    known.filter_map(|(i, source)| Some(OwnMagnitude { source: i, declared: source.magnitude? })).collect()
}

impl OwnMagnitude {
    /// The source with magnitude 1.
    pub(super) fn unit(self, spec: &Spec) -> Source {
        Source { magnitude: None, ..spec.sources[self.source].clone() }
    }
}
