//! Every error that was found, what acts alike, and how well each is known: `--full`.

use abbe_spec::Spec;
use abbe_study::identify::{Gain, Kind, Parameter, Report, Sizes, WeaklyDetermined, shown_lines};
use abbe_study::number::{self, counted, digits, fixed};

use super::super::{Table, alike, wrapped};

/// Returns what `abbe identify --full` prints, except what is written.
pub fn full_identification(spec: &Spec, report: &Report) -> String {
    let mut parts = vec![format!("{}: errors from measurements\n\n", spec.title)];
    for line in report.files.iter().flat_map(|file| file.lines()) {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    parts.push(known(report));
    parts.push(parameters(spec, report));
    parts.push(placed(spec, report));
    parts.push(errors(spec, report));
    if !report.terms.is_empty() || report.cross_validation.constant.is_some() {
        parts.push(terms(spec, report));
    }
    let notes = report.notes.iter().map(|note| wrapped(note, 0) + "\n").collect::<String>();
    if !notes.is_empty() {
        parts.push(notes);
    }
    parts.join("\n")
}

fn known(report: &Report) -> String {
    let mut text = format!(
        "What can be known: {} combinations of {} unknowns, {}\n",
        report.rank, report.unknowns, report.machine
    );
    text += &alike::table(&report.groups);
    if report.unexplained > 0 {
        let line = format!(
            "{} more combinations make no difference at these configurations: other ones would show them.",
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
    let mut text = format!("Errors of the machine, all others held at zero\n{table}");
    if !report.meanings.is_empty() {
        let sentences: String =
            report.meanings.iter().map(|meaning| format!("  {}\n", meaning.sentence)).collect();
        text +=
            &format!("The same in numbers of the chain, each in place of the error in brackets\n{sentences}");
    }
    if !report.magnitudes.is_empty() {
        let sentences: String =
            report.magnitudes.iter().map(|one| format!("{}\n", wrapped(&one.sentence, 2))).collect();
        text += &format!("Sources of the spec whose magnitude was to be found\n{sentences}");
    }
    if report.parameters.iter().any(|parameter| parameter.hardly_known) {
        let line = "Hardly known: the data say less of it than that it is small; `--prior` says how small.";
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

/// What was found of some of the unknowns.
pub(super) fn table(spec: &Spec, report: &Report, wanted: impl Fn(&Parameter) -> bool) -> Table {
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
        let remark = if parameter.hardly_known { "hardly known" } else { "" };
        table.row(vec![
            parameter.name.clone(),
            parameter.frame_name.clone().unwrap_or_default(),
            show(parameter.value),
            show(parameter.standard_deviation),
            unit.to_owned(),
            remark.to_owned(),
        ]);
    }
    table.right(&[2, 3])
}

/// Where the machine stands and what is mounted on its tool.
fn placed(spec: &Spec, report: &Report) -> String {
    let is_placed = |kind: Kind| kind != Kind::Machine;
    if !report.parameters.iter().any(|parameter| is_placed(parameter.kind)) {
        return "Where the machine stands and what is mounted on its tool is taken as the map has it.\n"
            .to_owned();
    }
    let words = "What acts alike before the first joint and where the machine stands is taken as where it stands; what acts \
                 alike behind the last joint and where targets are mounted, as where they are mounted. Neither is an error \
                 of the machine: it does not go into the spec and is not compensated.";
    format!(
        "Where the machine stands and what is mounted on its tool\n{}{}\n",
        table(spec, report, |parameter| is_placed(parameter.kind)),
        wrapped(words, 0)
    )
}

/// What is held because the data say less of it than was known before.
fn not_known(spec: &Spec, report: &Report) -> String {
    if report.not_known.is_empty() {
        return String::new();
    }
    let one = |not_known: &WeaklyDetermined| {
        let (unit, factor) = if not_known.unit == "rad" { ("mrad", 1e3) } else { (not_known.unit, 1.0) };
        let told = digits(not_known.told * factor, 2);
        format!(
            "{} (± {told} {unit}, expected ± {} {unit})",
            not_known.name,
            digits(not_known.expected * factor, 2)
        )
    };
    let all: Vec<String> = report.not_known.iter().map(one).collect();
    let line = format!(
        "Not known from these data: {}. The data alone would tell them to what stands first, which is no better than half of \
         what is expected: they are held at zero and not written. Other configurations, a target farther from the axes or a \
         finer instrument tell more: `abbe plan {}` says how much.",
        all.join(", "),
        spec.name
    );
    wrapped(&line, 0) + "\n"
}

/// How good the machine is as delivered, with base and tool fitted, and identified.
pub(super) fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let what = if report.instruments.is_empty() { "position error" } else { "error of a reading" };
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
        row(&format!("{set}: identified"), compared.rows, &compared.after);
        if set == "fit" {
            let name = format!("left out in turn, {} parts", report.cross_validation.folds);
            row(&name, compared.rows, &report.cross_validation.after);
        }
    }
    format!("How good it is, {}\n{}", spec.length.symbol(), table.right(&[1, 2, 3, 4, 5, 6]))
}

fn errors(spec: &Spec, report: &Report) -> String {
    let mut text = sizes(spec, report);
    let line = match &report.test {
        Some(_) if report.test_rows_of_the_fit > 0 => {
            report.on_train_test_overlap().map_or(String::new(), |said| said + ".")
        }
        Some(_) => "Nothing of the test rows was used to find or to choose anything.".to_owned(),
        None => {
            "On data it has not seen: the rows left out in turn; `--test FILE` judges on a file of its own."
                .to_owned()
        }
    };
    text += &format!("{}\n{}\n", wrapped(&line, 0), wrapped(&behind(report), 0));
    text += &outside(report);
    text += &instruments(report);
    text += &left(report);
    if let Some(order) = &report.order {
        text += &format!("{}\n", wrapped(&order.sentence, 0));
    }
    text += &judged(spec, report);
    text
}

/// Test rows beyond the ranges that were fitted, if there are any.
pub(super) fn outside(report: &Report) -> String {
    let mut text = String::new();
    if let Some(outside) = &report.outside {
        let [there, here] = [outside.known_outside, outside.known_within].map(|value| digits(value, 2));
        let line = format!(
            "{} outside the ranges of joints and inputs that were fitted: the place of the tool is known to {there} {} \
             there, to {here} {} at the rows that were fitted (one standard deviation, by what was found; errors that this \
             model has not grow unseen).",
            counted(outside.rows, "test row is", "test rows are"),
            report.length,
            report.length
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}

/// What is left against what the instrument explains.
pub(super) fn left(report: &Report) -> String {
    let factor = report.uncertainty_factor;
    let is_chance = report.certainty.p_of_factor > 0.001;
    let estimated = !report.instruments.is_empty() && report.instruments.iter().all(|told| told.estimated);
    let line = match factor {
        _ if estimated => "How good the instruments are was estimated from what is left: whether the machine has errors that \
                           this model has not, it cannot tell."
            .to_owned(),
        _ if is_chance => "What is left is what the instrument explains.".to_owned(),
        _ if factor > 1.5 => format!(
            "What is left is {} times what the instrument explains: the machine has errors that this model has not.",
            digits(factor, 3)
        ),
        _ if factor < 0.67 => format!(
            "What is left is {} times what the instrument's uncertainty in the map says: it is better than stated.",
            digits(factor, 3)
        ),
        _ => "What is left is what the instrument explains.".to_owned(),
    };
    wrapped(&line, 0) + "\n"
}

/// Limits that were declared, and rows that were left out.
pub(super) fn judged(spec: &Spec, report: &Report) -> String {
    let mut text = String::new();
    if let Some(accepted) = &report.accepted {
        text += &format!("{}\n", wrapped(&accepted.sentence(spec.length), 0));
    }
    if !report.rejected.is_empty() {
        let line = format!(
            "Left out as gross errors: {} rows, lines {}.",
            report.rejected.len(),
            shown_lines(&report.rejected)
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}

/// How many configurations stand behind the figures, and whether the machine is better than base and tool alone.
fn behind(report: &Report) -> String {
    let configurations = |count: usize| match count {
        1 => "1 configuration".to_owned(),
        count => format!("{count} configurations"),
    };
    let mut behind = format!("{} of the fit", configurations(report.fit.configurations));
    if let Some(test) = &report.test {
        behind += &format!(", {} of the test", configurations(test.configurations));
    }
    let judged = report.test.as_ref().map(|test| ("on the test rows", test.gain));
    let better = judged.map_or(String::new(), |(place, gain)| {
        format!(" Against base and tool fitted, {place}: {}.", comparison(gain, report.length))
    });
    let factor = digits(report.certainty.factor_95, 3);
    let counted = match report.certainty.counted {
        "numbers" => "",
        "points" => " Visits of a configuration count as one.",
        _ => " All that is measured at a configuration counts as one.",
    };
    format!(
        "±: one standard error of the mean. Behind these figures stand {behind}.{counted} Standard deviations times {factor} \
         hold with 95 %.{better}"
    )
}

/// Whether one model is better than another, and how sure that is.
pub(super) fn comparison(gain: Gain, unit: &str) -> String {
    let Some(error) = gain.standard_error else { return "one configuration cannot tell".to_owned() };
    let by = format!("{} ± {} {unit}", digits(gain.mean.abs(), 3), digits(error, 2));
    let p = if gain.p < 1e-12 { "below 1e-12".to_owned() } else { digits(gain.p, 2) };
    match gain.p < 0.05 {
        true if gain.mean > 0.0 => format!("better by {by} (configuration by configuration, p {p})"),
        true => format!("worse by {by} (configuration by configuration, p {p})"),
        false => format!("no difference that is more than chance ({by}, p {p})"),
    }
}

/// How good each instrument is, if they are read one by one.
pub(super) fn instruments(report: &Report) -> String {
    if report.instruments.is_empty() {
        return String::new();
    }
    let mut table =
        Table::new(&["instrument", "numbers", "standard deviation", "", "what is left, times that", ""]);
    for told in &report.instruments {
        let (unit, factor) = if told.unit == "rad" { ("mrad", 1e3) } else { (told.unit, 1.0) };
        table.row(vec![
            told.name.clone(),
            told.numbers.to_string(),
            digits(told.uncertainty * factor, 2),
            unit.to_owned(),
            digits(told.factor, 3),
            if told.estimated { "estimated" } else { "stated" }.to_owned(),
        ]);
    }
    format!("\n{}", table.right(&[1, 2, 4]))
}

pub(super) fn terms(spec: &Spec, report: &Report) -> String {
    if report.terms.is_empty() {
        let line = format!(
            "No richer term of {} earns its place: none makes rows that are left out fit better by half a percent and beyond chance.",
            report.tried
        );
        return wrapped(&line, 0) + "\n";
    }
    let decimals = number::error_decimals(spec.length);
    let mut table = Table::new(&["richer terms, as they came in", "before", "after", "p of the test"]);
    for term in &report.terms {
        let p = if term.p < 1e-12 { "below 1e-12".to_owned() } else { digits(term.p, 2) };
        table.row(vec![term.name.clone(), fixed(term.before, decimals), fixed(term.after, decimals), p]);
    }
    let unit = spec.length.symbol();
    let line = format!(
        "Before and after: root mean square of a coordinate on rows left out in turn, {unit}. Of {} groups of terms one is \
         taken in if that falls, and if p is so small that the best of all would hardly be so good by chance.",
        report.tried
    );
    let constant = report.cross_validation.constant.map_or(String::new(), |sizes| {
        format!(
            "Left out in turn, constants alone: mean {} {unit}; with these terms {} {unit}: {}.\n",
            fixed(sizes.mean, decimals),
            fixed(report.cross_validation.after.mean, decimals),
            report.cross_validation.gain.map_or(String::new(), |gain| comparison(gain, unit)),
        )
    });
    let constant = wrapped(constant.trim_end(), 0) + "\n";
    let lines = report.terms.iter().flat_map(|term| &term.lines);
    let lines: String = lines.map(|line| format!("  {}\n", line.replace('\n', ", "))).collect();
    let mut text =
        format!("{}{}\n{constant}As a spec reads\n{lines}", table.right(&[1, 2, 3]), wrapped(&line, 0));
    let unwritten: Vec<&str> =
        report.terms.iter().filter(|term| !term.written).map(|term| term.name.as_str()).collect();
    if !unwritten.is_empty() {
        let line = format!(
            "Of the rows of this file, not of the machine, and so in no spec that is written, and not counted on in other \
             files: {}.",
            unwritten.join("; ")
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text
}
