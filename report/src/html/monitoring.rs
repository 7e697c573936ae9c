//! The page of a machine that is watched: its charts over time, and what has changed.

use abbe_spec::Spec;
use abbe_study::data::{Calendar, Map};
use abbe_study::monitor::{Chart, Finding, Report};
use abbe_study::number::{fixed, percent};
use plotly::common::{HoverInfo, Line, Marker, Mode};
use plotly::{Layout, Plot, Scatter};

use super::figure::{Figures, round};
use super::provenance::{Provenance, instrument};
use super::{document, escaped, section, style};
use crate::axis::{BAR, INK, TOLERANCE, XYZ, css};

/// The most charts that have a picture of their own.
const DRAWN: usize = 9;

/// The page of a machine that is watched; `spec` and `map` are those of the job.
pub fn monitoring(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Watched</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&report.title)
    );
    let paragraphs = |sentences: Vec<String>| {
        sentences.iter().map(|said| format!("<p>{}</p>\n", escaped(said))).collect::<String>()
    };
    let class = if report.alarm.is_some() { "missed" } else { "met" };
    let mut findings = report.findings();
    let first = if findings.is_empty() { String::new() } else { findings.remove(0) };
    let verdict = format!(
        "<section class=\"verdict\">\n<h2 class=\"{class}\">{}</h2>\n{}</section>\n",
        escaped(&first),
        paragraphs(findings)
    );
    let unusable = report.files.iter().filter(|file| !file.unusable.is_empty()).flat_map(|file| file.lines());
    let unusable = unusable.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let body = [
        heading,
        verdict,
        section("What was watched", &paragraphs(report.watched())),
        section("Charts", &format!("{}{}", table(report), figures(report))),
        section("Instrument", &instrument(spec, map)),
        if unusable.is_empty() {
            unusable
        } else {
            section("Rows that cannot be used", &format!("<p>{unusable}</p>\n"))
        },
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: watched", spec.title), &body.concat())
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or_default()
}

fn table(report: &Report) -> String {
    let row = |chart: &Chart| {
        let (factor, unit) = if chart.unit == "rad" { (1e3, "mrad") } else { (1.0, chart.unit) };
        format!(
            "<tr><td class=\"words\">{}<small>{}</small></td><td>{}</td><td class=\"words\">{unit}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&chart.name),
            escaped(&chart.alike.join(", ")),
            fixed(last(&chart.values) * factor, 4),
            percent(last(&chart.average), 1.0),
            chart.alarm.map_or("", |check| &report.dates[check]),
        )
    };
    let rows = report.nearest_first().into_iter().chain([&report.left]).map(row).collect::<String>();
    let unseen = match report.unseen.len() {
        0 => String::new(),
        _ => format!(
            "<p>These cannot be told from where the instrument stands, or do not move what is measured: {}.</p>\n",
            escaped(&report.unseen.join(", "))
        ),
    };
    format!(
        "<table class=\"ledger\"><thead><tr><th class=\"words\">error, and below it those that act alike</th><th>last value</th><th></th>\
         <th>average, share of the limit</th><th>alarm</th></tr></thead>\n<tbody>{rows}</tbody></table>\n{unseen}"
    )
}

fn figures(report: &Report) -> String {
    let mut figures = Figures::new();
    if let Some(finding) = &report.finding {
        let caption = "Dots: the error at every check, as if all others stayed what they are. Line: the change that explains them best. \
                       Black: since when, with 95 % probability.";
        figures.add(
            &format!("What has changed: {}", escaped(&finding.name)),
            &[changed(finding, report)],
            340,
            caption,
        );
    }
    let caption =
        "Moving averages as shares of their limits: an alarm beyond ±100 %. Red: that of what has changed.";
    figures.add("All charts", &[all(report)], 340, caption);
    let charts = report.nearest_first();
    let own = charts.iter().copied().take(DRAWN).map(|chart| one(chart, report)).collect::<Vec<_>>();
    let hidden = charts.len().saturating_sub(DRAWN);
    let more = if hidden > 0 { format!(" {hidden} more are nearer to zero.") } else { String::new() };
    figures.add(
        "The charts nearest to their limits",
        &own,
        240,
        &format!("Dots: the error at every check, less its mean.{more}"),
    );
    let caption = "The norm of what differs from the checks before, in units of the instrument's uncertainty: 1 where checks scatter as it does.";
    figures.add("What is left", &[left(report)], 280, caption);
    figures.html()
}

/// Dates as plotly reads them, or plain numbers.
fn times(report: &Report) -> Vec<String> {
    match report.calendar {
        Calendar::Dates => report.dates.clone(),
        _ => report.times.iter().map(|time| round(*time).to_string()).collect(),
    }
}

fn layout(report: &Report, y: &str) -> Layout {
    let name = match report.calendar {
        Calendar::Dates => "",
        Calendar::Days => "day",
        Calendar::Checks => "check",
    };
    Layout::new().margin(style::margin([60, 10, 10, 44])).x_axis(style::axis(name)).y_axis(style::axis(y))
}

/// Rad as mrad.
fn shown(unit: &str) -> (f64, &str) {
    if unit == "rad" { (1e3, "mrad") } else { (1.0, unit) }
}

fn line(x: Vec<String>, y: Vec<f64>, colour: String, width: f64) -> Box<Scatter<String, f64>> {
    let y = y.into_iter().map(round).collect();
    Scatter::new(x, y)
        .mode(Mode::Lines)
        .line(Line::new().color(colour).width(width))
        .hover_info(HoverInfo::None)
}

fn dots(
    x: Vec<String>,
    y: Vec<f64>,
    report: &Report,
    unit: &str,
    colour: String,
) -> Box<Scatter<String, f64>> {
    let hover = report
        .dates
        .iter()
        .zip(&y)
        .map(|(date, value)| format!("{date}: {} {unit}", abbe_study::number::digits(*value, 4)));
    let hover = hover.collect::<Vec<_>>();
    let size = if y.len() > 300 { 3 } else { 5 };
    Scatter::new(x, y.into_iter().map(round).collect())
        .mode(Mode::Markers)
        .marker(Marker::new().size(size).color(colour))
        .hover_info(HoverInfo::Text)
        .hover_text_array(hover)
}

fn changed(finding: &Finding, report: &Report) -> Plot {
    let (factor, unit) = shown(finding.unit);
    let mut plot = style::plot(layout(report, &format!("{} ({unit})", finding.name)));
    let column = |i: usize| finding.series.iter().map(|values| values[i] * factor).collect::<Vec<f64>>();
    let (values, model) = (column(0), column(1));
    let [first, last] = finding.between;
    let inside =
        |time: &f64| first.is_none_or(|first| *time >= first) && last.is_some_and(|last| *time <= last);
    let (mut likely, mut others) = ((Vec::new(), Vec::new()), (Vec::new(), Vec::new()));
    for ((time, x), value) in report.times.iter().zip(times(report)).zip(&values) {
        let list = if inside(time) { &mut likely } else { &mut others };
        list.0.push(x);
        list.1.push(*value);
    }
    plot.add_trace(dots(others.0, others.1, report, unit, css(BAR, 0.9)));
    plot.add_trace(dots(likely.0, likely.1, report, unit, css(INK, 0.9)));
    plot.add_trace(line(times(report), model, css(XYZ[0], 1.0), 2.5));
    plot
}

fn limits(plot: &mut Plot, report: &Report, both: bool) {
    let x = times(report);
    let ends: Vec<String> = x.first().into_iter().chain(x.last()).cloned().collect();
    for limit in [100.0, -100.0].into_iter().take(if both { 2 } else { 1 }) {
        plot.add_trace(line(ends.clone(), vec![limit; ends.len()], css(TOLERANCE, 1.0), 1.2));
    }
}

fn percents(chart: &Chart) -> Vec<f64> {
    chart.average.iter().map(|share| 100.0 * share).collect()
}

fn all(report: &Report) -> Plot {
    let mut plot = style::plot(layout(report, "average, % of the limit"));
    let named = |name: &str| {
        report.charts.iter().find(|chart| chart.name == name || chart.alike.iter().any(|alike| alike == name))
    };
    let found = report.finding.as_ref().and_then(|finding| named(&finding.name));
    let first =
        found.map(|chart| chart.name.as_str()).or(report.alarm.as_ref().map(|alarm| alarm.chart.as_str()));
    for chart in report.charts.iter().chain([&report.left]).filter(|chart| Some(chart.name.as_str()) != first)
    {
        plot.add_trace(line(times(report), percents(chart), css(BAR, 0.45), 1.0));
    }
    limits(&mut plot, report, true);
    if let Some(chart) =
        report.charts.iter().chain([&report.left]).find(|chart| Some(chart.name.as_str()) == first)
    {
        plot.add_trace(line(times(report), percents(chart), css(XYZ[0], 1.0), 2.5));
    }
    plot
}

fn one(chart: &Chart, report: &Report) -> Plot {
    let (factor, unit) = shown(chart.unit);
    let mean = chart.values.iter().sum::<f64>() / chart.values.len().max(1) as f64;
    let values = chart.values.iter().map(|value| (value - mean) * factor).collect();
    let mut plot = style::plot(layout(report, &format!("{} ({unit})", chart.name)));
    let colour = if chart.alarm.is_some() { css(XYZ[0], 0.9) } else { css(INK, 0.6) };
    plot.add_trace(dots(times(report), values, report, unit, colour));
    plot
}

fn left(report: &Report) -> Plot {
    let mut plot = style::plot(layout(report, "norm"));
    plot.add_trace(dots(times(report), report.left.values.clone(), report, "", css(INK, 0.6)));
    plot
}
