//! The description that generated code has as a constant, made from the spec.

use abbe::{
    Class, Component, Description, Distribution, Effect, Frame, Input, LengthUnit, Orientation, Parameter,
    Source, Variable, VariableKind,
};
use abbe_codegen::chain::Model;
use abbe_codegen::expr;
use abbe_codegen::spec::{self, Spec};

/// What a [`Description`] borrows.
#[derive(Clone, Debug)]
pub(crate) struct Described<'s> {
    spec: &'s Spec,
    frames: Vec<Frame<'s>>,
    variables: Vec<Variable<'s>>,
    parameters: Vec<Parameter<'s>>,
    inputs: Vec<Input<'s>>,
    sources: Vec<Source<'s>>,
    effects: Vec<Effect>,
}

impl<'s> Described<'s> {
    pub(crate) fn new(spec: &'s Spec, model: &Model) -> Self {
        let effects = model
            .effects
            .iter()
            .map(|effect| Effect::new(effect.source, effect.frame, component(effect.component)));
        Self {
            spec,
            frames: spec.frames.iter().map(|frame| Frame::new(&frame.name, frame.variable)).collect(),
            variables: spec
                .variables
                .iter()
                .map(|variable| {
                    Variable::new(&variable.name, kind(variable.kind), variable.limits, variable.home)
                })
                .collect(),
            parameters: spec.parameters.iter().map(|p| Parameter::new(&p.name, p.value, &p.unit)).collect(),
            inputs: spec
                .inputs
                .iter()
                .map(|input| Input::new(&input.name, input.value, input.range, &input.unit))
                .collect(),
            sources: spec
                .enabled_sources()
                .map(|source| Source::new(&source.name, class(source.class), &source.reference))
                .collect(),
            effects: effects.collect(),
        }
    }

    pub(crate) fn description(&self) -> Description<'_> {
        Description {
            name: &self.spec.name,
            title: &self.spec.title,
            length: match self.spec.length {
                expr::LengthUnit::Metre => LengthUnit::Metre,
                expr::LengthUnit::Millimetre => LengthUnit::Millimetre,
            },
            orientation: match self.spec.orientation {
                spec::Orientation::RotationVector => Orientation::RotationVector,
                spec::Orientation::EulerYzx => Orientation::EulerYzx,
            },
            frames: &self.frames,
            variables: &self.variables,
            parameters: &self.parameters,
            inputs: &self.inputs,
            sources: &self.sources,
            effects: &self.effects,
        }
    }
}

fn kind(kind: spec::VariableKind) -> VariableKind {
    match kind {
        spec::VariableKind::Revolute => VariableKind::Revolute,
        spec::VariableKind::Prismatic => VariableKind::Prismatic,
    }
}

fn class(class: spec::Class) -> Class {
    match class {
        spec::Class::Repeatable => Class::Repeatable,
        spec::Class::Random(spec::Distribution::Uniform) => Class::Random(Distribution::Uniform),
        spec::Class::Random(spec::Distribution::Normal) => Class::Random(Distribution::Normal),
    }
}

fn component(component: spec::Component) -> Component {
    Component::ALL[component as usize]
}
