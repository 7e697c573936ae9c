//! Parts that several views have.

use abbe::LengthUnit;
use abbe_metrology::data::{Base, Layout, Map, Summary};
use abbe_metrology::identify::ResidualDrift;
use abbe_metrology::{AcceptanceVerdict, Decision, Judged, LimitCheck};
use abbe_spec::{Spec, option::NamedOption};
use abbe_study::Extrapolation;
use abbe_study::dead_point::DeadPoint;
use abbe_study::number::{self, digits, length, percent, quantity, short, unbroken};

use crate::document::{Section, Verdict, first, joined};

/// Rows of a file that the first screen names, one of which is the number of rows.
const ROWS: usize = 3;
/// Number of values of a configuration that are shown.
const NAMED: usize = 12;
/// Notes on the first screen.
pub(super) const NOTES: usize = 2;

/// Returns where one joint reaches a dead point alone.
pub(super) fn dead_point(point: Option<&DeadPoint>, spec: &Spec) -> String {
    let kind = |name: &str| spec.variables.iter().find(|variable| variable.name == name);
    point.and_then(|point| Some((kind(&point.joint)?, point))).map_or(
        "none for a joint that moves alone from home within its limits".to_owned(),
        |(variable, point)| {
            let distance = number::of_variable(point.distance, variable.kind, spec.length);
            format!("{}, {distance} from home", number::variable_is(variable, point.value, spec))
        },
    )
}

/// Formats a p-value.
pub(super) fn p_value(p: f64) -> String {
    if p < 1e-12 { "below 1e-12".to_owned() } else { digits(p, 2) }
}

/// States the verdict on a machine or its model.
pub(super) fn accepted(verdict: &AcceptanceVerdict, unit: LengthUnit) -> Verdict {
    accepted_by(verdict, |value| length(value, unit))
}

/// States a verdict with figures that `shown` formats.
pub(super) fn accepted_by(verdict: &AcceptanceVerdict, shown: impl Fn(f64) -> String) -> Verdict {
    let limit = |limit: &LimitCheck| {
        let [value, most] = [limit.value, limit.limit].map(&shown);
        let known = match limit.uncertainty {
            0.0 => String::new(),
            uncertainty => format!(" ± {}", shown(uncertainty)),
        };
        let more = match limit.decision {
            Decision::Accepted => "",
            Decision::Undecided => ", too near to it",
            Decision::Rejected => ", exceeded",
        };
        format!("{} {value}{known} (limit {most}){more}", limit.figure)
    };
    let (rows, limits) = (verdict.rows, verdict.limits.iter().map(limit).collect::<Vec<_>>().join("; "));
    let words = match (verdict.judged, verdict.decision) {
        (Judged::Model, Decision::Accepted) => format!("The model agrees with {rows}"),
        (Judged::Model, _) => format!("The model does not agree with {rows}"),
        (_, Decision::Accepted) => format!("Accepted on {rows}"),
        (_, Decision::Undecided) => format!("Neither accepted nor rejected on {rows}"),
        (_, Decision::Rejected) => format!("Not accepted on {rows}"),
    };
    let how = match verdict.judged {
        Judged::Model => "",
        Judged::Machine => ", as built",
        Judged::Corrected => ", with corrected commands",
    };
    Verdict { is_met: verdict.is_met(), text: format!("{words}{how}: {limits}.") }
}

/// Returns the facts about data files: their rows, and the first of those that cannot be used.
pub(super) fn first_rows(files: &[Summary]) -> Vec<(&'static str, String)> {
    let of_file = |file: &Summary| {
        let names = std::iter::once("Data").chain(std::iter::repeat(""));
        let lines = file.lines().into_iter().take(ROWS);
        names.zip(lines).map(|(name, line)| (name, line.trim().to_owned())).collect::<Vec<_>>()
    };
    files.iter().flat_map(of_file).collect()
}

/// Lists the rows of data files that cannot be used, if the first screen does not name them all.
pub(super) fn data_rows(files: &[Summary]) -> Section {
    let lines: Vec<String> =
        files.iter().filter(|file| file.lines().len() > ROWS).flat_map(Summary::lines).collect();
    Section::full("Rows").list("unusable_rows", "", lines)
}

/// Returns the first notes as facts.
pub(super) fn first_notes(notes: &[String]) -> Vec<(&'static str, String)> {
    some("Note", notes, NOTES)
}

/// Lists notes, if there are more than the first screen shows.
pub(super) fn notes(notes: &[String], shown: usize) -> Section {
    let all = if notes.len() > shown { notes } else { &[] };
    Section::full("Notes").list("notes", "", all.iter().map(|note| plain(note)).collect())
}

fn plain(note: &str) -> String {
    note.strip_prefix("note: ").unwrap_or(note).to_owned()
}

/// States the result of the χ² test of residuals: `factor` of the stated uncertainty with the
/// probability `p`. `missing` names errors that a larger factor shows, `or` is another cause of a
/// smaller one.
pub(super) fn residual_verdict(factor: f64, p: f64, missing: &str, or: &str) -> String {
    let times = digits(factor, 3);
    match factor {
        _ if p > 0.01 => "The residuals agree with the stated uncertainty of the instrument.".to_owned(),
        _ if factor > 1.5 => format!(
            "The residuals are {times} times the stated uncertainty of the instrument: the machine has \
             errors that {missing}."
        ),
        _ if factor > 1.0 => format!(
            "The residuals are {times} times the stated uncertainty of the instrument, more than chance \
             explains: the machine has errors that {missing}, or the instrument is worse than stated."
        ),
        _ => format!(
            "The residuals are {times} times the uncertainty stated in the map: the instrument is \
             better than stated{or}."
        ),
    }
}

/// States the drift of residuals: the first clause, and the rest.
pub(super) fn drift_clauses(drift: &ResidualDrift, unit: LengthUnit) -> [String; 2] {
    let lag = digits(drift.found.lag_1, 2);
    let what = match drift.found.follows {
        "distance" => "their distance".to_owned(),
        axis => format!("along {axis}"),
    };
    let by = length(drift.found.change.abs(), unit);
    let [first, last] = drift.found.ends.map(|end| length(end, unit));
    let ends = format!("Mean error of the first tenth of the rows {first}, of the last {last}.");
    let [summary, rest] = match (drift.is_drift, drift.found.settling) {
        (true, Some(share)) => [
            format!(
                "The residuals may settle with time, {what} by {by} with a time constant of {} of the run",
                percent(share, 1.0)
            ),
            format!(
                "; the machine may be warming up, or a mounting settling. {ends} Measure when the machine \
                 is warm, or leave the first rows out."
            ),
        ],
        (true, None) => [
            format!("The residuals may drift with time, {what} by {by} from the first row to the last"),
            format!(". {ends}"),
        ],
        (false, _) if drift.found.p_of_lag_1 <= drift.false_alarms => [
            format!("The residuals show no drift, but successive rows are correlated ({lag})"),
            ": the machine may have errors that the model does not have and that change slowly along the \
             measured path. Standard deviations may be too small."
                .to_owned(),
        ],
        _ => {
            return ["The residuals show no drift with the order of the rows", "."].map(str::to_owned);
        }
    };
    let test = format!(
        " Correlation of successive rows {lag} (permutation test, false-alarm rate 1 in {:.0}).",
        1.0 / drift.false_alarms
    );
    [summary, rest + &test]
}

/// Returns the facts about the instrument and what it measures.
pub(super) fn instrument(spec: &Spec, map: &Map) -> Vec<(&'static str, String)> {
    let angle = format!(" and {} mrad", short(map.uncertainty.angle * 1e3));
    let uncertainty = match &map.layout {
        Layout::Instruments(_) => "see each instrument".to_owned(),
        _ => format!(
            "{}{} (one standard deviation)",
            quantity(map.uncertainty.length, spec.length.symbol()),
            if matches!(map.layout, Layout::Pose(..)) { &angle } else { "" }
        ),
    };
    let base = match map.base {
        Base::Known => "in F_0, up to small errors",
        Base::Unknown => "fitted",
        Base::Exact => "exactly in F_0",
    };
    let measured = match &map.layout {
        Layout::Point(..) => "the tool point".to_owned(),
        Layout::Difference(..) => "the tool point, as target − actual".to_owned(),
        Layout::Targets(targets) => format!("{} targets", targets.len()),
        Layout::Pose(..) => "position and orientation of the tool".to_owned(),
        Layout::Instruments(all) => joined(all.list.iter().map(|instrument| instrument.name.as_str())),
    };
    vec![
        ("Instrument", map.title.clone()),
        ("Uncertainty", uncertainty),
        ("Measured", measured),
        ("Stands", base.to_owned()),
        ("Map", map.path().to_owned()),
    ]
}

/// Returns the number of rows outside the fitted ranges.
pub(super) fn extrapolated(rows: &Extrapolation) -> String {
    format!("{} of {} rows are outside the identified ranges", rows.count, rows.all)
}

/// Returns the first texts under one name, and the number of the others.
pub(super) fn some(name: &'static str, texts: &[String], shown: usize) -> Vec<(&'static str, String)> {
    let mut facts: Vec<_> = texts.iter().take(shown).map(|text| (name, plain(text))).collect();
    if texts.len() > shown {
        facts.push(("", format!("… and {} more", texts.len() - shown)));
    }
    facts
}

/// Returns the fact of the changes by options; none without changes.
pub(super) fn changed(changes: &[NamedOption]) -> Vec<(&'static str, String)> {
    let options: Vec<String> = changes.iter().map(NamedOption::to_string).collect();
    if options.is_empty() { Vec::new() } else { vec![("Changed", options.join(" "))] }
}

/// Returns a configuration with at most [`NAMED`] of its values.
pub(super) fn place(label: &str) -> String {
    let values: Vec<&str> = label.split(", ").collect();
    format!("at {}", unbroken(&first(&values, NAMED)))
}
