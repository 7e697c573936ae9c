//! Every error that was found, what acts alike, and how well each is known: `--full`.

use abbe_metrology::identify::{
    Gain, JointProfiles, Kind, Parameter, Report, Sizes, TestExtrapolation, WeaklyDetermined, shown_lines,
};
use abbe_spec::expr::Symbol;
use abbe_spec::{Fitted, Spec};
use abbe_study::number::{self, counted, digits, fixed, percent};

use super::{Table, indistinguishable, wrapped};

/// Returns what `abbe identify --full` prints, except what is written.
pub(in crate::text) fn identification(spec: &Spec, report: &Report) -> String {
    let mut parts = vec![format!("{}: errors from measurements\n\n", spec.title)];
    for line in report.files.iter().flat_map(|file| file.lines()) {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    parts.push(identifiable(report));
    parts.push(parameters(spec, report));
    parts.push(placed(spec, report));
    parts.push(errors(spec, report));
    if !report.terms.is_empty() || report.cross_validation.constant.is_some() {
        parts.push(terms(spec, report));
    }
    if let Some(profiles) = &report.profiles {
        parts.push(joint_profiles(spec, profiles));
    }
    let notes = report.notes.iter().map(|note| wrapped(note, 0) + "\n").collect::<String>();
    if !notes.is_empty() {
        parts.push(notes);
    }
    parts.join("\n")
}

fn identifiable(report: &Report) -> String {
    let mut text = format!(
        "Identifiable: {} combinations of {} unknowns, {}\n",
        report.rank, report.unknowns, report.machine
    );
    text += &indistinguishable::table(&report.groups);
    if report.unexplained > 0 {
        let line = format!(
            "{} more combinations have no effect at these configurations; other configurations \
             may reveal them.",
            report.unexplained
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    let o = report.observability;
    let line = format!(
        "Condition number {}; observability O1 {}, O2 {}, O3 {}, O4 {}, O5 {} (columns of unit length).",
        digits(report.condition, 3),
        digits(o.o1, 3),
        digits(o.o2, 3),
        digits(o.o3, 3),
        digits(o.o4, 3),
        digits(o.o5, 3)
    );
    text + &format!("{}\n", wrapped(&line, 0))
}

fn parameters(spec: &Spec, report: &Report) -> String {
    let table = table(spec, report, |parameter| parameter.kind == Kind::Machine);
    let mut text = format!("Errors of the machine, all others fixed at zero\n{table}");
    if !report.meanings.is_empty() {
        let sentences: String =
            report.meanings.iter().map(|meaning| format!("  {}\n", wrapped(&meaning.sentence, 2))).collect();
        text += &format!(
            "Equivalent joint offsets and DH errors (in place of the error in \
             brackets)\n{sentences}"
        );
    }
    if !report.magnitudes.is_empty() {
        let sentences: String =
            report.magnitudes.iter().map(|one| format!("{}\n", wrapped(&one.sentence, 2))).collect();
        text += &format!("Estimated magnitudes of sources of the spec\n{sentences}");
    }
    if report.parameters.iter().any(|parameter| parameter.hardly_known) {
        let line = "Prior-dominated: the prior has more influence on these errors than the data \
            (`--prior`).";
        text += &format!("{line}\n");
    }
    text += &not_known(spec, report);
    if !report.correlations.is_empty() {
        let shown = report.correlations.iter().take(8);
        let pairs: Vec<String> = shown
            .map(|pair| format!("{} with {} {}", pair.of[0], pair.of[1], fixed(pair.correlation, 3)))
            .collect();
        let more = report.correlations.len().saturating_sub(8);
        let more = if more > 0 { format!("; {more} more pairs") } else { String::new() };
        text += &format!(
            "{}\n",
            wrapped(&format!("Correlated by more than 0.9: {}{more}.", pairs.join(", ")), 0)
        );
    }
    text
}

/// Lists estimates with their standard deviations.
fn table(spec: &Spec, report: &Report, wanted: impl Fn(&Parameter) -> bool) -> Table {
    let mut table = Table::new(&["error", "of", "value", "standard deviation", "", ""]);
    let decimals = number::error_decimals(spec.length);
    for parameter in report.parameters.iter().filter(|parameter| wanted(parameter)) {
        let (unit, factor, decimals) = match parameter.unit {
            "rad" => ("mrad", 1e3, 4),
            "" => ("", 1.0, 4),
            unit => (unit, 1.0, decimals),
        };
        let show = |value: f64| match parameter.unit {
            "" => digits(value, 4),
            _ => fixed(value * factor, decimals),
        };
        let remark = if parameter.hardly_known { "prior-dominated" } else { "" };
        table.row(vec![
            match &parameter.iso {
                Some(iso) => format!("{} ({iso})", parameter.name),
                None => parameter.name.clone(),
            },
            parameter.frame_name.clone().unwrap_or_default(),
            show(parameter.value),
            show(parameter.standard_deviation),
            unit.to_owned(),
            remark.to_owned(),
        ]);
    }
    table.right(&[2, 3])
}

/// Lists the placement of the machine and of what is mounted on its tool.
fn placed(spec: &Spec, report: &Report) -> String {
    let is_placed = |kind: Kind| kind != Kind::Machine;
    if !report.parameters.iter().any(|parameter| is_placed(parameter.kind)) {
        return "The placement of the machine and of its tool is fixed to the values of the map.\n"
            .to_owned();
    }
    let words = "Errors before the first joint cannot be distinguished from the placement of the machine, nor \
     errors after the last joint from the mounting of targets; they count as placement. A \
     placement is no error of the machine: it is not written to the spec and not compensated.";
    format!(
        "Placement of the machine and of its tool\n{}{}\n",
        table(spec, report, |parameter| is_placed(parameter.kind)),
        wrapped(words, 0)
    )
}

/// Lists errors that are fixed at zero because the data determine them poorly.
fn not_known(spec: &Spec, report: &Report) -> String {
    if report.not_known.is_empty() {
        return String::new();
    }
    let one = |not_known: &WeaklyDetermined| {
        let (unit, factor) = if not_known.unit == "rad" { ("mrad", 1e3) } else { (not_known.unit, 1.0) };
        let deviation = digits(not_known.standard_deviation * factor, 2);
        format!(
            "{} (± {deviation} {unit}, expected ± {} {unit})",
            not_known.name,
            digits(not_known.expected * factor, 2)
        )
    };
    let all: Vec<String> = report.not_known.iter().map(one).collect();
    let line = format!(
        "Poorly determined by these data; fixed at zero and not written: {}. In brackets the \
         standard deviation from the data, which is more than half of the expected one. Other \
         configurations, a target farther from the axes or a better instrument determine them: \
         `abbe plan {}` predicts how well.",
        all.join(", "),
        spec.name
    );
    wrapped(&line, 0) + "\n"
}

/// Tabulates errors as delivered, with base and tool fitted, and identified.
fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let what = if report.instruments.is_empty() { "position error" } else { "residual of a reading" };
    let mut table = Table::new(&[what, "rows", "mean", "±", "rms", "95 %", "max"]);
    let mut row = |name: &str, rows: usize, sizes: &Sizes| {
        let sure = sizes.standard_error.map_or("?".to_owned(), |error| fixed(error, decimals));
        let [mean, rms, p95, max] =
            [sizes.mean, sizes.rms, sizes.p95, sizes.max].map(|value| fixed(value, decimals));
        table.row(vec![name.to_owned(), rows.to_string(), mean, sure, rms, p95, max]);
    };
    for (set, compared) in [("fit", Some(&report.fit)), ("test", report.test.as_ref())] {
        let Some(compared) = compared else { continue };
        row(&format!("{set}: as delivered"), compared.rows, &compared.before);
        row(&format!("{set}: base and tool fitted"), compared.rows, &compared.base_and_tool);
        if let Some(constant) = &compared.constant {
            row(&format!("{set}: constants alone"), compared.rows, constant);
        }
        row(&format!("{set}: identified"), compared.rows, &compared.after);
        if set == "fit" {
            let name = format!("{}-fold cross-validation", report.cross_validation.folds);
            row(&name, compared.rows, &report.cross_validation.after);
        }
    }
    format!("Accuracy, {}\n{}", spec.length.symbol(), table.right(&[1, 2, 3, 4, 5, 6]))
}

fn errors(spec: &Spec, report: &Report) -> String {
    let mut text = sizes(spec, report);
    let line = match &report.test {
        Some(_) if report.test_rows_of_the_fit > 0 => {
            report.train_test_overlap_warning().map_or(String::new(), |sentence| sentence + ".")
        }
        Some(_) => "The test rows were used for validation only.".to_owned(),
        None => {
            "On held-out rows: the cross-validation; `--test FILE` validates on separate data.".to_owned()
        }
    };
    text += &format!("{}\n{}\n", wrapped(&line, 0), wrapped(&behind(report), 0));
    text += &format!("{}\n", wrapped(&fitted_ranges(spec, report), 0));
    text += &extrapolation(report);
    text += &instruments(report);
    text += &known_distances(report);
    text += &(wrapped(&residuals(report), 0)
        + "
");
    if let Some(drift) = &report.drift {
        text += &format!(
            "{}
",
            wrapped(&drift.sentence, 0)
        );
    }
    text += &limits_and_outliers(spec, report);
    text
}

/// Lists the ranges of joints and inputs over the fitted rows, with the share of the joint limits.
fn fitted_ranges(spec: &Spec, report: &Report) -> String {
    let share = |fitted: &Fitted| {
        let Symbol::Variable(i) = fitted.symbol else { return String::new() };
        let [[from, to], [lower, upper]] = [fitted.range, spec.variables[i].limits];
        let share = (to - from) / (upper - lower);
        if share.is_finite() && upper - lower < f64::INFINITY {
            format!(" ({} of its limits)", percent(share, 1.0))
        } else {
            String::new()
        }
    };
    let range = |fitted: &Fitted| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        format!("{} {lower} … {upper}{}", spec.name_of(fitted.symbol), share(fitted))
    };
    let ranges: Vec<String> = report.found.fitted.iter().map(range).collect();
    format!("Fitted ranges: {}. Results beyond them are extrapolations.", ranges.join(", "))
}

/// Test rows beyond the ranges that were fitted, if there are any.
fn extrapolation(report: &Report) -> String {
    let mut text = String::new();
    if let Some(TestExtrapolation { rows, known_outside, known_within }) = report.outside {
        let mut line = format!(
            "{} outside the fitted ranges of joints and inputs",
            counted(rows, "test row is", "test rows are")
        );
        if let (Some(there), Some(within)) = (known_outside, known_within) {
            let ([there, within], length) = ([there, within].map(|value| digits(value, 2)), report.length);
            line += &format!(
                ": the standard deviation of the tool point is {there} {length} there, {within} \
                 {length} within the ranges (root mean squares). Errors that the model does not have \
                 are not included"
            );
        }
        line += ".";
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}

/// Compares the residuals with the uncertainty of the instrument.
pub(in crate::text) fn residuals(report: &Report) -> String {
    let mut parts = report.instruments.iter().chain(&report.coordinates).peekable();
    let estimated = parts.peek().is_some() && parts.all(|part| part.estimated);
    if estimated {
        return "The uncertainty of the instruments was estimated from the residuals, so the residuals cannot \
         show errors that the model does not have."
            .to_owned();
    }
    residual_verdict(report.uncertainty_factor, report.certainty.p_of_factor, "the model does not have", "")
}

/// States the result of the χ² test of residuals: `factor` of the stated uncertainty with the
/// probability `p`. `missing` names errors that a larger factor shows, `or` is another cause of a
/// smaller one.
pub(in crate::text) fn residual_verdict(factor: f64, p: f64, missing: &str, or: &str) -> String {
    let is_chance = p > 0.01;
    match factor {
        _ if is_chance => "The residuals agree with the stated uncertainty of the instrument.".to_owned(),
        _ if factor > 1.5 => format!(
            "The residuals are {} times the stated uncertainty of the instrument: the machine has \
             errors that {missing}.",
            digits(factor, 3)
        ),
        _ if factor > 1.0 => format!(
            "The residuals are {} times the stated uncertainty of the instrument, more than chance \
             explains: the machine has errors that {missing}, or the instrument is worse \
             than stated.",
            digits(factor, 3)
        ),
        _ => format!(
            "The residuals are {} times the uncertainty stated in the map: the instrument is \
             better than stated{or}.",
            digits(factor, 3)
        ),
    }
}

/// Limits that were declared, and rows that were left out.
fn limits_and_outliers(spec: &Spec, report: &Report) -> String {
    let mut text = String::new();
    if let Some(accepted) = &report.accepted {
        text += &format!("{}\n", wrapped(&accepted.sentence(spec.length), 0));
    }
    if !report.rejected.is_empty() {
        let line = format!(
            "Outliers left out: {} rows, lines {}.",
            report.rejected.len(),
            shown_lines(&report.rejected)
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}

/// States the number of configurations, and the gain over fitting base and tool alone.
fn behind(report: &Report) -> String {
    let configurations = |count: usize| match count {
        1 => "1 configuration".to_owned(),
        count => format!("{count} configurations"),
    };
    let mut behind = format!("{} of the fit", configurations(report.fit.configurations));
    if let Some(test) = &report.test {
        behind += &format!(", {} of the test", configurations(test.configurations));
    }
    let test = report.test.as_ref().map(|test| ("on the test rows", test.gain));
    let better = test.map_or(String::new(), |(place, gain)| {
        format!(" Compared with base and tool fitted, {place}: {}.", comparison(gain, report.length))
    });
    let factor = digits(report.certainty.factor_95, 3);
    let counted = match report.certainty.counted {
        "numbers" => "",
        "points" => " Visits of a configuration count as one.",
        _ => " All measurements at a configuration count as one.",
    };
    format!(
        "±: one standard error of the mean, from {behind}.{counted} The 95 % coverage factor of \
         standard deviations is {factor}.{better}"
    )
}

/// Compares two models with the p-value of the difference.
fn comparison(gain: Gain, unit: &str) -> String {
    let Some(error) = gain.standard_error else {
        return "not comparable: there is only one configuration".to_owned();
    };
    let by = format!("{} ± {} {unit}", digits(gain.mean.abs(), 3), digits(error, 2));
    let p = if gain.p < 1e-12 { "below 1e-12".to_owned() } else { digits(gain.p, 2) };
    match gain.p < 0.05 {
        true if gain.mean > 0.0 => format!("better by {by} (paired by configuration, p {p})"),
        true => format!("worse by {by} (paired by configuration, p {p})"),
        false => format!("no significant difference ({by}, p {p})"),
    }
}

/// Tabulates the uncertainty of each instrument, or of positions and rotations.
fn instruments(report: &Report) -> String {
    let parts = report.instruments.iter().chain(&report.coordinates);
    if parts.clone().next().is_none() {
        return String::new();
    }
    let mut table = Table::new(&["instrument", "numbers", "standard deviation", "", "residual / σ", ""]);
    for instrument in parts {
        let (unit, factor) = if instrument.unit == "rad" { ("mrad", 1e3) } else { (instrument.unit, 1.0) };
        table.row(vec![
            instrument.name.clone(),
            instrument.numbers.to_string(),
            digits(instrument.uncertainty * factor, 2),
            unit.to_owned(),
            digits(instrument.factor, 3),
            if instrument.estimated { "estimated" } else { "stated" }.to_owned(),
        ]);
    }
    format!("\n{}", table.right(&[1, 2, 4]))
}

/// Tabulates the known distances between instruments.
fn known_distances(report: &Report) -> String {
    if report.known_distances.is_empty() {
        return String::new();
    }
    let mut table = Table::new(&[
        "known distance between",
        "",
        "stated",
        "standard deviation",
        "found",
        "",
        "residual / σ",
    ]);
    for known in &report.known_distances {
        let [a, b] = &known.between;
        table.row(vec![
            a.clone(),
            b.clone(),
            digits(known.value, 7),
            digits(known.uncertainty, 2),
            digits(known.found, 7),
            report.length.to_owned(),
            fixed(known.residual, 2),
        ]);
    }
    format!("\n{}", table.right(&[2, 3, 4, 6]))
}

/// Tabulates the profiles of joints.
fn joint_profiles(spec: &Spec, profiles: &JointProfiles) -> String {
    let mut table =
        Table::new(&["joint profile", "range covered", "rms", "standard deviation", "", "error without it"]);
    for one in &profiles.joints {
        let [from, to] = one.range.map(|end| number::of_symbol(end, Symbol::Variable(one.variable), spec));
        let (factor, unit) = if one.unit == "rad" { (1e3, "mrad") } else { (1.0, one.unit) };
        let [rms, deviation] = [one.rms, one.standard_deviation].map(|value| digits(factor * value, 2));
        table.row(vec![
            one.joint.clone(),
            format!("{from} … {to}"),
            rms,
            deviation,
            unit.to_owned(),
            format!("× {}", fixed(one.without, 2)),
        ]);
    }
    let line = format!(
        "{} The last column is the factor of the cross-validation error (root mean square) without \
         this profile. The rows determine {} coefficients of the profiles.",
        profiles.sentence,
        fixed(profiles.effective, 0)
    );
    format!("{}{}\n", table.right(&[2, 3, 5]), wrapped(&line, 0))
}

fn terms(spec: &Spec, report: &Report) -> String {
    if report.terms.is_empty() {
        let line = format!(
            "None of {} additional terms was accepted: none lowers the cross-validation error by \
             half a percent and significantly.",
            report.tried
        );
        return wrapped(&line, 0) + "\n";
    }
    let decimals = number::error_decimals(spec.length);
    let mut table =
        Table::new(&["additional terms, in order of acceptance", "before", "after", "p of the test"]);
    for term in &report.terms {
        let p = if term.p < 1e-12 { "below 1e-12".to_owned() } else { digits(term.p, 2) };
        table.row(vec![term.name.clone(), fixed(term.before, decimals), fixed(term.after, decimals), p]);
    }
    let unit = spec.length.symbol();
    let line = format!(
        "Before and after: root mean square of a coordinate in cross-validation, {unit}. Of {} \
         groups of terms, one is accepted if it lowers this error and its p-value is significant \
         with the Bonferroni correction.",
        report.tried
    );
    let constant = report.cross_validation.constant.map_or(String::new(), |sizes| {
        format!(
            "Cross-validation, constants alone: mean {} {unit}; with these terms {} {unit}: {}.\n",
            fixed(sizes.mean, decimals),
            fixed(report.cross_validation.after.mean, decimals),
            report.cross_validation.gain.map_or(String::new(), |gain| comparison(gain, unit)),
        )
    });
    let constant = wrapped(constant.trim_end(), 0) + "\n";
    let lines = report.terms.iter().flat_map(|term| &term.lines);
    let lines: String = lines.map(|line| format!("  {}\n", line.replace('\n', ", "))).collect();
    let mut text =
        format!("{}{}\n{constant}As written to a spec\n{lines}", table.right(&[1, 2, 3]), wrapped(&line, 0));
    let unwritten: Vec<&str> =
        report.terms.iter().filter(|term| !term.written).map(|term| term.name.as_str()).collect();
    if !unwritten.is_empty() {
        let line = format!(
            "Specific to the rows of this file, so not written to a spec and not used for other \
             files: {}.",
            unwritten.join("; ")
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}
