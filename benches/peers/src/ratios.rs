//! Speed ratios to the peers: more than 1 is in our favor.

use crate::batch::MANY;
use crate::measure::Times;
use crate::row::{Kind, Row, Side};

/// Returns the head of the table.
pub fn head() -> String {
    let titles = Kind::ALL.map(Kind::title).join(" | ");
    format!("| robot | | {titles} |\n|---|---|---|---|---|---|")
}

/// Returns the lines of a robot.
pub fn lines(robot: &str, rows: &[Row], times: &[Times]) -> Vec<String> {
    let ratios = Ratios { rows, times };
    let line = |title: &str, ratio: &dyn Fn(Kind) -> Option<f64>| {
        let cells = Kind::ALL.map(|kind| ratio(kind).map_or(String::new(), |ratio| format!("{ratio:.2}")));
        format!("| {robot} | {title} | {} |", cells.join(" | "))
    };
    let single = |row: &Row| row.side == Side::Ours && row.block == 1;
    let in_c = |row: &Row| row.side == Side::OurC;
    let batch = |row: &Row| row.side == Side::Ours && row.block > 1;
    let many = |row: &Row| row.side == Side::Ours && row.block == MANY;
    let interpreted = |row: &Row| row.side == Side::Interpreter;
    let generator = |row: &Row| row.side == Side::Generator;
    let library = |row: &Row| row.side == Side::Library;
    vec![
        line("best generator / ours, one by one", &|kind| ratios.fastest_over(kind, generator, single)),
        line("best generator / ours in C", &|kind| ratios.fastest_over(kind, generator, in_c)),
        line("Pinocchio / ours, one by one", &|kind| ratios.fastest_over(kind, library, single)),
        line("best generator / our best batch", &|kind| ratios.fastest_over(kind, generator, batch)),
        line("Pinocchio / our best batch", &|kind| ratios.fastest_over(kind, library, batch)),
        line(&format!("interpreter / compiled, {MANY} at once"), &|kind| {
            ratios.fastest_over(kind, interpreted, many)
        }),
    ]
}

struct Ratios<'t> {
    rows: &'t [Row],
    times: &'t [Times],
}

impl Ratios<'_> {
    /// Returns the ratio of the fastest of some rows to the fastest of others.
    fn fastest_over(
        &self,
        kind: Kind,
        these: impl Fn(&Row) -> bool,
        those: impl Fn(&Row) -> bool,
    ) -> Option<f64> {
        Some(self.fastest(kind, these)? / self.fastest(kind, those)?)
    }

    fn fastest(&self, kind: Kind, among: impl Fn(&Row) -> bool) -> Option<f64> {
        let those = self.rows.iter().zip(self.times).filter(|(row, _)| row.kind == kind && among(row));
        those.map(|(_, times)| times.median).min_by(f64::total_cmp)
    }
}
