//! The description of a spec: what generated code has as a constant.

use indexmap::IndexSet;

use abbe_core::{Description, Effect, Frame, Input, Parameter, Source, Variable};

use super::{ChainNumber, Spec};

impl Spec {
    /// What a source is an error of: `joint q2`, `parameter a2`, `dh of elbow`, `frame elbow`, or several of these.
    pub fn place(&self, source: &super::Source) -> String {
        let frame = |frame: usize| self.frames[frame].name.clone();
        let of_chain = |deviation: &super::Deviation| match deviation.number {
            ChainNumber::Joint(joint) => ("joint", self.variables[joint].name.clone()),
            ChainNumber::Parameter(parameter) => ("parameter", self.parameters[parameter].name.clone()),
            ChainNumber::DenavitHartenberg { frame: of, .. } => ("dh of", frame(of)),
        };
        let frames = source.effects.iter().map(|effect| ("frame", frame(effect.frame)));
        let places: IndexSet<(&str, String)> = source.deviations.iter().map(of_chain).chain(frames).collect();
        let kinds: IndexSet<&str> = places.iter().map(|(kind, _)| *kind).collect();
        let listed = kinds.into_iter().map(|kind| {
            let names: Vec<&str> =
                places.iter().filter(|place| place.0 == kind).map(|place| place.1.as_str()).collect();
            match (&names[..], kind) {
                ([name], _) => format!("{kind} {name}"),
                ([first, second], "dh of") => format!("dh of {first}, {second}"),
                ([first, second], _) => format!("{kind}s {first}, {second}"),
                (_, "dh of") => format!("dh of {} frames", names.len()),
                _ => format!("{} {kind}s", names.len()),
            }
        });
        listed.collect::<Vec<_>>().join(", ")
    }

    /// What a manipulator of this spec says about itself, with these effects of its enabled sources.
    pub fn describe(&self, effects: impl IntoIterator<Item = Effect>) -> Description {
        let frames = self.frames.iter().zip(self.lower_pairs());
        let variables = self.variables.iter();
        let parameters = self.parameters.iter();
        let inputs = self.inputs.iter();
        Description {
            name: self.name.as_str().into(),
            title: self.title.as_str().into(),
            length: self.length,
            orientation: self.orientation,
            frames: frames
                .map(|(frame, lower_pair)| Frame {
                    name: frame.name.as_str().into(),
                    variable: frame.variable,
                    lower_pair,
                })
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
                    degrees_of_freedom: source.degrees_of_freedom,
                    at: self.place(source).as_str().into(),
                    reference: source.reference.as_str().into(),
                })
                .collect(),
            effects: effects.into_iter().collect(),
        }
    }
}
