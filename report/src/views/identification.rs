//! Identification: accuracy on held-out rows, errors of the machine, and what the data determine.

use abbe_metrology::data::Map;
use abbe_metrology::identify::{
    Gain, Indistinguishable, JointError, Kind, Parameter, Report, ResidualDrift, Sizes, shown_lines,
};
use abbe_spec::expr::Symbol;
use abbe_spec::{Fitted, Spec};
use abbe_study::number::{self, counted, digits, error_unit, fixed, percent};

use super::shared::{
    NOTES, accepted, angle_in_mrad, data_rows, instrument, notes, p_value, residual_verdict,
};
use crate::document::{Card, Document, Section, Table, first, joined, number, words};
use crate::figures::residuals::{ErrorNames, Residual, scenes};

/// Number of errors on the first screen.
const SHOWN: usize = 5;

/// Describes an identification; `spec` and `map` are those of the job.
pub fn identification(spec: &Spec, map: &Map, report: &Report) -> Document {
    Document {
        kind: "Errors from measurements",
        machine: spec.title.clone(),
        title: report.title.clone(),
        headline: headline(report),
        verdict: report.accepted.as_ref().map(|verdict| accepted(verdict, spec.length)),
        panel: "Residuals at a configuration",
        sections: [
            vec![answer(spec, report), Section::page("").cards(cards(report))],
            figures(spec, report),
            vec![
                machine(report),
                placement(report),
                identifiable(report),
                accuracy(spec, report),
                terms(report),
                profiles(spec, report),
                Section::page("Instrument").facts(instrument(spec, map)),
                data_rows(&report.files),
                notes(&report.notes, NOTES),
            ],
        ]
        .concat(),
        is_signed: report.accepted.is_some(),
        record: report.record.clone(),
    }
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

fn answer(spec: &Spec, report: &Report) -> Section {
    Section::answer()
        .table(sizes(report))
        .table(significant(report))
        .state("no_significant_error", no_significant_error(report))
        .facts(facts(spec, report))
}

/// Tabulates errors as delivered, with base and tool fitted, and identified.
fn sizes(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let what = if report.instruments.is_empty() { "position error" } else { "residual" };
    let columns = [
        words(what),
        number("rows"),
        number(format!("mean {unit}")),
        number("std. error"),
        number("rms"),
        number("95 %"),
        number("max"),
    ];
    let row = |(name, rows, sizes): (String, usize, &Sizes)| {
        let error = sizes.standard_error.map_or("?".to_owned(), |error| fixed(factor * error, 4));
        let [mean, rms, p95, max] =
            [sizes.mean, sizes.rms, sizes.p95, sizes.max].map(|value| fixed(factor * value, 4));
        [name, rows.to_string(), mean, error, rms, p95, max]
    };
    let mut rows = Vec::new();
    let cross = &report.cross_validation;
    for (set, compared) in [("fit", Some(&report.fit)), ("test", report.test.as_ref())] {
        let Some(compared) = compared else { continue };
        rows.push((format!("{set}: as delivered"), compared.rows, &compared.before));
        if set == "fit" {
            rows.push((format!("{set}: base and tool fitted"), compared.rows, &compared.base_and_tool));
        }
        rows.extend(
            compared.constant.iter().map(|one| (format!("{set}: constants alone"), compared.rows, one)),
        );
        rows.push((format!("{set}: identified"), compared.rows, &compared.after));
        if set == "fit" {
            rows.push((format!("{}-fold cross-validation", cross.folds), compared.rows, &cross.after));
        }
    }
    Table::new("", columns).rows(rows.into_iter().map(row))
}

fn significance(parameter: &Parameter) -> f64 {
    parameter.value.abs() / parameter.standard_deviation.max(f64::MIN_POSITIVE)
}

fn of_machine(report: &Report) -> impl Iterator<Item = &Parameter> {
    report.parameters.iter().filter(|parameter| parameter.kind == Kind::Machine)
}

/// Returns the errors that differ from zero with 95 % confidence for all of them together, the most
/// significant first.
fn significant_errors(report: &Report) -> Vec<&Parameter> {
    let limit = report.certainty.factor_of_all(of_machine(report).count());
    let mut all: Vec<&Parameter> =
        of_machine(report).filter(|parameter| significance(parameter) > limit).collect();
    all.sort_by(|a, b| significance(b).total_cmp(&significance(a)));
    all
}

fn no_significant_error(report: &Report) -> Option<String> {
    let count = of_machine(report).count();
    significant_errors(report)
        .is_empty()
        .then(|| format!("None of the {count} errors of the machine differs from zero with 95 % confidence."))
}

fn significant(report: &Report) -> Table {
    let all = significant_errors(report);
    let columns =
        [words("significant errors"), number("value"), number("± 1 σ"), words(""), words("in the chain")];
    let row = |parameter: &&Parameter| {
        let meaning = report.meanings.iter().find(|meaning| meaning.in_place_of == parameter.name);
        let name = match &parameter.frame_name {
            Some(frame) => format!("{} ({frame})", parameter.name),
            None => parameter.name.clone(),
        };
        let [value, deviation, unit] = estimate(report, parameter);
        [name, value, deviation, unit, meaning.map(JointError::names).unwrap_or_default()]
    };
    let mut table = Table::new("", columns).rows(all.iter().take(SHOWN).map(row));
    table.rest = match (all.len().saturating_sub(SHOWN), of_machine(report).count() - all.len()) {
        (0, 0) => String::new(),
        (0, others) => format!("… {others} not significant (95 %)"),
        (more, others) => format!("… {more} more, {others} not significant (95 %)"),
    };
    table
}

/// Formats a value, its standard deviation and their unit.
fn estimate(report: &Report, parameter: &Parameter) -> [String; 3] {
    let (factor, unit) = match parameter.unit {
        unit if unit == report.length => error_unit(report.length),
        unit => angle_in_mrad(unit),
    };
    let show = |value: f64| match parameter.unit {
        "" => digits(value, 4),
        _ => fixed(factor * value, 4),
    };
    [show(parameter.value), show(parameter.standard_deviation), unit.to_owned()]
}

fn facts(spec: &Spec, report: &Report) -> Vec<(&'static str, String)> {
    let (factor, unit) = error_unit(report.length);
    let mut facts = vec![("Residual", residuals(report))];
    facts.extend(report.accepted.iter().map(|accepted| ("Limits", accepted.sentence(spec.length))));
    if !report.terms.is_empty() {
        let names: Vec<&str> = report.terms.iter().map(|term| term.name.as_str()).collect();
        let text =
            format!("{} of {} groups of terms accepted: {}", names.len(), report.tried, first(&names, 3));
        facts.push(("Terms", text));
    }
    if let Some(profiles) = &report.profiles {
        let joints: Vec<&str> = profiles.joints.iter().map(|one| one.joint.as_str()).collect();
        let [before, after] = [&profiles.before, &profiles.after].map(|sizes| fixed(factor * sizes.mean, 4));
        let text = format!(
            "{}: cross-validation {before} → {after} {unit}, σ of the tool point + {} {unit}",
            first(&joints, 7),
            digits(factor * profiles.standard_deviation, 2)
        );
        facts.push(("Profiles", text));
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
    facts.extend(extrapolation(report).map(|sentence| ("Outside", sentence)));
    let is_found = |drift: &&ResidualDrift| drift.is_drift || drift.p_of_lag_1 <= drift.false_alarms;
    let drift = report.drift.iter().filter(is_found);
    facts.extend(drift.map(|drift| ("Drift", format!("{}; see --full", drift.summary))));
    facts.extend(super::shared::first_rows(&report.files));
    facts.extend(super::shared::first_notes(&report.notes));
    facts
}

/// Returns the number of test rows beyond the fitted ranges, with the uncertainty there.
fn extrapolation(report: &Report) -> Option<String> {
    let outside = report.outside.as_ref()?;
    let (factor, unit) = error_unit(report.length);
    let mut fact =
        counted(outside.rows, "test row beyond the fitted ranges", "test rows beyond the fitted ranges");
    if let (Some(there), Some(within)) = (outside.known_outside, outside.known_within) {
        let [there, within] = [there, within].map(|value| digits(factor * value, 2));
        fact += &format!(": σ of the tool point {there} {unit} there, {within} {unit} within");
    }
    Some(fact)
}

/// Compares the residuals with the uncertainty of the instrument.
fn residuals(report: &Report) -> String {
    let mut parts = report.instruments.iter().chain(&report.coordinates).peekable();
    let estimated = parts.peek().is_some() && parts.all(|part| part.estimated);
    if estimated {
        return "The uncertainty of the instruments was estimated from the residuals, so the residuals \
                cannot show errors that the model does not have."
            .to_owned();
    }
    residual_verdict(report.uncertainty_factor, report.certainty.p_of_factor, "the model does not have", "")
}

fn cards(report: &Report) -> Vec<Card> {
    let (factor, unit) = error_unit(report.length);
    let show = |sizes: &Sizes| format!("{} {unit}", fixed(factor * sizes.mean, 4));
    let card = |name, value, note: &str| Card { name, value, note: note.to_owned() };
    let fitted = "mean position error of the fitted rows";
    let folds = format!("{}-fold", report.cross_validation.folds);
    let mut all = vec![
        card("Base and tool fitted", show(&report.fit.base_and_tool), fitted),
        card("Identified", show(&report.fit.after), "the same rows"),
        card("Cross-validation", show(&report.cross_validation.after), &folds),
    ];
    if let Some(test) = &report.test {
        let note = match report.test_rows_of_the_fit {
            0 => format!("{} rows, used for validation only", test.rows),
            known => format!("{} rows, {known} of them also in the fit", test.rows),
        };
        all.push(card("Test rows", show(&test.after), &note));
    }
    let known = format!("{} of {}", report.rank, report.unknowns);
    all.push(card("Identifiable", known, "combinations of unknowns"));
    all
}

fn figures(spec: &Spec, report: &Report) -> Vec<Section> {
    let names = ErrorNames { before: "base and tool fitted", after: "identified" };
    let section = |title, is_test: bool| {
        let points = report.points.iter().filter(|point| point.is_test == is_test && !point.is_rejected);
        let residuals = points.map(|point| Residual {
            q: &point.q,
            point: point.point,
            before: Some(point.before),
            after: point.after,
        });
        let residuals: Vec<Residual<'_>> = residuals.collect();
        let drawn = if residuals.is_empty() { Vec::new() } else { scenes(&residuals, &names, spec) };
        Section::page(title).figures(drawn)
    };
    vec![section("Rows of the fit, without outliers", false), section("Test rows", true)]
}

fn machine(report: &Report) -> Section {
    let correlated = report.correlations.iter().take(8);
    let correlated =
        correlated.map(|pair| format!("{} with {} {}", pair.of[0], pair.of[1], fixed(pair.correlation, 3)));
    let more = match report.correlations.len().saturating_sub(8) {
        0 => String::new(),
        more => format!("; {more} more pairs"),
    };
    let correlated = (!report.correlations.is_empty())
        .then(|| format!("Correlated by more than 0.9: {}{more}.", joined(correlated)));
    let prior = report.parameters.iter().any(|parameter| parameter.hardly_known).then(|| {
        "Prior-dominated: the prior has more influence on these errors than the data (`--prior`).".to_owned()
    });
    let meanings = report.meanings.iter().map(|meaning| meaning.sentence.clone());
    let magnitudes = report.magnitudes.iter().map(|one| one.sentence.clone());
    Section::full("Errors of the machine")
        .table(estimates(report, "All others are fixed at zero", of_machine(report)))
        .list(
            "equivalent_errors",
            "Equivalent joint offsets and DH errors (in place of the error in brackets)",
            meanings.collect(),
        )
        .list("magnitudes", "Estimated magnitudes of sources of the spec", magnitudes.collect())
        .state("prior_dominated", prior)
        .state("poorly_determined", poorly_determined(report))
        .state("correlated", correlated)
}

/// Lists estimates with their standard deviations.
fn estimates<'r>(report: &Report, caption: &str, parameters: impl Iterator<Item = &'r Parameter>) -> Table {
    let columns =
        [words("error"), words("of"), number("value"), number("σ"), words(""), number("value/σ"), words("")];
    Table::new(caption, columns).rows(parameters.map(|parameter| {
        let [value, deviation, unit] = estimate(report, parameter);
        let name = match &parameter.iso {
            Some(iso) => format!("{} ({iso})", parameter.name),
            None => parameter.name.clone(),
        };
        let significance = fixed(significance(parameter).min(9999.0), 1);
        let remark = if parameter.hardly_known { "prior-dominated" } else { "" };
        let frame = parameter.frame_name.clone().unwrap_or_default();
        [name, frame, value, deviation, unit, significance, remark.to_owned()]
    }))
}

/// Lists errors that are fixed at zero because the data determine them poorly.
fn poorly_determined(report: &Report) -> Option<String> {
    let all = report.not_known.iter().map(|one| {
        let (factor, unit) = angle_in_mrad(one.unit);
        let [deviation, expected] =
            [one.standard_deviation, one.expected].map(|value| digits(value * factor, 2));
        format!("{} (± {deviation} {unit}, expected ± {expected} {unit})", one.name)
    });
    (!report.not_known.is_empty()).then(|| {
        format!(
            "Poorly determined by these data; fixed at zero and not written: {}. In brackets the \
             standard deviation from the data, which is more than half of the expected one. Other \
             configurations, a target farther from the axes or a better instrument determine them: \
             `abbe plan {}` predicts how well.",
            joined(all),
            report.name
        )
    })
}

/// Lists the placement of the machine and of what is mounted on its tool.
fn placement(report: &Report) -> Section {
    let placed = report.parameters.iter().filter(|parameter| parameter.kind != Kind::Machine);
    let table = estimates(report, "", placed);
    let words = match table.rows.is_empty() {
        true => "The placement of the machine and of its tool is fixed to the values of the map.",
        false => {
            "Errors before the first joint cannot be distinguished from the placement of the machine, \
             nor errors after the last joint from the mounting of targets; they count as placement. A \
             placement is no error of the machine: it is not written to the spec and not compensated."
        }
    };
    Section::full("Placement of the machine and of its tool")
        .table(table)
        .state("placement", words.to_owned())
}

/// Lists what the data determine, and what they cannot distinguish.
fn identifiable(report: &Report) -> Section {
    let o = report.observability;
    let [condition, o1, o2, o3, o4, o5] =
        [report.condition, o.o1, o.o2, o.o3, o.o4, o.o5].map(|value| digits(value, 3));
    let unexplained = (report.unexplained > 0).then(|| {
        format!(
            "{} more combinations have no effect at these configurations; other configurations may \
             reveal them.",
            report.unexplained
        )
    });
    Section::full("Indistinguishable errors")
        .state(
            "identifiable",
            format!(
                "Identifiable: {} combinations of {} unknowns, {}.",
                report.rank, report.unknowns, report.machine
            ),
        )
        .table(indistinguishable(&report.groups))
        .state("unexplained_combinations", unexplained)
        .state(
            "observability",
            format!(
                "Condition number {condition}; observability O1 {o1}, O2 {o2}, O3 {o3}, O4 {o4}, O5 {o5} \
                 (columns of unit length)."
            ),
        )
}

/// Lists unknowns that cannot be distinguished, by the reason.
pub(super) fn indistinguishable(groups: &[Indistinguishable]) -> Table {
    let mut reasons: Vec<[String; 2]> = Vec::new();
    for group in groups {
        match reasons.last_mut() {
            Some([reason, all]) if *reason == group.reason => *all += &format!("\n{}", group.sentence()),
            _ => reasons.push([group.reason.clone(), group.sentence()]),
        }
    }
    Table::new("", [words("because"), words("indistinguishable errors")]).rows(reasons)
}

fn accuracy(spec: &Spec, report: &Report) -> Section {
    let validation = match &report.test {
        Some(_) if report.test_rows_of_the_fit > 0 => None,
        Some(_) => Some("The test rows were used for validation only.".to_owned()),
        None => Some(
            "On held-out rows: the cross-validation; `--test FILE` validates on separate data.".to_owned(),
        ),
    };
    let outliers = (!report.rejected.is_empty()).then(|| {
        format!("Outliers left out: {} rows, lines {}.", report.rejected.len(), shown_lines(&report.rejected))
    });
    Section::full("Accuracy")
        .state("validation", validation)
        .state("basis", basis(report))
        .state("fitted_ranges", fitted_ranges(spec, report))
        .table(instruments(report))
        .table(known_distances(report))
        .state("drift", report.drift.as_ref().map(|drift| drift.sentence.clone()))
        .state("outliers", outliers)
}

/// States the number of configurations, and the gain over fitting base and tool alone.
fn basis(report: &Report) -> String {
    let configurations = |count: usize| counted(count, "configuration", "configurations");
    let mut basis = format!("{} of the fit", configurations(report.fit.configurations));
    let mut better = String::new();
    if let Some(test) = &report.test {
        basis += &format!(", {} of the test", configurations(test.configurations));
        let gain = comparison(test.gain, report.length);
        better = format!(" Compared with base and tool fitted, on the test rows: {gain}.");
    }
    let factor = digits(report.certainty.factor_95, 3);
    let counted = match report.certainty.counted {
        "numbers" => "",
        "points" => " Visits of a configuration count as one.",
        _ => " All measurements at a configuration count as one.",
    };
    format!(
        "Standard errors of the mean are from {basis}.{counted} The 95 % coverage factor of standard \
         deviations is {factor}.{better}"
    )
}

/// Compares two models with the p-value of the difference.
fn comparison(gain: Gain, length: &str) -> String {
    let Some(error) = gain.standard_error else {
        return "not comparable: there is only one configuration".to_owned();
    };
    let (factor, unit) = error_unit(length);
    let by = format!("{} ± {} {unit}", digits(factor * gain.mean.abs(), 3), digits(factor * error, 2));
    let p = p_value(gain.p);
    match gain.p < 0.05 {
        true if gain.mean > 0.0 => format!("better by {by} (paired by configuration, p {p})"),
        true => format!("worse by {by} (paired by configuration, p {p})"),
        false => format!("no significant difference ({by}, p {p})"),
    }
}

/// Lists the ranges of joints and inputs over the fitted rows, with the share of the joint limits.
fn fitted_ranges(spec: &Spec, report: &Report) -> String {
    let share = |fitted: &Fitted| {
        let Symbol::Variable(i) = fitted.symbol else { return String::new() };
        let [[from, to], [lower, upper]] = [fitted.range, spec.variables[i].limits];
        let share = (to - from) / (upper - lower);
        match share.is_finite() && upper - lower < f64::INFINITY {
            true => format!(" ({} of its limits)", percent(share, 1.0)),
            false => String::new(),
        }
    };
    let ranges = report.found.fitted.iter().map(|fitted| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        format!("{} {lower} … {upper}{}", spec.name_of(fitted.symbol), share(fitted))
    });
    format!("Fitted ranges: {}. Results beyond them are extrapolations.", joined(ranges))
}

/// Tabulates the uncertainty of each instrument, or of positions and rotations.
fn instruments(report: &Report) -> Table {
    let columns = [
        words("instrument"),
        number("numbers"),
        number("standard deviation"),
        words(""),
        number("residual / σ"),
        words(""),
    ];
    Table::new("", columns).rows(report.instruments.iter().chain(&report.coordinates).map(|instrument| {
        let (factor, unit) = angle_in_mrad(instrument.unit);
        let basis = if instrument.estimated { "estimated" } else { "stated" };
        let deviation = digits(instrument.uncertainty * factor, 2);
        let numbers = instrument.numbers.to_string();
        let residual = digits(instrument.factor, 3);
        [instrument.name.clone(), numbers, deviation, unit.to_owned(), residual, basis.to_owned()]
    }))
}

/// Tabulates the known distances between instruments.
fn known_distances(report: &Report) -> Table {
    let columns = [
        words("known distance between"),
        words(""),
        number("stated"),
        number("standard deviation"),
        number("found"),
        words(""),
        number("residual / σ"),
    ];
    Table::new("", columns).rows(report.known_distances.iter().map(|known| {
        let [a, b] = known.between.clone();
        let [stated, found] = [known.value, known.found].map(|value| digits(value, 7));
        let residual = fixed(known.residual, 2);
        [a, b, stated, digits(known.uncertainty, 2), found, report.length.to_owned(), residual]
    }))
}

/// Tabulates the profiles of joints.
fn profiles(spec: &Spec, report: &Report) -> Section {
    let section = Section::full("Joint profiles");
    let Some(profiles) = &report.profiles else { return section };
    let columns = [
        words("joint"),
        words("range covered"),
        number("rms"),
        number("σ"),
        words(""),
        number("error without it"),
    ];
    let table = Table::new("", columns).rows(profiles.joints.iter().map(|one| {
        let [from, to] = one.range.map(|end| number::of_symbol(end, Symbol::Variable(one.variable), spec));
        let (factor, unit) = angle_in_mrad(one.unit);
        let [rms, deviation] = [one.rms, one.standard_deviation].map(|value| digits(factor * value, 2));
        let without = format!("× {}", fixed(one.without, 2));
        [one.joint.clone(), format!("{from} … {to}"), rms, deviation, unit.to_owned(), without]
    }));
    let line = format!(
        "{} The last column is the factor of the cross-validation error (root mean square) without \
         this profile. The rows determine {} coefficients of the profiles.",
        profiles.sentence,
        fixed(profiles.effective, 0)
    );
    section.table(table).state("profiles", line)
}

fn terms(report: &Report) -> Section {
    let (tried, section) = (report.tried, Section::full("Additional terms"));
    if report.terms.is_empty() {
        let line = format!(
            "None of {tried} additional terms was accepted: none lowers the cross-validation error by \
             half a percent and significantly."
        );
        return section.state("no_term", report.cross_validation.constant.map(|_| line));
    }
    let (factor, unit) = error_unit(report.length);
    let columns =
        [words("in order of acceptance"), number("before"), number("after"), number("p of the test")];
    let table = Table::new("", columns).rows(report.terms.iter().map(|term| {
        let [before, after] = [term.before, term.after].map(|value| fixed(factor * value, 4));
        [term.name.clone(), before, after, p_value(term.p)]
    }));
    let cross = &report.cross_validation;
    let constant = cross.constant.map(|sizes| {
        let [alone, with] = [sizes.mean, cross.after.mean].map(|value| fixed(factor * value, 4));
        let gain = cross.gain.map_or(String::new(), |gain| format!(": {}", comparison(gain, report.length)));
        format!(
            "Cross-validation, constants alone: mean {alone} {unit}; with these terms {with} {unit}{gain}."
        )
    });
    let lines = report.terms.iter().flat_map(|term| &term.lines).map(|line| line.replace('\n', ", "));
    let unwritten = joined(report.terms.iter().filter(|term| !term.written).map(|term| term.name.as_str()));
    let unwritten = (!unwritten.is_empty()).then(|| {
        format!(
            "Specific to the rows of this file, so not written to a spec and not used for other files: \
             {unwritten}."
        )
    });
    section
        .table(table)
        .state(
            "terms",
            format!(
                "Before and after: root mean square of a coordinate in cross-validation, {unit}. Of {tried} \
                 groups of terms, one is accepted if it lowers this error and its p-value is significant \
                 with the Bonferroni correction."
            ),
        )
        .state("gain_of_terms", constant)
        .code("terms_in_spec", "As written to a spec", lines.collect())
        .state("terms_not_written", unwritten)
}
