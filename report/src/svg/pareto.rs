//! The share of each source, the largest first, and the shares added up.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, Side, line, panel, px, rgb, text};
use crate::axis::{Axis, BAR, GREY, INK, XYZ};
use crate::figure::Named;
use crate::shares::shares;
use abbe_study::analyze::Report;

pub(super) fn draw(sheet: &Sheet, figure: &Named, report: &Report) -> Result<String, Failed> {
    let shares = shares(figure, report);
    let unit = figure.axis(report).unit;
    let share = Axis { name: "share".to_owned(), unit: "%".to_owned(), factor: 100.0 };
    let rank = Axis { name: String::new(), unit: String::new(), factor: 1.0 };
    sheet.draw(|area| {
        let (chart_area, names_area) = area.split_vertically(px(380.0));
        let x = Side { axis: &rank, range: [-0.8, shares.len() as f64 - 0.4], about: 0, labelled: false };
        let y = Side { axis: &share, range: [0.0, 105.0], about: 6, labelled: true };
        let mut chart = panel(&chart_area, &x, &y, 18.0)?;
        let bars = shares.iter().enumerate().map(|(i, bar)| {
            let at = i as f64;
            Rectangle::new([(at - 0.36, 0.0), (at + 0.36, share.show(bar.share))], rgb(BAR).filled())
        });
        chart.draw_series(bars)?;
        let curve = shares.iter().enumerate().map(|(i, bar)| (i as f64, share.show(bar.cumulative)));
        let curve = curve.collect::<Vec<_>>();
        chart.draw_series(LineSeries::new(curve.iter().copied(), line(XYZ[0], 1.8)))?;
        chart.draw_series(curve.iter().map(|at| Circle::new(*at, px(3.2), rgb(XYZ[0]).filled())))?;
        for (i, bar) in shares.iter().enumerate() {
            let label = format!("{} {unit}", abbe_study::number::trimmed(bar.largest, 3));
            let at = (i as f64, share.show(bar.share));
            // Where the curve begins the number makes room for it.
            let inside = i == 0 && bar.share > 0.15 && shares.len() < 9;
            let (down, style) = if inside {
                (px(12.0), text(11.0, (255, 255, 255), HPos::Center, VPos::Top))
            } else {
                let side = if i == 0 { HPos::Right } else { HPos::Center };
                (-px(4.0), text(11.0, INK, side, VPos::Bottom))
            };
            chart.draw_series([EmptyElement::at(at) + Text::new(label, (0, down), style)])?;
        }
        let width = px(1.0).max((f64::from(px(900.0 - 92.0)) / shares.len().max(1) as f64) as i32);
        for (i, bar) in shares.iter().enumerate() {
            let (x, _) = chart.backend_coord(&(i as f64, 0.0));
            let style = text(11.0, INK, HPos::Center, VPos::Top);
            let x = x - chart_area.get_base_pixel().0;
            for (row, words) in wrapped(&bar.name, (width / px(6.2)).max(8) as usize).iter().enumerate() {
                let at = (x, px(2.0 + 14.0 * row as f64));
                names_area.draw(&Text::new(words.as_str(), at, style.clone()))?;
            }
        }
        let style = text(11.0, GREY, HPos::Right, VPos::Bottom);
        let (width, height) = names_area.dim_in_pixel();
        let note = "bars: share of the sum of the largest errors · line: shares added up";
        names_area.draw(&Text::new(note, (width as i32 - px(18.0), height as i32 - px(6.0)), style))?;
        Ok(())
    })
}

/// Words in lines of at most so many letters, longer words aside.
fn wrapped(name: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in name.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => word.clone_into(line),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
