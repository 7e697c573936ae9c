//! Reports in notebooks.

use crate::markup::escaped;

/// Largest number of lines of a text.
const LINES: usize = 500;

/// Formats the first screen of a report and its full text for a notebook: the headline, which is
/// the first paragraph, the rest of the first screen, and everything else below a heading that
/// opens it.
pub fn notebook(answer: &str, full: &str) -> String {
    let (headline, rest) = answer.trim().split_once("\n\n").unwrap_or((answer.trim(), ""));
    let mut html = format!("<div><strong>{}</strong>", escaped(&headline.replace('\n', " ")));
    if !rest.trim().is_empty() {
        html += &text(rest);
    }
    let details = full.trim().strip_prefix(answer.trim()).unwrap_or(full);
    if !details.trim().is_empty() {
        html += &format!("<details><summary>All tables</summary>{}</details>", text(details));
    }
    html + "</div>"
}

fn text(text: &str) -> String {
    let lines: Vec<&str> = text.trim_matches('\n').lines().collect();
    let mut shown = escaped(&lines[..LINES.min(lines.len())].join("\n"));
    if lines.len() > LINES {
        shown += &format!("\n… {} more lines", lines.len() - LINES);
    }
    format!("<pre style=\"line-height:1.3\">{shown}</pre>")
}
