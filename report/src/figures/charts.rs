//! Figures of monitoring: control charts over time.

use abbe::analysis::sampling::range_of;
use abbe_metrology::monitor::{Chart, Finding, Report};
use abbe_study::date::Calendar;

use crate::scene::{Axis, Colour, Mark, Panel, Scale, Scene, with_margin};
use crate::unit::angle_in_mrad;

/// Maximum number of charts with a panel of their own.
const DRAWN: usize = 9;
/// Colour of the error that changed.
const CHANGED: Colour = Colour::XYZ[0];

/// Builds the figures of repeated checks.
pub(crate) fn scenes(report: &Report) -> Vec<Scene> {
    let mut scenes = Vec::new();
    scenes.extend(report.finding.as_ref().map(|finding| changed(finding, report)));
    scenes.push(all(report));
    let charts = report.nearest_first();
    let own = charts.iter().take(DRAWN).map(|chart| one(chart, report)).collect::<Vec<_>>();
    if !own.is_empty() {
        let hidden = charts.len().saturating_sub(DRAWN);
        let more =
            if hidden > 0 { format!(" {hidden} more charts are nearer to zero.") } else { String::new() };
        let caption = format!("Dots: error at every check minus its mean.{more}");
        scenes.push(Scene::new("Charts nearest to their limits", own.len().min(3), own).captioned(caption));
    }
    let panel = panel(240.0, "norm", "", vec![dots(&report.left.values, Colour::INK, report)], report);
    let caption = "Norm of the change from earlier checks, relative to the uncertainty of the \
        instrument; 1 is the usual scatter.";
    scenes.push(Scene::new("Residual change", 1, vec![panel]).captioned(caption));
    scenes
}

/// Creates a panel over time whose axes contain all marks.
fn panel(height: f64, name: &str, unit: &str, marks: Vec<Mark<[f64; 2]>>, report: &Report) -> Panel {
    let values = marks.iter().flat_map(|mark| mark.places()).map(|[_, value]| value);
    let y = Axis::linear(name, unit, with_margin(range_of(values), 0.06));
    let time = with_margin(range_of(report.times.iter().copied()), 0.02);
    let x = match report.calendar {
        Calendar::Dates => Axis::linear("", "", time).scaled(Scale::Dates),
        Calendar::Days => Axis::linear("day", "", time),
        Calendar::Checks => Axis::linear("check", "", time),
    };
    Panel::plane(height, x, y, marks)
}

/// Pairs the time of every check with a value.
fn over_time(values: impl IntoIterator<Item = f64>, report: &Report) -> Vec<[f64; 2]> {
    report.times.iter().zip(values).map(|(time, value)| [*time, value]).collect()
}

fn dots(values: &[f64], colour: Colour, report: &Report) -> Mark<[f64; 2]> {
    let radius = if values.len() > 300 { 1.6 } else { 2.4 };
    Mark::points(colour, radius, over_time(values.iter().copied(), report)).faded(0.8)
}

/// Shows the error that changed, and the change that explains it best.
fn changed(finding: &Finding, report: &Report) -> Scene {
    let (factor, unit) = angle_in_mrad(finding.unit);
    let column = |i: usize| over_time(finding.series.iter().map(|values| values[i] * factor), report);
    let [first, last] = finding.between;
    let is_since = |[time, _]: &[f64; 2]| {
        first.is_none_or(|first| *time >= first) && last.is_some_and(|last| *time <= last)
    };
    let (since, others): (Vec<_>, Vec<_>) = column(0).into_iter().partition(is_since);
    let radius = if report.times.len() > 300 { 1.6 } else { 2.4 };
    let mut marks = vec![Mark::points(Colour::BAR, radius, others).named("error at every check")];
    if !since.is_empty() {
        marks.push(Mark::points(Colour::INK, radius, since).named("95 % interval for the time of change"));
    }
    marks.push(Mark::line(CHANGED, 2.5, column(1)).named("best-fitting change"));
    let title = format!("Detected change: {}", finding.name);
    let caption = "The error at every check is computed under the assumption that no other error \
        has changed.";
    Scene::new(title, 1, vec![panel(280.0, &finding.name, unit, marks, report)]).captioned(caption)
}

/// Shows all moving averages relative to their limits.
fn all(report: &Report) -> Scene {
    let charts = || report.charts.iter().chain([&report.left]);
    let named = |name: &str| {
        report
            .charts
            .iter()
            .find(|chart| chart.name == name || chart.indistinguishable.iter().any(|other| other == name))
    };
    let found = report.finding.as_ref().and_then(|finding| named(&finding.name));
    let first =
        found.map(|chart| chart.name.as_str()).or(report.alarm.as_ref().map(|alarm| alarm.chart.as_str()));
    let percents = |chart: &Chart| {
        let shares = if chart.average.is_empty() { &chart.single } else { &chart.average };
        over_time(shares.iter().map(|share| 100.0 * share), report)
    };
    let others = charts().filter(|chart| Some(chart.name.as_str()) != first).map(percents).collect();
    let time = range_of(report.times.iter().copied());
    let limits = [100.0, -100.0].map(|limit| time.map(|at| [at, limit]).to_vec());
    let mut marks = vec![
        Mark::lines(Colour::BAR, 1.0, others).faded(0.5).named("moving averages"),
        Mark::dashed(Colour::TOLERANCE, limits.to_vec()).named("limits"),
    ];
    if let Some(chart) = charts().find(|chart| Some(chart.name.as_str()) == first) {
        marks.push(Mark::line(CHANGED, 2.5, percents(chart)).named(&chart.name));
    }
    let panel = panel(280.0, "average as share of the limit", "%", marks, report);
    let caption = "Moving averages, and the residual change of each check, as shares of their limits; beyond ±100 % \
         there is an alarm.";
    Scene::new("All charts", 1, vec![panel]).captioned(caption)
}

/// Shows the error of one chart minus its mean.
fn one(chart: &Chart, report: &Report) -> Panel {
    let (factor, unit) = angle_in_mrad(chart.unit);
    let mean = chart.values.iter().sum::<f64>() / chart.values.len().max(1) as f64;
    let values = chart.values.iter().map(|value| (value - mean) * factor).collect::<Vec<_>>();
    let colour = if chart.alarm.is_some() { CHANGED } else { Colour::INK };
    panel(170.0, &chart.name, unit, vec![dots(&values, colour, report)], report)
}
