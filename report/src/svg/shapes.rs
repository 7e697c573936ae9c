//! Drawing of marks at pixel positions.

use std::collections::BTreeSet;

use super::canvas::{Anchor, Area, Canvas, Font, Pixel, path, px};
use crate::scene::{Colour, Corner, Mark, Shape};

/// Draws a mark. Labels stay within the area.
pub(super) fn draw(canvas: &mut Canvas, mark: &Mark<Pixel>, area: &Area) {
    let colour = mark.colour.css();
    let opacity = |kind: &str| match mark.opacity {
        1.0 => String::new(),
        opacity => format!(" {kind}-opacity=\"{opacity}\""),
    };
    let fill = || format!("fill=\"{colour}\"{}", opacity("fill"));
    let stroke = |width: f64| {
        format!(
            "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{}",
            px(width),
            opacity("stroke")
        )
    };
    match &mark.shape {
        Shape::Lines { lines, width, dashed } => {
            let d = lines.iter().map(|line| path(line)).collect::<String>();
            let dashes = if *dashed { " stroke-dasharray=\"6 4\"" } else { "" };
            canvas.path(&d, &format!("{}{dashes}", stroke(*width)), &mark.name);
        }
        Shape::Points { points, radius } => canvas.path(&dots(points), &stroke(2.0 * radius), &mark.name),
        Shape::Crosses { points } => {
            let cross = |[x, y]: &Pixel| format!("M{} {}l10 10m0-10l-10 10", px(x - 5.0), px(y - 5.0));
            canvas.path(&points.iter().map(cross).collect::<String>(), &stroke(2.0), &mark.name);
        }
        Shape::Band { lower, upper } => {
            let outline = upper.iter().chain(lower.iter().rev()).copied().collect::<Vec<_>>();
            canvas.path(&(path(&outline) + "z"), &fill(), &mark.name);
        }
        Shape::Bars { bars } => {
            let bar = |[[x0, y0], [x1, y1]]: &[Pixel; 2]| {
                format!("M{} {}H{}V{}H{}z", px(*x0), px(*y0), px(*x1), px(*y1), px(*x0))
            };
            let edge = " stroke=\"#fff\" stroke-width=\"0.6\"";
            let d = bars.iter().map(bar).collect::<String>();
            canvas.path(&d, &format!("{}{edge}", fill()), &mark.name);
        }
        Shape::Surface { corners, range } => surface(canvas, corners, *range),
        Shape::Texts { texts } => words(canvas, texts, area),
    }
}

/// Returns the path of dots, one per half pixel: others would be hidden.
fn dots(points: &[Pixel]) -> String {
    let places = points.iter().map(|[x, y]| [*y, *x].map(|pixels| (2.0 * pixels).round() as i64));
    let places = places.collect::<BTreeSet<_>>();
    let dot = |[y, x]: [i64; 2]| format!("M{} {}h0", x as f64 / 2.0, y as f64 / 2.0);
    places.into_iter().map(dot).collect()
}

/// Draws the patches whose four corners are known, each in the colour of its mean.
fn surface(canvas: &mut Canvas, corners: &[Vec<Option<Corner<Pixel>>>], [least, most]: [f64; 2]) {
    for lines in corners.windows(2) {
        for (one, other) in lines[0].windows(2).zip(lines[1].windows(2)) {
            let [Some(a), Some(b), Some(c), Some(d)] = [one[0], one[1], other[1], other[0]] else { continue };
            let mean = (a.value + b.value + c.value + d.value) / 4.0;
            let colour = Colour::graded((mean - least) / (most - least));
            let edge =
                "stroke=\"#000\" stroke-opacity=\"0.3\" stroke-width=\"0.4\" stroke-linejoin=\"round\"";
            let d = path(&[a, b, c, d].map(|corner| corner.at)) + "z";
            canvas.path(&d, &format!("fill=\"{}\" {edge}", colour.css()), "");
        }
    }
}

/// Draws labels at their positions, shifted down where they would overlap.
fn words(canvas: &mut Canvas, texts: &[(Pixel, String)], area: &Area) {
    const LINE: f64 = 15.0;
    // Rounding may leave lines that are one below the other a little closer.
    const OVERLAP: f64 = LINE - 1e-6;
    let font = Font::WORDS;
    let mut taken: Vec<[f64; 3]> = Vec::new();
    for ([x, y], text) in texts {
        let width = font.width(text);
        let x = (x + 6.0).min(area.right() - width).max(area.left);
        let mut y = y - 6.0;
        let hits =
            |[from, to, line]: &[f64; 3], y: f64| x < *to && x + width > *from && (line - y).abs() < OVERLAP;
        while let Some([_, _, line]) = taken.iter().find(|other| hits(other, y)) {
            y = line + LINE;
        }
        taken.push([x, x + width, y]);
        canvas.haloed_text([x, y], text, font, Anchor::Start);
    }
}

#[cfg(test)]
mod tests;
