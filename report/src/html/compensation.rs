//! The page of corrected commands: where the tool is without and with them.

use abbe::VariableKind;
use abbe_spec::Spec;
use abbe_study::compensate::{Report, Row, Size};
use abbe_study::data::Map;
use abbe_study::number::{self, fixed};
use abbe_study::study_file::Over;
use plotly::common::{ExponentFormat, HoverInfo, Marker, Mode};
use plotly::layout::{AxisType, Layout};
use plotly::{Plot, Scatter};

use super::figure::{Figures, round, step, thinned};
use super::provenance::Provenance;
use super::residuals::histogram;
use super::{document, escaped, section, style};
use crate::axis::{Axis, BAR, GREY, css};

/// The most dots of a picture.
const DOTS: usize = 3000;
/// The most rows that are listed.
const LISTED: usize = 100;

/// The page of corrected commands; `spec` is that of the machine.
pub fn compensation(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Corrected commands</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&map.title)
    );
    let lines = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect::<String>();
    let body = [
        heading,
        section("Distance of the tool point from where it should be", &sizes(spec, report)),
        section("Figures", &figures(spec, report)),
        section("Rows that are not compensated", &failed(report)),
        section("Rows", &format!("<p>{lines}</p>\n")),
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: corrected commands", spec.title), &body.concat())
}

fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |(name, size): (&str, &Size)| {
        let cells =
            [size.mean, size.rms, size.max].map(|v| format!("<td>{}</td>", fixed(v, decimals))).concat();
        format!(
            "<tr><td class=\"words\">{name}</td>{cells}<td>{}</td></tr>\n",
            fixed(size.angle_max * 1e3, 4)
        )
    };
    let rows = [("as commanded", &report.before), ("corrected", &report.after)].map(row).concat();
    format!(
        "<table class=\"ledger\"><thead><tr><th></th><th>mean ({unit})</th><th>rms ({unit})</th><th>largest ({unit})</th>\
         <th>largest turn (mrad)</th></tr></thead>\n<tbody>{rows}</tbody></table>\n<p>{} of {} rows are compensated: no more than {} is left \
         at the tool point.</p>\n",
        report.compensated,
        report.asked(),
        number::length(report.tolerance, spec.length),
        unit = report.length
    )
}

fn figures(spec: &Spec, report: &Report) -> String {
    let to_mm = 1e3 * spec.length.in_metres();
    let every = step(report.rows.len(), DOTS);
    let few = thinned(report.rows.len(), every);
    let numbered = report.rows.iter().enumerate().step_by(every);
    let shown: Vec<(f64, &Row)> = numbered.map(|(i, row)| (i as f64 + 1.0, row)).collect();
    let mut figures = Figures::new();
    let x = style::axis("rows in their order").exponent_format(ExponentFormat::None);
    let caption = format!(
        "Grey: as commanded. Blue: corrected. On a logarithmic scale; what is below 10 nm is drawn there.{few}"
    );
    figures.add("Distance over the order of the rows", &[distances(&shown, x, to_mm)], 320, &caption);
    let over = spec.variables.iter().enumerate().filter_map(|(joint, _)| {
        let axis = Axis::over(Over::Variable(joint), spec);
        let factor = axis.factor;
        let at = |row: &Row| row.q.0.get(joint).map_or(0.0, |(_, value)| value * factor);
        let points: Vec<(f64, &Row)> = shown.iter().map(|(_, row)| (at(row), *row)).collect();
        let first = points.first()?.0;
        let moves = points.iter().any(|(x, _)| (x - first).abs() > 1e-9);
        moves.then(|| distances(&points, style::axis(&axis.title()), to_mm))
    });
    figures.add("Distance over each joint", &over.collect::<Vec<_>>(), 240, &caption);
    let lists = [
        (report.rows.iter().map(|row| row.before.length * to_mm).collect(), css(GREY, 0.5)),
        (report.rows.iter().map(|row| row.after.length * to_mm).collect(), css(BAR, 0.75)),
    ];
    figures.add(
        "How often which distance occurs",
        &[histogram("distance (mm)", &lists)],
        260,
        "Grey: as commanded. Blue: corrected.",
    );
    let corrections = spec.variables.iter().enumerate().filter_map(|(joint, variable)| {
        let (factor, unit) = match variable.kind {
            VariableKind::Revolute => (1e3, "mrad"),
            VariableKind::Prismatic => (to_mm, "mm"),
        };
        let changes: Vec<f64> =
            report.rows.iter().filter_map(|row| Some(row.changes.get(joint)? * factor)).collect();
        let name = format!("change of {} ({unit})", variable.name);
        (!changes.is_empty()).then(|| histogram(&name, &[(changes, css(BAR, 0.75))]))
    });
    figures.add(
        "Corrections of the joints",
        &corrections.collect::<Vec<_>>(),
        230,
        "Corrected minus what the row has, all rows.",
    );
    format!("<p>Distances are in mm.</p>\n{}", figures.html())
}

fn distances(shown: &[(f64, &Row)], x: plotly::layout::Axis, to_mm: f64) -> Plot {
    let layout = Layout::new()
        .margin(style::margin([64, 10, 10, 44]))
        .x_axis(x)
        .y_axis(style::axis("distance (mm)").type_(AxisType::Log));
    let mut plot = style::plot(layout);
    let mut add = |value: &dyn Fn(&Row) -> f64, colour: String| {
        let all = shown.iter().map(|(x, row)| (round(*x), round((value(row) * to_mm).max(1e-5))));
        let (x, y): (Vec<f64>, Vec<f64>) = all.unzip();
        let hover = shown
            .iter()
            .map(|(_, row)| format!("line {}: {} mm", row.line, number::digits(value(row) * to_mm, 3)));
        plot.add_trace(
            Scatter::new(x, y)
                .mode(Mode::Markers)
                .marker(Marker::new().size(4).color(colour))
                .hover_info(HoverInfo::Text)
                .hover_text_array(hover.collect::<Vec<_>>()),
        );
    };
    add(&|row| row.before.length, css(GREY, 0.5));
    add(&|row| row.after.length, css(BAR, 0.9));
    plot
}

fn failed(report: &Report) -> String {
    let failed: Vec<(u64, &String)> =
        report.rows.iter().filter_map(|row| Some((row.line, row.reason.as_ref()?))).collect();
    if failed.is_empty() {
        return "<p>None.</p>\n".to_owned();
    }
    let items = failed
        .iter()
        .take(LISTED)
        .map(|(line, reason)| format!("<li>line {line}: {}</li>\n", escaped(reason)));
    let more = failed.len().saturating_sub(LISTED);
    let more = if more > 0 { format!("<li>… and {more} more</li>\n") } else { String::new() };
    format!("<ul>\n{}{more}</ul>\n", items.collect::<String>())
}
