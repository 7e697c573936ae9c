//! Magnitudes of sources as inputs at run time.

use std::collections::{HashMap, HashSet};

use abbe_core::Class;

use super::declared::Input;
use super::names::as_identifier;
use super::source::Source;
use super::spec::Spec;
use crate::expr::Dimension;

/// Prefix of the input that is the magnitude of a source.
pub const MAGNITUDE: &str = "magnitude_";

impl Spec {
    /// Adds an input for each enabled repeatable source, in their order, which multiplies the
    /// errors of the source. Its default is the source's factor. Its name is [`MAGNITUDE`]
    /// followed by the source's name as an identifier, and a number if that is taken.
    #[must_use]
    pub fn with_magnitudes_as_inputs(&self) -> Self {
        let mut spec = self.clone();
        let names = spec.variables.iter().map(|variable| &variable.name);
        let names = names.chain(spec.parameters.iter().map(|parameter| &parameter.name));
        let names = names.chain(spec.inputs.iter().map(|input| &input.name));
        let mut taken: HashSet<String> = names.cloned().collect();
        let mut numbers: HashMap<String, usize> = HashMap::new();
        let tunable = |source: &Source| source.enabled && source.class == Class::Repeatable;
        for source in spec.sources.iter_mut().filter(|source| tunable(source)) {
            let plain = format!("{MAGNITUDE}{}", as_identifier(&source.name));
            let mut name = plain.clone();
            while !taken.insert(name.clone()) {
                let number = numbers.entry(plain.clone()).or_insert(1);
                *number += 1;
                name = format!("{plain}_{number}");
            }
            source.tuned_by = Some(spec.inputs.len());
            spec.inputs.push(Input {
                name,
                value: source.factor(),
                dimension: Dimension::NONE,
                unit: String::new(),
                range: [f64::NEG_INFINITY, f64::INFINITY],
                levels: Vec::new(),
                uncertainty: 0.0,
                description: format!("{}: factor of this source", source.name),
            });
        }
        spec
    }
}
