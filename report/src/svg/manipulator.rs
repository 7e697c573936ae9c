//! The manipulator as a stick figure with its frames, seen from the corner (1, 1, 1).

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, line, px, rgb, text};
use crate::axis::{Axis, GREY, INK, XYZ};
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Range;
use abbe_study::analyze::figures::{Place, Stick};

pub(super) fn draw(stick: &Stick, up: usize, sheet: &Sheet, report: &Report) -> Result<String, Failed> {
    let Stick { places, size } = stick;
    let size = *size;
    let seen = |point: [f64; 3]| {
        let (left, right, up) = (point[(up + 1) % 3], point[(up + 2) % 3], point[up]);
        let (sin, cos) = std::f64::consts::FRAC_PI_6.sin_cos();
        ((right - left) * cos, up - (left + right) * sin)
    };
    let tip = |place: &Place, axis: usize| {
        let length = 0.11 * size;
        std::array::from_fn(|i| place.origin[i] + length * place.axes[axis][i])
    };
    let (mut across, mut along) = (Range::default(), Range::default());
    for place in places {
        for point in [place.origin, tip(place, 0), tip(place, 1), tip(place, 2)] {
            let (x, y) = seen(point);
            across.add(x);
            along.add(y);
        }
    }

    sheet.draw(|area| {
        let (width, height) = area.dim_in_pixel();
        let (width, height) = (f64::from(width), f64::from(height));
        let room = f64::from(px(70.0));
        let scale = ((width - 4.0 * room) / (across.largest - across.least).max(1e-9))
            .min((height - 2.0 * room) / (along.largest - along.least).max(1e-9));
        let place_at = |(x, y): (f64, f64)| {
            let x = width / 2.0 + (x - across.middle()) * scale;
            let y = height / 2.0 - (y - along.middle()) * scale;
            (x.round() as i32, y.round() as i32)
        };
        let at = |point| place_at(seen(point));

        let links = places.iter().map(|place| at(place.origin)).collect::<Vec<_>>();
        area.draw(&PathElement::new(links.clone(), line((176, 182, 192), 7.0)))?;
        for place in places {
            for (axis, colour) in XYZ.into_iter().enumerate() {
                let arrow = vec![at(place.origin), at(tip(place, axis))];
                area.draw(&PathElement::new(arrow, line(colour, 2.2)))?;
            }
            area.draw(&Circle::new(at(place.origin), px(4.0), rgb(INK).filled()))?;
        }
        let mut taken: Vec<(i32, i32)> = Vec::new();
        for (place, (x, y)) in places.iter().zip(links) {
            // Between the axes that point up and to the lower right.
            let (mut x, mut y) = (x + px(7.0), y - px(20.0));
            // Labels of neighbours one below the other.
            while taken.iter().any(|other| (other.1 - y).abs() < px(15.0) && (other.0 - x).abs() < px(150.0))
            {
                y += px(15.0);
            }
            if x > width as i32 - px(160.0) {
                x = width as i32 - px(160.0);
            }
            taken.push((x, y));
            // Readable where a link passes behind it; letters are about this wide.
            let letters = place.label.chars().count() as f64;
            let behind = [(x - px(2.0), y - px(1.0)), (x + px(6.2 * letters), y + px(13.0))];
            area.draw(&Rectangle::new(behind, WHITE.mix(0.8).filled()))?;
            let style = text(12.0, INK, HPos::Left, VPos::Top);
            area.draw(&Text::new(place.label.as_str(), (x, y), style))?;
        }
        scale_bar(area, size, scale, report)
    })
}

/// A length to compare with, and the colours of the axes.
fn scale_bar(area: &super::canvas::Area, size: f64, scale: f64, report: &Report) -> Result<(), Failed> {
    let (_, height) = area.dim_in_pixel();
    let length = Axis::length("", &report.spec);
    let ticks = length.ticks([0.0, size / 2.0], 2);
    let bar = ticks.values.iter().copied().fold(0.0, f64::max);
    let (left, y) = (px(24.0), height as i32 - px(28.0));
    // Lengths along an axis are seen at their full size in this view.
    let right = left + (bar * scale) as i32;
    area.draw(&PathElement::new(vec![(left, y), (right, y)], line(INK, 2.0)))?;
    let label = format!("{} {}, along an axis", abbe_study::number::short(bar), length.unit);
    area.draw(&Text::new(label, (left, y + px(5.0)), text(11.0, GREY, HPos::Left, VPos::Top)))?;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let x = left + px(38.0 * axis as f64);
        let y = y - px(18.0);
        area.draw(&PathElement::new(vec![(x, y), (x + px(16.0), y)], line(XYZ[axis], 2.2)))?;
        let style = text(12.0, INK, HPos::Left, VPos::Center);
        area.draw(&Text::new(name, (x + px(20.0), y), style))?;
    }
    Ok(())
}
