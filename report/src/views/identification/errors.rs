//! Errors of the machine: estimates, equivalent errors of joints, and magnitudes of sources.
//!
//! Combinations of unknowns that cannot be distinguished, by the reason.

use abbe_metrology::identify::{
    Indistinguishable, IndistinguishableReason as Reason, JointError, Magnitude, Report,
};
use abbe_spec::option::PRIOR;
use abbe_study::number::{digits, fixed};

use super::answer::{estimate, of_machine, significance};
use crate::document::{Section, Table, joined};
use crate::unit::angle_in_mrad;

/// Number of alternatives in a sentence.
const SHOWN: usize = 3;

pub(super) fn machine(report: &Report) -> Section {
    let correlated = report.correlations.iter().take(8);
    let correlated =
        correlated.map(|pair| format!("{} with {} {}", pair.of[0], pair.of[1], fixed(pair.correlation, 3)));
    let more = match report.correlations.len().saturating_sub(8) {
        0 => String::new(),
        more => format!("; {more} more pairs"),
    };
    let correlated = (!report.correlations.is_empty())
        .then(|| format!("Correlated by more than 0.9: {}{more}.", joined(correlated)));
    let prior = report.parameters.iter().any(|parameter| parameter.prior_dominated).then(|| {
        format!("Prior-dominated: the prior says more about these errors than the data (`{PRIOR}`).")
    });
    let expected = report.prior.map(|share| {
        format!(
            "Before the data, errors are expected to have {} mm per metre of arm, or {0} mrad, as these data \
             or `{PRIOR}` say.",
            digits(1e3 * share, 2)
        )
    });
    let set_up = (report.found.placed.stations.len() < 2).then_some(
        "Changes of the machine between set-ups, such as with its temperature, are not included in the \
         standard deviations; rows of several stations show them.",
    );
    let joint_errors = report.joint_errors.iter().map(|error| joint_error(error, report));
    Section::full("Errors of the machine")
        .table(estimates(report))
        .list(
            "equivalent_errors",
            "Equivalent joint offsets and DH errors (in place of the error in brackets)",
            joint_errors.collect(),
        )
        .list(
            "magnitudes",
            "Estimated magnitudes of sources of the spec",
            report.magnitudes.iter().map(magnitude).collect(),
        )
        .state("expected", expected)
        .state("set_up", set_up.map(str::to_owned))
        .state("prior_dominated", prior)
        .state("poorly_determined", poorly_determined(report))
        .state("correlated", correlated)
}

/// Lists estimates with their standard deviations.
fn estimates(report: &Report) -> Table {
    let columns = ["error", "of", ">value", ">σ", "", ">value/σ", ""];
    Table::new("Others act as these in every configuration", columns).rows(of_machine(report).map(
        |parameter| {
            let written = parameter.as_written();
            let [value, deviation, unit] = estimate(report, &written);
            let significance = fixed(significance(&written).min(9999.0), 1);
            let name = match &parameter.iso {
                Some(iso) if written.name == parameter.name => format!("{} ({iso})", written.name),
                _ => written.name,
            };
            let remark = if parameter.prior_dominated { "prior-dominated" } else { "" };
            let frame = parameter.frame_name.clone().unwrap_or_default();
            [name, frame, value, deviation, unit, significance, remark.to_owned()]
        },
    ))
}

/// Lists errors that the data determine poorly.
fn poorly_determined(report: &Report) -> Option<String> {
    let all = report.weakly_determined.iter().map(|one| {
        let (factor, unit) = angle_in_mrad(one.unit);
        let [deviation, expected] =
            [one.standard_deviation, one.expected].map(|value| digits(value * factor, 2));
        format!("{} (± {deviation} {unit}, expected ± {expected} {unit})", one.name)
    });
    (!report.weakly_determined.is_empty()).then(|| {
        format!(
            "Poorly determined by these data, so that the expectation counts (`{PRIOR}`): {}. In brackets the \
             standard deviation from the data, which is more than half of the expected one. Other \
             configurations, a target farther from the axes or a better instrument determine them: \
             `abbe plan {}` predicts how well.",
            joined(all),
            report.name
        )
    })
}

/// States a joint error with its alternatives.
fn joint_error(error: &JointError, report: &Report) -> String {
    let JointError { in_place_of, number, value, standard_deviation, unit, alternatives } = error;
    let named = number_error(number, *value, *standard_deviation, unit);
    if alternatives.is_empty() {
        return format!("{named} ({in_place_of})");
    }
    let shown = alternatives.iter().take(SHOWN);
    let shown = shown.map(|one| number_error(&one.number, one.value, one.standard_deviation, one.unit));
    let shown: String = shown.map(|other| format!(", or {other}")).collect();
    let more = match alternatives.len().saturating_sub(SHOWN) {
        0 => String::new(),
        1 => ", or 1 other error".to_owned(),
        more => format!(", or one of {more} other errors"),
    };
    let on_axis = report.target_on_axis.iter();
    let reason: String = on_axis.map(|joint| format!(" (the target is on the axis of {joint})")).collect();
    format!("{named} ({in_place_of}){shown}{more}: these data cannot tell which{reason}")
}

/// States the error of a number, such as `a of elbow is 0.2 ± 0.01 mm less than nominal`.
fn number_error(name: &str, value: f64, standard_deviation: f64, unit: &'static str) -> String {
    let (factor, unit) = angle_in_mrad(unit);
    let size =
        format!("{} ± {} {unit}", digits(value.abs() * factor, 3), digits(standard_deviation * factor, 2));
    match (name.starts_with("zero of "), value < 0.0) {
        (true, true) => format!("the {name} is offset by -{size}"),
        (true, false) => format!("the {name} is offset by {size}"),
        (false, true) => format!("{name} is {size} less than nominal"),
        (false, false) => format!("{name} is {size} more than nominal"),
    }
}

/// States the magnitude of a source.
fn magnitude(found: &Magnitude) -> String {
    let Magnitude { source, declared, declared_deviation, value, standard_deviation, sum, .. } = found;
    let deviation = declared_deviation.map(|deviation| format!(" ± {}", digits(deviation, 2)));
    let before = digits(*declared, 3) + &deviation.unwrap_or_default();
    let Some(deviation) = standard_deviation.map(|deviation| digits(deviation, 2)) else {
        return format!("the magnitude of {source} has no effect of its own; in the spec: {before}");
    };
    let less =
        if found.prior_dominated { ", which these data determine less well than the spec" } else { "" };
    let of_sum = sum.as_ref().map(|sum| {
        let deviation = digits(sum.standard_deviation, 2);
        format!("; they determine {} = {} ± {deviation}", combination(&sum.of), digits(sum.value, 4))
    });
    format!(
        "the magnitude of {source} is {} ± {deviation}{less} (in the spec: {before}){}",
        digits(*value, 4),
        of_sum.unwrap_or_default()
    )
}

/// Tabulates unknowns that cannot be distinguished.
pub(in crate::views) fn indistinguishable(groups: &[Indistinguishable]) -> Table {
    let row = |groups: &[Indistinguishable]| {
        let sentences: Vec<String> = groups.iter().map(sentence).collect();
        [reason(&groups[0].reason), sentences.join("\n")]
    };
    let rows = groups.chunk_by(|one, next| one.reason == next.reason).map(row);
    Table::new("", ["because", "indistinguishable errors"]).rows(rows)
}

/// States the combination, such as `e_z1 acts as e_z2`.
fn sentence(group: &Indistinguishable) -> String {
    let these = combination(&group.these);
    match (&group.act_as[..], group.these.len()) {
        ([], _) => format!("{these} cannot be observed"),
        (others, 1) => format!("{these} acts as {}", combination(others)),
        (others, _) => format!("{these} act as {}", combination(others)),
    }
}

/// Formats a combination, such as `e_r2 − 425 e_y2`.
pub(in crate::views) fn combination(terms: &[(String, f64)]) -> String {
    let mut text = String::new();
    for (name, factor) in terms {
        let size = digits(factor.abs(), 4);
        let factor_text = if size == "1" { String::new() } else { format!("{size} ") };
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text += &format!("{sign}{factor_text}{name}");
    }
    text
}

/// States the reason.
fn reason(reason: &Reason) -> String {
    match reason {
        Reason::Revolute(joint) => format!(
            "{joint} is revolute: errors about and along its axis are indistinguishable from those of \
             the next frame"
        ),
        Reason::Prismatic(joint) => format!(
            "{joint} is prismatic: translations, and rotations about its axis, are indistinguishable \
             from those of the next frame"
        ),
        Reason::NotMoved(joint) => format!("{joint} does not move in these data"),
        Reason::Fixed { frame, name } => format!("the frame {frame} ({name}) is fixed"),
        Reason::UnknownMounting => "the mounting of the target on the tool is unknown".to_owned(),
        Reason::SingleTarget => "rotations about a single target do not move it".to_owned(),
        Reason::UnknownPlacement => "the placement of the instruments is unknown: motions of the whole \
                                     machine are indistinguishable from it"
            .to_owned(),
    }
}
