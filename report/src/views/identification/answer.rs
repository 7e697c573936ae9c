//! The first screen: accuracy on held-out rows, most significant errors, and gaps.
//!
//! Places of the machine, of what is mounted on its tool, and of instruments, with their standard
//! deviations.

use abbe_metrology::identify::{
    FoundInstrument, JointError, Kind, Parameter, PlacementAtStation, Report, ResidualDrift, Sizes, Written,
    overlap_warning,
};
use abbe_spec::{Spec, option::FULL};
use abbe_study::number::{counted, digits, error_unit, fixed};

use crate::document::{Section, Table, first};
use crate::unit::angle_in_mrad;
use crate::views::shared::{accepted, drift_clauses, first_notes, first_rows, residual_verdict};

/// Number of errors on the first screen.
const SHOWN: usize = 5;

/// States the mean error on rows that were not used to fit.
pub(super) fn headline(report: &Report) -> String {
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
        report.accepted.as_ref().map(|one| if one.is_met() { "WITHIN LIMITS, " } else { "BEYOND LIMITS, " });
    format!("{}mean {what} {after} on {rows}, {before} as delivered", accepted.unwrap_or_default())
}

pub(super) fn answer(spec: &Spec, report: &Report) -> Section {
    Section::answer()
        .table(sizes(report))
        .table(if report.found.is_placement { places(report) } else { significant(report) })
        .state("no_significant_error", no_significant_error(report))
        .facts(facts(spec, report))
}

/// Tabulates errors as delivered, with base and tool fitted, and identified.
fn sizes(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let what = if report.instruments.is_empty() { "position error" } else { "residual" };
    let columns = [what, ">rows", &format!(">mean {unit}"), ">std. error", ">rms", ">95 %", ">max"];
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

pub(super) fn significance(written: &Written) -> f64 {
    written.value.abs() / written.standard_deviation.max(f64::MIN_POSITIVE)
}

pub(super) fn of_machine(report: &Report) -> impl Iterator<Item = &Parameter> {
    report.parameters.iter().filter(|parameter| parameter.kind == Kind::Machine)
}

/// Returns the errors that differ from zero with 95 % confidence for all of them together, the most
/// significant first, and those that explain the data as well.
fn significant_errors(report: &Report) -> Vec<(Written, String)> {
    let limit = report.certainty.factor_of_all(of_machine(report).count());
    let meaning = |name: &str| report.joint_errors.iter().find(|meaning| meaning.number == name);
    let of_parameters = of_machine(report).map(|parameter| {
        let mut written = parameter.as_written();
        // Where the fit is not written as numbers of the chain, they explain it to first order.
        let in_place = || report.joint_errors.iter().find(|one| one.in_place_of == written.name);
        let others = match (meaning(&written.name), in_place()) {
            (Some(named), _) => named.others(),
            (None, Some(named)) if parameter.written.is_none() => {
                [named.number.clone(), named.others()].join(" or ").trim_end_matches(" or ").to_owned()
            }
            _ => String::new(),
        };
        if let Some(frame) = parameter.frame_name.iter().find(|_| written.name == parameter.name) {
            written.name += &format!(" ({frame})");
        }
        (written, others)
    });
    let mut all: Vec<_> = of_parameters.filter(|(written, _)| significance(written) > limit).collect();
    // Those that share what they explain with others.
    let is_listed = |meaning: &&JointError| {
        let is_own = |parameter: &Parameter| {
            let written = parameter.as_written();
            let is_this = written.name == meaning.number
                || parameter.written.is_none() && written.name == meaning.in_place_of;
            is_this && significance(&written) > limit
        };
        of_machine(report).any(is_own)
    };
    let shared = report.joint_errors.iter().filter(|one| !is_listed(one)).map(|meaning| {
        let JointError { number, value, standard_deviation, unit, .. } = meaning.clone();
        (Written { name: number, value, standard_deviation, unit }, meaning.others())
    });
    all.extend(shared.filter(|(written, _)| significance(written) > limit));
    all.sort_by(|(a, _), (b, _)| significance(b).total_cmp(&significance(a)));
    all
}

fn no_significant_error(report: &Report) -> Option<String> {
    let count = of_machine(report).count();
    (count > 0 && significant_errors(report).is_empty())
        .then(|| format!("None of the {count} errors of the machine differs from zero with 95 % confidence."))
}

fn significant(report: &Report) -> Table {
    let all = significant_errors(report);
    let columns = ["significant errors", ">value", ">± 1 σ", "", "or"];
    let row = |(written, others): &(Written, String)| {
        let [value, deviation, unit] = estimate(report, written);
        [written.name.clone(), value, deviation, unit, others.clone()]
    };
    let mut table = Table::new("", columns).rows(all.iter().take(SHOWN).map(row));
    let others = of_machine(report).count().saturating_sub(all.len());
    table.rest = match (all.len().saturating_sub(SHOWN), others) {
        (0, 0) => String::new(),
        (0, others) => format!("… {others} not significant (95 %)"),
        (more, others) => format!("… {more} more, {others} not significant (95 %)"),
    };
    table
}

/// Formats a value, its standard deviation and their unit.
pub(super) fn estimate(report: &Report, written: &Written) -> [String; 3] {
    let Written { value, standard_deviation, unit, .. } = *written;
    let (factor, shown) = match unit {
        unit if unit == report.length => error_unit(report.length),
        unit => angle_in_mrad(unit),
    };
    let show = |value: f64| match unit {
        "" => digits(value, 4),
        _ => fixed(factor * value, 4),
    };
    [show(value), show(standard_deviation), shown.to_owned()]
}

fn facts(spec: &Spec, report: &Report) -> Vec<(&'static str, String)> {
    let (factor, unit) = error_unit(report.length);
    let mut facts = vec![("Residual", residuals(report))];
    facts.extend(report.accepted.iter().map(|verdict| ("Limits", accepted(verdict, spec.length).text)));
    let names: Vec<&str> = report.terms.iter().map(|term| term.name.as_str()).collect();
    // What was tried in vain is in the full report.
    if !names.is_empty() {
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
    if !report.weakly_determined.is_empty() {
        let names: Vec<&str> = report.weakly_determined.iter().map(|one| one.name.as_str()).collect();
        known += &format!("; poorly determined: {}", first(&names, 4));
    }
    facts.push(("Rank", known));
    if !report.rejected.is_empty() {
        facts.push(("Outliers", format!("{} left out", counted(report.rejected.len(), "row", "rows"))));
    }
    let overlap =
        report.test.as_ref().and_then(|test| overlap_warning(report.test_rows_of_the_fit, test.rows));
    facts.extend(overlap.map(|sentence| ("Overlap", sentence)));
    facts.extend(extrapolation(report).map(|sentence| ("Outside", sentence)));
    let is_found = |drift: &&ResidualDrift| drift.is_drift || drift.found.p_of_lag_1 <= drift.false_alarms;
    let drift = report.drift.iter().filter(is_found);
    facts.extend(
        drift.map(|drift| ("Drift", format!("{}; see {FULL}", drift_clauses(drift, spec.length)[0]))),
    );
    facts.extend(first_rows(&report.files));
    facts.extend(first_notes(&report.notes));
    facts
}

/// Returns the number of test rows beyond the fitted ranges, with the uncertainty there.
fn extrapolation(report: &Report) -> Option<String> {
    let rows = report.extrapolated.as_ref()?;
    let (factor, unit) = error_unit(report.length);
    let mut fact =
        counted(rows.count, "test row beyond the fitted ranges", "test rows beyond the fitted ranges");
    if let Some(deviation) = rows.standard_deviation {
        let [there, within] =
            [deviation.extrapolated, deviation.within].map(|value| digits(factor * value, 2));
        fact += &format!(": σ of the tool point {there} {unit} there, {within} within");
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
    if report.certainty.freedom == 0.0 {
        return "There are as many independent values as unknowns, so nothing could be tested: σ is that of \
                the stated uncertainties."
            .to_owned();
    }
    if report.found.is_random {
        // Rotations have not been compared.
        let what = if report.coordinates.is_empty() { "that" } else { "those of positions" };
        return format!(
            "The residuals are {} times the stated uncertainty of the instrument; the random sources of the spec \
             explain {what}.",
            digits(report.uncertainty_factor, 3)
        );
    }
    residual_verdict(report.uncertainty_factor, report.certainty.p_of_factor, "the model does not have", "")
}

/// Tabulates all places that were fitted: positions in the frame that the map states them in.
pub(super) fn places(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let columns = ["place", ">x", ">y", ">z", "", "± 1 σ"];
    let row = |name: String, at: [f64; 3], variances: [f64; 3]| {
        let [x, y, z] = at.map(|value| fixed(factor * value, 3));
        let deviations = variances.map(|variance| match variance > 0.0 {
            true => digits(factor * variance.sqrt(), 2),
            false => "held".to_owned(),
        });
        let is_fitted = variances.iter().any(|variance| *variance > 0.0);
        is_fitted.then(|| [name, x, y, z, unit.to_owned(), deviations.join(", ")])
    };
    let named =
        |what: &str, name: &str| if name.is_empty() { what.to_owned() } else { format!("{what} {name}") };
    let placed = &report.placed;
    let stations = placed.stations.iter().map(|station| {
        let of = |i: usize| station.covariance[i][i];
        row(named("machine", &station.name), [0, 1, 2].map(|i| station.pose[i][3]), [of(0), of(1), of(2)])
    });
    let on_tool = placed.placements();
    let on_tool = on_tool.iter().flat_map(|PlacementAtStation { station, targets, mounting, covariance }| {
        let targets = targets.iter().enumerate().map(move |(j, at)| {
            let what = if targets.len() > 1 { format!("target {}", j + 1) } else { "target".to_owned() };
            row(named(&what, station), *at, [0, 1, 2].map(|i| covariance[3 * j + i][3 * j + i]))
        });
        let frame = mounting.map(|pose| {
            let what = named("measured frame", station);
            row(what, [0, 1, 2].map(|i| pose[i][3]), [0, 1, 2].map(|i| covariance[i][i]))
        });
        targets.chain(frame)
    });
    let instruments =
        placed.instruments.iter().filter_map(|FoundInstrument { name, position, covariance, .. }| {
            Some(row(name.clone(), (*position)?, [0, 1, 2].map(|i| covariance[i][i])))
        });
    let rows: Vec<_> = stations.chain(on_tool).chain(instruments).flatten().collect();
    Table::new("", columns).rows(rows)
}
