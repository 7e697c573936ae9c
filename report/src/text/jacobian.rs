//! Pose, error Jacobian and generalized errors at one configuration, as text.

use std::fmt::Write;

use abbe_study::jacobian::{LegForce, Report};
use abbe_study::number::{self, unbroken};

use super::{Table, wrapped};

/// Returns what `abbe jacobian` prints.
pub fn jacobian(report: &Report) -> String {
    let mut text = String::new();
    let values = number::variables(&report.q, &report.spec);
    let unit = report.length;
    let _ = write!(
        text,
        "{} ({}) at {}\n\n\
         Units      {unit} and rad, in F_0\n\
         Rows       {} of the tool point ({unit}); {} (rad, {})\n\
         Columns    e_x e_y e_z ({unit}), e_s e_r e_p (rad) of each frame: turns about y, z, x\n\n\
         Pose of the tool\n",
        report.spec.title,
        report.name,
        wrapped(&unbroken(&values), 0),
        report.rows[..3].join(", "),
        report.rows[3..].join(", "),
        report.orientation,
    );
    text += &matrix(&report.pose);
    for (i, frame) in report.spec.frames.iter().enumerate() {
        let _ = writeln!(text, "\nFrame {}: {}", i + 1, frame.name);
        let six = 6 * i..6 * (i + 1);
        let mut header = vec![""];
        header.extend(report.columns[six.clone()].iter().map(String::as_str));
        let mut table = Table::new(&header);
        for (name, row) in report.rows.iter().zip(&report.error_jacobian) {
            table.row(cells(name, &row[six.clone()]));
        }
        table.row(cells("ε of the sources", &report.generalized_errors[six]));
        text += &table.right(&[1, 2, 3, 4, 5, 6]).to_string();
    }
    text += "\nError of the tool by the repeatable sources\n";
    let mut table = Table::new(&[&[""][..], &report.rows].concat());
    table.row(cells("ΔX = J_e ε", &report.displacement));
    text += &table.right(&[1, 2, 3, 4, 5, 6]).to_string();
    text += match report.spec.is_serial() {
        true => "\nReal pose of the tool, by the exact chain\n",
        false => "\nReal pose of the tool, exact\n",
    };
    text += &matrix(&report.real_pose);
    if report.leg_forces.iter().any(|one| one.force != 0.0) {
        text += "\nForces that close the loops under the loads; a leg that is pressed has a positive one\n";
        let mut table = Table::new(&["loop", "closes", "force"]);
        for LegForce { name, closes, force } in &report.leg_forces {
            let unit = if closes.starts_with('r') { "N m" } else { "N" };
            table.row(vec![
                name.clone(),
                (*closes).to_owned(),
                format!("{} {unit}", number::fixed(*force, 3)),
            ]);
        }
        text += &table.right(&[2]).to_string();
    }
    text
}

fn matrix(pose: &[[f64; 4]; 4]) -> String {
    let cell = |entry| format!("{:>14}", number::fixed(entry, 6));
    pose.iter().map(|row| row.map(cell).concat() + "\n").collect()
}

fn cells(name: &str, values: &[f64]) -> Vec<String> {
    let values = values.iter().map(|value| number::fixed(*value, 6));
    std::iter::once(name.to_owned()).chain(values).collect()
}
