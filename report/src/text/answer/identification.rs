//! The answer of an identification: accuracy on held-out rows, most significant errors, and gaps.

use abbe_metrology::identify::{
    JointError, Kind, Parameter, Report, ResidualDrift, Sizes, TestExtrapolation,
};
use abbe_spec::Spec;
use abbe_study::number::{counted, digits, fixed};

use super::full::identification::residuals;
use super::{Answer, aligned, error_unit, first};

/// Number of errors shown one by one.
const SHOWN: usize = 5;

pub(in crate::text) fn identification(spec: &Spec, report: &Report) -> String {
    let mut answer = Answer::new(&format!("{}: {}", spec.title, headline(report)));
    answer.block(&sizes(report));
    answer.block(&errors(report));
    answer.facts(facts(spec, report));
    answer.0
}

/// The mean error on rows that were not used to fit.
fn headline(report: &Report) -> String {
    let (factor, unit) = error_unit(report.length);
    let mean = |sizes: &Sizes| format!("{} {unit}", fixed(factor * sizes.mean, 4));
    let what = if report.instruments.is_empty() { "error" } else { "residual" };
    let (after, before, rows) = match &report.test {
        Some(test) => (mean(&test.after), mean(&test.before), format!("{} test rows", test.rows)),
        None => (
            mean(&report.cross_validation.after),
            mean(&report.fit.before),
            format!("held-out rows ({}-fold cross-validation)", report.cross_validation.folds),
        ),
    };
    let accepted =
        report.accepted.as_ref().map(|accepted| if accepted.met { "ACCEPTED, " } else { "NOT ACCEPTED, " });
    format!("{}mean {what} {after} on {rows}, {before} as delivered", accepted.unwrap_or_default())
}

fn sizes(report: &Report) -> String {
    let (factor, unit) = error_unit(report.length);
    let what = if report.instruments.is_empty() { "position error" } else { "residual" };
    let head = [what, "rows", &format!("mean {unit}"), "std. error", "rms", "95 %", "max"];
    let mut rows = vec![head.map(str::to_owned)];
    let mut row = |name: &str, count: usize, sizes: &Sizes| {
        let error = sizes.standard_error.map_or("?".to_owned(), |error| fixed(factor * error, 4));
        let [mean, rms, p95, max] =
            [sizes.mean, sizes.rms, sizes.p95, sizes.max].map(|value| fixed(factor * value, 4));
        rows.push([name.to_owned(), count.to_string(), mean, error, rms, p95, max]);
    };
    let (fit, cross) = (&report.fit, &report.cross_validation);
    row("fit: as delivered", fit.rows, &fit.before);
    row("fit: base and tool fitted", fit.rows, &fit.base_and_tool);
    row("fit: identified", fit.rows, &fit.after);
    row(&format!("{}-fold cross-validation", cross.folds), fit.rows, &cross.after);
    if let Some(test) = &report.test {
        row("test: as delivered", test.rows, &test.before);
        if let Some(constant) = &test.constant {
            row("test: constants alone", test.rows, constant);
        }
        row("test: identified", test.rows, &test.after);
    }
    aligned(&rows, [false, true, true, true, true, true, true])
}

fn significance(parameter: &Parameter) -> f64 {
    parameter.value.abs() / parameter.standard_deviation.max(f64::MIN_POSITIVE)
}

/// The errors that differ from zero with 95 % confidence for all of them together, the most
/// significant first.
fn errors(report: &Report) -> String {
    let machine = || report.parameters.iter().filter(|parameter| parameter.kind == Kind::Machine);
    let count = machine().count();
    let limit = report.certainty.factor_of_all(count);
    let mut all: Vec<&Parameter> = machine().filter(|parameter| significance(parameter) > limit).collect();
    all.sort_by(|a, b| significance(b).total_cmp(&significance(a)));
    if all.is_empty() {
        return format!("None of the {count} errors of the machine differs from zero with 95 % confidence.");
    }
    let (lengths, length) = error_unit(report.length);
    let head = ["significant errors", "value", "± 1 σ", "", "in the chain"];
    let mut rows = vec![head.map(str::to_owned)];
    rows.extend(all.iter().take(SHOWN).map(|parameter| {
        let (factor, unit) = match parameter.unit {
            "rad" => (1e3, "mrad"),
            unit if unit == report.length => (lengths, length),
            unit => (1.0, unit),
        };
        let show = |value: f64| match parameter.unit {
            "" => digits(value, 4),
            _ => fixed(factor * value, 4),
        };
        let meaning = report.meanings.iter().find(|meaning| meaning.in_place_of == parameter.name);
        let meaning = meaning.map(JointError::names);
        let frame = parameter.frame_name.clone();
        let name = frame.map_or(parameter.name.clone(), |frame| format!("{} ({frame})", parameter.name));
        let [value, deviation] = [parameter.value, parameter.standard_deviation].map(show);
        [name, value, deviation, unit.to_owned(), meaning.unwrap_or_default()]
    }));
    let (more, others) = (all.len().saturating_sub(SHOWN), count - all.len());
    let rest = match (more, others) {
        (0, 0) => String::new(),
        (0, others) => format!("  … {others} not significant (95 %)\n"),
        (more, others) => format!("  … {more} more, {others} not significant (95 %)\n"),
    };
    aligned(&rows, [false, true, true, false, false]) + &rest
}

fn facts(spec: &Spec, report: &Report) -> Vec<(&'static str, String)> {
    let (factor, unit) = error_unit(report.length);
    let mut facts = vec![("Residual", residuals(report))];
    facts.extend(report.accepted.iter().map(|accepted| ("Limits", accepted.sentence(spec.length))));
    if !report.terms.is_empty() {
        let names: Vec<&str> = report.terms.iter().map(|term| term.name.as_str()).collect();
        facts.push((
            "Terms",
            format!("{} of {} groups of terms accepted: {}", names.len(), report.tried, first(&names, 3)),
        ));
    }
    if let Some(profiles) = &report.profiles {
        let joints: Vec<&str> = profiles.joints.iter().map(|one| one.joint.as_str()).collect();
        let [before, after] = [&profiles.before, &profiles.after].map(|sizes| fixed(factor * sizes.mean, 4));
        facts.push((
            "Profiles",
            format!(
                "{}: cross-validation {before} → {after} {unit}, σ of the tool point + {} {unit}",
                first(&joints, 7),
                digits(factor * profiles.standard_deviation, 2)
            ),
        ));
    }
    let mut known = format!("{} of {} unknowns identifiable", report.rank, report.unknowns);
    if !report.not_known.is_empty() {
        let names: Vec<&str> = report.not_known.iter().map(|one| one.name.as_str()).collect();
        known += &format!("; poorly determined and fixed at zero: {}", first(&names, 4));
    }
    facts.push(("Rank", known));
    if !report.rejected.is_empty() {
        facts.push(("Outliers", format!("{} left out", counted(report.rejected.len(), "row", "rows"))));
    }
    facts.extend(report.train_test_overlap_warning().map(|sentence| ("Overlap", sentence)));
    if let Some(TestExtrapolation { rows, known_outside, known_within }) = report.outside {
        let mut fact =
            counted(rows, "test row beyond the fitted ranges", "test rows beyond the fitted ranges");
        if let (Some(there), Some(within)) = (known_outside, known_within) {
            let [there, within] = [there, within].map(|value| digits(factor * value, 2));
            fact += &format!(": σ of the tool point {there} {unit} there, {within} {unit} within");
        }
        facts.push(("Outside", fact));
    }
    let is_found = |drift: &&ResidualDrift| drift.is_drift || drift.p_of_lag_1 <= drift.false_alarms;
    facts.extend(
        report.drift.iter().filter(is_found).map(|drift| ("Drift", format!("{}; see --full", drift.summary))),
    );
    facts.extend(report.files.iter().flat_map(super::data));
    facts.extend(super::some("Note", &report.notes, 2));
    facts
}
