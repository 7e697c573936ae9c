//! Results in sentences: tolerance, compensation, first-order error.
//!
//! The certified upper bound of the worst case.

use abbe::analysis::Measurand;
use abbe_spec::Spec;
use abbe_study::analyze::{
    AfterCompensation, LoopCondition, NEARLY_SINGULAR, NOT_CERTIFIED, RemainingErrors, Report,
};
use abbe_study::number::{self, percent, short};

use crate::unit::{self, decimals, position};
use crate::views::shared::dead_point;

/// Returns the results in sentences: tolerance, compensation, first-order
/// error.
pub(super) fn conclusions(report: &Report) -> Vec<String> {
    let sentences = [
        allowance(report, Measurand::Position),
        allowance(report, Measurand::Orientation),
        ellipsoid(report),
        published_residual(report),
        report.compensation.as_ref().map(|compensation| residual(report, compensation)),
        certified_norms(report),
        Some(first_order(report)),
        report.loops.as_ref().map(|loops| {
            format!("Loops: {}; {}.", loop_condition(loops), nearest_dead_point(loops, &report.spec))
        }),
    ];
    sentences.into_iter().flatten().collect()
}

/// States how well the loops determine the passive variables.
pub(super) fn loop_condition(loops: &LoopCondition) -> String {
    let LoopCondition { configurations, largest, at, .. } = loops;
    let largest = number::digits(*largest, 3);
    match loops.is_nearly_singular() {
        true => format!(
            "nearly singular at {at}: the condition number of φ_p is {largest}, above {NEARLY_SINGULAR}; \
             errors in the loops are magnified there"
        ),
        false => format!(
            "the condition number of φ_p is at most {largest}, at {at}, of {configurations} configurations"
        ),
    }
}

/// States how near the loops come to a dead point.
pub(super) fn nearest_dead_point(loops: &LoopCondition, spec: &Spec) -> String {
    format!(
        "nearest dead point: {}; smallest singular value of φ_p {} at {}",
        dead_point(loops.dead_point.as_ref(), spec),
        number::digits(loops.smallest_singular, 3),
        loops.smallest_at
    )
}

/// Returns what first order is compared with.
pub(super) fn exact(report: &Report) -> &'static str {
    match (report.spec.is_serial(), report.spec.loops.is_empty()) {
        (true, _) => "the exact chain",
        (_, true) => "the exact tree of frames",
        _ => "the exact machine with closed loops",
    }
}

/// Formats an upper bound as `at most 0.0123 mm`, or `less than 0.001 mm` if the value is below
/// the last printed digit.
fn upper_bound(report: &Report, value: f64) -> String {
    let factor = unit::display_unit(report, Measurand::Position).0;
    let smallest = 10f64.powi(-(decimals(report) as i32)) / factor;
    match value < smallest / 2.0 {
        true => format!("less than {}", position(report, smallest)),
        false => format!("at most {}", position(report, value)),
    }
}

fn share_of_tolerance(report: &Report, value: f64) -> String {
    let share = report.study.tolerance.map(|tolerance| percent(value, tolerance));
    share.map(|share| format!(", {share} of the tolerance")).unwrap_or_default()
}

fn allowance(report: &Report, measurand: Measurand) -> Option<String> {
    let together = match measurand {
        Measurand::Position => report.factor_for_all,
        Measurand::Orientation => report.orientation.factor_for_all,
    }?;
    Some(format!(
        "With all sources × {}, the judged error as built equals the tolerance of {}.",
        number::rounded_down(together, number::decimals(together, 3)),
        unit::with_symbol(report, measurand, report.tolerance(measurand)?),
    ))
}

fn ellipsoid(report: &Report) -> Option<String> {
    let ellipsoid = &report.budget.combined.ellipsoid;
    ellipsoid.configuration?;
    let (factor, unit) = unit::display_unit(report, Measurand::Position);
    let [a, b, c] = ellipsoid.semi_axes.map(|value| number::trimmed(factor * value, decimals(report)));
    let lie = "Random errors, if normal, lie with 95 % probability";
    Some(match ellipsoid.rank() {
        1 => format!("{lie} within ± {a} {unit} on a line, at the configuration where it is longest."),
        2 => format!(
            "{lie} in an ellipse with semi-axes {a}, {b} {unit}, at the configuration where it is \
         longest."
        ),
        _ => format!(
            "{lie} in an ellipsoid with semi-axes {a}, {b}, {c} {unit}, at the configuration where it \
         is longest."
        ),
    })
}

fn published_residual(report: &Report) -> Option<String> {
    let AfterCompensation { residual, random, total, published } = report.after_compensation.as_ref()?;
    let (residual, random, total) = (*residual, *random, *total);
    Some(format!(
        "After compensation: {} repeatable residual + {} random = {}{}; {} prints {} + {} = {} ({}).",
        position(report, residual),
        position(report, random),
        position(report, total),
        share_of_tolerance(report, total),
        report.publisher(),
        short(published.residual),
        short(published.random),
        position(report, published.total),
        published.reference,
    ))
}

fn residual(report: &Report, compensation: &RemainingErrors) -> String {
    format!(
        "With the compensation of the study, at most {} of the repeatable errors remain, and {} with \
         the random errors{} (residuals as root sum of squares, errors that are not compensated \
         with their signs).",
        position(report, compensation.residual),
        position(report, compensation.total),
        share_of_tolerance(report, compensation.total),
    )
}

fn first_order(report: &Report) -> String {
    let first_order = &report.first_order;
    let any = |repeatable: bool| {
        report.budget.sources.iter().any(|alone| (alone.class == abbe::Class::Repeatable) == repeatable)
    };
    let which = match (any(true), any(false)) {
        (_, false) => "the repeatable sources",
        (false, _) => "the random sources at their bounds",
        _ => "all sources, the random ones at their bounds,",
    };
    let spread = if first_order.checked < report.configurations { ", evenly spaced" } else { "" };
    let (differs, by) = match first_order.largest {
        0.0 => ("does not differ", String::new()),
        largest => ("differs", format!(" by {}", upper_bound(report, largest))),
    };
    format!(
        "First order: J_e ε of {which} {differs} from {}{by}, at {} configurations{spread}.",
        if report.spec.is_serial() { "the exact chain A_1 E_1 … A_n E_n T" } else { exact(report) },
        first_order.checked,
    )
}

/// States at how many configurations Euler angles are singular.
pub(super) fn singular_sentence(report: &Report) -> String {
    format!(
        "Euler angles are singular at {} of {} configurations: those count for the position, not \
         for the orientation.",
        report.singular(),
        report.configurations,
    )
}

/// Returns a sentence with the certified bound; `None` if nothing is certified of a chain.
fn certified_norms(report: &Report) -> Option<String> {
    if !report.spec.is_serial() {
        return Some(format!("Certified: nothing; {NOT_CERTIFIED}."));
    }
    let norms = report.certified.as_ref()?;
    let (factor, unit) = unit::display_unit(report, Measurand::Position);
    let most = number::rounded_up(factor * norms.all_sources()?.certified?, decimals(report));
    let domain = match norms.contains_more {
        true => "the enclosing joint box, which is larger than the workspace,",
        false => "the whole box of the workspace",
    };
    Some(format!(
        "Certified, to first order: over {domain} the worst case over all signs is at most {most} {unit}."
    ))
}
