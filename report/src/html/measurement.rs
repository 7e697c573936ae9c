//! The page of a measurement: errors in space and how often which error occurs, as in the paper's Figures 13 and 14.

use abbe_spec::Spec;
use abbe_study::data::Map;
use abbe_study::measure::{Report, RowError};
use abbe_study::number::{digits, fixed, trimmed};
use plotly::common::{HoverInfo, Marker, Mode};
use plotly::layout::AspectMode;
use plotly::{Layout, Plot, Scatter3D};

use super::figure::{Figures, round};
use super::provenance::{Provenance, instrument};
use super::reach::Reach;
use super::residuals::{Residual, histogram, over_all};
use super::{document, escaped, section, style};
use crate::axis::{BAR, INK, XYZ, css};

/// The most points that are drawn.
const MOST: usize = 5000;
/// Its machine is in Figures 13 and 14.
const PAPER: &str = "High Performance Medical Robot Requirements and Accuracy Analysis";

/// The page of a measurement; `spec` and `map` are those of the job.
pub fn measurement(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let to_mm = if spec.length.symbol() == "m" { 1e3 } else { 1.0 };
    let position: Vec<[f64; 3]> =
        report.row_errors.iter().map(|row| [0, 1, 2].map(|axis| row.error[axis] * to_mm)).collect();
    let about: Vec<[f64; 3]> =
        report.about_barycentres.iter().map(|error| error.map(|v| v * to_mm)).collect();
    let heading = format!(
        "<header>\n<p class=\"kind\">Measured</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&report.title)
    );
    let sentences = report.sentences();
    let words: String = sentences.iter().map(|sentence| format!("<p>{}</p>\n", escaped(sentence))).collect();
    let lines: String = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect();
    let of_paper = |figure| if spec.reference.contains(PAPER) { paper_figure(figure) } else { String::new() };
    if !report.instruments.is_empty() {
        let body = [
            heading,
            section("Rows", &format!("<p>{lines}</p>\n")),
            section("Reading − prediction", &(instruments(report) + &words)),
            section("Figures", &of_readings(report).html()),
            section("Instrument", &instrument(spec, map)),
            section("Input files", &provenance.table()),
        ];
        return document(&format!("{}: measured", spec.title), &body.concat());
    }
    let mut drawn = Figures::new();
    let (dots, beyond) = cloud(&position, &report.row_errors);
    let words = match beyond {
        0 => "Each dot is ΔX of one row.".to_owned(),
        1 => "Each dot is ΔX of one row; 1 is beyond the picture.".to_owned(),
        beyond => format!("Each dot is ΔX of one row; {beyond} are beyond the picture."),
    };
    drawn.add(&format!("Accuracy: errors in space{}", of_paper(13)), &[dots], 560, &words);
    let title = format!("Accuracy: how often which error occurs{}", of_paper(14));
    drawn.add(&title, &histograms(&position), 260, "ΔX of all rows.");
    if !about.is_empty() {
        let title = format!("Repeatability: how often which error occurs{}", of_paper(14));
        let words = "About the barycentre of the visits of each configuration.";
        drawn.add(&title, &histograms(&about), 260, words);
    }
    let residuals = report.row_errors.iter().map(|row| Residual {
        line: row.observation.line,
        q: &row.observation.q,
        point: row.point,
        before: None,
        after: [row.error[0], row.error[1], row.error[2]],
    });
    over_all(&mut drawn, &residuals.collect::<Vec<_>>(), "ΔX", spec);
    let figures = drawn.html();
    let body = [
        heading,
        section("Rows", &format!("<p>{lines}</p>\n")),
        section("ΔX = measured − ideal", &(table(report) + &words)),
        section("Figures", &format!("<p>Errors are in mm.</p>\n{figures}")),
        section("Instrument", &instrument(spec, map)),
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: measured", spec.title), &body.concat())
}

fn table(report: &Report) -> String {
    let decimals = if report.length == "m" { 7 } else { 4 };
    let rows: String = report
        .errors
        .iter()
        .map(|size| {
            let numbers = [size.mean, size.rms, size.max, size.three_sigma];
            let decimals = if size.unit == "rad" { 6 } else { decimals };
            let cells: String = numbers
                .iter()
                .map(|v| format!("<td class=\"number\">{}</td>", fixed(*v, decimals)))
                .collect();
            format!("<tr><td class=\"words\">{} ({})</td>{cells}</tr>\n", size.name, size.unit)
        })
        .collect();
    format!(
        "<table class=\"ledger\">\n<thead><tr><th></th><th>mean</th><th>rms</th><th>largest</th><th>3 σ about the mean</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n"
    )
}

/// What is left of every instrument's readings, each in its own unit.
fn instruments(report: &Report) -> String {
    let rows = report.instruments.iter().map(|one| {
        let cell = |text: String| format!("<td class=\"number\">{text}</td>");
        let show = |value: f64| cell(digits(value, 4));
        let unknown = || cell(String::new());
        let cells = [
            cell(one.count.to_string()),
            show(one.ideal.rms),
            show(one.left.mean),
            one.left.standard_error.map_or_else(unknown, show),
            show(one.left.rms),
            show(one.left.max),
            one.uncertainty.map_or_else(unknown, show),
        ];
        let (name, unit) = (escaped(&one.name), escaped(&one.unit));
        format!("<tr><td class=\"words\">{name} ({unit})</td>{}</tr>\n", cells.concat())
    });
    let heads = ["", "read", "ideal: rms", "mean", "std. error", "rms", "largest", "stated σ"];
    let heads: String = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    format!(
        "<table class=\"ledger\">\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n",
        rows.collect::<String>()
    )
}

/// How often which error of a reading occurs, number by number.
fn of_readings(report: &Report) -> Figures {
    let mut drawn = Figures::new();
    for (i, name) in report.numbers.iter().enumerate() {
        let left: Vec<f64> = report.row_readings.iter().filter_map(|row| row.left[i]).collect();
        let of = report
            .instruments
            .iter()
            .find(|one| *name == one.name || name.starts_with(&format!("{}_", one.name)));
        let unit = of.map_or("", |one| &one.unit);
        if !left.is_empty() {
            let plot = histogram(&format!("{name} ({unit})"), &[(left, css(INK, 0.75))]);
            let title = format!("{}: how often which error occurs", escaped(name));
            drawn.add(
                &title,
                &[plot],
                260,
                "Reading minus prediction with the repeatable sources of the spec.",
            );
        }
    }
    drawn
}

/// Where the paper shows the same of the same machine.
fn paper_figure(number: u32) -> String {
    format!(" <span class=\"paper\">cf. Figure {number} of the paper</span>")
}

fn norm(error: [f64; 3]) -> f64 {
    error.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Without gross errors, and how many those are.
fn cloud(errors: &[[f64; 3]], rows: &[RowError]) -> (Plot, usize) {
    let reach = Reach::new(errors.iter().map(|error| norm(*error)).collect());
    let scene = style::scene(["x error (mm)", "y error (mm)", "z error (mm)"], AspectMode::Data, 2, 0.8);
    let mut plot = style::plot(Layout::new().margin(style::margin([0, 0, 0, 0])).scene(scene));
    let step = errors.len().div_ceil(MOST).max(1);
    let lines = rows.iter().map(|row| row.observation.line);
    let shown = errors.iter().zip(lines).filter(|(error, _)| reach.contains(norm(**error)));
    let shown: Vec<(&[f64; 3], u64)> = shown.step_by(step).collect();
    let along = |axis: usize| shown.iter().map(|(error, _)| round(error[axis])).collect::<Vec<_>>();
    let hover = shown.iter().map(|([x, y, z], line)| {
        format!("({}, {}, {}) mm<br>line {line}", trimmed(*x, 4), trimmed(*y, 4), trimmed(*z, 4))
    });
    let dots = Scatter3D::new(along(0), along(1), along(2))
        .mode(Mode::Markers)
        .hover_info(HoverInfo::Text)
        .hover_text_array(hover.collect::<Vec<_>>())
        .marker(Marker::new().size(3).opacity(0.8).color(css(BAR, 1.0)));
    plot.add_trace(dots);
    (plot, reach.beyond)
}

fn histograms(errors: &[[f64; 3]]) -> Vec<Plot> {
    let along = |axis: usize| errors.iter().map(|error| error[axis]).collect::<Vec<_>>();
    let norms = errors.iter().map(|error| norm(*error)).collect();
    let all = [
        ("x error (mm)", along(0), XYZ[0]),
        ("y error (mm)", along(1), XYZ[1]),
        ("z error (mm)", along(2), XYZ[2]),
        ("norm of the error (mm)", norms, INK),
    ];
    all.into_iter().map(|(name, values, colour)| histogram(name, &[(values, css(colour, 0.75))])).collect()
}
