//! What is left, as pictures: vectors in space, over the order of the rows, over each joint, and how often.

use abbe_spec::Spec;
use abbe_study::study_file::Over;
use plotly::common::{ExponentFormat, HoverInfo, Line, Marker, Mode};
use plotly::layout::{AspectMode, BarMode};
use plotly::{Bar, Layout, Plot, Scatter, Scatter3D};

use super::figure::{Figures, round, step, thinned};
use super::reach::Reach;
use super::style;
use crate::axis::{Axis, BAR, GREY, INK, XYZ, css};

/// The most vectors that are drawn, the most dots over rows, and over a joint.
const VECTORS: usize = 400;
const DOTS: usize = 3000;
const DOTS_OVER_JOINT: usize = 1200;
/// The bins of a histogram.
const BINS: usize = 40;

/// One point: where it is, and its error before and after. In the spec's length unit.
pub(super) struct Residual<'r> {
    pub(super) line: u64,
    pub(super) q: &'r [f64],
    pub(super) point: [f64; 3],
    pub(super) before: Option<[f64; 3]>,
    pub(super) after: [f64; 3],
}

/// What the two errors of every point are called.
pub(super) struct Names {
    pub(super) before: &'static str,
    pub(super) after: &'static str,
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Vectors, and what is over rows and joints, of points with one error each.
pub(super) fn over_all(figures: &mut Figures, residuals: &[Residual], name: &'static str, spec: &Spec) {
    let names = Names { before: "", after: name };
    vectors(figures, residuals, &names, spec);
    over_rows_and_joints(figures, residuals, &format!("{name}."), spec);
}

/// All pictures of a list of points.
pub(super) fn figures(figures: &mut Figures, residuals: &[Residual], names: &Names, spec: &Spec) {
    let to_mm = 1e3 * spec.length.in_metres();
    let colours = format!("Grey: {}. Blue: {}.", names.before, names.after);
    vectors(figures, residuals, names, spec);
    over_rows_and_joints(figures, residuals, &colours, spec);
    let caption = format!("{colours} Of x, y and z: {}.", names.after);
    figures.add("How often which error occurs", &histograms(residuals, to_mm), 240, &caption);
}

fn over_rows_and_joints(figures: &mut Figures, residuals: &[Residual], colours: &str, spec: &Spec) {
    let to_mm = 1e3 * spec.length.in_metres();
    let every = step(residuals.len(), DOTS);
    figures.add(
        "Over the order of the rows",
        &[over_rows(residuals, every, to_mm)],
        300,
        &format!("{colours}{}", thinned(residuals.len(), every)),
    );
    let joints = (0..spec.variables.len()).filter_map(|joint| over_joint(residuals, joint, spec, to_mm));
    let every = step(residuals.len(), DOTS_OVER_JOINT);
    figures.add(
        "Over each joint",
        &joints.collect::<Vec<_>>(),
        230,
        &format!(
            "{colours} A joint that stays where it is has no picture.{}",
            thinned(residuals.len(), every)
        ),
    );
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Side by side with one scale.
fn vectors(figures: &mut Figures, residuals: &[Residual], names: &Names, spec: &Spec) {
    let to_mm = 1e3 * spec.length.in_metres();
    let every = step(residuals.len(), VECTORS);
    let shown: Vec<&Residual> = residuals.iter().step_by(every).collect();
    let span = (0..3).map(|axis| {
        let along = shown.iter().map(|residual| residual.point[axis]);
        let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        (most - least).max(0.0)
    });
    let diagonal = norm([0, 1, 2].map({
        let span = span.collect::<Vec<_>>();
        move |axis| span[axis]
    }));
    // The longest but for a few gross ones are a tenth of all that is drawn.
    let scale = |error: &dyn Fn(&Residual) -> [f64; 3]| {
        let mut sizes: Vec<f64> = shown.iter().map(|residual| norm(error(residual))).collect();
        sizes.sort_by(f64::total_cmp);
        let long = sizes.get(sizes.len().saturating_sub(1) * 19 / 20).copied().unwrap_or_default();
        if long > 0.0 && diagonal > 0.0 { round_down(0.1 * diagonal / long) } else { 1.0 }
    };
    let after = |residual: &Residual| Some(residual.after);
    let own = scale(&|residual| residual.after);
    let many = |scale: f64| abbe_study::number::short(scale);
    let mut plots = Vec::new();
    let mut which = format!("{}, {} times as long as they are.", capital(names.after), many(own));
    if shown.iter().any(|residual| residual.before.is_some()) {
        let same = scale(&|residual| residual.before.unwrap_or(residual.after));
        plots.push(arrows(&shown, |residual| residual.before, same, GREY, spec, to_mm));
        plots.push(arrows(&shown, after, same, BAR, spec, to_mm));
        which = format!(
            "Left: {}. Middle: {}, both {} times as long as they are. Right: {}, {} times.",
            names.before,
            names.after,
            many(same),
            names.after,
            many(own)
        );
    }
    plots.push(arrows(&shown, after, own, BAR, spec, to_mm));
    let words = format!("{which} Lines begin at the tool point, a dot.{}", thinned(residuals.len(), every));
    figures.add("Errors in space", &plots, if plots.len() == 1 { 520 } else { 400 }, &words);
}

/// 1, 2 or 5 times a power of ten.
fn round_down(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= value * (1.0 + 1e-9));
    factor.unwrap_or(1.0) * power
}

fn arrows(
    shown: &[&Residual],
    error: impl Fn(&Residual) -> Option<[f64; 3]>,
    scale: f64,
    colour: (u8, u8, u8),
    spec: &Spec,
    to_mm: f64,
) -> Plot {
    let unit = spec.length.symbol();
    let titles = ["x", "y", "z"].map(|axis| format!("{axis} ({unit})"));
    let scene = style::scene(titles.each_ref().map(String::as_str), AspectMode::Data, 2, 0.9);
    let mut plot = style::plot(Layout::new().margin(style::margin([0, 0, 0, 0])).scene(scene));
    let drawn = || shown.iter().filter_map(|residual| Some((residual, error(residual)?)));
    let line = |axis: usize| {
        let ends = drawn().flat_map(move |(residual, error)| {
            let from = residual.point[axis];
            [Some(round(from)), Some(round(from + scale * error[axis])), None]
        });
        ends.collect::<Vec<_>>()
    };
    plot.add_trace(
        Scatter3D::new(line(0), line(1), line(2))
            .mode(Mode::Lines)
            .line(Line::new().width(3.0).color(css(colour, 1.0)))
            .hover_info(HoverInfo::None),
    );
    let along = |axis: usize| drawn().map(|(residual, _)| round(residual.point[axis])).collect::<Vec<_>>();
    let hover = drawn().map(|(residual, error)| {
        let [x, y, z] = error.map(|v| abbe_study::number::trimmed(v * to_mm, 4));
        format!("line {}: ({x}, {y}, {z}) mm", residual.line)
    });
    plot.add_trace(
        Scatter3D::new(along(0), along(1), along(2))
            .mode(Mode::Markers)
            .marker(Marker::new().size(2).color(css(INK, 0.7)))
            .hover_info(HoverInfo::Text)
            .hover_text_array(hover.collect::<Vec<_>>()),
    );
    plot
}

/// Norms as dots: before in grey below, after in blue.
fn dots(plot: &mut Plot, shown: &[(f64, &Residual)], to_mm: f64) {
    let size = match shown.len() {
        0..300 => 5,
        300..1500 => 4,
        _ => 3,
    };
    let mut add = |all: Vec<(f64, f64, u64)>, colour: String| {
        let hover = all
            .iter()
            .map(|(_, norm, line)| format!("line {line}: {} mm", abbe_study::number::trimmed(*norm, 4)));
        let hover = hover.collect::<Vec<_>>();
        let (x, y): (Vec<f64>, Vec<f64>) = all.iter().map(|(x, norm, _)| (round(*x), round(*norm))).unzip();
        plot.add_trace(
            Scatter::new(x, y)
                .mode(Mode::Markers)
                .marker(Marker::new().size(size).color(colour))
                .hover_info(HoverInfo::Text)
                .hover_text_array(hover),
        );
    };
    let before =
        shown.iter().filter_map(|(x, residual)| Some((*x, norm(residual.before?) * to_mm, residual.line)));
    add(before.collect(), css(GREY, 0.35));
    add(
        shown.iter().map(|(x, residual)| (*x, norm(residual.after) * to_mm, residual.line)).collect(),
        css(BAR, 0.9),
    );
}

/// The axis of errors of a picture of these points, but for gross ones.
fn error_axis(residuals: &[Residual], to_mm: f64) -> plotly::layout::Axis {
    let after = residuals.iter().map(|residual| norm(residual.after) * to_mm);
    let before = residuals.iter().filter_map(|residual| Some(norm(residual.before?) * to_mm));
    let reach = Reach::new(after.chain(before).collect());
    let axis = style::axis(&reach.title("error (mm)"));
    match reach.beyond {
        0 => axis.range_mode(plotly::layout::RangeMode::ToZero),
        _ => axis.range(vec![0.0, round(1.05 * reach.ends[1])]),
    }
}

fn over_rows(residuals: &[Residual], every: usize, to_mm: f64) -> Plot {
    let layout = Layout::new()
        .margin(style::margin([56, 10, 10, 44]))
        .x_axis(style::axis("points in the order of the rows").exponent_format(ExponentFormat::None))
        .y_axis(error_axis(residuals, to_mm));
    let mut plot = style::plot(layout);
    let numbered = residuals.iter().enumerate().map(|(i, residual)| (i as f64 + 1.0, residual));
    dots(&mut plot, &numbered.step_by(every).collect::<Vec<_>>(), to_mm);
    plot
}

/// None if it stays where it is.
fn over_joint(residuals: &[Residual], joint: usize, spec: &Spec, to_mm: f64) -> Option<Plot> {
    let axis = Axis::over(Over::Variable(joint), spec);
    let every = step(residuals.len(), DOTS_OVER_JOINT);
    let place = |residual: &Residual| axis.show(residual.q[joint]);
    let ends = residuals
        .iter()
        .map(place)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if ends.1 - ends.0 <= 1e-9 {
        return None;
    }
    let layout = Layout::new()
        .margin(style::margin([48, 10, 10, 44]))
        .x_axis(style::axis(&axis.title()))
        .y_axis(error_axis(residuals, to_mm));
    let mut plot = style::plot(layout);
    let shown = residuals.iter().step_by(every).map(|residual| (place(residual), residual));
    dots(&mut plot, &shown.collect::<Vec<_>>(), to_mm);
    Some(plot)
}

fn histograms(residuals: &[Residual], to_mm: f64) -> Vec<Plot> {
    let after =
        |axis: usize| residuals.iter().map(|residual| residual.after[axis] * to_mm).collect::<Vec<_>>();
    let norms = residuals.iter().map(|residual| norm(residual.after) * to_mm).collect::<Vec<_>>();
    let before =
        residuals.iter().filter_map(|residual| Some(norm(residual.before?) * to_mm)).collect::<Vec<_>>();
    let names = ["x", "y", "z"].map(|axis| format!("{axis} error (mm)"));
    let axes = names.iter().enumerate().map(|(i, name)| histogram(name, &[(after(i), css(XYZ[i], 0.75))]));
    let mut both = Vec::new();
    if !before.is_empty() {
        both.push((before, css(GREY, 0.45)));
    }
    both.push((norms, css(BAR, 0.75)));
    axes.chain([histogram("norm of the error (mm)", &both)]).collect()
}

/// Of several lists over the same bins, without gross values.
pub(super) fn histogram(name: &str, lists: &[(Vec<f64>, String)]) -> Plot {
    // Each has gross values of its own.
    let each: Vec<Reach> = lists.iter().map(|(values, _)| Reach::new(values.clone())).collect();
    let beyond = each.iter().map(|reach| reach.beyond).sum();
    let ends = each.iter().map(|reach| reach.ends);
    let ends = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or_default();
    let (reach, [least, most]) = (Reach { ends, beyond }, ends);
    let largest = lists.iter().map(|(values, _)| values.len()).max().unwrap_or_default();
    // As many as the square root of the values, so that twenty rows are no comb.
    let bins = ((largest as f64).sqrt() * 1.5).ceil().clamp(5.0, BINS as f64) as usize;
    let width = ((most - least) / bins as f64).max(1e-9);
    let layout = Layout::new()
        .margin(style::margin([56, 10, 10, 44]))
        .bar_mode(BarMode::Overlay)
        .x_axis(style::axis(&reach.title(name)))
        .y_axis(style::axis("how many").exponent_format(ExponentFormat::None));
    let mut plot = style::plot(layout);
    for (values, colour) in lists {
        let mut counts = vec![0_usize; bins];
        for value in values.iter().filter(|value| reach.contains(**value)) {
            counts[(((value - least) / width) as usize).min(bins - 1)] += 1;
        }
        let middles: Vec<f64> = (0..bins).map(|i| round(least + (i as f64 + 0.5) * width)).collect();
        plot.add_trace(
            Bar::new(middles, counts).width(width * 0.94).marker(Marker::new().color(colour.clone())),
        );
    }
    plot
}
