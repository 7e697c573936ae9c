//! Sentences on alarms and charts.

use abbe_metrology::monitor::{Finding, Report};
use abbe_study::number::{digits, fixed, trimmed};

/// States the checks, the charts and their false-alarm rate.
pub(crate) fn watched(report: &Report) -> Vec<String> {
    let (first, last) = (report.dates.first(), report.dates.last());
    let span = match (first, last) {
        (Some(first), Some(last)) if report.dates.len() > 1 => format!(" from {first} to {last}"),
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
    let unit = report.calendar.unit();
    let rate = match (report.limit.checks_per_false_alarm, unit) {
        (365.0, _) => "one false alarm per year at one check per day".to_owned(),
        (checks, _) => format!("one false alarm in {} checks", trimmed(checks, 1)),
    };
    vec![
        format!(
            "{} checks{span}; {} configurations in each, {} quantities independent of the \
             station.{more}",
            report.dates.len(),
            report.configurations,
            report.numbers
        ),
        station.to_owned(),
        format!(
            "{} EWMA charts with a weight of {} for the new check and limits at {} standard \
             deviations. Together they raise on average no more than {rate}, if the machine does \
             not change and checks are independent.",
            report.charts.len() + 1,
            trimmed(report.limit.lambda, 3),
            fixed(report.limit.limit, 3),
        ),
    ]
}

/// The alarm, and what has changed.
pub(crate) fn findings(report: &Report) -> Vec<String> {
    let Some(alarm) = &report.alarm else {
        let few = match report.dates.len() {
            0..10 => " So few checks have little power: use ten or more.",
            _ => "",
        };
        return vec![format!("No alarm: no significant change of the machine.{few}")];
    };
    let first = match alarm.chart == report.left.name {
        true => "The measurements differ from earlier ones by more than their scatter.".to_owned(),
        false => format!("First chart to exceed its limit: {}.", alarm.chart),
    };
    let mut all = vec![format!("Alarm at {}.", alarm.date), first];
    match &report.finding {
        Some(finding) => all.extend(changed(report, finding)),
        None => all.push("There are too few checks to date the change.".to_owned()),
    }
    all
}

fn changed(report: &Report, finding: &Finding) -> Vec<String> {
    let Finding { name, since_date, between_dates, size, standard_deviation, unit, effect, moved, .. } =
        finding;
    let per = report.calendar.unit();
    let (factor, unit) = if *unit == "rad" { (1e3, "mrad") } else { (1.0, *unit) };
    let value = format!("{} ± {} {unit}", digits(size * factor, 3), digits(standard_deviation * factor, 2));
    let between = match between_dates {
        [Some(first), Some(last)] => format!("95 %: {first} to {last}"),
        [_, Some(last)] => format!("95 %: {last} or before"),
        _ => "the date is unknown".to_owned(),
    };
    let micrometres = if report.length == "m" { 1e6 } else { 1e3 };
    let show = |value: f64| digits(value * micrometres, 2);
    let [size_there, sigma_there] = [size.abs() * effect, standard_deviation * effect].map(show);
    let mut all = vec![match finding.kind {
        "drift" => format!(
            "{name} drifts since {since_date} ({between}) by {value} per {per}. At the most \
             sensitive configuration the tool point moves by {size_there} ± {sigma_there} µm per \
             {per}, {} µm until now.",
            show(*moved)
        ),
        _ => format!(
            "{name} jumped by {value} at {since_date} ({between}). At the most sensitive \
             configuration the tool point moved by {size_there} ± {sigma_there} µm. If the \
             machine was serviced then, restart with `--since`."
        ),
    }];
    if !finding.as_well.is_empty() {
        const SHOWN: usize = 8;
        let more = finding.as_well.len().saturating_sub(SHOWN);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let names = finding.as_well.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>();
        all.push(format!("Equally good explanations: {}{more}.", names.join(", ")));
    }
    if finding.may_be_outside {
        let line = "The cause may therefore be outside the machine: check the placement of the \
            instrument and its target first.";
        all.push(line.to_owned());
    }
    all.extend(report.tolerance.map(|tolerance| leaving(report, finding, tolerance)));
    all
}

fn leaving(report: &Report, finding: &Finding, tolerance: f64) -> String {
    let limit = format!("{} {}", trimmed(tolerance, 6), report.length);
    let per = report.calendar.unit();
    match &finding.leaves {
        _ if finding.moved > tolerance => format!("That exceeds the tolerance of {limit}."),
        Some(leaving) => format!(
            "At this rate the tolerance of {limit} is exceeded at {} ± {} {per}s.",
            leaving.date,
            digits(leaving.standard_deviation, 2)
        ),
        None => format!("That is within the tolerance of {limit}."),
    }
}
