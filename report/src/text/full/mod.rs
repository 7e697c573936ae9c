//! Reports in full: every table and every sentence.

pub(super) mod analysis;
pub(super) mod bound;
pub(super) mod check;
mod compensation;
mod doctor;
mod exported;
pub(super) mod identification;
mod indistinguishable;
pub(super) mod measurement;
pub(super) mod monitoring;
mod plan;
mod positioning;

use super::{Table, listed, wrapped};

pub(super) use analysis::analysis;
pub(super) use bound::bound;
pub(super) use check::check;
pub(super) use compensation::compensation;
pub(super) use doctor::doctor;
pub(super) use exported::exported;
pub(super) use identification::identification;
pub(super) use measurement::measurement;
pub(super) use monitoring::monitoring;
pub(super) use plan::plan;
pub(super) use positioning::positioning;

/// Sets rows below a header.
fn table<const N: usize>(header: &[&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let mut table = Table::new(header);
    rows.for_each(|row| table.row(row));
    table.to_string()
}
