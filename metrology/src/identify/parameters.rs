//! Values of the identified unknowns, for the report.

use abbe::identify::{Camera, Fit, Identifiable, Model, Unknown};
use abbe_spec::Spec;

use super::magnitude::OwnMagnitude;
use super::report::{Kind, Magnitude, Pair, Parameter, Redundant};
use super::setup::Setup;
use super::solve::Solved;
use abbe_study::IsoAxis;

/// Returns the identified magnitudes of the sources of the spec.
pub(super) fn magnitudes(spec: &Spec, solved: &Solved) -> Vec<Magnitude> {
    let Solved { model, fit, own, .. } = solved;
    let deviations = fit.standard_deviations();
    let one = |own: &OwnMagnitude| {
        let of_this = |k: &usize| solved.own_magnitude(*k).is_some_and(|one| one.source == own.source);
        let k = (0..model.unknowns.len()).find(of_this);
        let (source, declared) = (spec.sources[own.source].name.clone(), own.declared.value);
        let declared_deviation = own.declared.standard_deviation;
        let standard_deviation = k.and_then(|k| deviations[k]);
        let value = declared + k.map_or(0.0, |k| fit.x[k]);
        let stands_for = k.map_or(Vec::new(), |k| solved.held_magnitudes(spec, k));
        let prior_dominated = k.is_some_and(|k| fit.weakly_determined().contains(&k));
        Magnitude {
            source,
            declared,
            declared_deviation,
            value,
            standard_deviation,
            stands_for,
            prior_dominated,
        }
    };
    own.iter().map(one).collect()
}

/// Returns the values of the kept unknowns with their standard deviations.
pub(super) fn parameters(setup: &Setup, solved: &Solved, spec: &Spec) -> Vec<Parameter> {
    let Solved { model, fit, .. } = solved;
    let (deviations, hardly) = (fit.standard_deviations(), fit.weakly_determined());
    let axes = IsoAxis::all(spec, setup.ideal.manipulator);
    let parameter = |k: &usize| {
        let unknown = model.unknowns[*k];
        let frame = match unknown {
            Unknown::Base(..) => Some(0),
            Unknown::Error(frame, _) => Some(frame + 1),
            _ => None,
        };
        let frame_name =
            |frame: usize| frame.checked_sub(1).map_or("base", |i| &setup.description.frames[i].name);
        let kind = match unknown {
            Unknown::Base(..) => Kind::Station,
            unknown if unknown.is_placement() => Kind::Placement,
            _ => Kind::Machine,
        };
        Parameter {
            kind,
            name: model.name(unknown),
            frame,
            iso: match unknown {
                Unknown::Error(frame, component) => IsoAxis::name_of(&axes, frame + 1, component),
                _ => None,
            },
            frame_name: frame.map(|frame| frame_name(frame).to_owned()),
            value: fit.x[*k] + solved.own_magnitude(*k).map_or(0.0, |own| own.declared.value) + 0.0,
            standard_deviation: deviations[*k].unwrap_or_default(),
            unit: match unknown {
                Unknown::Intrinsic(parameter) if Camera::is_pixel(parameter) => "px",
                Unknown::Magnitude(_) | Unknown::Intrinsic(_) => "",
                unknown if model.is_angle(unknown) => "rad",
                _ => spec.length.symbol(),
            },
            prior_dominated: hardly.contains(k),
        }
    };
    fit.identifiable.kept.iter().map(parameter).collect()
}

/// Returns the unknowns that are fixed at zero because they are equivalent to kept ones.
pub(super) fn redundant(model: &Model, identifiable: &Identifiable) -> Vec<Redundant> {
    let name = |k: &usize| model.name(model.unknowns[*k]);
    let one = |(k, acts_as): &(usize, Vec<(usize, f64)>)| Redundant {
        name: name(k),
        acts_as: acts_as.iter().map(|(j, factor)| (name(j), *factor)).collect(),
    };
    identifiable.redundant.iter().map(one).collect()
}

/// Returns the pairs of parameters with an absolute correlation above 0.9.
pub(super) fn correlated(model: &Model, fit: &Fit) -> Vec<Pair> {
    let name = |k: usize| model.name(model.unknowns[k]);
    let pairs = fit.correlations(0.9).into_iter();
    pairs.map(|(a, b, correlation)| Pair { of: [name(a), name(b)], correlation }).collect()
}
