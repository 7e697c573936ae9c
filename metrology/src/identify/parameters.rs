//! Values of the identified unknowns, for the report.

use abbe::identify::{Camera, Fit, Identifiable, Model, Unknown};
use abbe_spec::Spec;

use super::extended::OwnMagnitude;
use super::{AsJointErrors, Kind, Magnitude, MagnitudeSum, Pair, Parameter, Redundant, Setup, Solved};
use abbe_study::{IsoAxis, number::digits};

/// Returns the identified magnitudes of the sources of the spec.
pub(super) fn magnitudes(spec: &Spec, solved: &Solved) -> Vec<Magnitude> {
    let Solved { model, fit, own, .. } = solved;
    let deviations = fit.standard_deviations();
    let one = |(k, own): (usize, &OwnMagnitude)| {
        let (source, declared) = (spec.sources[own.source].name.clone(), own.declared.value);
        let declared_deviation = own.declared.standard_deviation;
        let found = solved.magnitude(k);
        let standard_deviation = found.map(|(_, deviation)| deviation);
        let others = solved.held_magnitudes(k);
        let sum = deviations.get(k).copied().flatten().filter(|_| !others.is_empty()).map(|deviation| {
            let all = [(*own, 1.0)].into_iter().chain(others);
            let nominal = all.clone().map(|(one, factor)| factor * one.declared.value).sum::<f64>();
            let of = all.map(|(one, factor)| (spec.sources[one.source].name.clone(), factor)).collect();
            MagnitudeSum { of, value: nominal + fit.x[k], standard_deviation: deviation }
        });
        let is_vague = |prior: f64| standard_deviation.is_some_and(|deviation| deviation > 0.5 * prior);
        let prior_dominated = declared_deviation.is_some_and(is_vague);
        let value = found.map_or(declared, |(value, _)| value);
        Magnitude { source, declared, declared_deviation, value, standard_deviation, sum, prior_dominated }
    };
    // Those of a fit of places alone are no unknowns.
    let own = own.iter().enumerate().take(model.unknowns.len());
    own.map(one).collect()
}

/// Returns the numbers that were fitted, with the values that are written.
pub(super) fn parameters(
    setup: &Setup,
    solved: &Solved,
    spec: &Spec,
    written: Option<&AsJointErrors>,
) -> Vec<Parameter> {
    let Solved { model, fit, .. } = solved;
    let (deviations, hardly) = (fit.standard_deviations(), fit.weakly_determined());
    let axes = IsoAxis::all(spec, setup.ideal.manipulator);
    let parameter = |(row, k): (usize, &usize)| {
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
        let mut found = Parameter {
            kind,
            name: model.name(unknown),
            written: None,
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
        };
        let mut of_this = found.as_written();
        let number = written.and_then(|written| written.numbers.iter().find(|number| number.index == row));
        let other = written.and_then(|written| written.others.iter().find(|(other, ..)| *other == row));
        if let Some(number) = number {
            (of_this.name, of_this.unit) = (number.name.clone(), number.unit(spec));
            (of_this.value, of_this.standard_deviation) = (number.value, number.standard_deviation);
        } else if let Some((_, value, deviation)) = other {
            (of_this.value, of_this.standard_deviation) = (found.value - fit.x[*k] + value, *deviation);
        }
        for (other, factor) in solved.held_magnitudes(*k) {
            of_this.name += &format!(" {} {}", times(factor), spec.sources[other.source].name);
        }
        found.written = written.is_some().then_some(of_this);
        found
    };
    fit.identifiable.kept.iter().enumerate().map(parameter).collect()
}

/// Returns a factor in a sum: `+`, `−`, `+ 2 ×`.
fn times(factor: f64) -> String {
    let sign = if factor < 0.0 { '−' } else { '+' };
    match digits(factor.abs(), 3) {
        one if one == "1" => sign.to_string(),
        size => format!("{sign} {size} ×"),
    }
}

/// Returns the unknowns that others stand for.
pub(crate) fn redundant(model: &Model, identifiable: &Identifiable) -> Vec<Redundant> {
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
