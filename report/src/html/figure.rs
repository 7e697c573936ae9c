//! Numbered figures: the SVG of a scene with title and caption.

use super::escaped;
use crate::scene::Scene;
use crate::svg;

/// Formats figures in order, numbered after `before` others.
pub(super) fn figures(scenes: &[Scene], before: usize) -> String {
    scenes.iter().enumerate().map(|(i, scene)| figure(before + i + 1, scene, "")).collect()
}

/// Formats a figure; `more` is HTML appended to its caption.
pub(super) fn figure(number: usize, scene: &Scene, more: &str) -> String {
    let heading = format!("{number}. {}", escaped(&scene.title));
    let reference = match scene.reference.as_str() {
        "" => String::new(),
        reference => format!(" <span class=\"paper\">{}</span>", escaped(reference)),
    };
    unnumbered(&format!("<h3>{heading}{reference}</h3>\n"), scene, more)
}

/// Formats a figure with a given heading.
pub(super) fn unnumbered(heading: &str, scene: &Scene, more: &str) -> String {
    let subtitle = if scene.subtitle.is_empty() { String::new() } else { format!("{}.", scene.subtitle) };
    let caption = [escaped(&subtitle), escaped(&scene.caption), more.to_owned()].join(" ");
    format!(
        "<figure>\n{heading}<div class=\"picture\">{}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
        svg::embedded(scene),
        caption.trim()
    )
}
