//! Positioning test: the characteristics of ISO 230-2, ISO 230-6 or ISO 230-4.

use abbe_metrology::positioning::{
    Characteristic, CircularPath, CircularResult, PositionResult, PositioningLine, Report, Unidirectional,
};
use abbe_spec::option::{READING_UNCERTAINTY, SCALE_UNCERTAINTY};
use abbe_study::number::digits;

use super::shared::accepted_by;
use crate::document::{Document, Section, Table, joined};
use crate::figures::deviations;

/// Describes the characteristics of a positioning test.
pub fn positioning(report: &Report) -> Document {
    let table = match (&report.lines[..], &report.circle) {
        (_, Some(circle)) => of_circle(circle, report.unit),
        ([line], _) if report.diagonals.is_none() => of_axis(line, report.unit),
        (lines, _) => of_diagonals(lines, report.unit),
    };
    let positions = report.lines.iter().map(|line| positions(report, line));
    let accepted = |verdict| accepted_by(verdict, |value| format!("{} {}", digits(value, 3), report.unit));
    let verdict = report.accepted.as_ref().map(accepted);
    Document {
        kind: if report.circle.is_some() { "Circular test" } else { "Positioning test" },
        machine: report.file.clone(),
        headline: verdict.as_ref().map_or_else(|| headline(report), |verdict| verdict.text.clone()),
        is_signed: verdict.is_some(),
        verdict,
        sections: vec![
            Section::answer().table(table).facts(facts(report)),
            Section::page("Figures").figures(deviations::scenes(report)),
            positions.fold(Section::full("Positions"), Section::table),
        ],
        ..Document::default()
    }
}

/// Returns the verdict: the characteristics that are quoted most.
fn headline(report: &Report) -> String {
    let unit = report.unit;
    let figures = report.figures().into_iter().filter(|(name, _)| *name != "M");
    let named =
        figures.filter_map(|(name, value)| Some(format!("{name} {} {unit}", digits(value?.value, 3))));
    let mut figures: Vec<String> = named.collect();
    let (standard, is_of_both) = match (&report.circle, &report.lines[..]) {
        (Some(circle), _) => ("ISO 230-4", circle.circularity.is_some()),
        (None, _) if report.diagonals.is_some() => ("ISO 230-6", true),
        (None, lines) => {
            ("ISO 230-2", lines.first().is_some_and(|line| line.evaluation.bidirectional.is_some()))
        }
    };
    match figures.first_mut() {
        None => figures.push("no direction has readings at every position".to_owned()),
        Some(first) if !is_of_both => first.insert_str(0, "one direction: "),
        Some(_) => {}
    }
    format!("{} ({standard})", joined(figures))
}

/// Formats a characteristic with its uncertainty.
fn shown(value: Option<Characteristic>) -> String {
    let Some(Characteristic { value, uncertainty }) = value else { return "-".to_owned() };
    let spread = uncertainty.map_or(String::new(), |uncertainty| format!(" ± {}", digits(uncertainty, 2)));
    digits(value, 3) + &spread
}

fn plain(value: f64) -> Option<Characteristic> {
    Some(Characteristic { value, uncertainty: None })
}

fn row(name: &str, both: Option<Characteristic>, sides: [Option<Characteristic>; 2]) -> [String; 4] {
    let [up, down] = sides.map(shown);
    [name.to_owned(), shown(both), up, down]
}

fn of_axis(PositioningLine { evaluation, .. }: &PositioningLine, unit: &str) -> Table {
    let both = evaluation.bidirectional.as_ref();
    let sides = [evaluation.forward.as_ref(), evaluation.reverse.as_ref()];
    let row = |name: &str, both, one: fn(&Unidirectional) -> Option<Characteristic>| {
        row(name, both, sides.map(|side| side.and_then(one)))
    };
    let none = |_: &Unidirectional| None;
    Table::new("", [unit, ">bidirectional", ">forward", ">reverse"]).rows([
        row("A   accuracy", both.and_then(|both| both.accuracy), |side| side.accuracy),
        row("E   systematic error", both.map(|both| both.systematic), |side| Some(side.systematic)),
        row("M   mean error", both.map(|both| both.mean), none),
        row("R   repeatability", both.and_then(|both| both.repeatability), |side| side.repeatability),
        row("B   reversal error", both.map(|both| both.reversal), none),
        row("B̄   mean reversal error", both.map(|both| both.mean_reversal), none),
    ])
}

fn of_diagonals(lines: &[PositioningLine], unit: &str) -> Table {
    let columns = ["diagonal", &format!(">E {unit}"), ">M", ">R", ">B"];
    Table::new("", columns).rows(lines.iter().map(|PositioningLine { name, evaluation }| {
        let both = evaluation.bidirectional.as_ref();
        [
            name.clone(),
            shown(both.map(|both| both.systematic)),
            shown(both.map(|both| both.mean)),
            shown(both.and_then(|both| both.repeatability)),
            shown(both.map(|both| both.reversal)),
        ]
    }))
}

fn of_circle(circle: &CircularResult, unit: &str) -> Table {
    let row = |name: &str, both, one: fn(&CircularPath) -> Option<Characteristic>| {
        row(name, both, [&circle.forward, &circle.reverse].map(|side| side.as_ref().and_then(one)))
    };
    Table::new("", [unit, ">both", ">counterclockwise", ">clockwise"]).rows([
        row("G   circular deviation", circle.circularity, |one| Some(one.circularity)),
        row("H   circular hysteresis", circle.hysteresis, |_| None),
        row("D   mean radial deviation", circle.mean, |_| None),
        row("F   largest radial deviation", None, |one| Some(one.largest)),
        row("F   smallest radial deviation", None, |one| Some(one.smallest)),
        row("asynchronous error motion", None, |one| plain(one.asynchronous?)),
        row("total error motion", None, |one| plain(one.total?)),
    ])
}

/// Tabulates every position of an axis or of a diagonal.
fn positions(report: &Report, PositioningLine { name, evaluation }: &PositioningLine) -> Table {
    let of = if name.is_empty() { String::new() } else { format!(" of diagonal {name}") };
    let caption = format!("Positions{of}, in {}; deviations in {}", report.position_unit, report.unit);
    let columns = [">P_i", ">x̄_i↑", ">s_i↑", ">x̄_i↓", ">s_i↓", ">x̄_i", ">B_i", ">R_i"];
    Table::new(caption, columns).rows(evaluation.positions.iter().map(|one| {
        let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| digits(value, 3));
        let [up, down] = [one.forward, one.reverse];
        [
            digits(one.position, 6),
            number(up.map(|up| up.mean)),
            number(up.and_then(|up| up.standard_deviation)),
            number(down.map(|down| down.mean)),
            number(down.and_then(|down| down.standard_deviation)),
            number(one.mean),
            number(one.reversal),
            number(one.repeatability),
        ]
    }))
}

/// Returns why characteristics are missing: approaches in one direction, or only one at a position.
fn missing(report: &Report) -> Option<String> {
    if let Some(CircularResult { circularity, hysteresis, .. }) = &report.circle {
        let is_missing = circularity.is_some() && hysteresis.is_none();
        return is_missing.then(|| "the directions have other angles: H needs both at each".to_owned());
    }
    let positions = || report.lines.iter().flat_map(|line| &line.evaluation.positions);
    let [forward, reverse] =
        [positions().any(|one| one.forward.is_some()), positions().any(|one| one.reverse.is_some())];
    let one_sided = positions().find(|one| one.forward.is_some() != one.reverse.is_some());
    if let Some(one) = one_sided.filter(|_| forward && reverse) {
        let side = if one.forward.is_none() { "below" } else { "above" };
        return Some(format!(
            "position {} {} has no approach from {side}: there are no characteristics of both directions",
            digits(one.position, 6),
            report.position_unit
        ));
    }
    let is_single = |one: &PositionResult| {
        [one.forward, one.reverse].into_iter().flatten().any(|own| own.standard_deviation.is_none())
    };
    positions().find(|one| is_single(one)).map(|one| {
        format!(
            "position {} {} has a single approach in a direction: A and R need two or more",
            digits(one.position, 6),
            report.position_unit
        )
    })
}

/// Returns the facts about the runs and the uncertainty.
fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let targets: Vec<usize> = report.lines.iter().map(|line| line.evaluation.positions.len()).collect();
    let all = || report.lines.iter().flat_map(|line| &line.evaluation.positions).map(|one| one.position);
    let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let range = |[least, most]: [usize; 2]| match least == most {
        true => least.to_string(),
        false => format!("{least} to {most}"),
    };
    let positions = [targets.iter().min(), targets.iter().max()].map(|one| one.copied().unwrap_or_default());
    let mut facts = vec![(
        "Runs",
        format!(
            "{} {} from {} to {} {}, {} {} in each direction",
            range(positions),
            if report.circle.is_some() { "angles" } else { "target positions" },
            digits(least, 6),
            digits(most, 6),
            report.position_unit,
            range(report.approaches),
            ["approaches", "approach", "readings", "reading"]
                [2 * usize::from(report.circle.is_some()) + usize::from(report.approaches == [1, 1])]
        ),
    )];
    facts.extend(missing(report).map(|missing| ("Missing", missing)));
    let of_scale = |scale: Option<f64>| match scale.map(|scale| digits(scale, 3)) {
        _ if report.circle.is_some() => String::new(),
        None => format!(" and `{SCALE_UNCERTAINTY}`"),
        Some(scale) => format!(", {scale} {}/{} of the scale", report.unit, report.position_unit),
    };
    facts.push((
        "±",
        match report.instrument {
            None => format!(
                "not known: state that of the instrument by `{READING_UNCERTAINTY}`{}",
                of_scale(None)
            ),
            Some([reading, scale]) => format!(
                "expanded uncertainty, k = 2, to first order: {} {} of a reading{} (standard uncertainties)",
                digits(reading, 3),
                report.unit,
                of_scale(Some(scale)),
            ),
        },
    ));
    facts
}
