//! The description of a spec: what generated code has as a constant.

use abbe::{Description, Effect, Frame, Input, Parameter, Source, Variable};

use super::Spec;

impl Spec {
    /// What a manipulator of this spec says about itself, with these effects of its enabled sources.
    pub fn describe(&self, effects: impl IntoIterator<Item = Effect>) -> Description {
        let frames = self.frames.iter();
        let variables = self.variables.iter();
        let parameters = self.parameters.iter();
        let inputs = self.inputs.iter();
        Description {
            name: self.name.as_str().into(),
            title: self.title.as_str().into(),
            length: self.length,
            orientation: self.orientation,
            frames: frames
                .map(|frame| Frame { name: frame.name.as_str().into(), variable: frame.variable })
                .collect(),
            variables: variables
                .map(|variable| Variable {
                    name: variable.name.as_str().into(),
                    kind: variable.kind,
                    limits: variable.limits,
                    home: variable.home,
                })
                .collect(),
            parameters: parameters
                .map(|parameter| Parameter {
                    name: parameter.name.as_str().into(),
                    nominal: parameter.value,
                    unit: parameter.unit.as_str().into(),
                })
                .collect(),
            inputs: inputs
                .map(|input| Input {
                    name: input.name.as_str().into(),
                    nominal: input.value,
                    range: input.range,
                    unit: input.unit.as_str().into(),
                })
                .collect(),
            sources: self
                .enabled_sources()
                .map(|source| Source {
                    name: source.name.as_str().into(),
                    class: source.class,
                    reference: source.reference.as_str().into(),
                })
                .collect(),
            effects: effects.into_iter().collect(),
        }
    }
}
