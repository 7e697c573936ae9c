//! What comes out, on a page: how good it is, what was found, what cannot be known, and what to do.

use abbe_spec::Spec;
use abbe_study::identify::{JointError, Kind, Parameter, Report, Sizes, TermGain};
use abbe_study::number::{digits, error_decimals, fixed};

use super::super::{Table, wrapped};
use super::full::{self, comparison, instruments, judged, left, outside, sizes, table};

/// How many errors, sentences and terms are shown.
const SHOWN: usize = 6;

/// Returns what `abbe identify` prints, except what is written.
pub fn identification(spec: &Spec, report: &Report) -> String {
    let mut head = format!("{}: errors from measurements\n{}", spec.title, answer(spec, report));
    for line in report.files.iter().flat_map(|file| file.lines()) {
        head += &format!("{}\n", wrapped(&line, 2));
    }
    let mut parts = vec![head, good(spec, report), found(spec, report)];
    if !report.terms.is_empty() || report.cross_validation.constant.is_some() {
        parts.push(terms(spec, report));
    }
    parts.push(not_known(report));
    let notes = report.notes.iter().map(|note| wrapped(note, 0) + "\n").collect::<String>();
    if !notes.is_empty() {
        parts.push(notes);
    }
    parts.join("\n")
}

/// The answer: how good it is on rows that it has not seen.
fn answer(spec: &Spec, report: &Report) -> String {
    let unit = spec.length.symbol();
    let what = if report.instruments.is_empty() { "The tool point" } else { "A reading" };
    let of = |sizes: &Sizes| fixed(sizes.mean, error_decimals(spec.length));
    let line = match &report.test {
        Some(test) => format!(
            "{what} is off by {} {unit} on average on the {} test rows; by {} with base and tool fitted alone, by {} as \
             delivered.",
            of(&test.after),
            test.rows,
            of(&test.base_and_tool),
            of(&test.before)
        ),
        None => format!(
            "{what} is off by {} {unit} on average on rows left out in turn; on all rows by {} with base and tool fitted alone, \
             by {} as delivered.",
            of(&report.cross_validation.after),
            of(&report.fit.base_and_tool),
            of(&report.fit.before)
        ),
    };
    wrapped(&line, 0) + "\n\n"
}

fn good(spec: &Spec, report: &Report) -> String {
    let mut text = sizes(spec, report);
    let factor = digits(report.certainty.factor_95, 3);
    let test = report.test.as_ref();
    let better = test.map_or(String::new(), |test| {
        format!(" Against base and tool fitted, on the test rows: {}.", comparison(test.gain, report.length))
    });
    let line = format!(
        "±: one standard error of the mean. Standard deviations times {factor} hold with 95 %.{better}"
    );
    if let Some(said) = report.on_train_test_overlap() {
        text += &format!("{}\n", wrapped(&(said + "."), 0));
    }
    text += &format!("{}\n{}{}", wrapped(&line, 0), outside(report), instruments(report));
    text += &left(report);
    if let Some(order) = &report.order {
        text += &format!("{}\n", wrapped(&order.sentence, 0));
    }
    text + &judged(spec, report)
}

/// How many standard deviations a value is from nothing.
fn sure(value: f64, standard_deviation: f64) -> f64 {
    value.abs() / standard_deviation.max(f64::MIN_POSITIVE)
}

/// The errors that are surest, and what they are in numbers of the chain.
fn found(spec: &Spec, report: &Report) -> String {
    let machine = report.parameters.iter().filter(|parameter| parameter.kind == Kind::Machine);
    let of = |parameter: &Parameter| sure(parameter.value, parameter.standard_deviation);
    let mut surest: Vec<f64> = machine.map(of).collect();
    surest.sort_by(|a, b| b.total_cmp(a));
    let count = surest.len();
    let least = surest.get(SHOWN - 1).copied().unwrap_or(0.0);
    let shown = table(spec, report, |parameter| parameter.kind == Kind::Machine && of(parameter) >= least);
    let mut text = match count {
        0..=SHOWN => format!("What was found, all others held at zero\n{shown}"),
        _ => format!(
            "What was found: of {count} errors those that are farthest from nothing, by their deviations\n{shown}"
        ),
    };
    let mut meanings: Vec<&JointError> = report.meanings.iter().collect();
    let of = |meaning: &JointError| sure(meaning.value, meaning.standard_deviation);
    meanings.sort_by(|a, b| of(b).total_cmp(&of(a)));
    let meanings: Vec<String> = meanings.into_iter().map(|meaning| meaning.sentence.clone()).collect();
    if !meanings.is_empty() {
        text += &format!("The same in numbers of the chain\n{}", few(&meanings));
    }
    let magnitudes: Vec<String> = report.magnitudes.iter().map(|one| one.sentence.clone()).collect();
    if !magnitudes.is_empty() {
        text += &format!("Sources of the spec whose magnitude was to be found\n{}", few(&magnitudes));
    }
    text
}

/// The first of some sentences, and how many more there are.
fn few(sentences: &[String]) -> String {
    let shown: String =
        sentences.iter().take(SHOWN).map(|sentence| format!("  {}\n", wrapped(sentence, 4))).collect();
    match sentences.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown}  … and {more} more\n"),
    }
}

fn terms(spec: &Spec, report: &Report) -> String {
    if report.terms.is_empty() {
        return full::terms(spec, report);
    }
    let decimals = error_decimals(spec.length);
    let mut table = Table::new(&["richer terms, as they came in", "before", "after"]);
    for TermGain { name, before, after, .. } in report.terms.iter().take(SHOWN) {
        table.row(vec![name.clone(), fixed(*before, decimals), fixed(*after, decimals)]);
    }
    let more = match report.terms.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!("  … and {more} more\n"),
    };
    let line = format!(
        "{} of {} groups of terms were taken in: root mean square of a coordinate on rows left out in turn, {}.",
        report.terms.len(),
        report.tried,
        spec.length.symbol()
    );
    let unwritten: Vec<&str> =
        report.terms.iter().filter(|term| !term.written).map(|term| term.name.as_str()).collect();
    let unwritten = match unwritten.is_empty() {
        true => String::new(),
        false => format!(
            " Of this file, not of the machine, and in no spec that is written: {}.",
            unwritten.join("; ")
        ),
    };
    format!("{}{more}{}\n", table.right(&[1, 2]), wrapped(&(line + &unwritten), 0))
}

/// How much cannot be known, and where it stands.
fn not_known(report: &Report) -> String {
    let mut line = format!(
        "What can be known: {} combinations of {} unknowns, {}.",
        report.rank, report.unknowns, report.machine
    );
    let counts = [
        (report.groups.len(), "act as others do or cannot be seen"),
        (report.unexplained, "make no difference at these configurations"),
        (report.not_known.len(), "are told too badly by these data, and held at zero"),
        (report.correlations.len(), "pairs of those that were found are correlated by more than 0.9"),
        (
            report.parameters.iter().filter(|one| one.hardly_known).count(),
            "are known by `--prior` rather than by the data",
        ),
    ];
    let counts: Vec<String> = counts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if !counts.is_empty() {
        line += &format!(" {}.", counts.join("; "));
    }
    line += " The same command with `--full` lists all of this, with every error; `--json` has the numbers.";
    wrapped(&line, 0) + "\n"
}
