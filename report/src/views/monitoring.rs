//! Monitoring: alarm or not, what changed, and the charts nearest to their limits.

use abbe_metrology::data::Map;
use abbe_metrology::monitor::{Chart, Finding, Report};
use abbe_spec::{Spec, option::SINCE};
use abbe_study::number::{digits, fixed, percent, trimmed};

use super::shared::instrument;
use crate::document::{Card, Document, Section, Table, Verdict, first, joined};
use crate::figures::charts;
use crate::unit::angle_in_mrad;

/// Number of charts on the first screen.
const SHOWN: usize = 5;
/// Number of charts in a full report.
const LISTED: usize = 12;
/// Number of indistinguishable errors named.
const NAMED: usize = 4;

/// Describes a monitored machine; `spec` and `map` are those of the job.
pub fn monitoring(spec: &Spec, map: &Map, report: &Report) -> Document {
    let alarm = report.alarm.as_ref();
    let headline = alarm.map_or("no alarm".to_owned(), |alarm| format!("ALARM at {}", alarm.date));
    let configurations = report.configurations;
    let count = report.charts.len() + 1;
    let facts = vec![("Charts", format!("{count}, from {configurations} configurations in each check"))];
    let files = report.files.iter().filter(|file| !file.unusable.is_empty());
    Document {
        kind: "Monitored",
        machine: spec.title.clone(),
        title: report.title.clone(),
        headline: format!("{headline}, {} checks", report.dates.len()),
        verdict: Some(Verdict {
            is_met: alarm.is_none(),
            text: if alarm.is_none() { "No alarm" } else { "Alarm: the machine has changed" }.to_owned(),
        }),
        panel: "Residuals at a configuration",
        sections: vec![
            findings(report).table(nearest(report)).facts(facts),
            Section::page("").cards(cards(report)),
            Section::page("Figures").figures(charts::scenes(report)),
            Section::full("Charts").table(charts(report)).state("not_observable", not_observable(report)),
            watched(report),
            Section::page("Instrument").facts(instrument(spec, map)),
            Section::full("Rows").list("unusable_rows", "", files.flat_map(|file| file.lines()).collect()),
        ],
        is_signed: false,
        record: report.record.clone(),
    }
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or_default()
}

fn last_check(report: &Report) -> usize {
    report.dates.len().saturating_sub(1)
}

/// Formats the last value of a chart, its unit, and the check of its alarm.
fn values(report: &Report, chart: &Chart) -> [String; 4] {
    let (factor, unit) = angle_in_mrad(chart.unit);
    let alarm = chart.alarm.map_or(String::new(), |check| report.dates[check].clone());
    [
        digits(factor * last(&chart.values), 3),
        unit.to_owned(),
        percent(chart.share(last_check(report)), 1.0),
        alarm,
    ]
}

fn nearest(report: &Report) -> Table {
    let columns = ["chart", ">last value", "", ">of the limit", "alarm"];
    let shown = report.nearest_first().into_iter().take(SHOWN).chain([&report.left]);
    Table::new("", columns).rows(shown.map(|chart| {
        let [value, unit, share, alarm] = values(report, chart);
        [chart.name.clone(), value, unit, share, alarm]
    }))
}

/// Tabulates the charts with the errors that each stands for.
fn charts(report: &Report) -> Table {
    let columns = ["error", "indistinguishable from", ">last value", "", ">of the limit", "alarm"];
    let all = report.nearest_first();
    let hidden = all.len().saturating_sub(LISTED);
    let shown = all.into_iter().take(LISTED).chain([&report.left]);
    let caption = "Of the limit: the last check, or the weighted average of the chart";
    let mut table = Table::new(caption, columns).rows(shown.map(|chart| {
        let [value, unit, share, alarm] = values(report, chart);
        [chart.name.clone(), first(&chart.indistinguishable, NAMED), value, unit, share, alarm]
    }));
    if hidden > 0 {
        table.rest = format!("… and {hidden} more, nearer to zero");
    }
    table
}

/// Names the errors that the checks cannot show.
fn not_observable(report: &Report) -> Option<String> {
    (!report.unseen.is_empty()).then(|| {
        format!(
            "Not observable, because indistinguishable from the station or without effect on the \
             measurements: {}.",
            joined(&report.unseen)
        )
    })
}

fn cards(report: &Report) -> Vec<Card> {
    let span = match &report.dates[..] {
        [first, .., last] => format!("{first} to {last}"),
        dates => dates.concat(),
    };
    let checks = Card { name: "Checks", value: report.dates.len().to_string(), note: span };
    let configurations = Card {
        name: "Configurations",
        value: report.configurations.to_string(),
        note: "in each check".to_owned(),
    };
    let nearest = report.nearest_first().first().map(|chart| Card {
        name: "Nearest to its limit",
        value: percent(chart.share(last_check(report)), 1.0),
        note: format!("of the limit: {}", chart.name),
    });
    [checks, configurations].into_iter().chain(nearest).collect()
}

/// States the checks, the charts and their false-alarm rate.
fn watched(report: &Report) -> Section {
    let span = match &report.dates[..] {
        [first, .., last] => format!(" from {first} to {last}"),
        _ => String::new(),
    };
    let more = match report.left_out {
        0 => String::new(),
        more => format!(" {more} more configurations are missing in some checks and are not used."),
    };
    let station = match report.fixed_station {
        true => "The instrument stays in place (`base = \"exact\"`): its station is monitored as well.",
        false => "The station of the instrument is fitted anew at every check.",
    };
    let rate = match report.limit.checks_per_false_alarm {
        365.0 => "one false alarm per year at one check per day".to_owned(),
        checks => format!("one false alarm in {} checks", trimmed(checks, 1)),
    };
    Section::full("Checks")
        .state(
            "checks",
            format!(
                "{} checks{span}; {} configurations in each, {} quantities independent of the station.{more}",
                report.dates.len(),
                report.configurations,
                report.numbers
            ),
        )
        .state("station", station.to_owned())
        .state(
            "false_alarms",
            format!(
                "{} charts compare each check with those before it; {} of them also have a moving average \
                 (EWMA) with a weight of {} for the new check and limits at {} standard deviations. Together \
                 they raise on average no more than {rate}, if the machine does not change and checks are \
                 independent.",
                report.charts.len() + 1,
                report.charts.len(),
                trimmed(report.limit.lambda, 3),
                fixed(report.limit.limit, 3),
            ),
        )
}

/// States what has changed.
fn findings(report: &Report) -> Section {
    let section = Section::answer();
    let Some(alarm) = &report.alarm else {
        let few = match report.dates.len() {
            0..10 => " So few checks have little power: use ten or more.",
            _ => "",
        };
        return section.state("no_alarm", format!("No alarm: no significant change of the machine.{few}"));
    };
    let first = match alarm.chart == report.left.name {
        true => "The measurements differ from earlier ones by more than their scatter.".to_owned(),
        false => format!("First chart to exceed its limit: {}.", alarm.chart),
    };
    let section = section.state("alarm", first);
    match &report.finding {
        Some(finding) => changed(section, report, finding),
        None => section.state("not_dated", "There are too few checks to date the change.".to_owned()),
    }
}

fn changed(section: Section, report: &Report, finding: &Finding) -> Section {
    let Finding { name, since_date, between_dates, size, standard_deviation, unit, effect, moved, .. } =
        finding;
    let per = report.calendar.unit();
    let (factor, unit) = angle_in_mrad(unit);
    let value = format!("{} ± {} {unit}", digits(size * factor, 3), digits(standard_deviation * factor, 2));
    let between = match between_dates {
        [Some(first), Some(last)] => format!("95 %: {first} to {last}"),
        [_, Some(last)] => format!("95 %: {last} or before"),
        _ => "the date is unknown".to_owned(),
    };
    let micrometres = if report.length == "m" { 1e6 } else { 1e3 };
    let show = |value: f64| digits(value * micrometres, 2);
    let [size_there, sigma_there] = [size.abs() * effect, standard_deviation * effect].map(show);
    let change = match finding.kind {
        "drift" => format!(
            "{name} drifts since {since_date} ({between}) by {value} per {per}. At the most sensitive \
             configuration the tool point moves by {size_there} ± {sigma_there} µm per {per}, {} µm until \
             now.",
            show(*moved)
        ),
        _ => {
            let back = finding.until_date.as_ref().map(|until| format!(" and was back at {until}"));
            let restart = format!(" If the machine was serviced then, restart with `{SINCE}`.");
            format!(
                "{name} jumped by {value} at {since_date} ({between}){}. At the most sensitive configuration \
                 the tool point moved by {size_there} ± {sigma_there} µm.{}",
                back.as_deref().unwrap_or_default(),
                if back.is_none() { &*restart } else { "" }
            )
        }
    };
    let as_well = (!finding.as_well.is_empty())
        .then(|| format!("Equally good explanations: {}.", first(&finding.as_well, 8)));
    let outside = finding.may_be_outside.then(|| {
        "The cause may therefore be outside the machine: check the placement of the instrument and its \
         target first."
            .to_owned()
    });
    section
        .state("change", change)
        .state("equally_good", as_well)
        .state("cause_outside", outside)
        .state("tolerance", report.tolerance.map(|tolerance| leaving(report, finding, tolerance)))
}

fn leaving(report: &Report, finding: &Finding, tolerance: f64) -> String {
    let limit = format!("{} {}", trimmed(tolerance, 6), report.length);
    let per = report.calendar.unit();
    match &finding.leaves {
        _ if finding.moved.max(finding.farthest) > tolerance => format!(
            "At {} it was {} {} from where it was before: that exceeds the tolerance of {limit}.",
            finding.farthest_date,
            digits(finding.farthest, 3),
            report.length
        ),
        Some(leaving) => format!(
            "At this rate the tolerance of {limit} is exceeded at {} ± {} {per}s.",
            leaving.date,
            digits(leaving.standard_deviation, 2)
        ),
        None => format!("That is within the tolerance of {limit}."),
    }
}
