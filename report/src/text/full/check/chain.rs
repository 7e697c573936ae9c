//! Nominal chain at home: Denavit-Hartenberg numbers of frames that have them, axes and origins
//! of the others.

use abbe_spec::Spec;
use abbe_study::check::{Chain, Link};
use abbe_study::number::{short, trimmed};

use super::super::table;

pub(super) fn text(chain: &Chain, spec: &Spec) -> String {
    let length = spec.length.symbol();
    let named = |frame: Option<usize>| format!("F_{}", frame.map_or(0, |frame| frame + 1));
    let mut text = String::new();
    let numbered = || (1..).zip(&chain.frames);
    if chain.frames.iter().any(|link| link.dh.is_some()) {
        let rows = numbered().filter_map(|(i, link)| {
            let dh = link.dh?;
            let angle = |value: f64| format!("{}°", trimmed(value.to_degrees(), 6));
            let [theta, alpha] = [dh.theta, dh.alpha].map(angle);
            Some([
                i.to_string(),
                link.name.clone(),
                theta,
                short(dh.d),
                short(dh.a),
                alpha,
                dh.convention.to_owned(),
            ])
        });
        let [d, a] = ["d", "a"].map(|name| format!("{name} ({length})"));
        let header = ["", "frame", "theta", d.as_str(), a.as_str(), "alpha", "Denavit-Hartenberg"];
        text += &format!("Nominal chain at home\n{}\n", table(&header, rows));
    }
    let origin = format!("origin ({length})");
    let header = ["", "from", "to", "x axis", "y axis", "z axis", origin.as_str()];
    let others = numbered().filter(|(_, link)| link.dh.is_none()).map(|(i, Link { name, matrix, .. })| {
        row(i.to_string(), named(spec.frames[i - 1].parent), name.clone(), matrix)
    });
    let tool = row(String::new(), named(Some(spec.tool_frame)), "tool point".to_owned(), &chain.tool);
    let home = row(String::new(), "F_0".to_owned(), "tool point".to_owned(), &chain.pose);
    text + &format!("Axes and origins at home\n{}", table(&header, others.chain([tool, home])))
}

/// The columns of a matrix.
fn row(number: String, from: String, to: String, matrix: &[[f64; 4]; 4]) -> [String; 7] {
    let column = |j: usize| {
        let entries = [0, 1, 2].map(|i| match j {
            3 => short(trimmed(matrix[i][j], 6).parse().unwrap_or(matrix[i][j])),
            _ => trimmed(matrix[i][j], 6),
        });
        format!("({})", entries.join(", "))
    };
    [number, from, to, column(0), column(1), column(2), column(3)]
}
