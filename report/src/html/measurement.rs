//! The page of a measurement: errors in space and how often which error occurs, as in the paper's Figures 13 and 14.

use abbe_codegen::spec::Spec;
use abbe_study::measure::{Report, RowError};
use abbe_study::number::{fixed, trimmed};
use plotly::common::{HoverInfo, Marker, Mode};
use plotly::layout::AspectMode;
use plotly::{Bar, Layout, Plot, Scatter3D};

use super::{document, escaped, section, style};
use crate::axis::{BAR, INK, XYZ, css};

/// The most points that are drawn.
const MOST: usize = 5000;
/// The bins of a histogram.
const BINS: usize = 40;
/// Its machine is in Figures 13 and 14.
const PAPER: &str = "High Performance Medical Robot Requirements and Accuracy Analysis";

/// The page of a measurement; `spec` is that of the machine.
pub fn measurement(spec: &Spec, report: &Report) -> String {
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
    let mut figures = figure(
        "Accuracy: errors in space",
        &of_paper(13),
        &[cloud(&position, &report.row_errors)],
        560,
        "Each dot is ΔX of one row.",
    );
    figures += &figure(
        "Accuracy: how often which error occurs",
        &of_paper(14),
        &histograms(&position),
        260,
        "ΔX of all rows.",
    );
    if !about.is_empty() {
        let words = "About the barycentre of the visits of each configuration.";
        figures += &figure(
            "Repeatability: how often which error occurs",
            &of_paper(14),
            &histograms(&about),
            260,
            words,
        );
    }
    let body = [
        heading,
        section("Rows", &format!("<p>{lines}</p>\n")),
        section("ΔX = measured − ideal", &(table(report) + &words)),
        section("Figures", &format!("<p>Errors are in mm.</p>\n{figures}")),
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

/// Where the paper shows the same of the same machine.
fn paper_figure(number: u32) -> String {
    format!(" <span class=\"paper\">cf. Figure {number} of the paper</span>")
}

fn figure(title: &str, paper: &str, plots: &[Plot], height: u32, words: &str) -> String {
    let slug: String =
        title.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect();
    let panels = plots.iter().enumerate().map(|(i, plot)| {
        let id = format!("{slug}-{}", i + 1);
        format!("<div class=\"plot\" style=\"height:{height}px\">{}</div>\n", plot.to_inline_html(Some(&id)))
    });
    format!(
        "<figure>\n<h3>{title}{paper}</h3>\n<div class=\"plots of-{}\">\n{}</div>\n\
         <figcaption>{words}</figcaption>\n</figure>\n",
        plots.len(),
        panels.collect::<String>()
    )
}

fn cloud(errors: &[[f64; 3]], rows: &[RowError]) -> Plot {
    let scene = style::scene(["x error (mm)", "y error (mm)", "z error (mm)"], AspectMode::Data, 2, 0.8);
    let mut plot = style::plot(Layout::new().margin(style::margin([0, 0, 0, 0])).scene(scene));
    let step = errors.len().div_ceil(MOST).max(1);
    let lines = rows.iter().map(|row| row.observation.line);
    let shown: Vec<(&[f64; 3], u64)> = errors.iter().zip(lines).step_by(step).collect();
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
    plot
}

fn histograms(errors: &[[f64; 3]]) -> Vec<Plot> {
    let along = |axis: usize| errors.iter().map(|error| error[axis]).collect::<Vec<_>>();
    let norms = errors.iter().map(|e| e.iter().map(|v| v * v).sum::<f64>().sqrt()).collect();
    let all = [
        ("x error", along(0), XYZ[0]),
        ("y error", along(1), XYZ[1]),
        ("z error", along(2), XYZ[2]),
        ("norm of the error", norms, INK),
    ];
    all.into_iter()
        .map(|(name, values, colour)| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let width = ((most - least) / BINS as f64).max(1e-9);
            let mut counts = vec![0_usize; BINS];
            for value in &values {
                counts[(((value - least) / width) as usize).min(BINS - 1)] += 1;
            }
            let middles: Vec<f64> = (0..BINS).map(|i| round(least + (i as f64 + 0.5) * width)).collect();
            let layout = Layout::new()
                .margin(style::margin([56, 10, 10, 44]))
                .x_axis(style::axis(&format!("{name} (mm)")))
                .y_axis(style::axis("rows"));
            let mut plot = style::plot(layout);
            plot.add_trace(
                Bar::new(middles, counts).width(width * 0.94).marker(Marker::new().color(css(colour, 0.75))),
            );
            plot
        })
        .collect()
}

/// Six digits: the file need not be longer.
fn round(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
