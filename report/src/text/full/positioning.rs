//! Every position of a positioning test, as text.

use abbe_metrology::positioning::{PositioningLine, Report};
use abbe_study::number::digits;

use super::Table;

/// Prints the answer, and a table of the positions of the axis or of each diagonal.
pub(in crate::text) fn positioning(report: &Report) -> String {
    let mut text = crate::text::answer::positioning(report);
    for PositioningLine { name, evaluation } in &report.lines {
        let title =
            if name.is_empty() { "Positions".to_owned() } else { format!("Positions of diagonal {name}") };
        let mut table = Table::new(&["P_i", "x̄_i↑", "s_i↑", "x̄_i↓", "s_i↓", "x̄_i", "B_i", "R_i"]);
        for one in &evaluation.positions {
            let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| digits(value, 3));
            let [up, down] = [one.forward, one.reverse];
            table.row([
                digits(one.position, 6),
                number(up.map(|up| up.mean)),
                number(up.and_then(|up| up.standard_deviation)),
                number(down.map(|down| down.mean)),
                number(down.and_then(|down| down.standard_deviation)),
                number(one.mean),
                number(one.reversal),
                number(one.repeatability),
            ]);
        }
        text += &format!(
            "\n{title}, in {}; deviations in {}\n{}",
            report.position_unit,
            report.unit,
            table.right(&[0, 1, 2, 3, 4, 5, 6, 7])
        );
    }
    text
}
