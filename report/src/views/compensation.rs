//! Compensation: how many commands are corrected, and the error before and after.

use abbe::{Class, Description, VariableKind};
use abbe_metrology::compensate::{NormStatistics, Report, RowSummary};
use abbe_metrology::data::Map;
use abbe_spec::{Spec, option::WEIGHT_ONE_METRE};
use abbe_study::number::{NO_BREAK, counted, error_decimals, error_unit, fixed, length, short, visible};

use super::shared::{data_rows, extrapolated, first_rows};
use crate::document::{Card, Document, Section, Table, Verdict, joined};
use crate::figures::distances;

/// Number of reasons on the first screen.
const REASONS: usize = 4;
/// Number of reasons in a full report.
const LISTED: usize = 100;

/// Describes corrected commands; `spec` and `map` are those of the job, and `machine` is the
/// description of its manipulator.
pub fn compensation(spec: &Spec, machine: &Description, map: &Map, report: &Report) -> Document {
    let within = length(report.tolerance, machine.length);
    let (done, all) = (report.compensated, report.total_rows());
    let is_corrected = has_sources(machine) || report.of_poses || done < all;
    Document {
        kind: "Corrected commands",
        machine: machine.title.to_string(),
        title: map.title.clone(),
        headline: match is_corrected {
            true => format!("{done} of {all} commands corrected to within {within}"),
            false => format!("nothing to correct in {all} commands"),
        },
        verdict: Some(Verdict {
            is_met: report.complete(),
            text: match is_corrected {
                true => format!("{done} of {all} commands corrected"),
                false => "The spec has no errors to correct".to_owned(),
            },
        }),
        panel: "Errors at a command",
        sections: vec![
            Section::answer().table(errors(report)).facts(facts(machine, report)),
            Section::page("").cards(cards(spec, report)),
            Section::page("Figures").figures(distances::scenes(report, spec)),
            about(machine, report),
            Section::full("Corrected commands").table(commands(machine, report)),
            Section::full("Rows not corrected").list("reasons", "", failed(report)),
            data_rows(std::slice::from_ref(&report.file)),
        ],
        is_signed: false,
        record: report.record.clone(),
    }
}

/// Returns whether there is anything to compensate.
fn has_sources(machine: &Description) -> bool {
    machine.sources.iter().any(|source| source.class == Class::Repeatable)
}

fn errors(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let columns = ["tool point", &format!(">mean {unit}"), ">rms", ">max", ">max orientation mrad"];
    let row = |(name, size): (&str, &NormStatistics)| {
        let [mean, rms, max] = [size.mean, size.rms, size.max].map(|value| visible(factor * value, 4));
        [name.to_owned(), mean, rms, max, visible(1e3 * size.angle_max, 4)]
    };
    let mut table = Table::new("", columns)
        .rows([("as commanded", &report.before), ("corrected", &report.after)].map(row));
    if let Some(deviation) = report.deviation {
        let sigma = visible(factor * deviation, 4);
        table.row(["known to (1 σ)".to_owned(), String::new(), sigma, String::new(), String::new()]);
    }
    table
}

fn facts(machine: &Description, report: &Report) -> Vec<(&'static str, String)> {
    let mut facts = Vec::new();
    if !has_sources(machine) {
        let nothing = "the spec has no repeatable source: there is nothing to compensate";
        facts.push(("Sources", nothing.to_owned()));
    }
    let RowSummary { failed, reasons, far, farthest, .. } = &report.row_summary;
    let names = std::iter::once("Failed").chain(std::iter::repeat(""));
    let reasons = reasons.iter().take(REASONS).map(|(line, reason)| format!("line {line}: {reason}"));
    facts.extend(names.zip(reasons));
    if *failed > REASONS {
        facts.push(("", format!("… and {} more rows not corrected", failed - REASONS)));
    }
    if let Some((line, turn)) = farthest {
        let rows = counted(*far, "row", "rows");
        let text = format!(
            "{rows} with a joint more than {}° from its command; largest {:.0}° (line {line}): review \
             before use",
            RowSummary::FAR,
            turn.to_degrees()
        );
        facts.push(("Far", text));
    }
    if let Some((line, angles)) = &report.row_summary.most_turned {
        let rows = counted(report.row_summary.turned, "row", "rows");
        let [before, after] = angles.map(|angle| visible(1e3 * angle, 4));
        let priority = match report.weight {
            None => format!(
                "The position of the tool point has priority; `{WEIGHT_ONE_METRE}` weighs 1 rad as 1 m"
            ),
            Some(weight) => format!("1 rad weighs as {}", length(weight, machine.length)),
        };
        let text = format!(
            "the orientation of {rows} is farther off than without correction, most in line {line}: {after} \
             mrad, {before} before. {priority}"
        );
        facts.push(("Turned", text));
    }
    if !report.held.is_empty() {
        let names = joined(report.held.iter().map(String::as_str));
        let text = format!("{names}, as in the map: columns for them there would let them correct, too");
        facts.push(("Held", text));
    }
    if report.mobility < 6 {
        let text = format!(
            "the joints move the tool in {} of 6 degrees of freedom{}",
            report.mobility,
            if report.weight.is_none() { "; position has priority" } else { "" }
        );
        facts.push(("Freedom", text));
    }
    facts.extend(report.extrapolated.iter().map(|rows| ("Outside", extrapolated(rows))));
    facts.extend(first_rows(std::slice::from_ref(&report.file)));
    facts
}

fn cards(spec: &Spec, report: &Report) -> Vec<Card> {
    let (factor, unit) = error_unit(report.length);
    let card = |name, size: &NormStatistics, known: &str| Card {
        name,
        value: format!("{} {unit}", visible(factor * size.mean, 4)),
        note: format!("mean; maximum {} {unit}{known}", visible(factor * size.max, 4)),
    };
    let known =
        report.deviation.map(|sigma| format!("; known to {} {unit} (1 σ)", visible(factor * sigma, 4)));
    let corrected = card("Corrected", &report.after, &known.unwrap_or_default());
    let tolerance = Card {
        name: "Tolerance",
        value: length(report.tolerance, spec.length),
        note: "largest error allowed at the tool point".to_owned(),
    };
    vec![card("As commanded", &report.before, ""), corrected, tolerance]
}

/// States what corrected means, and what corrections cover.
fn about(machine: &Description, report: &Report) -> Section {
    let turn = match report.mobility {
        0..6 => String::new(),
        _ => format!(" and {}{NO_BREAK}mrad", short(1e3 * report.tolerance * machine.length.in_metres())),
    };
    let tolerance = length(report.tolerance, machine.length);
    let cover = "Corrections cover the errors of the machine in its frame F_0, not the placement of the \
                 instrument or of targets.";
    Section::full("Corrections")
        .state(
            "tolerance",
            format!("Corrected: the remaining error of the tool point is at most {tolerance}{turn}."),
        )
        .state("cover", cover.to_owned())
        .state("extrapolated", report.extrapolated.as_ref().map(|rows| rows.sentence.clone()))
}

/// Tabulates the first rows.
fn commands(machine: &Description, report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let variables = machine.variables.iter().map(|variable| {
        let unit = if variable.kind == VariableKind::Revolute { "°" } else { report.length };
        format!(">{} ({unit})", variable.name)
    });
    let [line, before, after] = [">line", ">before", ">after"].map(str::to_owned);
    let columns: Vec<String> = [line].into_iter().chain(variables).chain([before, after]).collect();
    let first = &report.row_summary.first;
    let rows = first.iter().map(|row| {
        let values = machine.variables.iter().zip(&row.q.0).map(|(variable, (_, value))| {
            variable.kind.either(fixed(value.to_degrees(), 4), fixed(*value, error_decimals(machine.length)))
        });
        let left = [row.before.length, row.after.length].map(|value| visible(factor * value, 4));
        std::iter::once(row.line.to_string()).chain(values).chain(left).collect()
    });
    let caption = format!("Before and after: error of the tool point ({unit})");
    let mut table = Table::listing(caption, &columns, rows.collect());
    table.rest = match report.row_summary.rows - first.len() {
        0 => String::new(),
        more => format!("… and {more} more"),
    };
    table
}

/// Lists the reasons of rows that are not corrected, if the first screen does not have them all.
fn failed(report: &Report) -> Vec<String> {
    let all = report.rows.iter().filter_map(|row| Some((row.line, row.reason.as_ref()?)));
    let all: Vec<String> = all.map(|(line, reason)| format!("line {line}: {reason}")).collect();
    match all.len() {
        0..=REASONS => Vec::new(),
        count if count > LISTED => {
            let more = format!("… and {} more", count - LISTED);
            all.into_iter().take(LISTED).chain([more]).collect()
        }
        _ => all,
    }
}
