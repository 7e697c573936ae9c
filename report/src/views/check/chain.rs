//! Nominal chain at home: Denavit-Hartenberg numbers of frames that have them, axes and origins
//! of the others.

use abbe_spec::Spec;
use abbe_study::check::{Chain, Link};
use abbe_study::number::{short, trimmed};

use crate::document::{Section, Table};

pub(super) fn sections(chain: &Chain, spec: &Spec) -> [Section; 2] {
    let length = spec.length.symbol();
    let named = |frame: Option<usize>| format!("F_{}", frame.map_or(0, |frame| frame + 1));
    let numbered = || (1..).zip(&chain.frames);
    let dh = numbered().filter_map(|(i, link)| {
        let dh = link.dh?;
        let angle = |value: f64| format!("{}°", trimmed(value.to_degrees(), 6));
        let [theta, alpha] = [dh.theta, dh.alpha].map(angle);
        let [d, a] = [dh.d, dh.a].map(short);
        Some([i.to_string(), link.name.clone(), theta, d, a, alpha, dh.convention.to_owned()])
    });
    let columns = [
        "",
        "frame",
        ">theta",
        &format!(">d ({length})"),
        &format!(">a ({length})"),
        ">alpha",
        "Denavit-Hartenberg",
    ];
    let numbers = Table::new("", columns).rows(dh);
    let others = numbered().filter(|(_, link)| link.dh.is_none()).map(|(i, Link { name, matrix, .. })| {
        row(i.to_string(), named(spec.frames[i - 1].parent), name.clone(), matrix)
    });
    let tool = row(String::new(), named(Some(spec.tool_frame)), "tool point".to_owned(), &chain.tool);
    let home = row(String::new(), "F_0".to_owned(), "tool point".to_owned(), &chain.pose);
    let origin = format!("origin ({length})");
    let columns = ["", "from", "to", "x axis", "y axis", "z axis", &origin];
    let axes = Table::new("", columns).rows(others.chain([tool, home]));
    [
        Section::full("Nominal chain at home").table(numbers),
        Section::full("Axes and origins at home").table(axes),
    ]
}

/// Formats the columns of a matrix.
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
