//! Inputs and loads without effect.

use abbe_spec::expr::{Expression, Symbol};
use abbe_spec::{Cause, ChainNumber, Deviation, DeviationCause, Effect, Factor, Load, Point, Spec};

/// Returns a sentence for the inputs that nothing depends on, and one for the loads that nothing
/// yields to.
pub(super) fn notes(spec: &Spec) -> Vec<String> {
    let elements = || spec.sources.iter().flat_map(|source| &source.effects).filter(|e| e.cause.is_elastic());
    let joints = || spec.sources.iter().flat_map(|source| &source.deviations).filter(|d| d.is_elastic());
    let frame = |elastic: &Deviation| match elastic.number {
        ChainNumber::Joint(joint) => Some(spec.variables[joint].frame),
        _ => None,
    };
    let carried = |load: &Load| {
        let elastic = elements().map(|effect| effect.frame).chain(joints().filter_map(frame));
        elastic.into_iter().any(|frame| spec.tree().is_loaded(frame, load.frame))
    };
    let idle = spec.loads.iter().filter(|load| !carried(load)).count();
    let used: Vec<Symbol> = expressions(spec).into_iter().flat_map(Expression::symbols).collect();
    let unused = spec.inputs.iter().enumerate().filter(|(i, _)| !used.contains(&Symbol::Input(*i)));
    let unused: Vec<String> = unused.map(|(_, input)| format!("`{}`", input.name)).collect();
    let mut notes = Vec::new();
    match &unused[..] {
        [] => {}
        [one] => notes.push(format!("The input {one} is not used: no source or load depends on it.")),
        all => {
            notes.push(format!(
                "The inputs {} are not used: no source or load depends on them.",
                all.join(", ")
            ));
        }
    }
    if idle > 0 {
        let loads = if idle == 1 { "1 load has".to_owned() } else { format!("{idle} loads have") };
        notes.push(format!(
            "{loads} no effect: no elastic source at its frame or before it carries it. `identify` uses \
             loads for elastic terms."
        ));
    }
    notes
}

/// Returns the expressions of sources and loads.
fn expressions(spec: &Spec) -> Vec<&Expression> {
    let effects = spec.sources.iter().flat_map(|source| &source.effects).flat_map(effect_expressions);
    let deviations = spec.sources.iter().flat_map(|source| &source.deviations);
    let deviations = deviations.map(|deviation| match &deviation.cause {
        DeviationCause::Error(error) => error,
        DeviationCause::Stiffness(stiffness) => stiffness,
    });
    effects.chain(deviations).chain(spec.loads.iter().flat_map(load_expressions)).collect()
}

fn effect_expressions(effect: &Effect) -> Vec<&Expression> {
    let mut all: Vec<&Expression> = effect.at.iter().flat_map(Factor::expressions).collect();
    match &effect.cause {
        Cause::Errors(errors) => all.extend(errors.iter().map(|(_, error)| error)),
        Cause::Beam(beam) => {
            let optional = [&beam.torsion, &beam.extension, &beam.mass_per_length];
            all.extend([&beam.length].into_iter().chain(&beam.bending).chain(optional.into_iter().flatten()));
        }
        Cause::Compliance(compliance) => all.extend(compliance.iter().flatten().flatten()),
    }
    all
}

fn load_expressions(load: &Load) -> Vec<&Expression> {
    let vectors = [&load.force, &load.moment].into_iter().flatten().flatten();
    let point = match &load.point {
        Point::Here(point) => &point[..],
        Point::Tool => &[],
    };
    load.mass.iter().chain(vectors).chain(point).collect()
}
