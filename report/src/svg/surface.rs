//! The error farthest from zero over two travels: one surface for each axis.

use plotters::coord::cartesian::Cartesian3d;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, line, px, text};
use super::rule::Rule;
use crate::axis::{Axis, FAINT, GREY, INK, PUBLISHED, with_room};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Mesh, Range};
use abbe_study::study_file::Over;

pub(super) fn draw(mesh: &Mesh, over: [Over; 2], figure: &Named, report: &Report) -> Result<String, Failed> {
    let [first, second] = over.map(|over| Axis::over(over, &report.spec));
    let errors = figure.axis(report);
    let what = format!("{} farthest from zero where others vary too{}", figure.errors(), figure.remark());
    Sheet::new((1200, 430), figure, report, &what).draw(|area| {
        for (axis, area) in area.split_evenly((1, 3)).iter().enumerate() {
            let heights = heights(mesh, axis, &errors);
            let mut span = Range { least: 0.0, largest: 0.0 };
            heights.iter().flatten().flatten().for_each(|height| span.add(*height));
            let span = with_room([span.least, span.largest], 0.0);
            let xs = mesh.first.iter().map(|value| first.show(*value)).collect::<Vec<_>>();
            let zs = mesh.second.iter().map(|value| second.show(*value)).collect::<Vec<_>>();
            let (x_range, z_range) = (ends(&xs), ends(&zs));
            let (x_ticks, z_ticks) = (first.ticks(x_range, 4), second.ticks(z_range, 4));
            let y_ticks = errors.ticks(span, 5);

            let mut chart = ChartBuilder::on(area)
                .margin_top(px(24.0))
                .margin_left(px(38.0))
                .margin_bottom(px(40.0))
                .margin_right(px(38.0))
                .build_cartesian_3d(
                    Rule { range: x_range, labelled: x_ticks.values.clone() },
                    Rule { range: span, labelled: y_ticks.values.clone() },
                    Rule { range: z_range, labelled: z_ticks.values.clone() },
                )?;
            chart.with_projection(|mut view| {
                view.pitch = 0.42;
                view.yaw = 0.7;
                view.scale = 0.86;
                view.into_matrix()
            });
            let faint = line(FAINT, 1.0);
            chart
                .configure_axes()
                .axis_panel_style(WHITE.filled())
                .bold_grid_style(faint)
                .light_grid_style(line(FAINT, 0.0))
                .label_style(text(10.0, GREY, HPos::Center, VPos::Center))
                .x_formatter(&|value| x_ticks.label(*value))
                .y_formatter(&|value| y_ticks.label(*value))
                .z_formatter(&|value| z_ticks.label(*value))
                .tick_size(px(4.0))
                .draw()?;

            let colour = |height: f64| {
                let share = (height - span[0]) / (span[1] - span[0]);
                ViridisRGB.get_color(share.clamp(0.0, 1.0))
            };
            for (corners, mean) in patches(&xs, &zs, &heights) {
                chart.draw_series([Polygon::new(corners, colour(mean).filled())])?;
                let edge = corners.iter().chain(corners.first()).copied();
                chart.draw_series([PathElement::new(
                    edge.collect::<Vec<_>>(),
                    BLACK.mix(0.35).stroke_width(px(0.4).unsigned_abs()),
                )])?;
            }

            let (width, _) = area.dim_in_pixel();
            let title = text(13.0, INK, HPos::Center, VPos::Top);
            let name = format!("{} {} ({})", figure.rows(report)[axis], figure.errors(), errors.unit);
            area.draw(&Text::new(name, (width as i32 / 2, px(4.0)), title))?;
            axis_titles(&mut chart, [&first, &second], x_range, z_range, span)?;
            printed(area, axis, mesh, figure, report)?;
        }
        Ok(())
    })
}

type Space = Cartesian3d<Rule, Rule, Rule>;

/// The names of the two travels beside their axes.
fn axis_titles(
    chart: &mut ChartContext<SVGBackend, Space>,
    [first, second]: [&Axis; 2],
    x: [f64; 2],
    z: [f64; 2],
    y: [f64; 2],
) -> Result<(), Failed> {
    let middle = |[from, to]: [f64; 2]| f64::midpoint(from, to);
    let style = |horizontal| text(11.5, INK, horizontal, VPos::Top);
    let first_name = Text::new(first.title(), (-px(14.0), px(24.0)), style(HPos::Right));
    chart.draw_series([EmptyElement::at((middle(x), y[0], z[1])) + first_name])?;
    let second_name = Text::new(second.title(), (px(14.0), px(24.0)), style(HPos::Left));
    chart.draw_series([EmptyElement::at((x[1], y[0], middle(z))) + second_name])?;
    Ok(())
}

/// What is published on an axis, below its surface.
fn printed(
    area: &super::canvas::Area,
    axis: usize,
    mesh: &Mesh,
    figure: &Named,
    report: &Report,
) -> Result<(), Failed> {
    let mut span = Range::default();
    mesh.cells.iter().flatten().flatten().for_each(|cell| span.join(cell.errors[axis]));
    let errors = figure.axis(report);
    let here =
        format!("here: {} {}", abbe_study::number::trimmed(errors.show(span.farther()), 4), errors.unit);
    let label = match figure.printed(axis, span, report) {
        Some(printed) => format!("{here} · {}", printed.label()),
        None => here,
    };
    let (width, height) = area.dim_in_pixel();
    let style = text(11.0, PUBLISHED, HPos::Center, VPos::Bottom);
    area.draw(&Text::new(label, (width as i32 / 2, height as i32 - px(8.0)), style))
}

fn ends(values: &[f64]) -> [f64; 2] {
    let ends = values.first().zip(values.last()).map(|(first, last)| [*first, *last]);
    let [first, last] = ends.unwrap_or_default();
    if first < last { [first, last] } else { [first - 1.0, first + 1.0] }
}

/// The error farthest from zero in every cell, in the unit of the axis.
fn heights(mesh: &Mesh, axis: usize, errors: &Axis) -> Vec<Vec<Option<f64>>> {
    let height = |cell: &Option<abbe_study::analyze::figures::Extremes>| {
        cell.as_ref().map(|cell| errors.show(cell.errors[axis].farther()))
    };
    mesh.cells.iter().map(|line| line.iter().map(height).collect()).collect()
}

type Corner = (f64, f64, f64);

/// The patches between four neighbours, those in the back first, with their mean heights.
fn patches(xs: &[f64], zs: &[f64], heights: &[Vec<Option<f64>>]) -> Vec<([Corner; 4], f64)> {
    let mut patches = Vec::new();
    for i in 0..xs.len().saturating_sub(1) {
        for j in 0..zs.len().saturating_sub(1) {
            let corner = |i: usize, j: usize| Some((xs[i], heights[i][j]?, zs[j]));
            let corners = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
            if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                patches.push(([a, b, c, d], (a.1 + b.1 + c.1 + d.1) / 4.0));
            }
        }
    }
    patches
}
