//! The description of a manipulator, a constant in generated code.

use abbe_core::{Branch, Description, Effect, Frame, Input, Parameter, Source, Variable};
use abbe_spec::Spec;

use crate::chain::lower_pairs;

/// Returns the description of a spec with the effects of its enabled sources and the number of
/// solutions of inverse kinematics.
pub(super) fn description(
    spec: &Spec,
    effects: impl IntoIterator<Item = Effect>,
    solutions: usize,
) -> Description {
    let frames = spec.frames.iter().zip(lower_pairs(spec)).enumerate();
    let variables = spec.variables.iter();
    let parameters = spec.parameters.iter();
    let inputs = spec.inputs.iter();
    Description {
        name: spec.name.as_str().into(),
        title: spec.title.as_str().into(),
        length: spec.length,
        orientation: spec.orientation,
        frames: frames
            .map(|(index, (frame, lower_pair))| Frame {
                name: frame.name.as_str().into(),
                variable: frame.variable,
                lower_pair: lower_pair && spec.is_serial(),
                branch: (!spec.is_serial()).then(|| Branch {
                    parent: frame.parent,
                    passive: frame.passive.map(|passive| variable(&spec.passive[passive])),
                    carries_tool: index == spec.tool_frame,
                }),
            })
            .collect(),
        variables: variables.map(variable).collect(),
        sum_limits: spec.sum_limits.iter().cloned().collect(),
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
                levels: input.levels.iter().copied().collect(),
                unit: input.unit.as_str().into(),
            })
            .collect(),
        sources: spec
            .enabled_sources()
            .map(|source| Source {
                name: source.name.as_str().into(),
                class: source.class,
                degrees_of_freedom: source.degrees_of_freedom,
                at: spec.place(source).as_str().into(),
                reference: source.reference.as_str().into(),
            })
            .collect(),
        effects: effects.into_iter().collect(),
        solutions,
    }
}

fn variable(variable: &abbe_spec::Variable) -> Variable {
    let abbe_spec::Variable { name, kind, limits, home, .. } = variable;
    Variable { name: name.as_str().into(), kind: *kind, limits: *limits, home: *home }
}
