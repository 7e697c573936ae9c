//! Numbered figures: the SVG of a scene with title and caption.

use super::escaped;
use crate::document::Figure;
use crate::svg;

/// Formats a figure with its number.
pub(super) fn figure(number: usize, Figure { scene, note, file }: &Figure) -> String {
    let reference = match scene.reference.as_str() {
        "" => String::new(),
        reference => format!(" <span class=\"paper\">{}</span>", escaped(reference)),
    };
    let subtitle = if scene.subtitle.is_empty() { String::new() } else { format!("{}.", scene.subtitle) };
    let file = match file.as_str() {
        "" => String::new(),
        file => format!("<a href=\"{file}\">{file}</a>"),
    };
    let caption = [&subtitle, &scene.caption, note].map(|text| escaped(text));
    let caption = caption.iter().chain([&file]).filter(|text| !text.is_empty());
    format!(
        "<figure>\n<h3>{number}. {}{reference}</h3>\n<div class=\"picture\">{}</div>\n<figcaption>{}</figcaption>\n\
         </figure>\n",
        escaped(&scene.title),
        svg::embedded(scene),
        caption.map(String::as_str).collect::<Vec<_>>().join(" ")
    )
}
