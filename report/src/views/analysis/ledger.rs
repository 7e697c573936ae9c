//! The ledger as tables: one row per source, followed by their sums.

use abbe::analysis::{Extreme, Figures, Measurand};

use crate::document::Table;
use crate::unit::{self, decimals};
use abbe_study::analyze::{Ledger, LedgerEntry, Report};
use abbe_study::number::{fixed, percent, unbroken};

/// Returns the ledger of position errors as a table.
pub(super) fn ledger(report: &Report) -> Table {
    let tolerance = report.study.tolerance;
    let mut header = vec!["source", ">max", ">RMS", ">share", "worst at (the rest as at home)"];
    if tolerance.is_some() {
        header.insert(3, ">of tolerance");
    }
    let mut rows = Vec::new();
    let Ledger { sources, sums } = &report.ledger;
    for LedgerEntry { name, max, rms, share, configuration, .. } in sources.iter().chain(sums) {
        let at = report
            .configuration(*configuration)
            .filter(|_| *max > 0.0)
            .map(|worst| unbroken(&report.label(worst)));
        let show = |value| fixed(value, decimals(report));
        let mut cells = vec![
            name.clone(),
            show(*max),
            rms.map(show).unwrap_or_default(),
            share.map(|share| percent(share, 1.0)).unwrap_or_default(),
            at.unwrap_or_default(),
        ];
        if let Some(tolerance) = tolerance {
            cells.insert(3, percent(*max, tolerance));
        }
        rows.push(cells);
    }
    let caption = format!(
        "Norms of the errors of the tool point ({}): the largest, the root mean square, and the share of the judged error",
        report.spec.length.symbol()
    );
    Table::listing(caption, &header, rows)
}

/// Returns the ledger of orientation errors in mrad, rows 4–6 and their norm; `None` if no source
/// rotates the tool.
pub(super) fn orientation_ledger(report: &Report) -> Option<Table> {
    let (errors, combined) = report.budget.errors(Measurand::Orientation);
    if combined.worst_case_radius.value == 0.0 {
        return None;
    }
    let mut order = errors.iter().collect::<Vec<_>>();
    order.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    let show = |value| unit::fixed(report, Measurand::Orientation, value);
    let [first, second, third] =
        unit::row_names(report, Measurand::Orientation).map(|name| format!(">{name}"));
    let mut header =
        vec!["source", &first, &second, &third, ">norm", ">RMS", "worst at (the rest as at home)"];
    let tolerance = report.study.orientation_tolerance;
    if tolerance.is_some() {
        header.insert(5, ">of tolerance");
    }
    let row = |name: &str, rows: [Option<f64>; 3], norm: Extreme, rms: Option<f64>| {
        // An error that is constant over the workspace has no worst configuration.
        let varies = norm.value > rms.unwrap_or_default() * (1.0 + 1e-9);
        let at = report.configuration(norm.configuration).filter(|_| varies);
        let mut cells = vec![name.to_owned()];
        cells.extend(rows.map(|row| row.map(show).unwrap_or_default()));
        cells.extend([show(norm.value), rms.map(show).unwrap_or_default()]);
        cells.push(at.map(|worst| unbroken(&report.label(worst))).unwrap_or_default());
        if let Some(tolerance) = tolerance {
            cells.insert(5, percent(norm.value, tolerance));
        }
        cells
    };
    let alone = order.into_iter().map(|alone| {
        let Figures { x, y, z, norm } = alone.plain_max;
        let norm = Extreme { value: norm, configuration: alone.worst };
        row(&report.sources[alone.source].name, [x, y, z].map(Some), norm, Some(alone.rms))
    });
    let [repeatable, random, both] = combined.rms.map(Some);
    let together = [
        row("repeatable, with signs", combined.repeatable.map(Some), combined.repeatable_radius, repeatable),
        row("random, root sum of squares", combined.random.map(Some), combined.random_radius, random),
        row("all together", [None; 3], combined.radius, both),
    ];
    let rows = alone.chain(together).collect();
    let caption = "Rows 4 to 6 of ΔX in mrad, largest over the workspace";
    Some(Table::listing(caption, &header, rows))
}
