//! Accuracy: what the standard errors rest on, instruments, profiles of joints and richer terms.

use abbe_metrology::identify::{Gain, JointProfile, Report, shown_lines};
use abbe_spec::{Fitted, Spec, expr::Symbol, option::TEST_FILE};
use abbe_study::number::{self, counted, digits, error_unit, fixed, percent};

use crate::document::{Section, Table, joined};
use crate::unit::angle_in_mrad;
use crate::views::shared::{drift_clauses, p_value};

pub(super) fn accuracy(spec: &Spec, report: &Report) -> Section {
    let validation = match &report.test {
        Some(_) if report.test_rows_of_the_fit > 0 => None,
        Some(_) => Some("The test rows were used for validation only.".to_owned()),
        None => {
            Some(format!("On held-out rows: the cross-validation; `{TEST_FILE}` validates on separate data."))
        }
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
        .state("drift", report.drift.as_ref().map(|drift| drift_clauses(drift, spec.length).concat()))
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
    let columns = ["instrument", ">numbers", ">standard deviation", "", ">residual / σ", ""];
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
    let columns =
        ["known distance between", "", ">stated", ">standard deviation", ">found", "", ">residual / σ"];
    Table::new("", columns).rows(report.known_distances.iter().map(|known| {
        let [a, b] = known.between.clone();
        let [stated, found] = [known.value, known.found].map(|value| digits(value, 7));
        let residual = fixed(known.residual, 2);
        [a, b, stated, digits(known.uncertainty, 2), found, report.length.to_owned(), residual]
    }))
}

/// Tabulates the profiles of joints.
pub(super) fn profiles(spec: &Spec, report: &Report) -> Section {
    let section = Section::full("Joint profiles");
    let Some(profiles) = &report.profiles else { return section };
    let columns = ["joint", "range covered", ">rms", ">σ", "", ">error without it"];
    let range = |one: &JointProfile| {
        let [from, to] = one.range.map(|end| number::of_symbol(end, Symbol::Variable(one.variable), spec));
        format!("{from} … {to}")
    };
    let table = Table::new("", columns).rows(profiles.joints.iter().map(|one| {
        let (factor, unit) = angle_in_mrad(one.unit);
        let [rms, deviation] = [one.rms, one.standard_deviation].map(|value| digits(factor * value, 2));
        let without = format!("× {}", fixed(one.without, 2));
        [one.joint.clone(), range(one), rms, deviation, unit.to_owned(), without]
    }));
    let [before, after, deviation] = [profiles.before.mean, profiles.after.mean, profiles.standard_deviation]
        .map(|value| number::length(value, spec.length));
    let line = format!(
        "Joint profiles reduce the mean cross-validation error from {before} to {after} (paired by \
         configuration, p {}) and add {deviation} to the standard deviation of the tool point: {}. Beyond \
         these ranges the value at the end holds; only rows over whole turns give whole profiles. The last \
         column is the factor of the cross-validation error (root mean square) without this profile. \
         The rows determine {} coefficients of the profiles.",
        p_value(profiles.gain.p),
        joined(profiles.joints.iter().map(|one| format!("{} ({})", one.joint, range(one)))),
        fixed(profiles.effective, 0)
    );
    section.table(table).state("profiles", line)
}

pub(super) fn terms(report: &Report) -> Section {
    let (tried, section) = (report.tried, Section::full("Additional terms"));
    if report.terms.is_empty() {
        let line = format!(
            "None of {tried} groups of terms ({}) was accepted: none lowers the cross-validation error \
             by half a percent and significantly.",
            report.families
        );
        return section.state("no_term", report.cross_validation.constant.map(|_| line));
    }
    let (factor, unit) = error_unit(report.length);
    let columns = ["in order of acceptance", ">before", ">after", ">p of the test"];
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
