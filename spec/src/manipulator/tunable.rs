//! Magnitudes of sources that are given at run time.

use std::collections::{HashMap, HashSet};

use abbe_core::Class;

use super::declared::Input;
use super::names::as_identifier;
use super::source::Source;
use super::spec::Spec;
use crate::expr::Dimension;

/// How the name of an input begins that is the magnitude of a source.
pub const MAGNITUDE: &str = "magnitude_";

impl Spec {
    /// The same with one input more for each enabled repeatable source, in their order: what the source is multiplied by. It is
    /// mostly the magnitude that the source has, or 1; its name is [`MAGNITUDE`] and what identifier the source's name becomes,
    /// with a number behind it if that is taken.
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
                value: source.magnitude.map_or(1.0, |magnitude| magnitude.value),
                dimension: Dimension::NONE,
                unit: String::new(),
                range: [f64::NEG_INFINITY, f64::INFINITY],
                description: format!("{}: what this source is multiplied by", source.name),
            });
        }
        spec
    }
}
