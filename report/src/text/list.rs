//! The shipped manipulators, as text.

use abbe_study::list::ShippedManipulator;

use super::Table;

/// Returns what `abbe list` prints.
pub fn list(shipped: &[ShippedManipulator]) -> String {
    let mut table = Table::new(&["name", "manipulator", "joints", "unit", "sources", "study"]);
    for ShippedManipulator { name, title, joints, length, sources, study, .. } in shipped {
        let study = if *study { "yes" } else { "" };
        table.row([name, title, joints, *length, &sources.to_string(), study]);
    }
    table.right(&[4]).to_string()
}
